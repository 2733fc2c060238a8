#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/named.h"
#include "core/image/image.h"

namespace hybridrt {

/// Video without compression, as it goes through pipes. y4m: YUV4MPEG2, as mjpegtools define it (yuv4mpeg(5)); rgb24:
/// rows of red, green and blue bytes, and nothing else.
enum class VideoFormat { y4m, rgb24 };
inline constexpr Named<VideoFormat> kVideoFormats[] = {{"y4m", VideoFormat::y4m}, {"rgb24", VideoFormat::rgb24}};

/// Frames per second, `count` / `per`.
struct FrameRate {
  int count = 25, per = 1;
};

/// What comes before the first frame: for rgb24 nothing.
std::string video_header(VideoFormat format, int width_px, int height_px, FrameRate rate);

/// The display codes of a linear image as one frame, FRAME line included. y4m holds BT.709's Y'CbCr of them, 8 bits,
/// limited range (ITU-R BT.709-6, section 3), of every pixel (4:4:4): decoded, a code is off by 2 at most. Grey becomes
/// colour; alpha is left out. Throws Error (output), naming `name`, for a value that is not finite.
std::vector<uint8_t> video_frame(VideoFormat format, const Image& linear, const std::string& name);

}  // namespace hybridrt
