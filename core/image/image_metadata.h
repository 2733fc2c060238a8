#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hybridrt {

/// What a written image says about itself: names and values, in order. Only what decides the pixels belongs here
/// (version, settings, fingerprint), never a time or host: equal runs give equal bytes. Names hold no '=', and neither
/// names nor values hold line breaks; description_of() checks.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// One "name=value" line each, without a last line end.
std::string description_of(const ImageMetadata& metadata);

}  // namespace hybridrt
