#include "core/render/picture_files.h"

#include <charconv>
#include <set>
#include <system_error>

#include "core/base/real_path.h"
#include "core/render/settings.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

bool holds(const FrameSpec& frames, int frame) {
  for (const FrameRange& range : frames.ranges)
    if (range.first <= frame && frame <= range.last && (frame - range.first) % range.step == 0) return true;
  return false;
}

/// The frames whose numbers stand anywhere in `text`, parts of longer numbers too.
void add_frames_in(const std::string& text, const FrameSpec& frames, std::set<int>& found) {
  constexpr size_t kMostDigits = 10;
  const auto is_digit = [&](size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  for (size_t begin = 0; begin < text.size(); ++begin)
    for (size_t end = begin; is_digit(end); ++end) {
      const size_t zeros = std::min(text.find_first_not_of('0', begin), end);
      int frame = 0;
      if (end - zeros >= kMostDigits) break;
      const auto [stop, problem] = std::from_chars(text.data() + begin, text.data() + end + 1, frame);
      if (problem == std::errc() && holds(frames, frame)) found.insert(frame);
    }
}

std::set<int> frames_to_try(const RunFiles& files, const OutputPattern& pattern, const FrameSpec& frames) {
  std::set<int> found{frames.lowest()};
  for (const fs::path& path : files.paths()) {
    add_frames_in(path.string(), frames, found);
    add_frames_in(real_path(path).string(), frames, found);
  }
  std::error_code unreadable;
  fs::directory_iterator entry(common_folder(pattern), unreadable);
  for (; !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable))
    add_frames_in(entry->path().filename().string(), frames, found);
  return found;
}

}  // namespace

std::vector<std::string_view> aov_names(uint32_t aovs) {
  std::vector<std::string_view> names;
  for (const Named<uint32_t>& aov : kAovs)
    if (aovs & aov.value) names.push_back(aov.name);
  return names;
}

void require_pictures_unused(const RunFiles& files, const OutputPattern& pattern, const FrameSpec& frames,
                             const std::vector<std::string_view>& aovs) {
  for (const int frame : frames_to_try(files, pattern, frames)) {
    files.require_unused(output_path(pattern, frame), "the picture");
    for (const std::string_view aov : aovs) files.require_unused(output_path(pattern, frame, aov), "the AOV");
  }
}

}  // namespace hybridrt
