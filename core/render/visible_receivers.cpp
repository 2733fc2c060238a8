#include "core/render/visible_receivers.h"

#include "core/passes/receiver_hull.h"

namespace hybridrt {
namespace {

int blocks_across(const RenderSettings& s) { return receiver_blocks(s.width_px); }
int blocks_down(const RenderSettings& s) { return receiver_blocks(s.height_px); }

}  // namespace

VisibleReceivers::VisibleReceivers(const gl::Functions& gl, const gl::ShaderSources& shaders, const RenderSettings& s)
    : pass_(gl, shaders),
      blocks_(gl, GL_RG32F, blocks_across(s), blocks_down(s), "receivers' depths"),
      readback_(gl, sizeof(vec2) * blocks_across(s) * blocks_down(s), "reading back the receivers' depths") {
  if (!renders_part(s)) return;
  whole_frame_.emplace();
  whole_frame_->depth = {gl, GL_DEPTH_COMPONENT32F, s.width_px, s.height_px, "the whole frame's depth"};
  whole_frame_->target = {gl, nullptr, whole_frame_->depth, "the whole frame's depth"};
}

std::vector<dvec3> VisibleReceivers::find(const In& in) {
  const View whole = whole_frame_of(in.view);
  if (whole_frame_) in.id_pass.run({in.scene, whole, in.near_distance}, {whole_frame_->target});
  pass_.run({whole_frame_ ? whole_frame_->depth : in.depth, whole.width_px, whole.height_px}, {blocks_});
  readback_.start(blocks_, GL_RG, GL_FLOAT);
  readback_.wait();
  const auto* blocks = static_cast<const vec2*>(readback_.data());
  const size_t count = static_cast<size_t>(receiver_blocks(whole.width_px)) * receiver_blocks(whole.height_px);
  return receiver_hull(whole, in.near_distance, {blocks, count});
}

}  // namespace hybridrt
