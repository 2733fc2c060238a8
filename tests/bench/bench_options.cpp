#include "tests/bench/bench_options.h"

#include <algorithm>
#include <cstdlib>
#include <hwy/targets.h>
#include <string_view>

namespace hybridrt {
namespace {

[[noreturn]] void fail(const char* program, const char* what, std::string_view argument) {
  fprintf(stderr, "%s: %s %s\n", program, what, std::string(argument).c_str());
  std::exit(2);
}

int64_t target_named(const char* program, std::string_view name) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) return target;
  fail(program, "no such instruction set here:", name);
}

}  // namespace

BenchOptions parse_bench_options(int argc, char** argv) {
  BenchOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const size_t equals = std::min(argument.find('='), argument.size() - 1);
    const std::string_view name = argument.substr(0, equals + 1);
    const char* const value = argv[i] + equals + 1;
    if (name == "--threads=")
      options.threads = std::max(1, std::atoi(value));
    else if (name == "--rounds=")
      options.rounds = std::max(1, std::atoi(value));
    else if (name == "--depth=")
      options.depth = std::max(0, std::atoi(value));
    else if (name == "--size=" && std::sscanf(value, "%dx%d", &options.width_px, &options.height_px) == 2)
      continue;
    else if (name == "--target=")
      hwy::SetSupportedTargetsForTest(target_named(argv[0], value));
    else if (argument == "--alone")
      options.alone = true;
    else if (argument.starts_with("--"))
      fail(argv[0], "unknown option", argument);
    else
      options.scenes.emplace_back(argument);
  }
  if (options.scenes.empty()) options.scenes = {"scene:spheres,triangles=20000"};
  return options;
}

int print_table(int argc, char** argv, const char* header,
                const std::function<void(const std::string& scene, const BenchOptions&, ThreadPool&)>& measure) {
  const BenchOptions options = parse_bench_options(argc, argv);
  ThreadPool pool(options.threads);
  std::printf("%s\n", header);
  for (const std::string& scene : options.scenes) measure(scene, options, pool);
  return 0;
}

}  // namespace hybridrt
