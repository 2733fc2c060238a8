#include "core/render/output_claims.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

using Answer = FileClaims::Answer;

TEST(OutputClaims, FramesOfAPattern) {
  const TemporaryFolder temporary;
  const std::string folder = temporary.path.string();
  const auto answer = [](FileClaims& claims, const std::string& pattern, const std::string& frames) {
    const FrameSpec spec = parse_frame_spec(frames);
    return claim_frames(claims, parse_output_pattern(pattern, spec.count() > 1), spec);
  };
  FileClaims one, two;
  EXPECT_EQ(answer(one, folder + "/x.####.png", "1-99:2"), Answer::ours);
  EXPECT_EQ(answer(two, folder + "/x.####.png", "2-100:2"), Answer::ours) << "neighbours";
  EXPECT_EQ(answer(two, folder + "/x.#.png", "2,7,8"), Answer::taken) << "7 is one's, however it is written";
  EXPECT_EQ(answer(one, folder + "/q/{frame}/a.png", "1-10"), Answer::ours);
  EXPECT_EQ(answer(two, folder + "/q/{frame}/a.png", "10-11"), Answer::taken);
  EXPECT_EQ(answer(one, folder + "/one.png", "5-5"), Answer::ours);
  EXPECT_EQ(answer(two, folder + "/one.png", "6-6"), Answer::taken) << "one file, whatever the frame";
}

}  // namespace
}  // namespace hybridrt
