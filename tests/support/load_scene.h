#pragma once

#include "core/load/scene_source.h"

namespace hybridrt {

/// Loads the scene of a SCENE argument.
inline Scene load_scene(const std::string& argument, ThreadPool& pool, Warnings& warnings,
                        std::optional<UpAxis> up_axis = std::nullopt, const LoadWatch& watch = {}) {
  return load_scene(parse_scene_source(argument), up_axis, pool, warnings, watch);
}

}  // namespace hybridrt
