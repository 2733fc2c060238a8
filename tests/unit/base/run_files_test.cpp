#include "core/base/run_files.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/file_claims.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

TEST(RunFiles, OneFileHasOneIdentity) {
  const TemporaryFolder folder;
  const fs::path real = folder.write("a", "x");
  fs::create_symlink("a", folder.path / "link");
  fs::create_hard_link(real, folder.path / "hard");
  fs::create_symlink("later", folder.path / "to_later");
  for (const char* same : {"link", "hard", "./a", "missing/../a"})
    EXPECT_EQ(file_identity(folder.path / same), file_identity(real)) << same;
  EXPECT_EQ(file_identity(folder.path / "to_later"), file_identity(folder.path / "later"));
  EXPECT_NE(file_identity(folder.path / "b"), file_identity(real));
  EXPECT_EQ(file_identity("/dev/null"), "");
}

TEST(RunFiles, RefusesWhatIsReadOrWritten) {
  const TemporaryFolder folder;
  const fs::path read = folder.write("a", "x"), written = folder.path / "b";
  RunFiles files;
  files.reads(read);
  files.reads(read);
  EXPECT_THROW(files.writes(read, "-o"), Error);
  files.writes(written, "-o");
  EXPECT_THROW(files.writes(written, "--timings"), Error);
  EXPECT_THROW(files.require_unused(written, "--timings"), Error);
  files.writes("/dev/null", "-o");
  files.writes("/dev/null", "--timings");
  EXPECT_EQ(files.paths().size(), 2u);
}

TEST(NumberedName, IsTheLastNumberBeforeTheExtension) {
  const auto is = [](const char* file, const char* name, int64_t number) {
    const NumberedName found = numbered_name(file);
    EXPECT_EQ(found.name, name) << file;
    EXPECT_EQ(found.number, number) << file;
  };
  is("x.0007.png", "x.#.png", 7);
  is("q/shot2_0100.jp2", "shot2_#.jp2", 100);
  is("5.png", "#.png", 5);
  is("a7b", "a#b", 7);
  is("x.png", "x.png", -1);
  is("x.99999999999.png", "x.99999999999.png", -1);
}

}  // namespace
}  // namespace hybridrt
