#pragma once

#include <functional>
#include <memory>

#include "cli/exit_codes.h"
#include "cli/job.h"
#include "core/base/run_files.h"
#include "core/golden/golden.h"

namespace hybridrt::cli {

struct GoldenOptions {
  std::string list, output = "out/golden", junit, gl, device;
  std::vector<std::string> names;
  bool enforce_time = false;
  std::shared_ptr<gl::Probes> probes = std::make_shared<gl::Probes>();  ///< of all cases
};

/// --list, or the project's own: beside the sources while working on them, else where it was installed to.
std::filesystem::path list_of(const GoldenOptions& options);

/// "--list mine.json --gl off ", as the user gave them: for what a message says to type.
std::string repeated(const GoldenOptions& options);

/// A file that the command is going to write, and what it is.
struct GoldenOutput {
  std::filesystem::path path;
  const char* what;
};

/// The list and its scenes.
RunFiles files_of(const GoldenList& list);

/// What is needed to render a case.
struct CaseJob {
  std::unique_ptr<ThreadPool> pool;
  RenderJob job;
};

/// Throws Error(input) or (device) for its options and its scene, (usage) if it reads some of `outputs`.
CaseJob make_case_job(const GoldenCase& golden, const GoldenOptions& options, const std::vector<GoldenOutput>& outputs);

/// Where a case was rendered.
struct CaseFacts {
  RendererClass renderer = RendererClass::cpu;
  std::string where;  ///< the GL renderer, or "passes on the CPU"
};

/// Renders the case's frames. `deliver` gets each with its name (golden_picture_name). Times loading aside.
CaseFacts render_case(const GoldenCase& golden, const CaseJob& made,
                      const std::function<void(const std::string& name, const Image& picture)>& deliver);

void write_picture(const std::filesystem::path& path, const Image& picture);

ExitCode golden_check(const GoldenOptions& options);
ExitCode golden_update(const GoldenOptions& options);

struct GoldenAddition {
  std::string list, name, scene, reason;
  std::vector<std::string> options;  ///< of render
};
/// Makes an empty list in a folder.
ExitCode golden_init(const std::filesystem::path& folder);
/// Renders a new case's expected pictures and appends it to the list.
ExitCode golden_add(const GoldenAddition& addition);

}  // namespace hybridrt::cli
