// Native recordings among other programs: locks, growing files, links, journals, names.
#include <algorithm>
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_damage.h"
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

// Names of all that lies in a folder.
std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
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

// Whether this process has the file open.
bool isOpen(const fs::path& path) {
  std::error_code ignored;
  const fs::path wanted = fs::canonical(path, ignored);
  for (const auto& entry : fs::directory_iterator("/proc/self/fd"))
    if (fs::read_symlink(entry.path(), ignored) == wanted) return true;
  return false;
}

// SQLite would open and close it at each commit, and sync its folder each time.
TEST(PalpateFiles, theJournalStaysOpenBetweenTwoCommits) {
  const TemporaryFolder folder;
  const fs::path journal = folder / "r.palpate-journal";
  PalpateWriter writer(folder / "r.palpate", sdh2().layout);
  addSamples(writer, 0, 10);
  writer.commit();
  EXPECT_TRUE(isOpen(journal));
  EXPECT_EQ(readFile(journal).at(0), '\0');
  // Removed, it is made anew: a journal without a name would be lost with the process.
  fs::remove(journal);
  addSamples(writer, 10, 20);
  writer.commit();
  EXPECT_TRUE(fs::exists(journal));
  EXPECT_TRUE(isOpen(journal));
  writer.finish();
  EXPECT_FALSE(fs::exists(journal));
  expectFrames(folder / "r.palpate", 20, 20);
}

TEST(PalpateFiles, aLockThatIsALinkIsRefusedAndItsTargetIsNotMade) {
  const TemporaryFolder folder;
  fs::create_symlink(folder / "target", folder / "r.palpate.lock");
  expectContains(fileErrorOf([&] { PalpateWriter writer(folder / "r.palpate", sdh2().layout); }),
                 "a symbolic link has the name of its lock file (r.palpate.lock)");
  EXPECT_FALSE(fs::exists(folder / "target"));
  EXPECT_FALSE(fs::exists(folder / "r.palpate"));
  EXPECT_TRUE(fs::is_symlink(folder / "r.palpate.lock"));
}

TEST(PalpateFiles, aFileThatIsGoneIsWrittenNoMoreUntilItIsMoved) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  PalpateWriterOptions options;
  options.commitIntervalUs = INT64_MAX;
  PalpateWriter writer(path, sdh2().layout, {}, options);
  addSamples(writer, 0, 10);
  writer.commit();
  EXPECT_FALSE(writer.isGone());
  fs::rename(path, folder / "mine.palpate");
  EXPECT_TRUE(writer.isGone());
  // Also when nothing waits.
  expectContains(fileErrorOf([&] { writer.commit(); }), "is gone");
  addSamples(writer, 10, 20);
  expectContains(fileErrorOf([&] { writer.commit(); }), "is gone");
  addSamples(writer, 20, 30);
  expectContains(fileErrorOf([&] { writer.finish(); }), "is gone");
  writeFile(folder / "taken.palpate", "somebody's");
  expectContains(fileErrorOf([&] { writer.moveTo(folder / "taken.palpate"); }), "exists already");
  expectContains(fileErrorOf([&] { writer.moveTo(folder / "no/r.palpate"); }), "can't be written");
  EXPECT_TRUE(writer.isGone());
  writer.moveTo(path);
  EXPECT_FALSE(writer.isGone());
  expectContains(fileErrorOf([&] { PalpateWriter second(path, sdh2().layout); }),
                 "is being written by another program");
  writer.finish();
  // What is finished can go, too.
  fs::remove(path);
  expectContains(fileErrorOf([&] { writer.finish(); }), "is gone");
  writer.moveTo(folder / "kept.palpate");
  writer.finish();
  expectFrames(folder / "kept.palpate", 30, 30);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"kept.palpate", "mine.palpate", "taken.palpate"}));
  EXPECT_EQ(openRecording(folder / "mine.palpate").numFrames(), 10u);
}

// A commit that failed half way is undone before the file is copied.
TEST(PalpateFiles, aMoveThatFailsKeepsTheLock) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  PalpateWriter writer(path, sdh2().layout);
  addSamples(writer, 0, 10);
  writer.commit();
  fs::rename(path, folder / "mine.palpate");
  writeFile(path, "somebody's");
  EXPECT_THROW(writer.moveTo(path), FileError);
  fs::remove(path);
  expectContains(fileErrorOf([&] { PalpateWriter second(path, sdh2().layout); }),
                 "is being written by another program");
  EXPECT_FALSE(fs::exists(path));
  writer.moveTo(path);
  addSamples(writer, 10, 20);
  writer.finish();
  expectFrames(path, 20, 20);
  EXPECT_EQ(namesIn(folder.path()), (std::vector<std::string>{"mine.palpate", "r.palpate"}));
}

// Between the moment in which it gets its name and the one in which it is opened.
TEST(PalpateFiles, whatIsPutInPlaceOfABrandNewFileIsNeverWrittenOrRemoved) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeSamples(folder / "other.palpate", 5);
  const std::string theirs = readFile(folder / "other.palpate");
  FaultyVfs vfs;
  PalpateWriterOptions options;
  options.vfs = FaultyVfs::name();
  const auto putTheirs = [&](const std::string& opened) {
    vfs.setOpenHook({});
    fs::copy_file(folder / "other.palpate", folder / "copy");
    fs::rename(folder / "copy", opened);
  };
  vfs.setOpenHook(putTheirs);
  expectContains(fileErrorOf([&] { PalpateWriter writer(path, sdh2().layout, {}, options); }),
                 "is gone: something else was put in its place");
  EXPECT_TRUE(readFile(path) == theirs);
  fs::remove(path);
  PalpateWriter writer(path, sdh2().layout, {}, options);
  addSamples(writer, 0, 10);
  writer.commit();
  fs::remove(path);
  vfs.setOpenHook(putTheirs);
  expectContains(fileErrorOf([&] { writer.moveTo(path); }),
                 "is gone: something else was put in its place");
  EXPECT_TRUE(readFile(path) == theirs);
  writer.moveTo(folder / "kept.palpate");
  addSamples(writer, 10, 20);
  writer.finish();
  expectFrames(folder / "kept.palpate", 20, 20);
  EXPECT_TRUE(readFile(path) == theirs);
}

// cp other.palpate r.palpate: the name leads to the same file, with other content.
TEST(PalpateFiles, whatIsWrittenIntoTheFileInPlaceIsNoticedAndStays) {
  const TemporaryFolder folder;
  // Of the same size after as many commits.
  PalpateWriter other(folder / "other.palpate", sdh2().layout, {{"serial", "2"}});
  addSamples(other, 0, 10);
  other.commit();
  for (const std::string& content :
       {std::string(), std::string(100'000, 'x'), readFile(folder / "other.palpate")}) {
    SCOPED_TRACE(content.size());
    const fs::path path = folder / "r.palpate";
    {
      PalpateWriterOptions options;
      options.commitIntervalUs = INT64_MAX;
      PalpateWriter writer(path, sdh2().layout, {{"serial", "1"}}, options);
      addSamples(writer, 0, 10);
      writer.commit();
      writeFile(path, content);
      addSamples(writer, 10, 20);
      EXPECT_FALSE(writer.isUnreadable());
      expectContains(fileErrorOf([&] { writer.commit(); }), "was overwritten or damaged");
      EXPECT_TRUE(writer.isUnreadable());
      EXPECT_FALSE(writer.isGone());
      expectContains(fileErrorOf([&] { writer.finish(); }), "was overwritten or damaged");
      fs::rename(path, folder / "mine.palpate");
      EXPECT_THROW(writer.moveTo(path), FormatError) << "it isn't its own any more";
    }
    EXPECT_TRUE(readFile(folder / "mine.palpate") == content);
    fs::remove(path.string() + "-journal");
  }
}

TEST(PalpateFiles, aFileThatGoesWithinAFailingCommitIsKeptWhole) {
  for (std::int64_t n = 1; n < 40; ++n) {
    SCOPED_TRACE(n);
    const TemporaryFolder folder;
    FaultyVfs vfs;
    PalpateWriterOptions options;
    options.vfs = FaultyVfs::name();
    options.commitIntervalUs = INT64_MAX;
    PalpateWriter writer(folder / "r.palpate", sdh2().layout, {}, options);
    addSamples(writer, 0, 10);
    writer.commit();
    vfs.failAt(FaultyVfs::Fault::kError, vfs.operations() + n);
    addSamples(writer, 10, 20);
    fileErrorOf([&] { writer.commit(); });
    vfs.heal();
    fs::remove(folder / "r.palpate");
    writer.moveTo(folder / "r.palpate");
    addSamples(writer, 20, 30);
    writer.finish();
    expectFrames(folder / "r.palpate", 30, 30);
    EXPECT_EQ(verifyRecording(folder / "r.palpate").state, VerifyReport::State::kSound);
  }
}

// What the journal of a finished commit leaves when its process is killed keeps no name back.
TEST(PalpateFiles, theJournalOfAFinishedCommitBelongsToNoRecording) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  std::string shell;
  {
    PalpateWriter writer(path, sdh2().layout);
    addSamples(writer, 0, 10);
    writer.commit();
    shell = readFile(folder / "r.palpate-journal");
    writer.finish();
  }
  ASSERT_FALSE(shell.empty());
  fs::remove(path);
  writeFile(folder / "r.palpate-journal", shell);
  PalpateWriter writer(path, sdh2().layout);
  addSamples(writer, 0, 5);
  writer.finish();
  expectFrames(path, 5, 5);
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

// C-A8: whoever replaces an unfinished recording and fails has taken nothing from it.
TEST(PalpateFiles, aRecordingThatCouldNotBeReplacedIsAsItWas) {
  const TemporaryFolder folder;
  const std::size_t committed = makeHot(folder.path());
  writeSamples(folder / "other.palpate", 5);
  const Profile other = openRecording(folder / "other.palpate");
  // The new one is whole, but can't get the name: the old one stays, with all that was committed.
  EXPECT_THROW(saveRecording(other,
                             {},
                             folder / "r.palpate",
                             Overwrite::kReplace,
                             [&](double) {
                               throw FileError(folder / "r.palpate", "no");
                               return true;
                             }),
               FileError);
  EXPECT_EQ(openRecording(folder / "r.palpate").numFrames(), committed);
  // Replaced, it is the new one, and nothing of the old one is left beside it.
  saveRecording(other, {}, folder / "r.palpate", Overwrite::kReplace);
  EXPECT_TRUE(dumped(openRecording(folder / "r.palpate")) == dumped(other));
  EXPECT_EQ(namesIn(folder.path()), (std::vector<std::string>{"other.palpate", "r.palpate"}));
}

// C-A8: the journal is needed until the new file has the name.
TEST(PalpateFiles, aProcessThatDiesWhileItReplacesLeavesTheOldOneWhole) {
  const TemporaryFolder folder;
  const std::size_t committed = makeHot(folder.path());
  writeSamples(folder / "other.palpate", 5);
  const Profile other = openRecording(folder / "other.palpate");
  std::size_t replaced = 0;
  for (unsigned spin = 0; spin < 60; ++spin) {
    const TemporaryFolder run;
    for (const char* name : {"r.palpate", "r.palpate-journal"})
      fs::copy_file(folder / name, run / name);
    const pid_t child = fork();
    if (child == 0) {
      saveRecording(other, {}, run / "r.palpate", Overwrite::kReplace);
      _exit(0);
    }
    volatile unsigned wait = spin * 400'000;
    while (wait > 0) wait = wait - 1;
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    const std::size_t frames = openRecording(run / "r.palpate").numFrames();
    EXPECT_TRUE(frames == committed || frames == 5) << frames << " at spin " << spin;
    replaced += frames == 5 ? 1 : 0;
  }
  std::printf("%zu of 60 replaced before they were killed\n", replaced);
}

// what reading meets in a header or beside the file makes it write nothing there.
TEST(PalpateFiles, readingWritesNothingBesideWhatItReads) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeSamples(path, 100);
  const std::string sound = readFile(path);
  for (const bool header : {true, false}) {
    SCOPED_TRACE(header ? "a header that says WAL" : "a write-ahead log beside it");
    std::string bytes = sound;
    if (header) bytes[18] = bytes[19] = 2;  // sqlite.org/fileformat2.html, section 1.3.3
    writeFile(path, bytes);
    std::vector<std::string> names{"r.palpate"};
    if (!header) {
      writeFile(folder / "r.palpate-wal", "");
      names.emplace_back("r.palpate-wal");
    }
    EXPECT_EQ(framesOf(openRecording(path)).size(), 100u);
    EXPECT_EQ(namesIn(folder.path()), names);
    verifyRecording(path);
    readEvents(path);
    EXPECT_EQ(namesIn(folder.path()), names);
    EXPECT_TRUE(readFile(path) == bytes);
  }
}

// the copy that an unfinished recording is opened from has no name that could stay behind.
TEST(PalpateFiles, anInterruptedReadingLeavesNothingInTheTemporaryFolder) {
  const TemporaryFolder folder;
  const std::size_t committed = makeHot(folder.path());
  const TemporaryFolder temporary;
  const pid_t child = fork();
  if (child == 0) {
    setenv("TMPDIR", temporary.path().c_str(), 1);
    const Profile profile = openRecording(folder / "r.palpate");
    if (profile.numFrames() != committed) _exit(1);
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(namesIn(temporary.path()), std::vector<std::string>{});
}

// O-A27: something else than a file beside a recording keeps nobody waiting.
TEST(PalpateFiles, aPipeNamedAsASideFileIsNotWaitedFor) {
  for (const char* ending : {".lock", "-journal"}) {
    SCOPED_TRACE(ending);
    const TemporaryFolder folder;
    const fs::path path = folder / "r.palpate";
    writeSamples(path, 20);
    ASSERT_EQ(mkfifo((path.string() + ending).c_str(), 0600), 0);
    const pid_t child = fork();
    if (child == 0) {
      alarm(10);
      const bool sound = verifyRecording(path).state == VerifyReport::State::kSound;
      const std::size_t frames = sound ? openRecording(path).numFrames() : 0;
      _exit(frames == 20 || std::string(ending) == "-journal" ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "status " << status;
  }
}

// The recording is as it was: what is beside it is named, not damage of the recording.
TEST(PalpateFiles, aPipeNamedAsAJournalIsNoDamageOfTheRecording) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeSamples(path, 20);
  ASSERT_EQ(mkfifo((path.string() + "-journal").c_str(), 0600), 0);
  for (const fs::path& name : {path, fs::path(folder / "link.palpate")}) {
    if (name != path) fs::create_symlink(path, name);
    const VerifyReport report = verifyRecording(name);
    EXPECT_EQ(report.state, VerifyReport::State::kUnreadable);
    EXPECT_TRUE(report.message.starts_with(path.string() + "-journal: is not a regular file"))
        << report.message;
    EXPECT_NE(report.message.find("move it away"), std::string::npos) << report.message;
    EXPECT_THROW(recoverRecording(name, folder / "out.palpate"), FileError);
  }
  fs::remove(path.string() + "-journal");
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
}

// O-A24: a message names the file that was asked for.
TEST(PalpateFiles, aDiskThatIsFullIsToldUnderTheNameThatWasGiven) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 400);
  const Profile profile = openRecording(folder / "a.palpate");
  const pid_t child = fork();
  if (child == 0) {
    // As a full disk: nothing longer than this can be written.
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20'000, 20'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message =
        fileErrorOf([&] { saveRecording(profile, {}, folder / "b.palpate"); });
    const bool named = message.rfind((folder / "b.palpate").string() + ": ", 0) == 0 &&
                       message.find("recording.palpate") == std::string::npos;
    if (!named) std::printf("%s\n", message.c_str());
    std::fflush(stdout);
    _exit(named ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"a.palpate"});
}

}  // namespace
}  // namespace palpate::palpate_files_test
