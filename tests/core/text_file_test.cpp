#include "palpate/core/text_file.h"

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
  // A device has no size, and no end.
  EXPECT_EQ(messageOf("/dev/zero", 3 << 20), "/dev/zero: is too large: more than 3 MB");
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
