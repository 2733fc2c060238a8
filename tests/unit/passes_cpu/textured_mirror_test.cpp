// A texture in a mirror is filtered for the whole path: as if seen from the mirror image of the eye.

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/kd_caster.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

constexpr int kSide_px = 48;

Scene ceiling(bool with_mirror) {
  const TemporaryFolder folder;
  folder.write("noise.png", "x");
  folder.write("a.mtl", "newmtl lamp\nKd 0\nmap_Ke -s 20 20 noise.png\nnewmtl mirror\nKd 0\nKs 1\nillum 3\n");
  const std::string floor = "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nusemtl mirror\nf -1 -2 -3 -4\n";
  const std::filesystem::path obj =
      folder.write("a.obj",
                   "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nv -9 2 -9\nv 9 2 -9\nv 9 2 9\nv -9 2 9\n"
                   "usemtl lamp\nf 1/1 2/2 3/3 4/4\n" +
                       (with_mirror ? floor : std::string()));
  LoadWatch watch;
  watch.textures = texel_files(pattern_named);
  ThreadPool pool(1);
  Warnings warnings;
  return load_scene(obj.string(), pool, warnings, std::nullopt, watch);
}

/// What an eye at height `eye_y` sees along y; x is to the right of the picture, -z its top.
std::vector<vec4> seen(const Scene& scene, double eye_y, double along) {
  View view;
  view.width_px = view.frame_width_px = view.height_px = view.frame_height_px = kSide_px;
  view.eye = {0.3, eye_y, 0.4};
  view.right = {1, 0, 0}, view.up = {0, 0, -1}, view.forward = {0, along, 0};
  TraceJob job{scene, view, {}, /*shadows=*/false};
  ThreadPool pool(1);
  const KdTree tree = build_kd_tree(scene, pool);
  std::vector<vec4> picture(kSide_px * kSide_px);
  std::vector<uint32_t> ids(picture.size());
  trace_frame(job, *make_reference_caster(tree), pool, TracedFrame<double>{picture, ids, {}});
  return picture;
}

TEST(TexturedMirror, ShowsTheTextureAsFromBehindIt) {
  const auto reflected = seen(ceiling(true), 1, -1), direct = seen(ceiling(false), -1, 1),
             nearer = seen(ceiling(false), 1, 1);
  float contrast = 0, gap = 0;
  for (size_t i = 0; i < direct.size(); ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflected[i][c], direct[i][c], 1e-5f) << i;
    contrast = std::max(contrast, std::abs(direct[i].x - direct[0].x));
    gap = std::max(gap, std::abs(nearer[i].x - direct[i].x));
  }
  EXPECT_GT(contrast, 0.01f) << "a texture, not a plain colour";
  EXPECT_GT(gap, 0.01f) << "distance matters";
}

}  // namespace
}  // namespace hybridrt
