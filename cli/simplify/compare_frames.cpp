#include "cli/simplify/compare_frames.h"

#include "cli/sweep/accuracy.h"
#include "cli/sweep/loaded_scene.h"
#include "core/base/check.h"
#include "core/image/compare.h"
#include "core/simplify/silhouette.h"

namespace hybridrt::cli {
namespace {

constexpr size_t kFramesAtOnce = 8;

/// 1 where the frame sees something; empty if it has no ids.
std::vector<uint8_t> cover_of(const Frame& frame) {
  std::vector<uint8_t> cover;
  for (const ImageLayer& layer : frame.aovs)
    if (layer.name == "id")
      for (uint32_t id : layer.numbers) cover.push_back(id != kNoTriangle);
  return cover;
}

FrameDifference difference_of(const Frame& before, const Frame& after) {
  const CompareResult compared = compare_images(displayed(after.picture), displayed(before.picture));
  HRT_CHECK(compared.measured);
  FrameDifference difference{before.number, compared.psnr_db, std::nullopt};
  if (const std::vector<uint8_t> cover = cover_of(before); !cover.empty())
    difference.outline_px = outline_distance(cover, cover_of(after), before.picture.width_px);
  return difference;
}

}  // namespace

std::vector<FrameDifference> compare_frames(RenderJob& before, RenderJob& after, ThreadPool& pool) {
  const KeptJob kept_before{before}, kept_after{after};
  std::vector<FrameDifference> differences;
  FrameCursor cursor(before.frames);
  for (bool more = true; more;) {
    std::vector<FrameRange> some;
    while (some.size() < kFramesAtOnce && more)
      if (const std::optional<int> frame = cursor.next())
        some.push_back({*frame, *frame, 1});
      else
        more = false;
    if (some.empty()) break;
    before.frames.ranges = after.frames.ranges = some;
    const std::vector<Frame> as_was = render_to_compare(before, pool), as_is = render_to_compare(after, pool);
    if (as_was.size() < some.size() || as_is.size() < some.size()) break;  // asked to stop
    for (size_t i = 0; i < some.size(); ++i) differences.push_back(difference_of(as_was[i], as_is[i]));
  }
  return differences;
}

}  // namespace hybridrt::cli
