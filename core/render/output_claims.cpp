#include "core/render/output_claims.h"

namespace hybridrt {
namespace {

using Answer = FileClaims::Answer;

constexpr int kMostSingleFrames = 1000;  // the kernel keeps its locks in a list

/// The single names that files of a range have, so that other patterns for some of them are noticed.
Answer claim_names(FileClaims& claims, const OutputPattern& pattern, std::string_view aov, const FrameRange& range) {
  const std::filesystem::path folder = common_folder(pattern);
  const auto path = [&](int64_t frame) { return output_path(pattern, frame, aov); };
  if (path(range.first).parent_path() != path(range.last).parent_path()) return Answer::ours;
  const NumberedName first = numbered_name(path(range.first)), last = numbered_name(path(range.last));
  const bool ends_in_number = first.number == range.first && last.number == range.last && first.name == last.name;
  if (ends_in_number && (range.step == 1 || (range.last - range.first) / range.step >= kMostSingleFrames))
    return claims.claim(folder, first.name, range.first, range.last);
  if ((range.last - range.first) / range.step >= kMostSingleFrames) return Answer::ours;
  for (int64_t frame = range.first; frame <= range.last; frame += range.step)
    if (const Answer answer = claims.claim(path(frame)); answer != Answer::ours) return answer;
  return Answer::ours;
}

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

Answer claim_frames(FileClaims& claims, const OutputPattern& pattern, const FrameSpec& frames,
                    const std::vector<std::string_view>& aovs) {
  const bool numbered = output_path(pattern, 1) != output_path(pattern, 2);
  std::vector<std::string_view> pictures{""};
  pictures.insert(pictures.end(), aovs.begin(), aovs.end());
  for (const std::string_view aov : pictures) {
    Answer answer = numbered ? Answer::ours : claims.claim(output_path(pattern, 1, aov));
    for (const FrameRange& range : frames.ranges) {
      if (!numbered || answer != Answer::ours) break;
      if (aov.empty()) answer = claim_range(claims, pattern, range);
      if (answer == Answer::ours) answer = claim_names(claims, pattern, aov, range);
    }
    if (answer != Answer::ours) return answer;
  }
  return Answer::ours;
}

}  // namespace hybridrt
