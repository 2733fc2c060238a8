#pragma once

#include "core/base/named.h"

namespace hybridrt {

/// How hard a picture is packed. The pixels are the same.
enum class Compression { fast, small };
inline constexpr Named<Compression> kCompressions[] = {{"fast", Compression::fast}, {"small", Compression::small}};

/// The numbers of an EXR's picture. Its layers stay as they are.
enum class ExrNumbers { half, single };
inline constexpr Named<ExrNumbers> kExrNumbers[] = {{"half", ExrNumbers::half}, {"float", ExrNumbers::single}};

struct EncodeOptions {
  Compression compression = Compression::fast;
  ExrNumbers exr = ExrNumbers::single;
};

}  // namespace hybridrt
