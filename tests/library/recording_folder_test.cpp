#include "palpate/library/recording_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::recording_folder_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

std::vector<std::string> namesOf(const std::vector<fs::path>& paths, const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.lexically_relative(folder).string());
  return names;
}

TEST(RecordingFolder, findsRecordingsByTheirNamesInAllFoldersBelow) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "b/c");
  fs::create_directories(folder / ".hidden");
  for (const char* name : {"z.dsa",
                           "a.PALPATE",
                           "b/x.Dsa",
                           "b/c/y.palpate",
                           "b/notes.txt",
                           ".hidden.dsa",
                           ".hidden/q.dsa",
                           "z.dsa.notes.json",
                           "y.palpate.lock",
                           "y.palpate-journal",
                           "without"})
    writeFile(folder / name, "x");
  writeSamples(folder / "n.palpate", 3);
  fs::rename(folder / "n.palpate", folder / "native");
  fs::create_directory(folder / "folder.dsa");
  ASSERT_EQ(mkfifo((folder / "pipe.dsa").c_str(), 0600), 0);
  const RecordingFolder listing = recordingsBelow(folder.path());
  EXPECT_EQ(namesOf(listing.files, folder.path()),
            (std::vector<std::string>{"a.PALPATE", "b/c/y.palpate", "b/x.Dsa", "native", "z.dsa"}));
  EXPECT_EQ(namesOf(listing.folders, folder.path()),
            (std::vector<std::string>{".", "b", "b/c", "folder.dsa"}));
  EXPECT_TRUE(listing.problems.empty());
}

TEST(RecordingFolder, linksInCirclesAreWalkedOnce) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "a");
  fs::create_directories(folder / "b");
  writeFile(folder / "a/one.dsa", "x");
  writeFile(folder / "b/two.dsa", "x");
  fs::create_directory_symlink(folder.path(), folder / "a/up");
  fs::create_directory_symlink(folder / "b", folder / "a/other");
  fs::create_directory_symlink(folder / "a", folder / "b/other");
  fs::create_symlink(folder / "a/one.dsa", folder / "again.dsa");
  fs::create_symlink("loop.dsa", folder / "loop.dsa");
  const RecordingFolder listing = recordingsBelow(folder.path());
  std::vector<std::string> names = namesOf(listing.files, folder.path());
  std::erase(names, "loop.dsa");  // leads nowhere: whoever reads it says so
  EXPECT_EQ(names, (std::vector<std::string>{"a/one.dsa", "b/two.dsa"}));
}

TEST(RecordingFolder, whatCantBeLookedIntoIsSaid) {
  const TemporaryFolder folder;
  const RecordingFolder missing = recordingsBelow(folder / "missing");
  EXPECT_TRUE(missing.files.empty());
  ASSERT_EQ(missing.problems.size(), 1u);
  EXPECT_NE(missing.problems[0].find("can't be read"), std::string::npos);
  if (geteuid() == 0) return;  // root may look everywhere
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::none);
  EXPECT_EQ(recordingsBelow(folder.path()).problems.size(), 1u);
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(RecordingFolder, canBeCancelled) {
  const TemporaryFolder folder;
  for (int i = 0; i < 50; ++i) writeFile(folder / (std::to_string(i) + ".dsa"), "x");
  int asked = 0;
  EXPECT_THROW(recordingsBelow(folder.path(), [&](double) { return ++asked < 10; }), Cancelled);
  EXPECT_EQ(asked, 10);
}

}  // namespace
}  // namespace palpate::recording_folder_test
