#include "cli/sweep/truth.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <span>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image/srgb.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"
#include "core/render/fingerprint.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kTruthDepth = 64;

float of_code(uint8_t code) { return code / 255.0f; }

std::vector<int> frames_of(const RenderJob& job) {
  std::vector<int> frames;
  FrameCursor cursor(job.frames);
  while (const std::optional<int> frame = cursor.next()) frames.push_back(*frame);
  return frames;
}

std::vector<uint64_t> truth_keys(const RenderJob& job, int samples) {
  const RenderSettings settings = truth_settings(job.settings, samples);
  const uint64_t scene = fingerprint(job.scene);
  std::vector<uint64_t> keys;
  for (int frame : frames_of(job)) keys.push_back(fingerprint(scene, frame_request(job, frame), settings));
  return keys;
}

/// Whether the last number in a file's name is the frame's: 7 of car.0007.
bool names_frame(const std::string& stem, int frame) {
  const size_t end = stem.find_last_of("0123456789");
  if (end == stem.npos) return false;
  const size_t before = stem.find_last_not_of("0123456789", end);
  const size_t start = before == stem.npos ? 0 : before + 1;
  int number = 0;
  const auto read = std::from_chars(&stem[start], &stem[end] + 1, number);
  return read.ec == std::errc{} && number == frame;
}

fs::path file_of_frame(const fs::path& folder, int frame) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && can_write_format(entry.path().string()) &&
        names_frame(entry.path().stem().string(), frame))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.empty())
    throw error(ErrorKind::input, "--truth {}: holds no picture of frame {}; name it like truth.{:04}.png",
                folder.string(), frame, frame);
  if (found.size() > 1)
    throw error(ErrorKind::input, "--truth {}: both {} and {} may be frame {}; leave one", folder.string(),
                found[0].filename().string(), found[1].filename().string(), frame);
  return found[0];
}

/// A picture as an 8-bit file of display values holds it; files of floats are linear.
Image read_displayed(const fs::path& file) {
  Image stored = read_image(file);
  if (keeps_layers(file.string()) || file.extension() == ".hdr") return displayed(stored);
  for (float& value : stored.data)
    value = of_code(static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))));
  return stored;
}

}  // namespace

Image displayed(const Image& linear) {
  Image result = Image::uninitialized(linear.width_px, linear.height_px, linear.channels);
  const std::vector<uint8_t> codes = srgb8_from_linear(linear);
  std::transform(codes.begin(), codes.end(), result.data.begin(), of_code);
  return result;
}

RenderSettings truth_settings(const RenderSettings& settings, int samples) {
  RenderSettings truth;
  truth.width_px = settings.width_px, truth.height_px = settings.height_px;
  truth.crop = settings.crop;
  truth.ambient = settings.ambient, truth.background = settings.background;
  truth.alpha = settings.alpha;
  truth.method = Method::reference;
  truth.shadows = ShadowMode::rays;
  truth.reflection_depth = kTruthDepth;
  truth.samples = samples;
  return truth;
}

TruthStore::TruthStore(const TruthOptions& options, fs::path kept, std::function<void(const std::string&)> tell)
    : options_(options), kept_(std::move(kept)), tell_(std::move(tell)) {
  if (!options_.folder.empty() && !fs::is_directory(options_.folder))
    throw error(ErrorKind::input, "--truth {}: is no folder; name the one that holds the frames",
                options_.folder.string());
}

const std::vector<Truth>& TruthStore::of(RenderJob& job, ThreadPool& pool) {
  if (options_.samples == 0 && options_.folder.empty()) return truths_;
  std::vector<uint64_t> keys = truth_keys(job, options_.samples);
  if (keys == keys_) return truths_;
  keys_.clear();
  truths_.clear();  // before the next ones take memory
  truths_ = options_.folder.empty() ? from_reference(job, pool, keys) : from_folder(job);
  keys_ = std::move(keys);
  return truths_;
}

std::vector<Truth> TruthStore::from_folder(const RenderJob& job) const {
  std::vector<Truth> truths;
  for (int frame : frames_of(job)) {
    Truth& truth = truths.emplace_back();
    truth.file = file_of_frame(options_.folder, frame);
    truth.picture = read_displayed(truth.file);
  }
  return truths;
}

std::vector<Truth> TruthStore::from_reference(RenderJob& job, ThreadPool& pool,
                                              const std::vector<uint64_t>& keys) const {
  std::vector<Truth> truths(keys.size());
  bool all_kept = true;
  for (size_t i = 0; i < keys.size(); ++i) {
    truths[i].file = kept_ / fmt::format("{:016x}.png", keys[i]);
    all_kept = all_kept && !kept_.empty() && fs::exists(truths[i].file);
  }
  // Ids and shadows are those of the first sample, so a picture that is kept needs that one only.
  RenderSettings settings = truth_settings(job.settings, all_kept ? 1 : options_.samples);
  settings.aovs = kAovId | kAovShadow;
  if (!all_kept)
    tell_(fmt::format("rendering the truth: {} frame{} with {} sample{} a pixel in double precision", keys.size(),
                      keys.size() == 1 ? "" : "s", settings.samples, settings.samples == 1 ? "" : "s"));
  std::vector<Frame> frames = render_frames(job, settings, pool);
  if (frames.size() != keys.size()) return {};  // stopped
  for (size_t i = 0; i < keys.size(); ++i) {
    for (ImageLayer& aov : frames[i].aovs)
      if (aov.name == "id")
        truths[i].ids = std::move(aov.numbers);
      else
        truths[i].shadow = std::move(aov.values);
    if (kept_.empty()) {
      truths[i].picture = displayed(frames[i].picture);
      continue;
    }
    if (!all_kept) {
      const std::vector<unsigned char> bytes = encode_image(frames[i].picture, "png");
      write_file_atomically(truths[i].file, std::as_bytes(std::span(bytes)));
    }
    truths[i].picture = read_displayed(truths[i].file);
  }
  return truths;
}

}  // namespace hybridrt::cli
