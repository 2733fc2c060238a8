// Frames that show what the one before shows: they are not rendered, and nothing else is left out.

#include "core/render/still_frames.h"

#include <functional>
#include <gtest/gtest.h>

namespace hybridrt {
namespace {

FrameRequest request(int number, double eye_x = 0) {
  FrameRequest made;
  made.number = number;
  made.camera.eye_world = {eye_x, 1, 5};
  made.lights = {DirectionalLight{}};
  return made;
}

TEST(StillFrames, EverythingButTheNumberCounts) {
  EXPECT_TRUE(shows_the_same(request(1), request(2)));
  const std::vector<std::function<void(FrameRequest&)>> changes = {
      [](FrameRequest& r) { r.camera.eye_world.y = std::nextafter(r.camera.eye_world.y, 2.0); },
      [](FrameRequest& r) { r.camera.target_world.x += 1; },
      [](FrameRequest& r) { r.camera.up.x += 1; },
      [](FrameRequest& r) { r.camera.fov_y_rad += 1e-9; },
      [](FrameRequest& r) { r.lights[0].toward.x += 1e-9; },
      [](FrameRequest& r) { r.lights[0].color.y += 1; },
      [](FrameRequest& r) { r.lights[0].casts_shadow = false; },
      [](FrameRequest& r) { r.lights.clear(); },
      [](FrameRequest& r) { r.lights.emplace_back(); },
      [](FrameRequest& r) { r.light_moves = true; },
      [](FrameRequest& r) { r.sample_offset_px.x = 0.25; }};
  for (size_t i = 0; i < changes.size(); ++i) {
    FrameRequest changed = request(1);
    changes[i](changed);
    EXPECT_FALSE(shows_the_same(request(1), changed)) << i;
  }
}

/// What a renderer that works on `in_flight` frames at once is asked for, and what is delivered.
struct Rendering {
  std::vector<int> rendered, delivered, repeated;
  std::vector<float> pixels;
};

Rendering run(const std::vector<FrameRequest>& requests, size_t in_flight) {
  Rendering result;
  size_t asked = 0;
  const FrameEnds ends = without_repeats(
      [&]() -> std::optional<FrameRequest> {
        if (asked == requests.size()) return std::nullopt;
        return requests[asked++];
      },
      [&](Frame&& frame) {
        result.delivered.push_back(frame.number);
        result.pixels.push_back(frame.picture.data[0]);
        if (frame.repeated) {
          result.repeated.push_back(frame.number);
          EXPECT_EQ(frame.timings.wall_ms, 0);
          EXPECT_EQ(frame.stats.shadow_rays, 0);
          EXPECT_EQ(frame.stats.pixels_hit, 7);
        }
      });
  std::vector<Frame> under_way;
  const auto finish_first = [&] {
    ends.deliver(std::move(under_way.front()));
    under_way.erase(under_way.begin());
  };
  while (const auto request = ends.next()) {
    result.rendered.push_back(request->number);
    Frame frame;
    frame.number = request->number;
    frame.picture = Image(1, 1, 3, static_cast<float>(request->camera.eye_world.x));
    frame.timings.wall_ms = 5;
    frame.stats.shadow_rays = 9, frame.stats.pixels_hit = 7;
    under_way.push_back(std::move(frame));
    if (under_way.size() == in_flight) finish_first();
  }
  while (!under_way.empty()) finish_first();
  return result;
}

TEST(StillFrames, AreRenderedOnceAndDeliveredInOrder) {
  const std::vector<FrameRequest> requests = {request(1, 0), request(2, 0), request(3, 0), request(4, 1),
                                              request(7, 2), request(8, 2), request(9, 0)};
  for (size_t in_flight : {1, 2, 3}) {
    const Rendering made = run(requests, in_flight);
    EXPECT_EQ(made.rendered, (std::vector<int>{1, 4, 7, 9}));
    EXPECT_EQ(made.delivered, (std::vector<int>{1, 2, 3, 4, 7, 8, 9}));
    EXPECT_EQ(made.repeated, (std::vector<int>{2, 3, 8}));
    EXPECT_EQ(made.pixels, (std::vector<float>{0, 0, 0, 1, 2, 2, 0}));
  }
}

TEST(StillFrames, NothingMovesOrEverythingDoes) {
  EXPECT_EQ(run({}, 2).delivered, std::vector<int>{});
  EXPECT_EQ(run({request(1)}, 2).rendered, std::vector<int>{1});
  EXPECT_EQ(run({request(1), request(2), request(3)}, 2).rendered, std::vector<int>{1});
  EXPECT_EQ(run({request(1, 0), request(2, 1), request(3, 2)}, 2).repeated, std::vector<int>{});
}

}  // namespace
}  // namespace hybridrt
