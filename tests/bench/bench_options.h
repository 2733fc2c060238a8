#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/parallel.h"

namespace hybridrt {

/// What the benchmarks of frames and ids are asked for.
struct BenchOptions {
  int threads = allowed_processors(), rounds = 11, width_px = 1024, height_px = 768, depth = 1;
  bool alone = false;  ///< the hybrid only, for a profiler
  std::vector<std::string> scenes;
};

/// --threads=N --rounds=N --size=WxH --depth=N --alone SCENE...; --target=NAME limits Highway to that instruction set.
/// Ends the program with a line for anything else.
BenchOptions parse_bench_options(int argc, char** argv);

/// A benchmark's main(): prints its table's header and has each scene's lines printed.
int print_table(int argc, char** argv, const char* header,
                const std::function<void(const std::string& scene, const BenchOptions&, ThreadPool&)>& measure);

}  // namespace hybridrt
