#pragma once

#include <bit>
#include <cstring>

#include "tests/support/obj_test.h"

namespace hybridrt {

/// One mesh file of any format as a scene.
inline Loaded load(const std::string& name, std::string_view bytes, UpAxis up = UpAxis::y) {
  const TemporaryFolder folder;
  ThreadPool pool(2);
  Loaded loaded;
  const std::filesystem::path path = folder.write(name, bytes);
  loaded.scene = load_meshes({&path, 1}, up, pool, loaded.warnings);
  return loaded;
}

/// The message of the Error (input) that loading it must throw; "" (and a failure) if it does not.
inline std::string failure(const std::string& name, std::string_view bytes) {
  try {
    load(name, bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line only";
    return error.what();
  }
  ADD_FAILURE() << "loaded without an error";
  return "";
}

/// A number in the given byte order.
template <typename T>
std::string bytes(T value, bool big = false) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) return {text.rbegin(), text.rend()};
  return text;
}

}  // namespace hybridrt
