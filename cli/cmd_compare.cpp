// hybridrt compare: two pictures, their metrics, a verdict.

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/warning_output.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/run_files.h"
#include "core/image/compare.h"
#include "core/image/srgb.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"

namespace hybridrt::cli {
namespace {

constexpr double kDifferenceAmplification = 10;

struct CompareOptions {
  std::string image, reference, diff;
  CompareLimits limits;
  bool json = false;
};

void print_table(const CompareResult& result) {
  if (result.measured) {
    fmt::print("mean absolute error  {:.6g}\n", result.mean_abs_error);
    fmt::print("RMSE                 {:.6g}\n", result.rmse);
    fmt::print("PSNR                 {:.2f} dB\n", result.psnr_db);
    fmt::print("largest error        {:.6g}", result.max_error);
    if (result.max_error > 0) fmt::print(" at ({}, {}), channel {}", result.max_x, result.max_y, result.max_channel);
    fmt::print("\npixels over fail     {} ({:.4g} %)\n", result.pixels_over_fail, result.percent_over_fail());
    fmt::print("pixels over hard     {} ({:.4g} %)\n", result.pixels_over_hard_fail, result.percent_over_hard_fail());
  }
  if (result.same)
    fmt::print("verdict              same\n");
  else
    fmt::print("verdict              differ: {}\n", result.reason);
}

/// Numbers that were not measured are left out; an infinite PSNR is null, as JSON has no infinity.
void print_json(const CompareOptions& options, const CompareResult& result) {
  nlohmann::ordered_json object = {
      {"image", options.image}, {"reference", options.reference}, {"verdict", result.same ? "same" : "differ"}};
  if (!result.same) object["reason"] = result.reason;
  if (result.measured) {
    object["mean_abs_error"] = result.mean_abs_error;
    object["rmse"] = result.rmse;
    if (std::isfinite(result.psnr_db))
      object["psnr_db"] = result.psnr_db;
    else
      object["psnr_db"] = nullptr;
    object["max_error"] = result.max_error;
    object["max_error_at"] = {{"x", result.max_x}, {"y", result.max_y}, {"channel", result.max_channel}};
    object["pixels"] = result.pixels;
    object["pixels_over_fail"] = result.pixels_over_fail;
    object["percent_over_fail"] = result.percent_over_fail();
    object["pixels_over_hard_fail"] = result.pixels_over_hard_fail;
    object["percent_over_hard_fail"] = result.percent_over_hard_fail();
  }
  object["limits"] = {{"fail", options.limits.fail},
                      {"fail_percent", options.limits.fail_percent},
                      {"hard_fail", options.limits.hard_fail}};
  // File names need not be UTF-8.
  fmt::print("{}\n", object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

ExitCode compare(const CompareOptions& options) {
  if (!options.diff.empty()) {  // before the work, not after
    require_writable_format(options.diff);
    RunFiles files;
    files.reads(options.image);
    files.reads(options.reference);
    files.writes(options.diff, "--diff");
  }
  const Image image = read_image(options.image);
  const Image reference = read_image(options.reference);
  const CompareResult result = compare_images(image, reference, options.limits);

  const bool comparable = image.width_px == reference.width_px && image.height_px == reference.height_px &&
                          image.channels == reference.channels;
  if (!options.diff.empty() && comparable) {
    // Differences of stored values are made linear, so that the encoder's curve restores them.
    const Image difference = linear_from_srgb(difference_image(image, reference, kDifferenceAmplification));
    const std::vector<unsigned char> bytes = encode_image(difference, options.diff);
    write_file_atomically(options.diff, std::as_bytes(std::span(bytes)));
  } else if (!options.diff.empty()) {
    warn({WarningCode::difference_unwritten, fmt::format("{} not written: {}", options.diff, result.reason)});
  }

  if (options.json)
    print_json(options, result);
  else
    print_table(result);
  return result.same ? ExitCode::ok : ExitCode::images_differ;
}

/// CLI11's own ranges accept NaN.
CLI::Validator from_zero_to(double most) {
  return CLI::Validator(
      [most](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= most) return "";
        return fmt::format("'{}' is not a number from 0 to {}", text, most);
      },
      "");
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("compare", "Compare an image with a reference: metrics and a verdict");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("IMAGE", options->image, "The image to judge")->required();
  command->add_option("REFERENCE", options->reference, "What it should look like")->required();
  command->add_option("--fail", options->limits.fail, "A pixel fails when a channel is off by more (values 0-1)")
      ->check(from_zero_to(1e6))
      ->capture_default_str();
  command->add_option("--fail-percent", options->limits.fail_percent, "Percentage of the pixels that may fail")
      ->check(from_zero_to(100))
      ->capture_default_str();
  command->add_option("--hard-fail", options->limits.hard_fail, "No pixel may be off by more")
      ->check(from_zero_to(1e6))
      ->capture_default_str();
  command->add_option("--diff", options->diff,
                      fmt::format("Write the difference, amplified {} times", kDifferenceAmplification));
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->footer(
      "Examples:\n"
      "  hybridrt compare out/new.png out/old.png\n"
      "  hybridrt compare out/new.exr truth.exr --fail 0.01 --diff out/difference.png");
  command->callback([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

}  // namespace hybridrt::cli
