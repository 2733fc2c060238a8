#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/file_claims.h"
#include "core/load/scene_source.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// Where the simplified scene goes; claimed until this object's end, so that no two runs write the same files.
struct SimplifyOutput {
  std::filesystem::path obj, mtl;
  std::unique_ptr<FileClaims> claims;
};

/// Before any work. Throws Error(usage) unless the name ends in .obj, and where one of the files is one that the scene
/// was read from, under whatever name; Error(output) for what cannot be written or is being written by another run.
SimplifyOutput prepare_simplify_output(const std::filesystem::path& obj, const SceneSource& source, const Scene& scene);

/// The size of the meshes and materials that the scene was read from; nothing for a scene that was made or came from a
/// pipe.
std::optional<uint64_t> bytes_of_files(const Scene& scene);

/// A scene JSON's lights, cameras and settings are not part of an OBJ.
void warn_of_what_is_not_geometry(const SceneSource& source, const std::filesystem::path& obj, Warnings& warnings);

/// Throws Error(input) unless the memory limit leaves room for simplifying the job's scene and for the scenes before
/// and after, by an estimate.
void require_room_to_simplify(const RenderJob& job, const SceneSource& source);

}  // namespace hybridrt::cli
