#pragma once

#include "core/passes/receiver_hull.h"
#include "core/passes_gl/id_buffer.h"
#include "core/passes_gl/receiver_depths.h"
#include "core/render/frame_plan.h"
#include "core/trace/kd_caster.h"
#include "core/trace/triangle.h"
#include "tests/gl/gl_test.h"
#include "tests/support/built_normals.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {

/// Adds what shading reads to a scene of bare triangles: one grey material and each face's normal.
inline Scene with_normals(Scene scene) {
  std::erase_if(scene.triangle_positions, [&](const uvec3& t) {
    return is_degenerate(scene.positions[t[0]], scene.positions[t[1]], scene.positions[t[2]]);
  });
  scene.materials = {Material{}};
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  return with_built_normals(std::move(scene));
}

/// Slightly from above, `distance` box diagonals from the middle.
inline Camera camera_at_angle(const Scene& scene, double angle, double distance) {
  const dvec3 middle = scene.origin_world + dvec3(scene.bounds.center());
  const double away = distance * glm::length(dvec3(scene.bounds.extent()));
  return {middle + away * dvec3(std::sin(angle), 0.4, std::cos(angle)), middle, {0, 1, 0}, 0.7};
}

/// Everything that passes 2 to 5 read of a scene and a view, with pass 2's ids drawn.
struct SeenScene {
  SeenScene(const gl::Context& context, const Scene& scene, const View& view_, double near_distance)
      : gl(context.functions()),
        view(view_),
        gpu(context, scene),
        ids(gl, GL_R32UI, view.width_px, view.height_px, "ids"),
        depth(gl, GL_DEPTH_COMPONENT32F, view.width_px, view.height_px, "depth"),
        target(gl, &ids, depth, "ids") {
    IdBufferPass(gl, gl::embedded_shaders()).run({gpu, view, near_distance}, {target});
  }
  std::vector<uint32_t> read_ids() const {
    return read_pixels<uint32_t>(gl, ids, view.width_px, view.height_px, GL_RED_INTEGER, GL_UNSIGNED_INT);
  }
  std::vector<dvec3> receivers(double near_distance) const {
    const int across = receiver_blocks(view.width_px), down = receiver_blocks(view.height_px);
    const gl::Texture blocks(gl, GL_RG32F, across, down, "blocks");
    ReceiverDepthsPass(gl, gl::embedded_shaders()).run({depth, view.width_px, view.height_px}, {blocks});
    return receiver_hull(view, near_distance, read_pixels<vec2>(gl, blocks, across, down, GL_RG, GL_FLOAT));
  }

  const gl::Functions& gl;
  View view;
  SceneGpu gpu;
  gl::Texture ids, depth;
  gl::Framebuffer target;
};

/// Primary rays in double against a kd-tree: the truth that the ids are measured by.
class PrimaryRays {
 public:
  explicit PrimaryRays(const Scene& scene)
      : pool_(2), tree_(build_kd_tree(scene, pool_)), caster_(make_reference_caster(tree_)) {}

  /// The triangle seen (`dx`, `dy`) pixels away from the centre of pixel (x, y).
  uint32_t triangle_at(const View& view, int x, int y, double dx = 0, double dy = 0) const {
    const Ray<double> ray{view.eye, view.pixel_dir(x, y) + dx * view.ray_step_x() + dy * view.ray_step_y()};
    return closest(ray).triangle;
  }
  Hit<double> closest(const Ray<double>& ray) const {
    Hit<double> hit;
    caster_->closest_hits({&ray, 1}, {&hit, 1});
    return hit;
  }
  bool occluded(const Ray<double>& ray) const {
    uint8_t hit = 0;
    caster_->any_hits({&ray, 1}, {&hit, 1});
    return hit != 0;
  }

 private:
  ThreadPool pool_;
  KdTree tree_;
  std::unique_ptr<RayCaster<double>> caster_;
};

}  // namespace hybridrt
