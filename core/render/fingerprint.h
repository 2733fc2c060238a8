#pragma once

#include <cstdint>

#include "core/gl/program.h"
#include "core/render/frame_plan.h"

namespace hybridrt {

/// A 64-bit number that changes with anything in the scene that decides pixels. Not cryptographic.
uint64_t fingerprint(const Scene& scene);

/// The same for the shaders' texts.
uint64_t fingerprint(const gl::ShaderSources& shaders);

/// The same for a frame's camera, lights and settings on top of a scene's fingerprint.
uint64_t fingerprint(uint64_t scene, const FrameRequest& request, const RenderSettings& settings);

}  // namespace hybridrt
