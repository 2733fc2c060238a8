#pragma once

#include <optional>
#include <vector>

#include "core/gl/readback.h"
#include "core/passes_gl/id_buffer.h"
#include "core/passes_gl/receiver_depths.h"
#include "core/render/settings.h"

namespace hybridrt {

/// What a warped shadow map is fitted to: all that the whole frame sees, even if only a part is rendered, so that a
/// part has the same pixels as the whole.
class VisibleReceivers {
 public:
  VisibleReceivers(const gl::Functions& gl, const gl::ShaderSources& shaders, const RenderSettings& settings);

  struct In {
    const SceneGpu& scene;
    const IdBufferPass& id_pass;
    const View& view;
    double near_distance;
    const gl::Texture& depth;  ///< the view's depth, from `id_pass`
  };
  /// The points of receiver_hull(). Waits for the GPU.
  std::vector<dvec3> find(const In& in);

 private:
  struct WholeFrame {
    gl::Texture depth;
    gl::Framebuffer target;
  };

  ReceiverDepthsPass pass_;
  gl::Texture blocks_;
  gl::Readback readback_;
  std::optional<WholeFrame> whole_frame_;  ///< if only a part is rendered
};

}  // namespace hybridrt
