#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/merge/shard.h"
#include "core/base/parallel.h"

namespace hybridrt::cli {

/// A sequence put together from its shards.
struct Joined {
  std::vector<Shard> shards;    ///< by their first frames
  std::map<int, size_t> whose;  ///< the frames that are there, each with the shard that made it last
  std::vector<int> missing;     ///< frames of the sequence without a whole picture that a shard vouches for
  std::vector<int> without_times;

  /// What made the pictures, by what they say themselves (version, form, OpenGL, rays), with the frames; the one of
  /// most frames first.
  std::vector<std::pair<std::string, std::vector<int>>> makers;

  const FrameRange& sequence() const { return shards.front().sequence; }
};

/// Looks at every picture's header, on the threads of `pool`. `shards`: at least one, of one sequence.
Joined join(std::vector<Shard> shards, ThreadPool& pool);

}  // namespace hybridrt::cli
