// The headers that are looked at before a picture is opened: JPEG, JPEG 2000, GIF, OpenEXR.

#include <stdexcept>

#include "core/base/error.h"
#include "core/image_io/header_check.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {

void read_input(std::string_view bytes) {
  const TexelLimits limits{4096, 1 << 20};
  const HeaderClaim claim = header_claim(input_file("input", bytes), limits);
  if (!claim.fault.empty()) throw error(ErrorKind::input, "{}", claim.fault);
  const auto side_px = static_cast<uint64_t>(limits.largest_side_px);
  if (claim.width_px > side_px || claim.height_px > side_px || claim.width_px * claim.height_px > limits.most_texels)
    throw std::logic_error("taken, though it is over the limits");
}

}  // namespace hybridrt::fuzz
