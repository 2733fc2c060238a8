#include "core/render/frame_spec.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "core/base/error.h"

namespace hybridrt {
namespace {

std::vector<int> frames_of(const std::string& text) {
  std::vector<int> frames;
  FrameCursor cursor(parse_frame_spec(text));
  while (const std::optional<int> frame = cursor.next()) frames.push_back(*frame);
  EXPECT_EQ(cursor.next(), std::nullopt) << "it stays at the end";
  EXPECT_EQ(parse_frame_spec(text).count(), static_cast<int64_t>(frames.size())) << text;
  return frames;
}

std::string refusal(const std::string& text) {
  try {
    parse_frame_spec(text);
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::usage) << text;
    return refused.what();
  }
  return "";
}

using Frames = std::vector<int>;

TEST(FrameSpec, ALoneNumberIsACount) {
  EXPECT_EQ(frames_of("1"), Frames{1});
  EXPECT_EQ(frames_of("4"), (Frames{1, 2, 3, 4}));
  EXPECT_EQ(frames_of("100").size(), 100u);
}

TEST(FrameSpec, Ranges) {
  EXPECT_EQ(frames_of("3-6"), (Frames{3, 4, 5, 6}));
  EXPECT_EQ(frames_of("5-5"), Frames{5});
  EXPECT_EQ(frames_of("1-100:5").size(), 20u);
  EXPECT_EQ(frames_of("1-12:5"), (Frames{1, 6, 11}));
  EXPECT_EQ(frames_of("1-11:5"), (Frames{1, 6, 11}));
  EXPECT_EQ(frames_of("7-9:100"), Frames{7});
}

TEST(FrameSpec, InAListALoneNumberIsThatFrame) {
  EXPECT_EQ(frames_of("1-3,20,30-32"), (Frames{1, 2, 3, 20, 30, 31, 32}));
  EXPECT_EQ(frames_of("9,5"), (Frames{9, 5})) << "the order given";
  EXPECT_EQ(frames_of("1-9:2,2-8:2"), (Frames{1, 3, 5, 7, 9, 2, 4, 6, 8})) << "interleaved, but no frame twice";
}

TEST(FrameSpec, Bounds) {
  const FrameSpec spec = parse_frame_spec("20,30-41:5,3-4");
  EXPECT_EQ(spec.lowest(), 3);
  EXPECT_EQ(spec.highest(), 40);
}

TEST(FrameSpec, NonsenseIsRefusedWithWhatIsAllowed) {
  for (const char* text : {"",     ",",    "1,,2",  "1,",   ",1",    "a",          "1-",
                           "-1",   "1--2", "1-2-3", "1-5:", "1-5:0", "1-5:-1",     "1-5:a",
                           "1.5",  " 1",   "1 ",    "0x10", "0",     "2147483648", "99999999999999999999",
                           "1-5;7"}) {
    const std::string message = refusal(text);
    EXPECT_FALSE(message.empty()) << '\'' << text << "' was accepted";
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_NE(refusal("abc").find("1-100:5"), std::string::npos) << "what is allowed: " << refusal("abc");
}

TEST(FrameSpec, BackwardsRangesAreRefused) {
  EXPECT_NE(refusal("10-1").find("10-1"), std::string::npos);
  EXPECT_FALSE(refusal("1-3,10-9").empty());
}

TEST(FrameSpec, OverlapsAreRefused) {
  for (const char* text : {"1-10,10-20", "1-10,5", "5,5", "1-100:3,4-5", "1-9:2,2-8:2,8", "10-20,1-30", "1-10:3,1-10:7",
                           "1-1000000000,999999999-1000000001", "1-10000000,9999999-20000001",
                           "1-2000000000:3,2-2000000000:1000000007", "5-2000000000:2,7-9"})
    EXPECT_NE(refusal(text).find("overlap"), std::string::npos) << text;
  for (const char* text :
       {"1-10:3,2-10:3,3-9:3", "1-9,10-20", "1-1000000000:2,2-1000000000:2", "1-2000000000:6,2-2000000000:4"})
    EXPECT_EQ(refusal(text), "") << text;
}

TEST(FrameSpec, OverlapsAreFoundExactly) {
  const auto frames = [](const FrameRange& r) {
    std::set<int> all;
    for (int frame = r.first; frame <= r.last; frame += r.step) all.insert(frame);
    return all;
  };
  std::mt19937 random(8);
  for (int i = 0; i < 3000; ++i) {
    FrameRange ranges[2];
    for (FrameRange& r : ranges) {
      r.first = static_cast<int>(random() % 40);
      r.last = r.first + static_cast<int>(random() % 60);
      r.step = 1 + static_cast<int>(random() % 12);
    }
    bool common = false;
    for (int frame : frames(ranges[0])) common |= frames(ranges[1]).contains(frame);
    const std::string text = fmt::format("{}-{}:{},{}-{}:{}", ranges[0].first, ranges[0].last, ranges[0].step,
                                         ranges[1].first, ranges[1].last, ranges[1].step);
    EXPECT_EQ(!refusal(text).empty(), common) << text;
  }
}

// Only the ranges are held: going through a sequence of 10^9 frames takes no memory.
TEST(FrameSpec, ABillionFramesAreStreamed) {
  const FrameSpec spec = parse_frame_spec("1-1000000000");
  EXPECT_EQ(spec.count(), 1'000'000'000);
  EXPECT_EQ(spec.ranges.size(), 1u);
  EXPECT_EQ(parse_frame_spec("1000000000").count(), 1'000'000'000);
  FrameCursor cursor(spec);
  for (int frame = 1; frame <= 5'000'000; ++frame) ASSERT_EQ(cursor.next(), frame);
}

TEST(FrameSpec, TheLargestNumbersDoNotOverflow) {
  EXPECT_EQ(frames_of("2147483645-2147483647"), (Frames{2147483645, 2147483646, 2147483647}));
  EXPECT_EQ(frames_of("2147483640-2147483647:5"), (Frames{2147483640, 2147483645}));
  EXPECT_EQ(parse_frame_spec("1-2147483647").count(), 2147483647);
  EXPECT_EQ(parse_frame_spec("1-2147483647:2147483646").highest(), 2147483647);
}

TEST(Sequence, IsOneRange) {
  EXPECT_EQ(parse_sequence("3-9").first, 3);
  EXPECT_EQ(parse_sequence("3-9").last, 9);
  EXPECT_EQ(parse_sequence("5-5").last, 5);
  for (const char* text : {"", "5", "9-3", "1-5:2", "1-5,7", "1-", "-5", "a-b", "1-2-3"}) {
    EXPECT_THROW(parse_sequence(text), Error) << text;
  }
}

TEST(FrameSpec, WrittenFromFrames) {
  const auto text = [](const Frames& frames) { return text_of(spec_of(frames)); };
  EXPECT_EQ(text({}), "");
  EXPECT_EQ(text({5}), "5-5") << "a lone 5 would be five frames";
  EXPECT_EQ(text({1, 2}), "1-2");
  EXPECT_EQ(text({1, 3}), "1,3");
  EXPECT_EQ(text({1, 3, 5}), "1-5:2");
  EXPECT_EQ(text({1, 2, 4, 6, 8, 9}), "1-2,4-8:2,9");
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    Frames frames;
    const unsigned density = 1 + random() % 4;
    for (int frame = 0; frame < 30; ++frame)
      if (random() % density == 0) frames.push_back(frame);
    if (!frames.empty()) {
      EXPECT_EQ(frames_of(text(frames)), frames) << text(frames);
    }
  }
}

TEST(FrameSpec, NamesOfPartsTellSpecsApart) {
  EXPECT_EQ(name_part_of(parse_frame_spec("1-10")), "0001-0010");
  EXPECT_EQ(name_part_of(parse_frame_spec("5-5")), "0005-0005");
  EXPECT_EQ(name_part_of(parse_frame_spec("1-10:2")), "0001-0009x2");
  EXPECT_EQ(name_part_of(parse_frame_spec("1-10,20,30-40")), "0001-0010+0020+0030-0040");
  const auto long_list = [](int one) {
    std::string list = "1";
    for (int frame = 3; frame < 200; frame += 7) list += fmt::format(",{}", frame == 94 ? one : frame);
    return name_part_of(parse_frame_spec(list));
  };
  EXPECT_TRUE(long_list(94).starts_with("0001-0199+")) << long_list(94);
  EXPECT_LT(long_list(94).size(), 60u);
  EXPECT_NE(long_list(94), long_list(95));
}

}  // namespace
}  // namespace hybridrt
