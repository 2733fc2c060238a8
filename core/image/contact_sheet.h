#pragma once

#include <span>

#include "core/image/image.h"

namespace hybridrt {

/// Thumbnails in reading order, `columns` >= 1 per row, each `cell_width_px` >= 1 wide and box-filtered in linear
/// light, on dark grey with small gaps. A cell is as high as the highest thumbnail. Linear, three channels: grey is
/// repeated, alpha and further channels are left out. No images give an empty image.
Image contact_sheet(std::span<const Image> images, int columns, int cell_width_px);

/// Every result pixel is the mean over the area that it covers in the source. The result may be larger than the source.
Image box_filtered(const Image& image, int width_px, int height_px);

}  // namespace hybridrt
