#include "cli/sweep/visit_frames.h"

#include <gtest/gtest.h>
#include <vector>

namespace hybridrt::cli {
namespace {

std::vector<int> numbers_of(const FrameSpec& spec) {
  std::vector<int> numbers;
  for (const FrameRange& range : spec.ranges)
    for (int n = range.first; n <= range.last; n += range.step) numbers.push_back(n);
  return numbers;
}

TEST(VisitFrames, AFrameComesOnceMoreForWhatIsMadeOnce) {
  const VisitFrames visit = frames_of_visit(parse_frame_spec("5-5"), 1);
  EXPECT_EQ(numbers_of(visit.frames), (std::vector{5, 5}));
  EXPECT_EQ(visit.before, 1u);
}

TEST(VisitFrames, SeveralFollowTheirLast) {
  const VisitFrames visit = frames_of_visit(parse_frame_spec("1-9:3,20"), 1);
  EXPECT_EQ(numbers_of(visit.frames), (std::vector{7, 20, 1, 4, 7, 20}));
  EXPECT_EQ(visit.before, 2u);
}

// Frames that fill the slots, and those that empty them, leave together: they do not count.
TEST(VisitFrames, AsManyComeBeforeAndAfterAsThereAreFramesInFlight) {
  for (const size_t in_flight : {1, 2, 4, 16}) {
    const VisitFrames visit = frames_of_visit(parse_frame_spec("1-8:3"), static_cast<int>(in_flight));
    const std::vector<int> numbers = numbers_of(visit.frames);
    EXPECT_EQ(visit.before, in_flight + 1);
    ASSERT_EQ(numbers.size(), visit.before + 3 + in_flight - 1);
    for (size_t i = 1; i < numbers.size(); ++i)
      EXPECT_EQ(numbers[i], numbers[i - 1] == 7 ? 1 : numbers[i - 1] + 3) << "no frame follows itself";
    EXPECT_EQ(numbers[visit.before], 1);
  }
}

}  // namespace
}  // namespace hybridrt::cli
