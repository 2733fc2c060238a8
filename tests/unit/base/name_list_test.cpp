#include <gtest/gtest.h>

#include "core/base/warnings.h"

namespace hybridrt {
namespace {

TEST(NameList, KeepsEachNameOnceAndSpellsOutTheFirst) {
  NameList names;
  EXPECT_EQ(names.text(), "");
  for (const char* name : {"b", "a", "b"}) names.add(name);
  EXPECT_EQ(names.count(), 2u);
  EXPECT_EQ(names.text(), "'b', 'a'");
  for (int i = 0; i < 12; ++i) names.add(std::string(1, static_cast<char>('c' + i)));
  EXPECT_EQ(names.count(), 14u);
  EXPECT_TRUE(names.text().ends_with("'k', 'l' and 2 more")) << names.text();
}

}  // namespace
}  // namespace hybridrt
