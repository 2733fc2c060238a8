#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "cli/sweep/loaded_scene.h"

namespace hybridrt::cli {

/// What a sweep's pictures are measured against.
struct TruthOptions {
  int samples = 64;              ///< of the reference; 0: nothing is measured
  std::filesystem::path folder;  ///< the user's own pictures; empty: the reference's are rendered
};

/// A frame as it should be.
struct Truth {
  Image picture;               ///< display values, as an 8-bit file holds them
  std::vector<uint32_t> ids;   ///< of the reference at the pixels' centres; empty if unknown
  std::vector<float> shadow;   ///< the share of the lights that arrives there; empty if unknown
  std::filesystem::path file;  ///< where the picture is kept
};

/// A linear picture as an 8-bit file shows it: display values in 0-1.
Image displayed(const Image& linear);

/// The settings that render the truth of `settings`: method reference with shadow rays and deep reflections.
RenderSettings truth_settings(const RenderSettings& settings, int samples);

/// Finds the truths of a job's frames; keeps the pictures that it renders in `kept`, under the fingerprints of their
/// frames, and the last job's truths in memory. If `kept` is empty no file is read or written.
class TruthStore {
 public:
  /// `tell` is given a line before work that takes long.
  TruthStore(const TruthOptions& options, std::filesystem::path kept, std::function<void(const std::string&)> tell);

  /// One truth per frame of the job, in order; none if nothing is measured. Throws Error(input) where the user's folder
  /// lacks a frame or holds several for it, or a picture that cannot be read.
  const std::vector<Truth>& of(RenderJob& job, ThreadPool& pool);

 private:
  std::vector<Truth> from_folder(const RenderJob& job) const;
  std::vector<Truth> from_reference(RenderJob& job, ThreadPool& pool, const std::vector<uint64_t>& keys) const;

  const TruthOptions options_;
  const std::filesystem::path kept_;
  const std::function<void(const std::string&)> tell_;
  std::vector<uint64_t> keys_;  ///< fingerprints of the frames of truths_
  std::vector<Truth> truths_;
};

}  // namespace hybridrt::cli
