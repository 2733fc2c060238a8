#include "cli/files_read.h"

#include <system_error>

#include "core/load/scene_file.h"

namespace hybridrt::cli {

namespace fs = std::filesystem;

void add_files_read(const RenderOptions& options, const SceneSource& source, RunFiles& files) {
  if (!source.procedural && source.argument != "-") files.reads(source.argument);
  for (const fs::path& mesh : source.meshes) files.reads(mesh);
  if (!options.camera.empty()) files.reads(options.camera);
  if (!options.config.empty()) files.reads(options.config);
  if (const fs::path camera = camera_file_of(source); !camera.empty()) files.reads(camera);
  std::error_code unreadable;
  if (!options.shaders.empty())
    for (fs::directory_iterator entry(options.shaders, unreadable); !unreadable && entry != fs::directory_iterator();
         entry.increment(unreadable))
      files.reads(entry->path());
}

void add_files_read(const Scene& scene, RunFiles& files) {
  for (const std::string& file : scene.files) files.reads(file);
  for (const Material& material : scene.materials)
    for (const TextureMap& map : material.maps)
      if (!map.path.empty()) files.reads(map.path);
}

}  // namespace hybridrt::cli
