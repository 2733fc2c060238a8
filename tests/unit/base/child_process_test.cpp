#include "core/base/child_process.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"

namespace hybridrt {
namespace {

using std::chrono::milliseconds;

// This program is the test program: its list of tests is an answer.
TEST(ChildProcess, WhatItSaysComesBack) {
  const ChildEnd end =
      run_this_program({"--gtest_list_tests", "--gtest_filter=ChildProcess.*"}, milliseconds(60000), 1 << 20);
  EXPECT_EQ(end.problem, "");
  EXPECT_NE(end.output.find("WhatItSaysComesBack"), std::string::npos) << end.output;
}

TEST(ChildProcess, DISABLED_Crashes) { std::abort(); }
TEST(ChildProcess, DISABLED_Fails) { std::_Exit(3); }
TEST(ChildProcess, DISABLED_SaysNothing) { std::this_thread::sleep_for(std::chrono::hours(1)); }
TEST(ChildProcess, DISABLED_SaysTooMuch) {
  for (;;) std::puts("and so on");
}

std::string problem_of(const std::string& test, milliseconds longest_silence = milliseconds(60000)) {
  return run_this_program({"--gtest_also_run_disabled_tests", "--gtest_filter=ChildProcess.DISABLED_" + test},
                          longest_silence, 1 << 20)
      .problem;
}

TEST(ChildProcess, HowItEndedIsSaid) {
  EXPECT_EQ(problem_of("Crashes"), "crashed (Aborted)");
  EXPECT_EQ(problem_of("Fails"), "ended with code 3");
  EXPECT_EQ(problem_of("SaysNothing", milliseconds(300)), "did not answer for 0.3 s");
  EXPECT_EQ(problem_of("SaysTooMuch"), "answered more than 1048576 bytes");
}

TEST(ChildProcess, ManyAtOnce) {
  ThreadPool pool(4);
  for (int round = 0; round < 10; ++round)
    parallel_for(pool, 8, 1, [](size_t, size_t) { EXPECT_EQ(problem_of("Fails"), "ended with code 3"); });
}

}  // namespace
}  // namespace hybridrt
