#pragma once

#include <optional>
#include <vector>

#include "core/gl/readback.h"
#include "core/passes_gl/id_buffer.h"
#include "core/passes_gl/receiver_depths.h"
#include "core/render/settings.h"

namespace hybridrt {

/// What a warped shadow map is fitted to: all that the whole frame sees, whatever part of it is rendered, so that a
/// part has the whole's pixels.
class VisibleReceivers {
 public:
  VisibleReceivers(const gl::Functions& gl, const gl::ShaderSources& shaders, const RenderSettings& settings);

  struct In {
    const SceneGpu& scene;
    const IdBufferPass& id_pass;
    const View& view;
    double near_distance;
    const gl::Texture& depth;  ///< of the view, by `id_pass`
  };
  /// As receiver_hull() has them. Waits for the GPU.
  std::vector<dvec3> find(const In& in);

 private:
  struct WholeFrame {
    gl::Texture depth;
    gl::Framebuffer target;
  };

  ReceiverDepthsPass pass_;
  gl::Texture blocks_;
  gl::Readback readback_;
  std::optional<WholeFrame> whole_frame_;  ///< where only a part is rendered
};

}  // namespace hybridrt
