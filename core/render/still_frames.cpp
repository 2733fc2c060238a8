#include "core/render/still_frames.h"

#include <deque>
#include <memory>
#include <utility>

namespace hybridrt {
namespace {

bool same(const Camera& a, const Camera& b) {
  return a.eye_world == b.eye_world && a.target_world == b.target_world && a.up == b.up && a.fov_y_rad == b.fov_y_rad;
}

bool same(const DirectionalLight& a, const DirectionalLight& b) {
  return a.toward == b.toward && a.color == b.color && a.casts_shadow == b.casts_shadow;
}

/// A frame that shows what `frame` shows, for nothing.
Frame repeat(const Frame& frame, int number) {
  Frame again;
  again.number = number;
  again.picture = frame.picture;
  again.aovs = frame.aovs;
  again.repeated = true;
  again.stats.pixels_hit = frame.stats.pixels_hit;
  again.stats.pixels_lit = frame.stats.pixels_lit;
  again.stats.pixels_reflective = frame.stats.pixels_reflective;
  again.stats.pixels_refractive = frame.stats.pixels_refractive;
  return again;
}

struct Sequence {
  NextFrame next;
  std::optional<FrameRequest> ahead;  ///< asked for already
  bool started = false;
  std::deque<std::vector<int>> repeats;  ///< for each frame under way, the numbers that show the same
};

}  // namespace

bool shows_the_same(const FrameRequest& a, const FrameRequest& b) {
  if (!same(a.camera, b.camera) || a.lights.size() != b.lights.size() || a.light_moves != b.light_moves ||
      a.sample_offset_px != b.sample_offset_px)
    return false;
  for (size_t i = 0; i < a.lights.size(); ++i)
    if (!same(a.lights[i], b.lights[i])) return false;
  return true;
}

FrameEnds without_repeats(NextFrame next, DeliverFrame deliver) {
  const auto sequence = std::make_shared<Sequence>();
  sequence->next = std::move(next);
  const auto next_different = [sequence]() -> std::optional<FrameRequest> {
    if (!std::exchange(sequence->started, true)) sequence->ahead = sequence->next();
    std::optional<FrameRequest> request = std::move(sequence->ahead);
    sequence->ahead.reset();
    if (!request) return std::nullopt;
    std::vector<int> repeats;
    while ((sequence->ahead = sequence->next()) && shows_the_same(*request, *sequence->ahead))
      repeats.push_back(sequence->ahead->number);
    sequence->repeats.push_back(std::move(repeats));
    return request;
  };
  const auto deliver_with_repeats = [sequence, deliver = std::move(deliver)](Frame&& frame) {
    const std::vector<int> repeats = std::move(sequence->repeats.front());
    sequence->repeats.pop_front();
    if (repeats.empty()) return deliver(std::move(frame));
    const Frame kept = frame;
    deliver(std::move(frame));
    for (int number : repeats) deliver(repeat(kept, number));
  };
  return {next_different, deliver_with_repeats};
}

}  // namespace hybridrt
