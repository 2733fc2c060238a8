#include "core/load/find_file.h"

#include <sys/stat.h>

#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

/// A folder with these files; where each name is found in it, relative to it.
struct FindFile : testing::Test {
  TemporaryFolder folder;

  void make(const std::string& name) {
    fs::create_directories((folder.path / name).parent_path());
    folder.write(name, "x");
  }
  std::string found(const std::string& name, bool as_written, std::vector<std::string> folders = {"mats"}) {
    std::vector<fs::path> paths;
    for (const std::string& below : folders) paths.push_back(folder.path / below);
    const FoundFile file = FileFinder(paths).find(name);
    EXPECT_EQ(file.as_written, as_written) << name;
    return file.path.empty() ? "" : file.path.lexically_normal().lexically_relative(folder.path).string();
  }
};

TEST_F(FindFile, AsWritten) {
  for (const char* name : {"mats/wood.png", "mats/maps/tile.png", "images/sky.png", "mats/b\\c.png", "mats/b/c.png"})
    make(name);
  EXPECT_EQ(found("wood.png", true), "mats/wood.png");
  EXPECT_EQ(found("./maps\\tile.png", true), "mats/maps/tile.png");
  EXPECT_EQ(found("../images/sky.png", true), "images/sky.png");
  EXPECT_EQ(found("none/../wood.png", true), "mats/wood.png") << "a folder that is not there";
  EXPECT_EQ(found((folder.path / "images/sky.png").string(), true), "images/sky.png") << "absolute";
  EXPECT_EQ(found("b\\c.png", true), "mats/b\\c.png") << "literally, if it is there";
}

TEST_F(FindFile, ExactlyThenIgnoringCaseThenInTheOtherFolder) {
  for (const char* name : {"mats/TEX.png", "mats/Tex.png", "mats/Maps/A.PNG", "mats/maps/B.png", "obj/tex.png",
                           "obj/maps/a.png", "mats/ÄÖ Ж.png"})
    make(name);
  EXPECT_EQ(found("Tex.png", true), "mats/Tex.png");
  EXPECT_EQ(found("tex.png", false), "mats/TEX.png") << "the first by bytes";
  EXPECT_EQ(found("tex.png", true, {"mats", "obj"}), "obj/tex.png") << "an exact name goes first";
  EXPECT_EQ(found("maps/a.png", false), "mats/Maps/A.PNG") << "not in the folder that is exact";
  EXPECT_EQ(found("MAPS\\b.PNG", false), "mats/maps/B.png");
  EXPECT_EQ(found("../MATS/tex.PNG", false), "mats/TEX.png");
  EXPECT_EQ(found("äö ж.PNG", false), "mats/ÄÖ Ж.png") << "whatever the locale";
  EXPECT_EQ(found((folder.path / "MATS/tex.PNG").string(), false), "mats/TEX.png");
  EXPECT_EQ(found("texx.png", false), "");
}

TEST_F(FindFile, Decoded) {
  for (const char* name : {"mats/a b.png", "mats/c%20d.png", "mats/c d.png", "mats/'e'.png", "mats/sub/F 1.png"})
    make(name);
  EXPECT_EQ(found("a%20b.png", false), "mats/a b.png");
  EXPECT_EQ(found("c%20d.png", true), "mats/c%20d.png") << "literally, if it is there";
  EXPECT_EQ(found("\"a b.png\"", false), "mats/a b.png");
  EXPECT_EQ(found("'e'.png", true), "mats/'e'.png");
  EXPECT_EQ(found("\"sub\\f%201.PNG\"", false), "mats/sub/F 1.png") << "all at once";
  EXPECT_EQ(found("a%2", false), "");
  EXPECT_EQ(found("%00", false), "");
}

TEST_F(FindFile, ByTheirLastParts) {
  for (const char* name : {"mats/wood.png", "mats/maps/wood.png", "obj/sky.png"}) make(name);
  EXPECT_EQ(found("C:\\project\\maps\\wood.png", false), "mats/maps/wood.png") << "as much of it as there is";
  EXPECT_EQ(found("/no/such/folder/WOOD.png", false), "mats/wood.png");
  EXPECT_EQ(found("..\\wood.png", false), "mats/wood.png");
  EXPECT_EQ(found("\\\\server\\share\\sky.png", false, {"mats", "obj"}), "obj/sky.png");
  EXPECT_EQ(found("", false), "");
  EXPECT_EQ(found("C:\\", false), "");
}

TEST_F(FindFile, OnlyRegularFiles) {
  make("mats/tex/inside.png");
  make("mats/TEX.png");
  ASSERT_EQ(mkfifo((folder.path / "mats/tex.png").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder.path / "mats/pipe.png").c_str(), 0600), 0);
  EXPECT_EQ(found("tex.png", false), "mats/TEX.png") << "past a pipe";
  FileFinder finder({folder.path / "mats"});
  for (const std::string name : {"pipe.png", "tex", "/dev/zero"}) {
    EXPECT_FALSE(finder.find(name).path.empty()) << name;
    EXPECT_FALSE(finder.find(name).regular) << name;
  }
}

TEST_F(FindFile, HugeNamesTakeNoTime) {
  make("mats/a/b.png");
  std::string deep;
  while (deep.size() < 4000) deep += "a/";
  EXPECT_EQ(found(deep + "b.png", false), "mats/a/b.png");
  EXPECT_EQ(found(std::string(1 << 20, '/') + "b.png", false), "");
  EXPECT_EQ(found(std::string(1000, 'x') + ".png", false), "");
}

TEST(FoldCase, BytesThatAreNoUtf8Stay) { EXPECT_EQ(fold_case("A\xC4Z\xC3\x84"), "a\xC4z\xC3\xA4"); }

}  // namespace
}  // namespace hybridrt
