#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hybridrt {

/// Call it before any use of OpenImageIO: turns off its thread pools, as callers do their own threading. Thread-safe;
/// only the first call has an effect. Throws Error (usage) when the system cannot start OpenImageIO's threads.
void set_up_oiio();

/// The formats that we let OpenImageIO read and write, by its names. Their readers took 1,500 damaged files each
/// without a crash. Left out on purpose: what is not a picture file (null, term, zfile, ffmpeg, openvdb, raw, dicom);
/// ico, iff and dpx (their readers write past their buffers or crash on damaged files); sgi (uninitialised bytes in the
/// header); rla (time, user and host in the header); heif (starts its own threads); psd, dds and the rest (read-only,
/// untested).
std::span<const char* const> picture_formats();
bool is_picture_format(std::string_view name);

/// OpenImageIO's pending messages as one line.
std::string one_line(std::string_view message);

}  // namespace hybridrt
