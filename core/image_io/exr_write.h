#pragma once

#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image_io/encode_options.h"

namespace hybridrt {

/// The bytes of an EXR file (ZIP, scan lines) with a linear image of finite values: its channels, named as OpenImageIO
/// names them (Y, A; R, G, B, A; channel4 …), the channels of its layers, and its camera as worldToCamera and
/// worldToNDC. Colours are held times alpha, as readers expect. `description` becomes the attribute "comments".
///
/// With half numbers the picture's own channels are halfs, unless a value is too large for one: then they are floats.
/// Layers keep their numbers. Equal arguments give equal bytes. Starts no thread. Throws Error (output), naming `name`.
///
/// OpenEXR's core library writes the file. Its blocks are packed here, by its ZIP (bytes apart, differences, zlib),
/// since its zlib takes 88 ms for floats of 1024x768 pixels.
std::vector<unsigned char> encode_exr(const Image& linear, const std::string& name, const std::string& description,
                                      const EncodeOptions& options);

}  // namespace hybridrt
