#include "cli/simplify/compare_frames.h"

#include "cli/sweep/loaded_scene.h"
#include "cli/sweep/truth.h"
#include "core/base/check.h"
#include "core/image/compare.h"
#include "core/simplify/silhouette.h"

namespace hybridrt::cli {
namespace {

constexpr size_t kFramesAtOnce = 8;

/// 1 where the frame sees something at the pixel's centre.
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
  return {before.number, compared.psnr_db,
          outline_distance(cover_of(before), cover_of(after), before.picture.width_px)};
}

}  // namespace

std::vector<FrameDifference> compare_frames(RenderJob& before, RenderJob& after, ThreadPool& pool) {
  const KeptJob kept_before{before}, kept_after{after};
  std::vector<FrameDifference> differences;
  RenderSettings settings = before.settings;
  settings.aovs = kAovId;  // of the first sample, which is the pixel's centre
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
    const std::vector<Frame> as_was = render_frames(before, settings, pool),
                             as_is = render_frames(after, settings, pool);
    if (as_was.size() < some.size() || as_is.size() < some.size()) break;  // asked to stop
    for (size_t i = 0; i < some.size(); ++i) differences.push_back(difference_of(as_was[i], as_is[i]));
  }
  return differences;
}

}  // namespace hybridrt::cli
