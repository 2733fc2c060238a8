#pragma once

#include "core/load/camera_json.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {

/// The camera of a file with this text.
inline CameraCourse read_camera_text(std::string_view text, Warnings& warnings, UpAxis up = UpAxis::y) {
  const TemporaryFolder folder;
  return read_camera_file(folder.write("shot.json", text), up, warnings);
}

inline CameraPath read_path(const std::string& keys, UpAxis up = UpAxis::y) {
  Warnings warnings;
  return std::get<CameraPath>(read_camera_text("{\"keyframes\":[" + keys + "]}", warnings, up));
}

inline std::string key(int frame, const std::string& eye, const std::string& more = "") {
  return "{\"frame\":" + std::to_string(frame) + ",\"eye\":" + eye + ",\"target\":[0,0,0]" + more + "}";
}

}  // namespace hybridrt
