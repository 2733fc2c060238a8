#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "cli/commands.h"
#include "cli/files_read.h"
#include "cli/job.h"
#include "cli/option_values.h"
#include "cli/parse_message.h"
#include "cli/standard_streams.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/golden/golden.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kDifferenceAmplification = 20;

struct GoldenOptions {
  std::string list, output = "out/golden", junit, gl, device;
  std::vector<std::string> names;
};

/// ours: beside the sources while working on them, else where it was installed to.
fs::path default_list() {
  const fs::path here = "golden/golden.json";
  if (fs::exists(here)) return here;
  std::error_code problem;
  const fs::path binary = fs::read_symlink("/proc/self/exe", problem);
  const fs::path installed = binary.parent_path().parent_path() / "share/hybridrt/golden/golden.json";
  return fs::exists(installed) ? installed : here;
}

/// What is needed to render a case.
struct CaseJob {
  std::unique_ptr<ThreadPool> pool;
  RenderJob job;
  RunFiles read;
};

/// A file that the command is going to write, and what it is.
struct GoldenOutput {
  fs::path path;
  const char* what;
};

/// Throws Error(usage) if some of what will be written is a case's scene or belongs to it.
void require_unread(const std::vector<GoldenOutput>& outputs, const RunFiles& read) {
  for (const GoldenOutput& output : outputs) read.require_unused(output.path, output.what);
}

/// Where a case's passes run, if `options` say so.
void choose_gl(const GoldenOptions& options, RenderOptions& to) {
  if (!options.gl.empty()) to.gl_use = parse_name("--gl", kGlUses, options.gl);
  if (!options.device.empty()) to.gl.device = options.device;
}

/// The job for a case's only frame. Errors in its options or scene are the list's fault: Error(input).
CaseJob make_case_job(const GoldenCase& golden, const GoldenOptions& options_given) {
  RenderOptions command_line;
  CLI::App parser;
  add_render_options(parser, command_line);
  std::vector<std::string> arguments(golden.options.rbegin(), golden.options.rend());  // CLI11 takes them in reverse
  arguments.push_back(golden.scene);
  try {
    parser.parse(arguments);
    const SceneSource source = scene_source_of(command_line);
    RenderOptions options = with_scene_settings(command_line, source);
    choose_gl(options_given, options);
    CaseJob made{std::make_unique<ThreadPool>(thread_count(options)), {}, {}};
    Warnings warnings;
    made.job = make_render_job(options, source, *made.pool, warnings);
    add_files_read(options, source, made.read);
    add_files_read(made.job.scene, made.read);
    if (made.job.frames.count() != 1)
      throw error(ErrorKind::input, "{} frames; say which one, like --frames 5-5", made.job.frames.count());
    return made;
  } catch (const CLI::ParseError& problem) {
    throw error(ErrorKind::input, "golden case '{}': {}", golden.name, parse_message(parser, problem));
  } catch (const Error& problem) {
    throw error(ErrorKind::input, "golden case '{}': {}", golden.name, problem.what());
  }
}

Image picture_of(const CaseJob& made) {
  Image picture;
  const auto keep = [&](Frame&& frame) { picture = std::move(frame.picture); };
  run(
      made.job, *made.pool, [](const RunFacts&) {}, [] { return false; }, keep);
  return picture;
}

void write_picture(const fs::path& path, const Image& picture) {
  const std::vector<unsigned char> bytes = encode_image(picture, path.string());
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

fs::path actual_picture(const fs::path& output, const GoldenCase& golden) { return output / (golden.name + ".png"); }
fs::path difference_picture(const fs::path& output, const GoldenCase& golden) {
  return output / (golden.name + ".diff.png");
}

/// Throws if the case cannot be rendered at all; errors in its expected picture are a result.
GoldenResult check(const GoldenList& list, const GoldenCase& golden, const GoldenOptions& options,
                   const std::vector<GoldenOutput>& outputs) {
  const fs::path output = options.output;
  GoldenResult result;
  result.golden = golden;
  const Stopwatch stopwatch;
  const CaseJob job = make_case_job(golden, options);
  require_unread(outputs, job.read);
  try {
    const fs::path actual = actual_picture(output, golden);
    write_picture(actual, picture_of(job));
    result.actual = actual;
    const fs::path expected = list.expected(golden);
    if (!fs::exists(expected))
      throw error(ErrorKind::input, "{} is missing; 'hybridrt golden update {}' makes it", expected.string(),
                  golden.name);
    result.expected = expected;
    const Image a = read_image(actual), b = read_image(expected);
    result.compared = compare_images(a, b, golden.limits);
    if (result.compared.measured && result.compared.max_error > 0) {
      result.difference = difference_picture(output, golden);
      Image difference = difference_image(a, b, kDifferenceAmplification);
      write_picture(result.difference, difference);
    }
  } catch (const Error& problem) {
    if (problem.kind() == ErrorKind::output || problem.kind() == ErrorKind::device) throw;
    result.failure = problem.what();
  }
  result.seconds = stopwatch.elapsed_ms() * 1e-3;
  return result;
}

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw error(ErrorKind::output, "cannot make the folder {}: {}", folder.string(), problem.message());
}

fs::path list_of(const GoldenOptions& options) {
  return options.list.empty() ? default_list() : fs::path(options.list);
}

/// The list and its scenes.
RunFiles files_of(const GoldenList& list, const GoldenOptions& options) {
  RunFiles files;
  files.reads(list_of(options));
  for (const GoldenCase& golden : list.cases)
    if (!golden.scene.starts_with("scene:")) files.reads(golden.scene);
  return files;
}

/// What `check` writes. Throws Error(usage) where that is read too, or one file is meant twice.
std::vector<GoldenOutput> outputs_of_check(const GoldenList& list, const GoldenOptions& options) {
  RunFiles files = files_of(list, options);
  for (const GoldenCase& any : read_golden_list(list_of(options)).cases) files.reads(list.expected(any));
  std::vector<GoldenOutput> outputs = {{fs::path(options.output) / "report.html", "the report"}};
  if (!options.junit.empty()) outputs.push_back({options.junit, "--junit"});
  for (const GoldenCase& golden : list.cases) {
    outputs.push_back({actual_picture(options.output, golden), "-o: the picture"});
    outputs.push_back({difference_picture(options.output, golden), "-o: the difference"});
  }
  for (const GoldenOutput& output : outputs) files.writes(output.path, output.what);
  return outputs;
}

std::vector<GoldenOutput> outputs_of_update(const GoldenList& list, const GoldenOptions& options) {
  RunFiles files = files_of(list, options);
  std::vector<GoldenOutput> outputs;
  for (const GoldenCase& golden : list.cases) {
    outputs.push_back({list.expected(golden), "the expected picture"});
    files.writes(outputs.back().path, outputs.back().what);
  }
  return outputs;
}

GoldenList chosen_cases(const GoldenOptions& options) {
  GoldenList list = read_golden_list(list_of(options));
  keep_cases(list, options.names);
  return list;
}

ExitCode check_all(const GoldenOptions& options) {
  const GoldenList list = chosen_cases(options);
  const std::vector<GoldenOutput> outputs = outputs_of_check(list, options);
  make_folder(options.output);
  std::vector<GoldenResult> results;
  size_t failed = 0;
  for (const GoldenCase& golden : list.cases) {
    results.push_back(check(list, golden, options, outputs));
    const GoldenResult& result = results.back();
    failed += !result.passed();
    fmt::print("{}  {:<24} {:5.1f} s  {}\n", result.passed() ? "ok    " : "FAILED", in_one_line(golden.name),
               result.seconds, in_one_line(result.verdict()));
    flush_output();
  }
  const fs::path report = fs::path(options.output) / "report.html";
  write_file_atomically(report, golden_html(results, options.output));
  if (!options.junit.empty()) write_file_atomically(options.junit, golden_junit(results));
  fmt::print("{} of {} as expected; report: {}\n", results.size() - failed, results.size(), report.string());
  return failed ? ExitCode::images_differ : ExitCode::ok;
}

ExitCode update_all(const GoldenOptions& options) {
  const GoldenList list = chosen_cases(options);
  const std::vector<GoldenOutput> outputs = outputs_of_update(list, options);
  for (const GoldenCase& golden : list.cases) {
    const CaseJob job = make_case_job(golden, options);
    require_unread(outputs, job.read);
    write_picture(list.expected(golden), picture_of(job));
    fmt::print("wrote {}\n", list.expected(golden).string());
  }
  return ExitCode::ok;
}

}  // namespace

void add_golden_command(CLI::App& app, Command& chosen) {
  CLI::App* golden =
      app.add_subcommand("golden", "Render a list of cases and compare them with their expected pictures");
  golden->require_subcommand(1);
  golden->footer(
      "Examples:\n"
      "  hybridrt golden check\n"
      "  hybridrt golden check --list mine/golden.json glass mirror\n"
      "  hybridrt golden update --list mine/golden.json glass");
  auto options = std::make_shared<GoldenOptions>();
  const auto add = [&](const char* name, const char* what, ExitCode (*action)(const GoldenOptions&)) {
    CLI::App* command = golden->add_subcommand(name, what);
    command->add_option("names", options->names, "Cases (default: all)")->type_name("NAME");
    command->add_option("--gl", options->gl, "Where passes run, as for render (default: as each case says)")
        ->type_name("WHERE");
    command->add_option("--device", options->device, "GL device, as 'hybridrt doctor' lists them")->type_name("ID");
    command->add_option("--list", options->list, "List of cases (default: the project's own)")->type_name("FILE");
    command->callback([options, action, &chosen] {
      chosen = [options, action] {
        gl::limit_software_threads(allowed_processors());  // before the first case starts a thread
        return action(*options);
      };
    });
    return command;
  };
  CLI::App* checking = add("check", "Compare; exit 6 when a picture differs", check_all);
  checking->add_option("-o,--output", options->output, "Folder for pictures and report.html (default out/golden)")
      ->type_name("DIR");
  checking->add_option("--junit", options->junit, "Also write the results for a CI server")->type_name("FILE.xml");
  add("update", "Replace the expected pictures", update_all);
}

}  // namespace hybridrt::cli
