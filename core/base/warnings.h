#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/warning_code.h"

namespace hybridrt {

/// Something that was repaired or left out: one sentence, with the number of cases ("12 faces …"). There is none
/// without a code.
struct Warning {
  Warning(WarningCode kind, std::string sentence) : code(kind), text(std::move(sentence)) {}
  bool operator==(const Warning&) const = default;

  WarningCode code;
  std::string text;
};

/// Functions that can go on in spite of a fault append to them; the command line prints them.
using Warnings = std::vector<Warning>;

/// `text` for messages: in single quotes, shortened, without control characters.
std::string in_quotes(std::string_view text);

/// Counts the cases of one kind of fault and remembers where the first one was.
struct Tally {
  size_t count = 0, first_line = 0;
  void add(size_t line, size_t cases = 1) {
    if (count == 0 || line < first_line) first_line = line;
    count += cases;
  }
};

/// Names of cases of one kind of fault, each kept once.
class NameList {
 public:
  void add(std::string_view name);
  size_t count() const { return known_.size(); }
  /// The first ones in quotes, in their order: "'a', 'b' and 14 more".
  std::string text() const;

 private:
  std::unordered_set<std::string> known_;
  std::vector<std::string> first_;
};

/// "sports.obj: 57 triangles of zero area were left out (first at line 1234)", unless there were none.
void report(WarningCode code, const Tally& tally, std::string_view what, const std::filesystem::path& file,
            Warnings& warnings, std::string_view place = "line");

}  // namespace hybridrt
