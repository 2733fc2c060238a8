// fuzz_NAME_corpus FOLDER: feeds every file of the folder to the reader. Files named good-… must be accepted, all
// others refused.

#include <cstdio>
#include <exception>
#include <fmt/core.h>

#include "tests/fuzz/reader.h"
#include "tests/support/temporary_folder.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  size_t good = 0, bad = 0, wrong = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const std::string name = entry.path().filename().string();
    const bool shall = name.starts_with("good-");
    ++(shall ? good : bad);
    std::string what = shall ? "is refused" : "is taken";
    try {
      if (hybridrt::fuzz::takes(hybridrt::file_contents(entry.path())) == shall) continue;
    } catch (const std::exception& fault) {
      what = fault.what();
    }
    ++wrong;
    fmt::print(stderr, "{}: {}\n", name, what);
  }
  fmt::print("{} good and {} bad inputs, {} not treated as such\n", good, bad, wrong);
  return good > 0 && bad > 0 && wrong == 0 ? 0 : 1;
}
