#include "core/gl/extension_list.h"

#include <gtest/gtest.h>

namespace hybridrt::gl {
namespace {

TEST(ExtensionList, HasWholeNamesOnly) {
  const char* all = "EGL_EXT_device_base_foo EGL_EXT_platform_device X_EGL_EXT_client";
  EXPECT_FALSE(lists_extension(all, "EGL_EXT_device_base"));
  EXPECT_FALSE(lists_extension(all, "EGL_EXT_client"));
  EXPECT_FALSE(lists_extension(all, "EGL_EXT_platform_device X_EGL_EXT_client"));
  EXPECT_TRUE(lists_extension(all, "EGL_EXT_device_base_foo"));
  EXPECT_TRUE(lists_extension(all, "EGL_EXT_platform_device"));
  EXPECT_TRUE(lists_extension(all, "X_EGL_EXT_client"));
}

// A longer name before the wanted one does not hide it.
TEST(ExtensionList, FindsANameBehindALongerOne) {
  EXPECT_TRUE(lists_extension("EGL_EXT_device_base_foo EGL_EXT_device_base", "EGL_EXT_device_base"));
}

TEST(ExtensionList, TakesWhatDriversGive) {
  EXPECT_FALSE(lists_extension(nullptr, "A"));
  EXPECT_FALSE(lists_extension("", "A"));
  EXPECT_FALSE(lists_extension("  ", "A"));
  for (const char* name : {"A", "B"}) EXPECT_TRUE(lists_extension(" A  B ", name)) << name;
}

}  // namespace
}  // namespace hybridrt::gl
