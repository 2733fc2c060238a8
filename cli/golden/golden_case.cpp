#include "cli/golden/golden_case.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/files_read.h"
#include "cli/option_values.h"
#include "cli/parse_message.h"
#include "core/base/output_file.h"
#include "core/image_io/encode_image.h"

namespace hybridrt::cli {

namespace fs = std::filesystem;

fs::path list_of(const GoldenOptions& options) {
  if (!options.list.empty()) return options.list;
  const fs::path here = "golden/golden.json";
  if (fs::exists(here)) return here;
  std::error_code problem;
  const fs::path binary = fs::read_symlink("/proc/self/exe", problem);
  const fs::path installed = binary.parent_path().parent_path() / "share/hybridrt/golden/golden.json";
  return fs::exists(installed) ? installed : here;
}

std::string repeated(const GoldenOptions& options) {
  std::string text;
  for (const auto& [name, value] :
       {std::pair("--list", options.list), {"--gl", options.gl}, {"--device", options.device}})
    if (!value.empty()) text += fmt::format("{} {} ", name, value);
  return text;
}

RunFiles files_of(const GoldenList& list) {
  RunFiles files;
  files.reads(list.file);
  for (const GoldenCase& golden : list.cases)
    if (!golden.scene.starts_with("scene:")) files.reads(golden.scene);
  return files;
}

namespace {

/// Also collects what it reads.
CaseJob make_job(const GoldenCase& golden, const GoldenOptions& given, RunFiles& read) {
  RenderOptions command_line;
  command_line.probes = given.probes;
  CLI::App parser;
  add_render_options(parser, command_line);
  std::vector<std::string> arguments(golden.options.rbegin(), golden.options.rend());  // CLI11 takes them in reverse
  arguments.push_back(golden.scene);
  try {
    parser.parse(arguments);
  } catch (const CLI::ParseError& problem) {
    throw error(ErrorKind::input, "{}", parse_message(parser, problem));
  }
  const SceneSource source = scene_source_of(command_line);
  RenderOptions options = with_scene_settings(command_line, source);
  if (!given.gl.empty()) options.gl_use = parse_name("--gl", kGlUses, given.gl);
  if (!given.device.empty()) {
    options.gl.device = given.device;
    if (given.gl.empty()) options.gl_use = GlUse::automatic;  // a case's own --gl off says nothing of this device
  }
  CaseJob made{std::make_unique<ThreadPool>(thread_count(options)), {}};
  Warnings warnings;
  made.job = make_render_job(options, source, *made.pool, warnings);
  constexpr int64_t kMostFrames = 100;
  if (made.job.frames.count() > kMostFrames)
    throw error(ErrorKind::input, "{} frames; a case has at most {}: --frames 1-3", made.job.frames.count(),
                kMostFrames);
  add_files_read(options, source, read);
  add_files_read(made.job.scene, read);
  return made;
}

}  // namespace

CaseJob make_case_job(const GoldenCase& golden, const GoldenOptions& given, const std::vector<GoldenOutput>& outputs) {
  RunFiles read;
  CaseJob made;
  try {
    made = make_job(golden, given, read);
  } catch (const Error& problem) {
    // The options are the list's, not the command line's.
    throw Error(problem.kind() == ErrorKind::usage ? ErrorKind::input : problem.kind(), problem.what());
  }
  for (const GoldenOutput& output : outputs) read.require_unused(output.path, output.what);
  return made;
}

CaseFacts render_case(const GoldenCase& golden, const CaseJob& made,
                      const std::function<void(const std::string& name, const Image& picture)>& deliver) {
  CaseFacts facts{RendererClass::cpu, "passes on the CPU"};
  const bool has_several = made.job.frames.count() > 1;
  const auto starting = [&](const RunFacts& run) {
    if (!run.gl) return;
    facts.renderer = run.gl->software ? RendererClass::software_gl : RendererClass::hardware_gl;
    facts.where = run.gl->renderer;
  };
  run(
      made.job, *made.pool, starting, [] { return false; },
      [&](Frame&& frame) { deliver(golden_picture_name(golden, frame.number, has_several), frame.picture); });
  return facts;
}

void write_picture(const fs::path& path, const Image& picture) {
  const std::vector<unsigned char> bytes = encode_image(picture, path.string());
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

}  // namespace hybridrt::cli
