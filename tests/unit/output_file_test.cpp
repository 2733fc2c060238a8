#include "core/base/output_file.h"

#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/base/error.h"
#include "tests/unit/temporary_folder.h"

namespace hybridrt {
namespace {

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
