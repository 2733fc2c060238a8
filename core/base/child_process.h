#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace hybridrt {

/// How a child process ended.
struct ChildEnd {
  std::string output;   ///< what it wrote to its standard output
  std::string problem;  ///< "crashed (Segmentation fault)", "did not answer for 20 s", "ended with code 3"; empty: none
};

/// Runs this very program with other arguments, waits for its end, and returns what it says: for work in libraries
/// that may crash, hang or take memory without bound. Its standard input and error lead nowhere. It is killed when it
/// says nothing for `longest_silence`, writes more than `most_bytes`, or when this process ends (if it calls
/// die_with_parent() first). Nothing of it is left, whatever happens. The child starts anew (posix_spawn), so threads
/// of this process do not matter. Throws Error(usage) when the system starts no process.
ChildEnd run_this_program(const std::vector<std::string>& arguments, std::chrono::milliseconds longest_silence,
                          size_t most_bytes);

/// For the child, first of all: it ends with its parent, and its crashes leave no core files.
void die_with_parent();

}  // namespace hybridrt
