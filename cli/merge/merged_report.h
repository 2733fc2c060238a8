#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/merge/joined.h"

namespace hybridrt::cli {

/// The run.json that one run of the whole sequence would have written, beside `timings`: what belongs to a machine is
/// the first shard's, times are sums, memory is the most. Added are `missing` (a frame spec, or null) and `shards`,
/// with what each run says about itself.
nlohmann::ordered_json merged_report(const Joined& joined, const std::string& timings);

}  // namespace hybridrt::cli
