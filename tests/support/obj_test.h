#pragma once

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/load_obj.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {

struct Loaded {
  Scene scene;
  Warnings warnings;
};

inline Loaded load_text(std::string_view obj, int threads = 2) {
  const TemporaryFolder folder;
  ThreadPool pool(threads);
  Loaded loaded;
  loaded.scene = load_obj(folder.write("test.obj", obj), pool, loaded.warnings);
  return loaded;
}

/// The message of the Error (input) that loading must throw; "" (and a failure) if it does not.
inline std::string error_of(std::string_view obj) {
  try {
    load_text(obj);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line only";
    return error.what();
  }
  ADD_FAILURE() << "loaded without an error";
  return "";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// "TEXT [CODE]", as people read it.
inline std::string with_code(const Warning& warning) {
  return warning.text + " [" + std::string(name_of(warning.code)) + "]";
}

/// How gtest shows one that is not as expected.
inline void PrintTo(const Warning& warning, std::ostream* out) { *out << with_code(warning); }

/// Whether exactly one warning says `part`.
inline bool warned(const Warnings& warnings, const std::string& part) {
  return std::count_if(warnings.begin(), warnings.end(), [&](const auto& w) { return contains(with_code(w), part); }) ==
         1;
}

inline const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace hybridrt
