#include "palpate/core/text_file.h"

#include <sys/stat.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::text_file_test {
namespace {

std::string messageOf(const std::filesystem::path& path, std::uint64_t byteLimit) {
  try {
    readTextFile(path, byteLimit);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TextFile, GivesAllBytesUpToTheBound) {
  const testing::TemporaryFolder folder;
  std::string bytes(200'000, 'x');
  bytes[7] = '\0';
  testing::writeFile(folder / "a", bytes);
  EXPECT_TRUE(readTextFile(folder / "a", 200'000) == bytes);
  testing::writeFile(folder / "empty", "");
  EXPECT_EQ(readTextFile(folder / "empty", 10), "");
}

TEST(TextFile, RefusesWhatIsTooLargeWhateverItIs) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a", std::string(1001, 'x'));
  EXPECT_THROW(readTextFile(folder / "a", 1000), FormatError);
  EXPECT_EQ(messageOf(folder / "a", 1000),
            (folder / "a").string() + ": is too large: more than 1000 bytes");
  testing::writeFile(folder / "a", std::string((3 << 20) + 1, 'x'));
  EXPECT_EQ(messageOf(folder / "a", 3 << 20),
            (folder / "a").string() + ": is too large: more than 3 MB");
}

TEST(TextFile, RefusesWhatIsNoRegularFile) {
  const testing::TemporaryFolder folder;
  const auto fifo = folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(messageOf(fifo, 10), fifo.string() + ": is not a regular file");
  EXPECT_EQ(messageOf("/dev/zero", 10), "/dev/zero: is not a regular file");
  EXPECT_EQ(beginningOfFile(fifo, 10), "");
  EXPECT_EQ(beginningOfFile("/dev/zero", 10), "");
}

TEST(TextFile, SaysWhyItCanNotBeOpened) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(readTextFile(folder / "none", 10), FileError);
  EXPECT_EQ(messageOf(folder / "none", 10),
            (folder / "none").string() + ": can't be opened: No such file or directory");
  EXPECT_EQ(messageOf(folder.path(), 10), folder.path().string() + ": is a folder");
}

TEST(TextFile, BeginningOfAFileIsAllThatIsThereOfIt) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a", std::string("ab\0cd", 5));
  EXPECT_EQ(beginningOfFile(folder / "a", 3), std::string("ab\0", 3));
  EXPECT_EQ(beginningOfFile(folder / "a", 9), std::string("ab\0cd", 5));
  EXPECT_EQ(beginningOfFile(folder / "none", 9), "");
  EXPECT_EQ(beginningOfFile(folder.path(), 9), "");
}

}  // namespace
}  // namespace palpate::text_file_test
