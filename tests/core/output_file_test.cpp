#include "palpate/core/output_file.h"

#include <cerrno>
#include <system_error>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::output_file_test {
namespace {

namespace fs = std::filesystem;
using palpate::testing::readFile;
using palpate::testing::TemporaryFolder;
using palpate::testing::writeFile;

std::size_t numFiles(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFile, AppearsWholeOnCommit) {
  const TemporaryFolder folder;
  OutputFile out(folder / "a.txt");
  out.write("one ");
  out.write("two");
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  out.commit();
  EXPECT_EQ(readFile(folder / "a.txt"), "one two");
  EXPECT_EQ(numFiles(folder.path()), 1u);
}

TEST(OutputFile, CanBeWrittenByWhoeverOpensItsDescriptorAnew) {
  const TemporaryFolder folder;
  OutputFile out(folder / "a.txt");
  writeFile("/proc/self/fd/" + std::to_string(out.descriptor()), "by another");
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  out.commit();
  EXPECT_EQ(readFile(folder / "a.txt"), "by another");
}

TEST(OutputFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  { OutputFile(folder / "a.txt").write("lost"); }
  EXPECT_EQ(numFiles(folder.path()), 0u);
}

TEST(OutputFile, RefusesToReplaceUnlessAsked) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "old");
  EXPECT_THROW(OutputFile(folder / "a.txt"), FileError);
  OutputFile out(folder / "a.txt", Overwrite::kReplace);
  out.write("new");
  EXPECT_EQ(readFile(folder / "a.txt"), "old");
  out.commit();
  EXPECT_EQ(readFile(folder / "a.txt"), "new");
}

TEST(OutputFile, RefusesAFileThatAppearedMeanwhile) {
  const TemporaryFolder folder;
  OutputFile out(folder / "a.txt");
  out.write("mine");
  writeFile(folder / "a.txt", "somebody else's");
  EXPECT_THROW(out.commit(), FileError);
  EXPECT_EQ(readFile(folder / "a.txt"), "somebody else's");
}

TEST(OutputFile, IsAsReadableAsAnyFile) {
  const TemporaryFolder folder;
  const mode_t mask = ::umask(022);
  OutputFile out(folder / "a.txt");
  ::umask(mask);
  out.commit();
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(OutputFile, WritesWhatALinkPointsToAndKeepsTheLink) {
  const TemporaryFolder folder;
  writeFile(folder / "target.txt", "old");
  fs::create_symlink("target.txt", folder / "link.txt");
  EXPECT_THROW(OutputFile(folder / "link.txt"), FileError);
  OutputFile out(folder / "link.txt", Overwrite::kReplace);
  out.write("new");
  out.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readFile(folder / "target.txt"), "new");
}

TEST(OutputFile, NeverReplacesADeviceOrAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(OutputFile(folder / "pipe", Overwrite::kReplace), FileError);
  EXPECT_THROW(OutputFile("/dev/null", Overwrite::kReplace), FileError);
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(OutputFile, TakesTheLongestNameThereIs) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  OutputFile out(folder / name);
  out.commit();
  EXPECT_TRUE(fs::exists(folder / name));
}

// The disk is full: here by a limit on the size of files, in a process of its own.
TEST(OutputFile, AFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto write = [&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      OutputFile out(folder / "a.txt");
      out.write(std::string(10'000, 'x'));
      out.commit();
    } catch (const FileError&) {
      ::_exit(7);
    }
    ::_exit(0);
  };
  EXPECT_EXIT(write(), ::testing::ExitedWithCode(7), "");
  EXPECT_EQ(numFiles(folder.path()), 0u);
}

// O-A24: one way of saying it, whatever is written.
TEST(OutputFile, AFullDiskIsSaidInPlainWords) {
  EXPECT_EQ(writeFailureText(ENOSPC), "the disk is full");
  EXPECT_EQ(writeFailureText(EACCES), std::generic_category().message(EACCES));
}

TEST(OutputFile, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFile(folder / "missing" / "a.txt"), FileError);
  EXPECT_THROW(OutputFile(folder.path(), Overwrite::kReplace), FileError);
  try {
    OutputFile out("/dev/full/a");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/full/a"), std::string::npos);
  }
}

}  // namespace
}  // namespace palpate::output_file_test
