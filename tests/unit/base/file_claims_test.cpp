#include "core/base/file_claims.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

using Answer = FileClaims::Answer;

class FileClaimsTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

// Claims within one process conflict like those of two processes: the locks belong to the open file.
TEST_F(FileClaimsTest, FilesAreClaimedOnce) {
  FileClaims one;
  EXPECT_EQ(one.claim(folder_.path / "a.png"), Answer::ours);
  EXPECT_EQ(one.claim(folder_.path / "a.png"), Answer::ours) << "a claim does not conflict with itself";
  {
    FileClaims two;
    EXPECT_EQ(two.claim(folder_.path / "." / "a.png"), Answer::taken);
    EXPECT_EQ(two.claim(folder_.path / "b.png"), Answer::ours);
    EXPECT_EQ(one.claim(folder_.path / "b.png"), Answer::taken);
  }
  EXPECT_EQ(one.claim(folder_.path / "b.png"), Answer::ours);
  EXPECT_EQ(folder_.names(), std::set<std::string>{".hybridrt.lock"});
}

TEST_F(FileClaimsTest, TheLastOneRemovesTheLockFile) {
  {
    FileClaims one;
    EXPECT_EQ(one.claim(folder_.path / "a.png"), Answer::ours);
    {
      FileClaims two;
      EXPECT_EQ(two.claim(folder_.path / "b.png"), Answer::ours);
    }
    EXPECT_EQ(folder_.names().size(), 1u);
    FileClaims three;
    EXPECT_EQ(three.claim(folder_.path / "a.png"), Answer::taken);
  }
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(FileClaimsTest, FramesOverlapOrDoNot) {
  FileClaims one, two;
  EXPECT_EQ(one.claim(folder_.path, "x.#.png", 10, 20), Answer::ours);
  for (const auto& [first, last] : {std::pair{1, 10}, {20, 20}, {15, 16}, {1, 1000000}})
    EXPECT_EQ(two.claim(folder_.path, "x.#.png", first, last), Answer::taken) << first << "-" << last;
  EXPECT_EQ(two.claim(folder_.path, "x.#.png", 1, 9), Answer::ours);
  EXPECT_EQ(two.claim(folder_.path, "x.#.png", 21, 2147483647), Answer::ours);
  EXPECT_EQ(two.claim(folder_.path, "y.#.png", 10, 20), Answer::ours);
}

TEST_F(FileClaimsTest, SymbolicLinksAreFollowed) {
  std::filesystem::create_directory(folder_.path / "real");
  std::filesystem::create_directory_symlink("real", folder_.path / "link");
  FileClaims one, two;
  EXPECT_EQ(one.claim(folder_.path / "real" / "a.png"), Answer::ours);
  EXPECT_EQ(two.claim(folder_.path / "link" / "a.png"), Answer::taken);
}

TEST_F(FileClaimsTest, TheDeadClaimNothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    FileClaims claims;
    const Answer answer = claims.claim(folder_.path / "a.png");
    ::_exit(answer == Answer::ours ? 0 : 1);  // without the destructor, as if killed
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  EXPECT_EQ(folder_.names(), std::set<std::string>{".hybridrt.lock"});
  {
    FileClaims claims;
    EXPECT_EQ(claims.claim(folder_.path / "a.png"), Answer::ours);
  }
  EXPECT_TRUE(folder_.names().empty());
}

/// Runs `body(i)` in `count` processes at once; true if all of them returned true.
template <typename Body>
bool in_processes(int count, const Body& body) {
  for (int i = 0; i < count; ++i)
    if (::fork() == 0) ::_exit(body(i) ? 0 : 1);
  bool all = true;
  for (int status = 0; ::wait(&status) > 0;) all = all && status == 0;
  return all;
}

// The lock file is removed and created again all the time.
TEST_F(FileClaimsTest, DisjointFramesAreNeverRefused) {
  EXPECT_TRUE(in_processes(8, [&](int process) {
    for (int i = 0; i < 300; ++i) {
      FileClaims claims;
      if (claims.claim(folder_.path, "x", 10 * process, 10 * process + 9) != Answer::ours) return false;
    }
    return true;
  }));
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(FileClaimsTest, NoTwoHoldTheSameFrames) {
  EXPECT_TRUE(in_processes(8, [&](int process) {
    int held = 0;
    for (int i = 0; held < 50; ++i) {
      FileClaims claims;
      const int part = (i + process) % 3;
      const Answer answer = claims.claim(folder_.path, "x", 10 * part, 10 * part + 9);
      if (answer == Answer::unknown) return false;  // it would try for ever
      if (answer != Answer::ours) continue;
      const std::filesystem::path mine = folder_.path / std::to_string(part);
      const int descriptor = ::open(mine.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
      if (descriptor < 0) return false;  // another process is in it
      ::close(descriptor);
      ::unlink(mine.c_str());
      ++held;
    }
    return true;
  }));
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(FileClaimsTest, DevicesNeedNoClaim) {
  FileClaims one, two;
  EXPECT_EQ(one.claim("/dev/null"), Answer::ours);
  EXPECT_EQ(two.claim("/dev/null"), Answer::ours);
}

TEST_F(FileClaimsTest, PlacesThatCannotBeAreNamed) {
  const std::filesystem::path file = folder_.write("file", "x");
  FileClaims claims;
  try {
    (void)claims.claim(file / "deep" / "a.png");
    ADD_FAILURE() << "claimed";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::output);
    EXPECT_NE(std::string(failure.what()).find("deep/a.png"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace hybridrt
