#include "core/base/output_file.h"

#include <atomic>
#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// The message of the Error (output) that writing must throw.
std::string refusal_of(const fs::path& path, std::string_view text) {
  try {
    write_file_atomically(path, text);
  } catch (const Error& refusal) {
    EXPECT_EQ(refusal.kind(), ErrorKind::output);
    return refusal.what();
  }
  ADD_FAILURE() << path << " was written";
  return "";
}

TEST(OutputFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "a.txt";
  write_file_atomically(path, std::string_view("first, and longer"));
  write_file_atomically(path, std::string_view("second"));
  EXPECT_EQ(file_contents(path), "second");
  write_file_atomically(path, std::string_view(""));
  EXPECT_EQ(file_contents(path), "");
  EXPECT_EQ(folder.names(), Names{"a.txt"}) << "no temporary stays";
}

TEST(OutputFile, TakesTheLongestNames) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file_atomically(folder.path / name, std::string_view("x"));
  EXPECT_EQ(folder.names(), Names{name});
}

TEST(OutputFile, NamesTheProblem) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal_of(folder.path, "x").find("directory"), std::string::npos);
  write_file_atomically(folder.path / "file", std::string_view("x"));
  EXPECT_NE(refusal_of(folder.path / "file/a.txt", "x").find("Not a directory"), std::string::npos);
}

TEST(OutputFile, FollowsSymbolicLinks) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path / "real", std::string_view("old"));
  fs::create_symlink("real", folder.path / "link");
  write_file_atomically(folder.path / "link", std::string_view("new"));
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_EQ(file_contents(folder.path / "real"), "new");
}

TEST(OutputFile, LeavesDevicesInPlace) {
  write_file_atomically("/dev/null", std::string_view("x"));
  EXPECT_EQ(fs::status("/dev/null").type(), fs::file_type::character);
  EXPECT_NE(refusal_of("/dev/full", "x").find("No space left"), std::string::npos);
}

// A write that fails halfway, as on a full disk: the old file survives and the temporary is gone.
TEST(OutputFile, KeepsTheOldFileWhenTheWriteEndsHalfway) {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "a.bin";
  write_file_atomically(path, std::string_view("old"));

  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = 10000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  const std::string message = refusal_of(path, std::string(20000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_EQ(file_contents(path), "old");
  EXPECT_EQ(folder.names(), Names{"a.bin"});
}

// A reader that polls sees complete files only, whoever writes.
TEST(OutputFile, ReadersNeverSeeATornFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "a.bin";
  write_file_atomically(path, std::string(1 << 18, 'a'));
  std::atomic<int> writing{2};
  std::vector<std::thread> writers;
  for (const char letter : {'b', 'c'})
    writers.emplace_back([&, letter] {
      for (int i = 0; i < 20; ++i) write_file_atomically(path, std::string(1 << 18, letter));
      --writing;
    });
  int torn = 0;
  while (writing > 0) {
    const std::string seen = file_contents(path);
    torn += seen.size() != 1 << 18 || seen.find_first_not_of(seen[0]) != std::string::npos;
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(folder.names(), Names{"a.bin"});
}

size_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const auto path = folder.path / "deep" / "down" / "file.txt";
  {
    OutputFile file(path);
    file.write("half");
  }
  EXPECT_EQ(files_in(path.parent_path()), 0u);
  const std::string large(3 << 20, 'x');
  {
    OutputFile file(path);
    file.write("a");
    file.write(large);
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
    EXPECT_EQ(file.bytes(), large.size() + 1);
  }
  EXPECT_TRUE(file_contents(path) == "a" + large);
  EXPECT_EQ(files_in(path.parent_path()), 1u);
}

TEST(OutputFile, ReplacesAndFollowsLinks) {
  const TemporaryFolder folder;
  const auto real = folder.write("real.txt", "old"), link = folder.path / "link.txt";
  std::filesystem::create_symlink("real.txt", link);
  OutputFile file(link);
  file.write("new");
  file.commit();
  EXPECT_EQ(file_contents(real), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(OutputFile, WritesADeviceWithoutReplacingIt) {
  write_file_atomically("/dev/null", std::string_view("x"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, AFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1 << 16, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // then write() fails as it does on a full disk
  ::setrlimit(RLIMIT_FSIZE, &small);
  try {
    OutputFile file(folder.path / "file.txt");
    file.write(std::string(1 << 20, 'x'));
    file.commit();
    ADD_FAILURE() << "wrote past the limit";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::output);
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(files_in(folder.path), 0u);
}

}  // namespace
}  // namespace hybridrt
