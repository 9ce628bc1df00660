#include "palpate/library/recording_files.h"

#include <array>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::recording_files_test {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::writeFile;

class RecordingFiles : public ::testing::Test {
 protected:
  std::string contentOf(const std::string& name) { return testing::readFile(folder_ / name); }
  fs::path file(const std::string& name) {
    writeFile(folder_ / name, "content of " + name);
    return folder_ / name;
  }
  std::string refusal(std::span<const fs::path> parts, const std::string& stem) {
    try {
      renameRecording(parts, stem);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  const TemporaryFolder folder_;
};

TEST_F(RecordingFiles, TheMcapBesideItAndTheNotesOfADsaBelongToIt) {
  const fs::path a = file("a.palpate"), mcap = file("a.mcap");
  file("a.csv");
  EXPECT_EQ(filesOfRecording(a), (std::vector{a, mcap}));
  const fs::path dsa = file("b.dsa"), notes = file("b.dsa.notes.json");
  file("b.mcap");
  EXPECT_EQ(filesOfRecording(dsa), (std::vector{dsa, notes}));
  EXPECT_TRUE(filesOfRecording(folder_ / "none.palpate").empty());
}

TEST_F(RecordingFiles, AllPartsAndWhatBelongsToThemGetTheNewName) {
  const std::array parts{file("run_001.palpate"), file("run_001_002.palpate")};
  file("run_001.mcap");
  file("run_001_002.mcap");
  const auto named = renameRecording(parts, "good");
  EXPECT_EQ(named, (std::vector{folder_ / "good.palpate", folder_ / "good_002.palpate"}));
  EXPECT_EQ(contentOf("good.palpate"), "content of run_001.palpate");
  EXPECT_EQ(contentOf("good_002.palpate"), "content of run_001_002.palpate");
  EXPECT_EQ(contentOf("good.mcap"), "content of run_001.mcap");
  EXPECT_EQ(contentOf("good_002.mcap"), "content of run_001_002.mcap");
  EXPECT_FALSE(fs::exists(parts[0]));
  EXPECT_FALSE(fs::exists(folder_ / "run_001_002.mcap"));
}

TEST_F(RecordingFiles, TheSameNameChangesNothing) {
  const std::array parts{file("a.palpate")};
  EXPECT_EQ(renameRecording(parts, "a"), std::vector{parts[0]});
  EXPECT_EQ(contentOf("a.palpate"), "content of a.palpate");
}

TEST_F(RecordingFiles, NothingIsReplacedAndAllKeepTheirNames) {
  const std::array parts{file("a.palpate"), file("a_002.palpate")};
  file("b_002.palpate");
  EXPECT_EQ(refusal(parts, "b"),
            (folder_ / "b_002.palpate").string() + ": exists already; give another name");
  EXPECT_EQ(contentOf("a.palpate"), "content of a.palpate");
  EXPECT_FALSE(fs::exists(folder_ / "b.palpate"));
  file("c.mcap");
  file("a.mcap");
  EXPECT_NE(refusal(parts, "c"), "") << "an MCAP file has the name";
}

TEST_F(RecordingFiles, WhatIsNoNameIsRefused) {
  const std::array parts{file("a.palpate")};
  for (const char* stem : {"", ".hidden", "other/place", ".."})
    EXPECT_THROW(renameRecording(parts, stem), std::invalid_argument) << stem;
  EXPECT_THROW(renameRecording({}, "b"), std::invalid_argument);
  const std::array gone{folder_ / "gone.palpate"};
  EXPECT_NE(refusal(gone, "b").find("isn't there any more"), std::string::npos);
}

TEST_F(RecordingFiles, ARecordingThatIsBeingWrittenIsNotTouched) {
  const std::array parts{folder_ / "a.palpate"};
  {
    PalpateWriter writer(parts[0], sdh2().layout, {}, {});
    EXPECT_TRUE(isBeingWritten(parts[0]));
    EXPECT_NE(refusal(parts, "b").find("is being written"), std::string::npos);
    EXPECT_THROW(requireNotBeingWritten(parts), FileError);
    EXPECT_THROW(deleteRecording(parts), FileError);
    EXPECT_TRUE(fs::exists(parts[0]));
    writer.finish();
  }
  EXPECT_FALSE(isBeingWritten(parts[0]));
  EXPECT_EQ(refusal(parts, "b"), "");
  EXPECT_EQ(verifyRecording(folder_ / "b.palpate").state, VerifyReport::State::kSound);
}

TEST_F(RecordingFiles, AnUnfinishedOneKeepsItsName) {
  const std::array parts{file("a.palpate")};
  file("a.palpate-journal");
  EXPECT_NE(refusal(parts, "b").find("was never finished"), std::string::npos);
}

// A killed writer leaves its lock, which nobody holds.
TEST_F(RecordingFiles, ALockThatIsLeftDoesntStayWithoutItsRecording) {
  const std::vector<fs::path> a{file("a.palpate")}, c{file("c.palpate")};
  file("a.palpate.lock");
  EXPECT_EQ(renameRecording(a, "b"), std::vector{folder_ / "b.palpate"});
  EXPECT_FALSE(fs::exists(folder_ / "a.palpate.lock"));
  EXPECT_FALSE(fs::exists(folder_ / "b.palpate.lock"));
  file("c.palpate.lock");
  deleteRecording(c);
  EXPECT_FALSE(fs::exists(folder_ / "c.palpate.lock"));
}

TEST_F(RecordingFiles, IsDeletedWithAllThatBelongsToIt) {
  const std::array parts{file("a.palpate"), folder_ / "gone.palpate"};
  file("a.mcap");
  file("ab.palpate");
  deleteRecording(parts);
  EXPECT_FALSE(fs::exists(folder_ / "a.palpate"));
  EXPECT_FALSE(fs::exists(folder_ / "a.mcap"));
  EXPECT_TRUE(fs::exists(folder_ / "ab.palpate"));
}

}  // namespace
}  // namespace palpate::recording_files_test
