#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/material_kinds.h"
#include "core/procedural/procedural.h"
#include "core/scene/camera_path.h"
#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

/// What a command's SCENE argument means before meshes are read: what the scene is made of, and how it should be seen.
/// What it does not say is empty and left to the command line. Numbers are in the axes of the files.
struct SceneSource {
  std::string argument;  ///< as given, for messages

  const ProceduralScene* procedural = nullptr;  ///< null: `meshes` are read
  SceneValues procedural_values;
  std::vector<std::filesystem::path> meshes;  ///< at least one, or procedural

  std::filesystem::path names_begin_in;   ///< where names in the meshes begin; empty: beside each mesh
  std::shared_ptr<const void> kept_file;  ///< keeps a temporary mesh (spooled_scene.h)

  MaterialKinds kinds;  ///< of the meshes' materials
  std::optional<UpAxis> up_axis;
  std::optional<std::vector<DirectionalLight>> lights;  ///< `toward` unit, at most HRT_MAX_LIGHTS; may be none
  std::optional<vec3> ambient, background;
  /// Render options by their names on the command line, without dashes, and their values as text; "true" for a flag
  /// that is set. Their names are not checked here.
  std::vector<std::pair<std::string, std::string>> settings;

  std::optional<CameraCourse> shot;                ///< how a procedural scene is best looked at
  std::shared_ptr<const nlohmann::json> document;  ///< the parsed scene JSON, for camera_of()
};

/// `argument`: the path of a mesh file or of a scene JSON (scene_file.h), or a procedural scene (procedural.h):
/// `scene:chess`, say, optionally followed by `,KEY=VALUE` for any of its parameters, the last one of a key counts. A
/// scene JSON is read and parsed here and nowhere else. Throws Error (usage) for an unknown scene name, key or value,
/// naming what is allowed; Error (input) for a file that is missing or of a kind that we do not read; and as
/// read_scene_file() does.
SceneSource parse_scene_source(const std::string& argument);

/// What files that are made from the scene are called: its file's name without folder and extension, or the name of a
/// procedural scene.
std::string short_name(const SceneSource& source);

/// The scene's own camera, if it has one. `up` is the axis that points up in its files, after the command line's
/// option. Throws Error (input) as parse_camera() and read_camera_file() do.
std::optional<CameraCourse> camera_of(const SceneSource& source, UpAxis up, Warnings& warnings);

/// Reads the meshes (load_meshes) or makes the scene. `up_axis` replaces the source's. Throws Error (usage) for a
/// procedural scene with an up axis other than y, and Error (input), before reading or making anything, for a scene
/// that would take more than watch.most_bytes of memory.
Scene load_scene(const SceneSource& source, std::optional<UpAxis> up_axis, ThreadPool& pool, Warnings& warnings,
                 const LoadWatch& watch = {});

}  // namespace hybridrt
