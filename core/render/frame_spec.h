#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hybridrt {

/// first, first + step, … up to last (inclusive).
struct FrameRange {
  int first = 1, last = 1, step = 1;
};

/// The frames to render: ranges that do not overlap, in the given order.
struct FrameSpec {
  std::vector<FrameRange> ranges{{1, 1, 1}};

  int64_t count() const;
  int lowest() const;
  int highest() const;
};

/// `100` = 1-100; `1-100`, `1-100:5`, `1-10,20,30-40` (in a list a lone N is that frame; `5-5` is one frame). Throws
/// Error(usage) naming what is wrong and what is allowed.
FrameSpec parse_frame_spec(const std::string& text);

/// The spec of these frames, which ascend: as few ranges, some with a step, as going through them once gives.
FrameSpec spec_of(const std::vector<int>& frames);

/// parse_frame_spec() gives the spec back: `1-100:5`, `1-10,20`, `5-5`.
std::string text_of(const FrameSpec& spec);

/// The frames in a file's name: `0001-0010`, `0001-0009x2`, `0001-0010+0020`. Of many ranges the lowest and highest
/// frame and a hash of them all, so that different specs have different names.
std::string name_part_of(const FrameSpec& spec);

/// `A-B` with A <= B.
FrameRange parse_sequence(const std::string& text);

/// Goes through a spec without listing its frames.
class FrameCursor {
 public:
  explicit FrameCursor(FrameSpec spec) : spec_(std::move(spec)) {}
  std::optional<int> next();

 private:
  FrameSpec spec_;
  size_t range_ = 0;
  int64_t offset_ = 0;
};

}  // namespace hybridrt
