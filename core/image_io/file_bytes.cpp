#include "core/image_io/file_bytes.h"

namespace hybridrt {

FileBytes::FileBytes(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  file_.seekg(0, std::ios::end);
  size_ = file_ ? static_cast<uint64_t>(file_.tellg()) : 0;
}

std::string FileBytes::at(uint64_t place, size_t count) {
  std::string bytes(count, '\0');
  if (place >= size_) return bytes;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(place));
  file_.read(bytes.data(), static_cast<std::streamsize>(count));
  return bytes;
}

uint64_t FileBytes::big(uint64_t place, int count) {
  uint64_t value = 0;
  for (const char c : at(place, static_cast<size_t>(count))) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

uint64_t FileBytes::little(uint64_t place, int count) {
  const std::string bytes = at(place, static_cast<size_t>(count));
  uint64_t value = 0;
  for (auto c = bytes.rbegin(); c != bytes.rend(); ++c) value = value << 8 | static_cast<unsigned char>(*c);
  return value;
}

}  // namespace hybridrt
