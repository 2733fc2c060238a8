#include <algorithm>
#include <fmt/format.h>

#include "cli/golden/golden_case.h"
#include "cli/standard_streams.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/output_file.h"
#include "core/image/srgb.h"
#include "core/image_io/read_image.h"

// The commands that write the list and its expected pictures.

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

std::vector<GoldenOutput> outputs_of(const GoldenList& list) {
  RunFiles files = files_of(list);
  std::vector<GoldenOutput> outputs;
  for (const GoldenCase& golden : list.cases) {
    outputs.push_back({list.expected(golden.name), "the expected picture"});
    files.writes(outputs.back().path, outputs.back().what);
  }
  return outputs;
}

/// As a PNG keeps it, and read_image() gives it back.
Image as_stored(const Image& picture) {
  Image stored(picture.width_px, picture.height_px, picture.channels);
  const std::vector<uint8_t> values = srgb8_from_linear(picture);
  std::ranges::transform(values, stored.data.begin(), [](uint8_t value) { return static_cast<float>(value) / 255; });
  return stored;
}

/// What replacing the expected picture changes.
std::string change_text(const fs::path& expected, const Image& picture) {
  if (!fs::exists(expected)) return "new";
  try {
    constexpr double kRounding = 1e-6;
    const CompareResult compared = compare_images(as_stored(picture), read_image(expected), {kRounding, 0, kRounding});
    if (compared.same) return "unchanged";
    if (!compared.measured) return "changed: " + compared.reason;
    return fmt::format("changed: {:.3f} % of the pixels, by at most {:.4f}", compared.percent_over_fail(),
                       compared.max_error);
  } catch (const Error& problem) {
    return fmt::format("changed: the old one cannot be read ({})", problem.what());
  }
}

/// Says what changes, then replaces what does.
void replace(const fs::path& expected, const Image& picture) {
  const std::string change = change_text(expected, picture);
  fmt::print("{}: {}\n", expected.string(), in_one_line(change));
  flush_output();
  if (change != "unchanged") write_picture(expected, picture);
}

void update_case(const GoldenList& list, const GoldenCase& golden, const GoldenOptions& options,
                 const std::vector<GoldenOutput>& outputs) {
  try {
    const CaseJob job = make_case_job(golden, options, outputs);
    render_case(golden, job,
                [&](const std::string& name, const Image& picture) { replace(list.expected(name), picture); });
  } catch (const Error& problem) {
    throw error(problem.kind(), "golden case '{}': {}", golden.name, problem.what());
  }
}

}  // namespace

ExitCode golden_update(const GoldenOptions& options) {
  GoldenList list = read_golden_list(list_of(options));
  keep_cases(list, options.names);
  const std::vector<GoldenOutput> outputs = outputs_of(list);
  for (const GoldenCase& golden : list.cases) update_case(list, golden, options, outputs);
  return ExitCode::ok;
}

ExitCode golden_init(const fs::path& folder) {
  const fs::path list = folder / "golden.json";
  if (fs::exists(list))
    throw error(ErrorKind::usage, "{} is there already; 'hybridrt golden add' adds to it", list.string());
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw error(ErrorKind::output, "cannot make the folder {}: {}", folder.string(), problem.message());
  write_file_atomically(list, std::string_view("{\n \"cases\": []\n}\n"));
  fmt::print("wrote {}; next: hybridrt golden add NAME SCENE --list {}\n", list.string(), list.string());
  return ExitCode::ok;
}

ExitCode golden_add(const GoldenAddition& addition) {
  GoldenOptions given;
  given.list = addition.list;
  const fs::path file = list_of(given);
  if (!fs::exists(file))
    throw error(ErrorKind::input, "{}: no such golden list; 'hybridrt golden init {}' makes one", file.string(),
                file.parent_path().empty() ? "." : file.parent_path().string());
  GoldenList list;
  list.file = file, list.folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  GoldenCase golden;
  golden.name = addition.name, golden.scene = addition.scene, golden.options = addition.options;
  // The same form of the passes on every machine, whatever GPU it has.
  if (std::ranges::none_of(golden.options, [](const std::string& option) { return option.starts_with("--gl"); }))
    golden.options.insert(golden.options.end(), {"--gl", "off"});
  const bool is_file = !golden.scene.starts_with("scene:") && !fs::path(golden.scene).is_absolute();
  const std::string scene = is_file ? fs::proximate(golden.scene, list.folder).generic_string() : golden.scene;
  const std::string text = with_golden_case(read_whole_file(file, size_t{64} << 20), file, golden.name, scene,
                                            golden.options, addition.reason);
  list.cases = {golden};
  update_case(list, golden, {}, outputs_of(list));
  write_file_atomically(file, text);
  fmt::print("{}: case '{}' added\n", file.string(), golden.name);
  return ExitCode::ok;
}

}  // namespace hybridrt::cli
