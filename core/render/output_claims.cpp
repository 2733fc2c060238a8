#include "core/render/output_claims.h"

namespace hybridrt {
namespace {

using Answer = FileClaims::Answer;

constexpr int kMostSingleFrames = 1000;  // the kernel keeps its locks in a list

Answer claim_range(FileClaims& claims, const OutputPattern& pattern, const FrameRange& range) {
  const std::filesystem::path folder = common_folder(pattern);
  const std::string name = name_below(pattern);
  if (range.step == 1 || (range.last - range.first) / range.step >= kMostSingleFrames)
    return claims.claim(folder, name, range.first, range.last);
  for (int64_t frame = range.first; frame <= range.last; frame += range.step)
    if (const Answer answer = claims.claim(folder, name, static_cast<int>(frame), static_cast<int>(frame));
        answer != Answer::ours)
      return answer;
  return Answer::ours;
}

}  // namespace

Answer claim_frames(FileClaims& claims, const OutputPattern& pattern, const FrameSpec& frames) {
  if (output_path(pattern, 1) == output_path(pattern, 2)) return claims.claim(output_path(pattern, 1));
  for (const FrameRange& range : frames.ranges)
    if (const Answer answer = claim_range(claims, pattern, range); answer != Answer::ours) return answer;
  return Answer::ours;
}

}  // namespace hybridrt
