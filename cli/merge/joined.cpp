#include "cli/merge/joined.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"
#include "core/render/picture_record.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

fs::path picture_of(const Shard& shard, int frame, const std::string& aov) {
  const fs::path then = output_path(shard.pattern, frame, aov);
  return shard.folder / then.lexically_relative(common_folder(shard.pattern));
}

/// What made the picture, if it is whole and of that fingerprint.
std::optional<std::string> maker_of(const fs::path& picture, const std::string& fingerprint) {
  std::error_code unreachable;
  if (!fs::is_regular_file(picture, unreachable)) return std::nullopt;
  std::istringstream description(keeps_metadata(picture.string()) ? read_description(picture) : read_record(picture));
  std::string maker, line;
  bool is_of_frame = false;
  while (std::getline(description, line)) {
    if (line == "fingerprint=" + fingerprint) is_of_frame = true;
    const bool tells = line.starts_with("hybridrt=") || line.starts_with("form=") || line.starts_with("layers=");
    if (tells) maker += (maker.empty() ? "" : ", ") + line;
  }
  if (!is_of_frame) return std::nullopt;
  return maker;
}

/// Of a frame: its picture and the AOVs that are files beside it.
std::optional<std::string> maker_of_frame(const Shard& shard, int frame) {
  const std::string& fingerprint = shard.fingerprints.at(frame);
  const std::optional<std::string> maker = maker_of(picture_of(shard, frame, ""), fingerprint);
  if (!maker || keeps_layers(shard.pattern.name)) return maker;
  for (const auto& aov : shard.report.at("settings").at("aovs"))
    if (maker_of(picture_of(shard, frame, aov.get<std::string>()), fingerprint) != maker) return std::nullopt;
  return maker;
}

}  // namespace

Joined join(std::vector<Shard> shards, ThreadPool& pool) {
  Joined joined;
  const auto first_frame = [](const Shard& shard) {
    return shard.fingerprints.empty() ? shard.sequence.last : shard.fingerprints.begin()->first;
  };
  std::stable_sort(shards.begin(), shards.end(),
                   [&](const Shard& a, const Shard& b) { return first_frame(a) < first_frame(b); });
  joined.shards = std::move(shards);

  std::map<int, size_t> claimed;
  for (size_t i = 0; i < joined.shards.size(); ++i)
    for (const auto& [frame, fingerprint] : joined.shards[i].fingerprints) {
      const auto [known, is_new] = claimed.emplace(frame, i);
      if (!is_new && joined.shards[known->second].date <= joined.shards[i].date) known->second = i;
    }

  const std::vector<std::pair<int, size_t>> candidates(claimed.begin(), claimed.end());
  std::vector<std::optional<std::string>> found(candidates.size());
  parallel_for(pool, candidates.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      found[i] = maker_of_frame(joined.shards[candidates[i].second], candidates[i].first);
  });

  std::map<std::string, std::vector<int>> makers;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto [frame, shard] = candidates[i];
    if (!found[i]) continue;
    joined.whose[frame] = shard;
    makers[*found[i]].push_back(frame);
    if (!joined.shards[shard].rows.contains(frame)) joined.without_times.push_back(frame);
  }
  joined.makers.assign(makers.begin(), makers.end());
  std::stable_sort(joined.makers.begin(), joined.makers.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  for (int64_t frame = joined.sequence().first; frame <= joined.sequence().last; ++frame)
    if (!joined.whose.contains(static_cast<int>(frame))) joined.missing.push_back(static_cast<int>(frame));
  return joined;
}

}  // namespace hybridrt::cli
