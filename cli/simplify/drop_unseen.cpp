#include "cli/simplify/drop_unseen.h"

#include <algorithm>

#include "cli/interrupt.h"
#include "cli/simplify/path_bounds.h"
#include "core/base/error.h"
#include "core/render/samples.h"
#include "core/simplify/corners.h"
#include "core/simplify/seen_triangles.h"

namespace hybridrt::cli {

Scene without_unseen(const RenderJob& job, ThreadPool& pool) {
  const int depth = job.settings.method == Method::raster ? 0 : job.settings.reflection_depth;
  SeenTriangles seen(job.scene, depth, pool);
  FrameCursor cursor(job.frames);
  while (const std::optional<int> frame = cursor.next()) {
    Sight sight = sight_of(job, *frame);
    for (int sample = 0; sample < std::max(kSeenSamples, job.settings.samples); ++sample) {
      if (stop_requested()) return job.scene;
      sight.view.sample_px = sample_offset_px(sample);
      seen.look(sight);
    }
  }
  if (seen.seen_count() == 0)
    throw error(ErrorKind::input, "no frame sees any triangle; look at the camera options, or leave out --drop-unseen");
  const std::vector<uint8_t> kept = seen.kept(job.topology);
  std::vector<CornerTriangle> triangles;
  for (uint32_t t = 0; t < kept.size(); ++t)
    if (kept[t]) triangles.push_back(as_it_is(t));
  return scene_of_corners(job.scene, triangles);
}

}  // namespace hybridrt::cli
