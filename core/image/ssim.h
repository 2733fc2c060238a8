#pragma once

#include "core/image/image.h"

namespace hybridrt {

/// Structural similarity (Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image Quality Assessment: From Error Visibility
/// to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004) of two pictures of display values in
/// 0-1: the mean over all windows that lie within the picture, each a Gaussian of 11x11 pixels with sigma 1.5, of the
/// pictures' luma (BT.601 weights). 1 for equal pictures, down to -1. Pictures smaller than a window: one window of
/// equal weights. Same size and channels; alpha does not count.
double structural_similarity(const Image& a, const Image& b);

}  // namespace hybridrt
