#include "palpate/interop/remote_file.h"

#include <stdexcept>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::remote_file_test {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;

TEST(RemoteRecordingPath, APlainNameAsItIs) {
  const TemporaryFolder folder;
  EXPECT_EQ(remoteRecordingPath(folder.path(), "run 7", {}), folder / "run 7.palpate");
  EXPECT_EQ(remoteRecordingPath(folder.path(), "run.7.palpate", {}), folder / "run.7.palpate");
  EXPECT_EQ(remoteRecordingPath(folder.path(), "Übung~1", {}), folder / "Übung~1.palpate");
}

TEST(RemoteRecordingPath, ATemplateCountsUp) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "ball_004.palpate", "x");
  EXPECT_EQ(remoteRecordingPath(folder.path(), "{object}_{run}", {0, "", "ball"}),
            folder / "ball_005.palpate");
  // The text inserted for a placeholder can't lead out of the folder either.
  const fs::path path = remoteRecordingPath(folder.path(), "{object}_{run}", {0, "", "../../etc"});
  EXPECT_EQ(path.parent_path(), folder.path());
}

TEST(RemoteRecordingPath, NothingLeavesTheFolder) {
  const TemporaryFolder folder;
  for (const std::string& name : {std::string("../a"),
                                  std::string("/tmp/a"),
                                  std::string("a/b"),
                                  std::string(".."),
                                  std::string("."),
                                  std::string(".hidden"),
                                  std::string("-o"),
                                  std::string(""),
                                  std::string("a\0b", 3),
                                  std::string("a\nb"),
                                  std::string("\xff.palpate"),
                                  std::string("../{run}"),
                                  std::string("{run}/../../a"),
                                  std::string("{shell}"),
                                  std::string("{run"),
                                  std::string("a.dsa"),
                                  std::string("a.jsonl"),
                                  std::string(201, 'a')}) {
    EXPECT_NE(problemOfRemoteName(name), "") << name;
    EXPECT_THROW(remoteRecordingPath(folder.path(), name, {}), std::invalid_argument) << name;
  }
  EXPECT_EQ(problemOfRemoteName("a"), "");
  EXPECT_EQ(problemOfRemoteName("{date}_{run}.palpate"), "");
  EXPECT_THROW(remoteRecordingPath(folder / "no", "a", {}), FileError);
}

}  // namespace
}  // namespace palpate::remote_file_test
