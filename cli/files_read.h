#pragma once

#include "cli/render_options.h"
#include "core/base/run_files.h"
#include "core/scene/scene.h"

namespace hybridrt::cli {

/// What is read before the scene is loaded: the scene's file and meshes, camera, settings, shaders.
void add_files_read(const RenderOptions& options, const SceneSource& source, RunFiles& files);

/// What the scene was made of: meshes, MTL files, every texture that they name.
void add_files_read(const Scene& scene, RunFiles& files);

}  // namespace hybridrt::cli
