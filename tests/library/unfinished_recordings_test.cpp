#include "palpate/library/unfinished_recordings.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_faults.h"
#include "testing/testing.h"

namespace palpate::unfinished_recordings_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const UnfinishedRecording& found : findUnfinished(folder)) {
    EXPECT_EQ(found.path.parent_path(), folder);
    names.push_back(found.path.filename().string());
  }
  return names;
}
using Names = std::vector<std::string>;

// Everything in a folder, byte for byte.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) content[entry.path().filename().string()] = readFile(entry.path());
  return content;
}

// A recorder in a process of its own that has committed 60 frames, and goes on living until it is
// killed.
class OtherRecorder {
 public:
  explicit OtherRecorder(const fs::path& path) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      PalpateWriter writer(path, sdh2().layout);
      addSamples(writer, 0, 60);
      writer.commit();
      if (write(ends[1], "c", 1) != 1) _exit(1);
      for (;;) pause();
    }
    close(ends[1]);
    char told = 0;
    EXPECT_EQ(read(ends[0], &told, 1), 1);
    close(ends[0]);
  }
  ~OtherRecorder() { killIt(); }
  OtherRecorder(const OtherRecorder&) = delete;
  OtherRecorder& operator=(const OtherRecorder&) = delete;
  void killIt() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = 0;
  }

 private:
  pid_t child_ = 0;
};

// r.palpate in `folder`, whose writer died inside a commit: with a journal to play back.
void makeHot(const fs::path& folder) {
  std::mt19937 random(3);
  for (std::int64_t n = operationsOfRun() / 2;; ++n) {
    FaultyVfs vfs;
    vfs.failAt(FaultyVfs::Fault::kPowerCut, n);
    const TemporaryFolder run;
    record(run / "r.palpate");
    vfs.writeRemains(folder, random);
    const std::string journal = readFile(folder / "r.palpate-journal");
    if (!journal.empty() && journal[0] != 0) return;
  }
}

TEST(UnfinishedRecordings, oneWhoseRecorderWasKilledIsFound) {
  const TemporaryFolder folder;
  writeSamples(folder / "finished.palpate", 50);
  OtherRecorder recorder(folder / "killed.palpate");
  EXPECT_EQ(namesIn(folder.path()), Names{}) << "it is being written";
  recorder.killIt();
  ASSERT_TRUE(fs::exists(folder / "killed.palpate.lock")) << "left behind, held by nobody";
  const auto before = contentOf(folder.path());
  const auto found = findUnfinished(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, folder / "killed.palpate");
  EXPECT_EQ(found[0].sizeBytes, fs::file_size(folder / "killed.palpate"));
  struct stat facts {};
  ASSERT_EQ(::stat(found[0].path.c_str(), &facts), 0);
  EXPECT_EQ(found[0].changedUs / 1'000'000, facts.st_mtim.tv_sec);
  EXPECT_EQ(contentOf(folder.path()), before);
}

TEST(UnfinishedRecordings, oneThatDiedInsideACommitIsFoundAndNotTouched) {
  const TemporaryFolder folder;
  makeHot(folder.path());
  const auto before = contentOf(folder.path());
  EXPECT_EQ(namesIn(folder.path()), Names{"r.palpate"});
  EXPECT_EQ(contentOf(folder.path()), before);
  // A journal that belongs to no recording makes none.
  writeFile(folder / "r.palpate", "SQLite format 3 and nothing else");
  EXPECT_EQ(namesIn(folder.path()), Names{});
}

TEST(UnfinishedRecordings, aWriterInThisProcessIsLeftAlone) {
  const TemporaryFolder folder;
  PalpateWriter writer(folder / "own.palpate", sdh2().layout);
  for (std::size_t i = 0; i < 30; ++i) {
    addSamples(writer, 10 * i, 10 * i + 10);
    EXPECT_EQ(namesIn(folder.path()), Names{});
    writer.commit();
  }
  writer.finish();
  EXPECT_EQ(namesIn(folder.path()), Names{});
  expectFrames(folder / "own.palpate", 300, 300);
}

TEST(UnfinishedRecordings, theOneChangedLastStandsFirst) {
  const TemporaryFolder folder;
  const auto now = fs::file_time_type::clock::now();
  int age = 0;
  for (const char* name : {"m.palpate", "z.palpate", "a.palpate"}) {
    writeSamples(folder / name, 5, false);
    fs::last_write_time(folder / name, now - std::chrono::hours(age++));
  }
  EXPECT_EQ(namesIn(folder.path()), (Names{"m.palpate", "z.palpate", "a.palpate"}));
}

TEST(UnfinishedRecordings, whatIsNoUnfinishedRecordingOfTheFolderIsLeftOut) {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  fs::create_directory(folder / "below");
  writeSamples(folder / "below/deep.palpate", 5, false);
  fs::create_directory(folder / "folder.palpate");
  writeSamples(elsewhere / "far.palpate", 5, false);
  fs::create_symlink(elsewhere / "far.palpate", folder / "link.palpate");
  fs::create_symlink(folder / "nowhere", folder / "dangling.palpate");
  ASSERT_EQ(::mkfifo((folder / "pipe.palpate").c_str(), 0600), 0);
  writeSamples(folder / ".hidden.palpate", 5, false);
  writeSamples(folder / "other.dat", 5, false);
  { PalpateWriter writer(folder / "nothing in it.palpate", sdh2().layout); }
  writeFile(folder / "empty.palpate", "");
  writeFile(folder / "text.palpate", "not at all");
  writeFile(folder / "cut.palpate", readFile(folder / "other.dat").substr(0, 5000));
  // A database of another program, with everything else alike.
  std::string foreign = readFile(folder / "other.dat");
  foreign[68] = 'X';
  writeFile(folder / "foreign.palpate", foreign);
  // Side files that would keep whoever opens them waiting for ever.
  writeSamples(folder / "lock.palpate", 5, false);
  ASSERT_EQ(::mkfifo((folder / "lock.palpate.lock").c_str(), 0600), 0);
  writeSamples(folder / "journal.palpate", 5, false);
  fs::remove(folder / "journal.palpate-journal");
  ASSERT_EQ(::mkfifo((folder / "journal.palpate-journal").c_str(), 0600), 0);
  EXPECT_EQ(namesIn(folder.path()), Names{});
  writeSamples(folder / "This One.PALPATE", 5, false);
  EXPECT_EQ(namesIn(folder.path()), Names{"This One.PALPATE"});
}

TEST(UnfinishedRecordings, anySampleOrNoteIsWorthRecovering) {
  const TemporaryFolder folder;
  {
    PalpateWriter writer(folder / "a note.palpate", sdh2().layout);
    writer.addEvent({kSampleStartUs, kSampleStartUs, "note", {}, "text", ""});
  }
  {
    PalpateWriter writer(folder / "angles.palpate", sdh2().layout);
    writer.addSample(sampleAngles(0));
  }
  const Names names = namesIn(folder.path());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()),
            (std::set<std::string>{"a note.palpate", "angles.palpate"}));
  const fs::path out = recoveredPathOf(folder / "a note.palpate");
  EXPECT_EQ(recoverRecording(folder / "a note.palpate", out).state, RecoverReport::State::kWhole);
  EXPECT_EQ(readEvents(out).events.size(), 1u);
}

// Who recorded what, and the settings of the sensor, come along: forces and the Library need them.
TEST(UnfinishedRecordings, whatIsSaidOfTheRecordingIsRecovered) {
  const TemporaryFolder folder;
  const fs::path in = folder / "run.palpate", out = folder / "whole.palpate";
  const std::map<std::string, std::string> said{{"operator", "Ada"},
                                                {"object", "pen"},
                                                {"run", "left"},
                                                {"notes", "pinch"},
                                                {"settings", R"({"sensitivity":[0.5]})"},
                                                {"sensor_serial", "1D9B0057"}};
  {
    PalpateWriter writer(in, sdh2().layout, said);
    writer.addSample(sampleAngles(0));
  }
  EXPECT_EQ(recoverRecording(in, out).state, RecoverReport::State::kWhole);
  const std::map<std::string, std::string> kept = readRecordingMeta(out);
  for (const auto& [key, value] : said) {
    ASSERT_TRUE(kept.contains(key)) << key;
    EXPECT_EQ(kept.at(key), value);
  }
  EXPECT_EQ(kept.at("finished"), "1") << "only the original is unfinished";
}

TEST(UnfinishedRecordings, whatWasRecoveredIsNotFoundAgain) {
  const TemporaryFolder folder;
  writeSamples(folder / "run.palpate", 40, false);
  writeSamples(folder / "run_1.palpate", 40, false);
  const fs::path out = recoveredPathOf(folder / "run.palpate");
  EXPECT_EQ(out, folder / "run_recovered.palpate");
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(recoverRecording(folder / "run.palpate", out).state, RecoverReport::State::kWhole);
  EXPECT_EQ(namesIn(folder.path()), Names{"run_1.palpate"});
  // Neither when only a second attempt is left.
  fs::rename(out, folder / "run_recovered-2.palpate");
  EXPECT_EQ(namesIn(folder.path()), Names{"run_1.palpate"});
  // Names that only look alike say nothing.
  for (const char* name : {"run_recovered-x.palpate",
                           "run_recovered-.palpate",
                           "run_recovered-2.dsa",
                           "run_recovered.palpate.lock",
                           "run_recovered2.palpate"}) {
    fs::rename(folder / "run_recovered-2.palpate", folder / name);
    EXPECT_EQ(namesIn(folder.path()).size(), 2u) << name;
    fs::rename(folder / name, folder / "run_recovered-2.palpate");
  }
}

TEST(UnfinishedRecordings, theRecoveredOneGetsANameThatNothingHas) {
  const TemporaryFolder folder;
  const fs::path in = folder / "a.b.palpate";
  EXPECT_EQ(recoveredPathOf(in), folder / "a.b_recovered.palpate");
  fs::create_symlink("/nowhere/at/all", folder / "a.b_recovered.palpate");
  EXPECT_EQ(recoveredPathOf(in), folder / "a.b_recovered-2.palpate");
  writeFile(folder / "a.b_recovered-2.palpate-journal", "of another");
  EXPECT_EQ(recoveredPathOf(in), folder / "a.b_recovered-3.palpate");
  EXPECT_EQ(recoveredPathOf("run.palpate"), "run_recovered.palpate");
  EXPECT_EQ(recoveredPathOf(folder / "no ending"), folder / "no ending_recovered.palpate");
}

TEST(UnfinishedRecordings, theLongestNamesCanBeRecoveredOnce) {
  const TemporaryFolder folder;
  // 239 bytes and the ending: with "-journal" the longest that a recording can have. Letters of two
  // bytes: none may be cut in two.
  std::string name = "x";
  while (name.size() < 239) name += "\xC3\xBC";
  const fs::path in = folder / (name + ".palpate");
  writeSamples(in, 20, false);
  ASSERT_EQ(findUnfinished(folder.path()).size(), 1u);
  const fs::path out = recoveredPathOf(in);
  EXPECT_EQ(recoverRecording(in, out).state, RecoverReport::State::kWhole);
  EXPECT_EQ(openRecording(out).numFrames(), 20u);
  const std::string stem = out.stem().string();
  EXPECT_EQ(stem.substr(stem.find('_')), "_recovered");
  EXPECT_EQ(stem.find('_') % 2, 1u) << "x, then whole letters";
  EXPECT_EQ(namesIn(folder.path()), Names{});
}

TEST(UnfinishedRecordings, aFolderThatIsntThereHasNoneAFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_TRUE(findUnfinished(folder / "not/there").empty());
  writeFile(folder / "file", "");
  EXPECT_THROW(findUnfinished(folder / "file"), FileError);
}

TEST(UnfinishedRecordings, ReportsProgressAndCanBeCancelled) {
  const TemporaryFolder folder;
  for (const char* name : {"a.palpate", "b.palpate", "c.palpate"}) writeSamples(folder / name, 5);
  std::vector<double> told;
  findUnfinished(folder.path(), [&](double fraction) {
    told.push_back(fraction);
    return true;
  });
  EXPECT_GE(told.size(), 3u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0.0);
  EXPECT_LE(told.back(), 1.0);
  int asked = 0;
  EXPECT_THROW(findUnfinished(folder.path(), [&](double) { return ++asked < 2; }), Cancelled);
  EXPECT_EQ(asked, 2);
}

// What this process has read so far [bytes], from files and from the cache of the system.
std::uintmax_t bytesRead() {
  std::istringstream facts(readFile("/proc/self/io"));
  std::string name;
  std::uintmax_t bytes = 0;
  facts >> name >> bytes;
  EXPECT_EQ(name, "rchar:");
  return bytes;
}

// A folder with a thousand recordings of a day each is looked through when the window opens.
TEST(UnfinishedRecordings, finishedOnesAreNotReadThrough) {
  const TemporaryFolder folder;
  writeSamples(folder / "0.palpate", 3000);
  constexpr int kNumRecordings = 1000;
  for (int i = 1; i < kNumRecordings; ++i)
    fs::create_hard_link(folder / "0.palpate", folder / (std::to_string(i) + ".palpate"));
  writeSamples(folder / "last.palpate", 30, false);
  const std::uintmax_t before = bytesRead();
  EXPECT_EQ(namesIn(folder.path()), Names{"last.palpate"});
  const std::uintmax_t each = (bytesRead() - before) / kNumRecordings;
  EXPECT_LT(10 * each, fs::file_size(folder / "0.palpate")) << each << " bytes of each";
}

}  // namespace
}  // namespace palpate::unfinished_recordings_test
