#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/frame_spec.h"
#include "core/render/output_pattern.h"

namespace hybridrt::cli {

/// A run that rendered a part of a sequence, by the tables that it left.
struct Shard {
  std::filesystem::path file;  ///< its run.PART.json
  nlohmann::ordered_json report;
  std::filesystem::path folder;  ///< of the pictures, where they are now
  OutputPattern pattern;         ///< of the pictures, as the run was told
  std::string date;              ///< when it ended; compares as text
  FrameRange sequence;
  std::map<int, std::string> fingerprints;  ///< of the frames whose pictures it left
  std::map<int, std::string> rows;          ///< of its timings CSV, by frame
};

/// The parts of sequences whose tables lie in `folder`, by their files' names. Throws Error(input) if there is none, or
/// one that cannot be read.
std::vector<Shard> read_shards(const std::filesystem::path& folder);

/// The shards of each sequence, told apart by their pictures' names.
std::vector<std::vector<Shard>> by_pictures(std::vector<Shard> shards);

/// Throws Error(input), saying what differs, unless all have the same sequence, scene, settings, camera and lights.
void require_one_sequence(const std::vector<Shard>& shards);

}  // namespace hybridrt::cli
