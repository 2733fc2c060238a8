#include "core/load/spooled_scene.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "core/base/error.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

/// A folder that is removed with what it holds.
struct TemporaryFolder {
  fs::path path;
  explicit TemporaryFolder(fs::path made) : path(std::move(made)) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

std::shared_ptr<const TemporaryFolder> make_folder() {
  std::error_code problem;
  std::string name = (fs::temp_directory_path(problem) / "hybridrt-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw error(ErrorKind::output, "{}: no folder can be made for what standard input brings: {}", name,
                std::strerror(errno));
  return std::make_shared<const TemporaryFolder>(name);
}

/// Returns how many bytes came.
size_t copy_standard_input(const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  std::string block(size_t{1} << 20, '\0');
  size_t bytes = 0;
  while (const size_t read = std::fread(block.data(), 1, block.size(), stdin)) {
    file.write(block.data(), static_cast<std::streamsize>(read));
    bytes += read;
  }
  if (std::ferror(stdin)) throw error(ErrorKind::input, "standard input cannot be read: {}", std::strerror(errno));
  file.close();
  if (!file) throw error(ErrorKind::output, "{}: cannot be written; make room, or set TMPDIR", path.string());
  return bytes;
}

}  // namespace

SceneSource read_scene_from_standard_input(MeshFormat format) {
  const std::shared_ptr<const TemporaryFolder> folder = make_folder();
  const fs::path path = folder->path / fmt::format("stdin.{}", name_in(kMeshFormatNames, format));
  if (copy_standard_input(path) == 0)
    throw error(ErrorKind::input, "-: standard input is empty; pipe a mesh into it, or name a file");
  SceneSource source;
  source.argument = std::string("-");
  source.meshes = {path};
  source.names_begin_in = fs::current_path();
  source.kept_file = folder;
  return source;
}

}  // namespace hybridrt
