#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hybridrt {

/// Once before any use of OpenImageIO: its own thread pools stay off, parallelism is the caller's.
/// Thread-safe. Throws Error usage when the system gives OpenImageIO no threads.
void set_up_oiio();

/// The formats that we let OpenImageIO read and write, by its names. Their readers took 1,500 damaged files
/// each without a crash. Left out on purpose: what is no picture file (null, term, zfile, ffmpeg, openvdb,
/// raw, dicom); ico, iff and dpx (their readers write past their buffers or crash on damaged files); sgi
/// (uninitialised bytes in the header); rla (time, user and host in the header); heif (starts threads of its
/// own); psd, dds and the rest (read only, untried).
std::span<const char* const> picture_formats();
bool is_picture_format(std::string_view name);

/// OpenImageIO's pending messages as one line.
std::string one_line(std::string_view message);

}  // namespace hybridrt
