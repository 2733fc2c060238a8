#include "core/load/spooled_scene.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/given_descriptor.h"
#include "core/base/input_file.h"
#include "core/base/temporary_names.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

/// A folder that is removed with what it holds.
struct TemporaryFolder {
  fs::path path, file;
  TemporaryName kept_folder, kept_file;
  TemporaryFolder(const fs::path& made, const std::string& name)
      : path(made),
        file(made / name),
        kept_folder(path, TemporaryName::Kind::folder),
        kept_file(file, TemporaryName::Kind::file) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

std::shared_ptr<const TemporaryFolder> make_folder(const std::string& file) {
  std::error_code problem;
  std::string name = (fs::temp_directory_path(problem) / "hybridrt-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw error(ErrorKind::output, "{}: no folder can be made for what standard input brings: {}", name,
                std::strerror(errno));
  return std::make_shared<const TemporaryFolder>(name, file);
}

/// Returns how many bytes came.
size_t copy_input(int descriptor, const std::string& name, const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  std::string block(size_t{1} << 20, '\0');
  size_t bytes = 0;
  while (const size_t read = read_some(descriptor, block.data(), block.size(), name)) {
    file.write(block.data(), static_cast<std::streamsize>(read));
    bytes += read;
  }
  file.close();
  if (!file) throw error(ErrorKind::output, "{}: cannot be written; make room, or set TMPDIR", path.string());
  return bytes;
}

}  // namespace

SceneSource read_piped_scene(const std::string& argument, MeshFormat format) {
  const int descriptor = argument == "-" ? STDIN_FILENO : descriptor_named_by(argument).value();
  const std::string name = descriptor == STDIN_FILENO ? "standard input" : argument;
  const std::shared_ptr<const TemporaryFolder> folder =
      make_folder(fmt::format("stdin.{}", name_in(kMeshFormatNames, format)));
  const fs::path path = folder->file;
  if (copy_input(descriptor, name, path) == 0)
    throw error(ErrorKind::input, "{}: {} is empty; pipe a mesh into it, or name a file", argument, name);
  SceneSource source;
  source.argument = std::string("-");
  source.meshes = {path};
  source.names_begin_in = fs::current_path();
  source.kept_file = folder;
  return source;
}

}  // namespace hybridrt
