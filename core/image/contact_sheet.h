#pragma once

#include <span>

#include "core/image/image.h"

namespace hybridrt {

/// Thumbnails in reading order, `columns` >= 1 a row, each `cell_width_px` >= 1 wide and box-filtered in
/// linear light, on a dark grey with small gaps. A cell is as high as the highest thumbnail. Linear, three
/// channels: grey is repeated, alpha and all beyond left out. No images give an empty image.
Image contact_sheet(std::span<const Image> images, int columns, int cell_width_px);

/// Every result pixel is the mean over the area it covers in the source. Any size, larger too.
Image box_filtered(const Image& image, int width_px, int height_px);

}  // namespace hybridrt
