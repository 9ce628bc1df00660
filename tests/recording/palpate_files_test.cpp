// Native recordings among other programs: locks, growing files, links, journals, names.
#include <algorithm>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_faults.h"
#include "testing/testing.h"

namespace palpate::palpate_files_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

template <typename Work>
std::string fileErrorOf(Work work) {
  try {
    work();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' not in: " << text;
}

// An unfinished recording whose writer died inside a commit: with a rollback journal to play back.
// Returns how many frames were committed.
std::size_t makeHot(const fs::path& folder) {
  std::mt19937 random(3);
  for (std::int64_t n = operationsOfRun() / 2;; ++n) {
    FaultyVfs vfs;
    vfs.failAt(FaultyVfs::Fault::kPowerCut, n);
    const TemporaryFolder run;
    const RunResult result = record(run / "r.palpate");
    vfs.writeRemains(folder, random);
    const std::string journal = readFile(folder / "r.palpate-journal");
    if (!journal.empty() && journal[0] != 0) return result.committed;
  }
}

TEST(PalpateFiles, aSecondWriterIsToldAndHarmsNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  PalpateWriter writer(path, sdh2().layout);
  addSamples(writer, 0, 10);
  expectContains(fileErrorOf([&] { PalpateWriter second(path, sdh2().layout); }),
                 "is being written by another program");
  writeSamples(folder / "other.palpate", 5);
  expectContains(fileErrorOf([&] {
                   saveRecording(
                       openRecording(folder / "other.palpate"), {}, path, Overwrite::kReplace);
                 }),
                 "is being written by another program");
  addSamples(writer, 10, 20);
  writer.finish();
  expectFrames(path, 20, 20);
  expectContains(fileErrorOf([&] { PalpateWriter late(path, sdh2().layout); }), "exists already");
}

TEST(PalpateFiles, aGrowingFileReadsAsOfItsOpening) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  PalpateWriter writer(path, sdh2().layout);
  std::size_t written = 0;
  std::vector<std::pair<Profile, std::size_t>> opened;
  for (int round = 0; round < 10; ++round) {
    addSamples(writer, written, written + 37);
    written += 37;
    writer.commit();
    opened.emplace_back(openRecording(path), written);
    EXPECT_EQ(opened.back().first.info().warnings.size(), 1u);
    const VerifyReport report = verifyRecording(path);
    EXPECT_EQ(report.state, VerifyReport::State::kSound) << report.message;
    expectContains(report.message, "still being written");
  }
  writer.finish();
  for (const auto& [profile, frames] : opened) {
    ASSERT_EQ(profile.numFrames(), frames);
    for (std::size_t i = 0; i < frames; ++i)
      ASSERT_EQ(profile.frame(i).values, sampleFrame(i).values);
  }
  EXPECT_EQ(recoverRecording(path, folder / "out.palpate").state, RecoverReport::State::kWhole);
}

TEST(PalpateFiles, aLinkLeadsToTheJournalBesideTheFileItself) {
  const TemporaryFolder folder;
  const TemporaryFolder links;
  const std::size_t committed = makeHot(folder.path());
  fs::create_symlink(folder / "r.palpate", links / "link.palpate");
  const std::string bytes = readFile(folder / "r.palpate");
  const std::string journal = readFile(folder / "r.palpate-journal");
  expectFrames(links / "link.palpate", committed, kRunFrames);
  EXPECT_EQ(recoverRecording(links / "link.palpate", links / "out.palpate").state,
            RecoverReport::State::kWhole);
  // Opening and recovering touch neither.
  EXPECT_TRUE(readFile(folder / "r.palpate") == bytes);
  EXPECT_TRUE(readFile(folder / "r.palpate-journal") == journal);
}

TEST(PalpateFiles, aJournalIsNeverPlayedBackIntoAnotherRecording) {
  const TemporaryFolder folder;
  makeHot(folder.path());
  const TemporaryFolder other;
  writeSamples(other / "a.palpate", 100);
  const Profile profile = openRecording(other / "a.palpate");
  saveRecording(profile, {}, folder / "r.palpate", Overwrite::kReplace);
  EXPECT_FALSE(fs::exists(folder / "r.palpate-journal"));
  expectFrames(folder / "r.palpate", 100, 100);
  // Its recording was moved away: the journal still belongs to it.
  makeHot(folder.path());
  fs::rename(folder / "r.palpate", folder / "moved.palpate");
  expectContains(fileErrorOf([&] { saveRecording(profile, {}, folder / "r.palpate"); }),
                 "belongs to an unfinished recording");
  expectContains(fileErrorOf([&] { PalpateWriter writer(folder / "r.palpate", sdh2().layout); }),
                 "belongs to an unfinished recording");
}

TEST(PalpateFiles, nothingIsWrittenOntoItsSource) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 20);
  fs::create_hard_link(folder / "a.palpate", folder / "b.palpate");
  fs::create_symlink(folder / "a.palpate", folder / "c.palpate");
  const std::string bytes = readFile(folder / "a.palpate");
  for (const char* out : {"a.palpate", "b.palpate", "c.palpate"})
    expectContains(fileErrorOf([&] {
                     recoverRecording(folder / "a.palpate", folder / out, Overwrite::kReplace);
                   }),
                   "is the input itself");
  EXPECT_TRUE(readFile(folder / "a.palpate") == bytes);
}

TEST(PalpateFiles, aFinishedRecordingOpensFromAReadOnlyFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 20);
  const std::size_t hot = makeHot(folder.path());
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(openRecording(folder / "a.palpate").numFrames(), 20u);
  EXPECT_GE(openRecording(folder / "r.palpate").numFrames(), hot);
  EXPECT_NE(fileErrorOf([&] { PalpateWriter writer(folder / "b.palpate", sdh2().layout); }), "");
  fs::permissions(folder.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace palpate::palpate_files_test
