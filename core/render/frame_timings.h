#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hybridrt {

/// What a frame's time is spent on, in the order of the timings CSV (its column is NAME_ms).
enum class PassId { shadow_map, id, mark, readback, trace, upload, shade, download, write, count };

inline constexpr std::array<std::string_view, static_cast<size_t>(PassId::count)> kPassNames = {
    "shadow_map", "id", "mark", "readback", "trace", "upload", "shade", "download", "write"};

/// Milliseconds of each pass; 0 where a pass did not run.
struct FrameTimings {
  std::array<double, static_cast<size_t>(PassId::count)> pass_ms{};
  std::array<double, static_cast<size_t>(PassId::count)> threads_ms{};  ///< of all threads, where passes share them
  double wall_ms = 0;  ///< since the previous frame left pass 5's download

  double& operator[](PassId pass) { return pass_ms[static_cast<size_t>(pass)]; }
  double operator[](PassId pass) const { return pass_ms[static_cast<size_t>(pass)]; }
};

}  // namespace hybridrt
