#pragma once

#include <string>
#include <vector>

namespace hybridrt {

/// Things that were repaired or left out, one finished sentence each, cases counted ("12 faces …").
/// Functions that can go on in spite of a fault take one and append; the command line prints them.
using Warnings = std::vector<std::string>;

}  // namespace hybridrt
