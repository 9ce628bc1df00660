#include "palpate/core/file_id.h"

#include <filesystem>
#include <string>

#include <fcntl.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"

#include "testing/testing.h"

namespace palpate::file_id_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

std::string goneText(const fs::path& path, const FileId& file) {
  EXPECT_FALSE(leadsTo(path, file));
  try {
    requireLeadsTo(path, file);
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), path);
    return error.what();
  }
  return "not gone";
}

TEST(FileId, isThatOfTheFileAndNotOfItsName) {
  const TemporaryFolder folder;
  writeFile(folder / "a", "1");
  writeFile(folder / "b", "1");
  const auto a = fileIdOf(folder / "a");
  ASSERT_TRUE(a);
  EXPECT_NE(a, fileIdOf(folder / "b"));
  const FileDescriptor open(::open((folder / "a").c_str(), O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(fileIdOf(open.get()), a);
  fs::create_symlink("a", folder / "link");
  EXPECT_EQ(fileIdOf(folder / "link"), a);
  fs::rename(folder / "a", folder / "c");
  EXPECT_EQ(fileIdOf(folder / "c"), a);
  EXPECT_EQ(fileIdOf(folder / "a"), std::nullopt);
  EXPECT_EQ(fileIdOf(-1), std::nullopt);
}

TEST(FileId, aNameThatLeadsElsewhereIsNoticedAndTheReasonSaid) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "in");
  const fs::path path = folder / "in/a";
  writeFile(path, "1");
  // Open: its number isn't given to another file.
  const FileDescriptor open(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const FileId file = *fileIdOf(open.get());
  EXPECT_TRUE(leadsTo(path, file));
  EXPECT_NO_THROW(requireLeadsTo(path, file));
  fs::remove(path);
  EXPECT_NE(goneText(path, file).find("the file was moved, renamed or deleted"), std::string::npos);
  writeFile(path, "2");
  EXPECT_NE(goneText(path, file).find("something else was put in its place"), std::string::npos);
  fs::remove(path);
  fs::create_symlink("nowhere", path);
  EXPECT_NE(goneText(path, file).find("something else was put in its place"), std::string::npos);
  fs::remove_all(folder / "in");
  EXPECT_NE(goneText(path, file).find("its folder was moved, renamed or deleted"),
            std::string::npos);
  writeFile(folder / "in", "no folder");
  EXPECT_FALSE(leadsTo(path, file));
}

// Too long to be looked up: nobody knows.
TEST(FileId, aNameThatCantBeLookedUpCountsAsUnchanged) {
  EXPECT_TRUE(leadsTo(std::string(5000, 'x'), FileId{1, 2}));
}

}  // namespace
}  // namespace palpate::file_id_test
