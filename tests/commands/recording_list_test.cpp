#include "commands/recording_list.h"

#include <algorithm>
#include <csignal>
#include <latch>
#include <map>
#include <set>

#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/read_ahead.h"

#include "commands/command_line.h"
#include "commands/palpate_program.h"
#include "recording/palpate_samples.h"
#include "testing/background_program.h"
#include "testing/process_facts.h"

namespace palpate::commands::recording_list_test {
namespace {
namespace fs = std::filesystem;
using namespace palpate::testing;
using palpate::testing::palpate;
using Names = std::vector<std::string>;

void synthesize(const fs::path& file, const std::string& seconds = "1") {
  fs::create_directories(file.parent_path());
  const auto made = palpate({"synthesize", "-o", file, "--duration", seconds, "--rate", "10"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
}

void writeFiles(const fs::path& folder, const Names& names) {
  for (const std::string& name : names) {
    fs::create_directories((folder / name).parent_path());
    writeFile(folder / name, "not looked at");
  }
}

// root may read everything; without these two rights it sees what an owner may see.
bool givesUpRootsEyes() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct rights[_LINUX_CAPABILITY_U32S_3] = {};
  if (syscall(SYS_capget, &header, rights) != 0) return false;
  rights[0].effective &= ~(1U << CAP_DAC_OVERRIDE) & ~(1U << CAP_DAC_READ_SEARCH);
  return syscall(SYS_capset, &header, rights) == 0;
}

// What is found below a folder, relative to it.
Names found(const fs::path& folder) {
  Names names;
  for (const fs::path& file : recordingsIn({folder.string()}).files)
    names.push_back(file.lexically_relative(folder).string());
  return names;
}

TEST(RecordingList, FindsEveryRecordingBelowAFolderSortedByPath) {
  const TemporaryFolder folder;
  writeFiles(folder.path(),
             {"b/z.dsa",
              "b/a.PALPATE",
              "b/deep/er/c.Dsa",
              "a.dsa",
              "a.palpate",
              "b.dsa",
              "folder.dsa/inner.dsa"});
  EXPECT_EQ(found(folder.path()),
            (Names{"a.dsa",
                   "a.palpate",
                   "b/a.PALPATE",
                   "b/deep/er/c.Dsa",
                   "b/z.dsa",
                   "b.dsa",
                   "folder.dsa/inner.dsa"}));
  const RecordingList list = recordingsIn({folder.path().string() + "/"});
  EXPECT_EQ(list.files.at(0).string(), (folder / "a.dsa").string());  // no doubled slash
  EXPECT_TRUE(list.several);
  EXPECT_TRUE(list.problems.empty());
}

TEST(RecordingList, PassesOverWhatLiesBesideRecordings) {
  const TemporaryFolder folder;
  writeFiles(folder.path(),
             {"a.dsa",
              "a.dsa.notes.json",
              "b.palpate",
              "b.palpate.lock",
              "b.palpate-journal",
              "a.csv",
              "a.csv.angles.csv",
              "a.npz",
              "a.dsa.bak",
              ".hidden.dsa",
              ".git/x.dsa",
              ".palpate-0badcafe",
              "README"});
  EXPECT_EQ(found(folder.path()), (Names{"a.dsa", "b.palpate"}));
}

TEST(RecordingList, KnowsANativeRecordingWithoutAnEndingByItsContent) {
  const TemporaryFolder folder;
  writeSamples(folder / "whole.palpate", 3);
  fs::rename(folder / "whole.palpate", folder / "take_12");
  // Another program's SQLite file: the application_id at byte 68 is not ours.
  std::string other = readFile(folder / "take_12");
  other.replace(68, 4, std::string(4, '\0'));
  writeFile(folder / "cookies", other);
  writeFile(folder / "short", other.substr(0, 20));
  EXPECT_EQ(found(folder.path()), Names{"take_12"});
}

TEST(RecordingList, LinksInCirclesEndAndNothingIsFoundTwice) {
  const TemporaryFolder elsewhere;
  writeFiles(elsewhere.path(), {"far.dsa", "sub/farther.dsa"});
  const TemporaryFolder parent;
  writeFiles(parent.path(), {"sibling.dsa", "root/a/one.dsa", "root/b/two.dsa"});
  const fs::path root = parent / "root";
  fs::create_directory_symlink("../b", root / "a/to_b");
  fs::create_directory_symlink("../a", root / "b/to_a");
  fs::create_directory_symlink(".", root / "a/self");
  fs::create_directory_symlink("..", root / "up");  // its neighbours are not below it
  fs::create_directory_symlink(elsewhere.path(), root / "0_elsewhere");
  fs::create_directory_symlink(elsewhere.path(), root / "1_again");
  fs::create_symlink("a/one.dsa", root / "0_alias.dsa");
  fs::create_symlink(parent / "sibling.dsa", root / "linked.dsa");
  fs::create_symlink("nowhere.dsa", root / "lost.dsa");  // opening it will say so
  fs::create_symlink("nowhere", root / "lost");
  fs::create_symlink("spin.dsa", root / "spin.dsa");
  EXPECT_EQ(found(root),
            (Names{"0_elsewhere/far.dsa",
                   "0_elsewhere/sub/farther.dsa",
                   "a/one.dsa",
                   "b/two.dsa",
                   "linked.dsa",
                   "lost.dsa",
                   "spin.dsa"}));
}

TEST(RecordingList, FilesStayAsTheyAreGiven) {
  const TemporaryFolder folder;
  writeFiles(folder.path(), {"in/b.dsa", "a.txt"});
  const RecordingList list = recordingsIn({folder / "a.txt", "missing.dsa", folder / "in"});
  EXPECT_EQ(list.files,
            (std::vector<fs::path>{folder / "a.txt", "missing.dsa", folder / "in/b.dsa"}));
  EXPECT_TRUE(list.several);
  EXPECT_FALSE(recordingsIn({folder / "a.txt"}).several);
}

TEST(RecordingList, AFolderWithoutRecordingsIsATrouble) {
  const TemporaryFolder folder;
  writeFiles(folder.path(), {"a.txt"});
  const RecordingList list = recordingsIn({folder.path().string()});
  EXPECT_TRUE(list.files.empty());
  ASSERT_EQ(list.problems.size(), 1u);
  EXPECT_NE(list.problems[0].find(folder.path().string()), std::string::npos);
  EXPECT_NE(list.problems[0].find("no recording"), std::string::npos);
}

TEST(RecordingList, ASubfolderThatCannotBeReadIsATroubleAndTheOthersAreFound) {
  const TemporaryFolder folder;
  writeFiles(folder.path(), {"a.dsa", "locked/b.dsa", "open/c.dsa"});
  fs::permissions(folder.path(), fs::perms::all);
  fs::permissions(folder / "locked", fs::perms::none);
  const pid_t child = fork();
  if (child == 0) {
    if (!givesUpRootsEyes()) _exit(2);
    const RecordingList list = recordingsIn({folder.path().string()});
    const bool right =
        list.files == std::vector<fs::path>{folder / "a.dsa", folder / "open/c.dsa"} &&
        list.problems.size() == 1 &&
        list.problems[0].find("locked: can't be read: Permission denied") != std::string::npos;
    _exit(right ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  fs::permissions(folder / "locked", fs::perms::owner_all);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

// What a way through a list says and how it ends.
struct ListResult {
  int exitCode = -1;
  std::string out = {};
  std::string err = {};
};
ListResult runOver(const RecordingList& list, const FileWork& work, bool quiet = false) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  ListResult run;
  run.exitCode = forEachRecording(list, quiet, work);
  run.out = ::testing::internal::GetCapturedStdout();
  run.err = ::testing::internal::GetCapturedStderr();
  return run;
}

const RecordingList kThree{.files = {"a", "b", "c"}, .problems = {}, .several = true};

TEST(ForEachRecording, TheExitCodeTellsHowMuchWasDone) {
  const auto failingAt = [](std::set<fs::path> bad) {
    return [bad](const fs::path& file, const Progress&) {
      if (bad.contains(file)) throw FileError(file, "is broken");
      return FileOutcome{.said = "did " + file.string()};
    };
  };
  const ListResult all = runOver(kThree, failingAt({}));
  EXPECT_EQ(all.exitCode, kDone);
  EXPECT_EQ(all.out, "did a\ndid b\ndid c\n");
  EXPECT_EQ(all.err, "");
  const ListResult some = runOver(kThree, failingAt({"b"}));
  EXPECT_EQ(some.exitCode, kPartlyDone);
  EXPECT_EQ(some.out, "did a\ndid c\n");
  EXPECT_EQ(some.err, "palpate: b: is broken\n");
  const ListResult none = runOver(kThree, failingAt({"a", "b", "c"}), true);
  EXPECT_EQ(none.exitCode, kFailed);
  EXPECT_EQ(none.err,
            "palpate: a: is broken\npalpate: b: is broken\npalpate: c: is broken\n"
            "palpate: 3 of 3 recordings failed\n");
}

TEST(ForEachRecording, WhatIsDoneInPartOrNotFoundMakesItThree) {
  const ListResult part = runOver(kThree, [](const fs::path& file, const Progress&) {
    return FileOutcome{.said = {}, .problem = file == "c" ? "c: half of it" : ""};
  });
  EXPECT_EQ(part.exitCode, kPartlyDone);
  EXPECT_EQ(part.err, "palpate: c: half of it\n");
  const auto done = [](const fs::path&, const Progress&) { return FileOutcome{}; };
  RecordingList list = kThree;
  list.problems = {"sub: can't be read"};
  const ListResult beside = runOver(list, done);
  EXPECT_EQ(beside.exitCode, kPartlyDone);
  EXPECT_EQ(beside.err, "palpate: sub: can't be read\n");
  list.files.clear();
  EXPECT_EQ(runOver(list, done).exitCode, kFailed);
}

TEST(ForEachRecording, WhatIsNoFilesFaultEndsIt) {
  int calls = 0;
  const auto full = [&](const fs::path&, const Progress&) -> FileOutcome {
    ++calls;
    throw OutputError("disk full");
  };
  EXPECT_THROW(forEachRecording(kThree, true, full), OutputError);
  EXPECT_EQ(calls, 1);
  EXPECT_THROW(forEachRecording(kThree,
                                true,
                                [](const fs::path&, const Progress&) -> FileOutcome {
                                  throw UsageError("wrong");
                                }),
               UsageError);
}

TEST(ForEachRecording, ASignalEndsItAndIsHeededByTheProgress) {
  const ListResult run = runOver(kThree, [](const fs::path& file, const Progress& progress) {
    EXPECT_TRUE(progress(0.0));
    if (file == "b") {
      std::raise(SIGINT);
      EXPECT_FALSE(progress(0.5));
      throw Cancelled();
    }
    return FileOutcome{.said = "did " + file.string()};
  });
  EXPECT_EQ(run.exitCode, kPartlyDone);
  EXPECT_EQ(run.out, "did a\n");
  EXPECT_EQ(run.err, "palpate: interrupted: 1 of 3 recordings are done\n");
}

Profile smallProfile() {
  return ::palpate::synthesize({.durationS = 0.2, .rateHz = 10.0, .grasps = 0});
}

// Small recordings, so that they are read ahead of their turn.
RecordingList smallOnes(const TemporaryFolder& folder, std::size_t count) {
  RecordingList list{.files = {}, .problems = {}, .several = true};
  for (std::size_t i = 0; i < count; ++i) {
    list.files.push_back(folder / (std::to_string(i) + ".dsa"));
    writeDsa(smallProfile(), list.files.back());
    EXPECT_TRUE(isReadAhead(list.files.back()));
  }
  return list;
}

ListResult textsOf(const RecordingList& list, const TextFrame& frame, const OpenedText& work) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  ListResult run;
  ResultOutput out;
  run.exitCode = writeReadableTexts(list, true, frame, out, work);
  run.out = ::testing::internal::GetCapturedStdout();
  run.err = ::testing::internal::GetCapturedStderr();
  return run;
}

TEST(WriteReadableTexts, TheTextsStandInTheOrderOfTheRecordings) {
  const TemporaryFolder folder;
  const RecordingList list = smallOnes(folder, 40);
  const auto name =
      [](const fs::path& file, const Recording& recording, const TextSink& write, const Progress&) {
        write(file.stem().string());
        write(" has " + std::to_string(recording.profile.numFrames()));
      };
  const std::string frames = std::to_string(smallProfile().numFrames());
  std::string expected = "begin: ";
  for (std::size_t i = 0; i < list.files.size(); ++i)
    expected += (i > 0 ? ", " : "") + std::to_string(i) + " has " + frames;
  const ListResult run = textsOf(list, {.begin = "begin: ", .between = ", "}, name);
  EXPECT_EQ(run.exitCode, kDone);
  EXPECT_EQ(run.out, expected);
  EXPECT_EQ(run.err, "");
}

// The work of each of two recordings waits for that of the other: one thread would never end.
TEST(WriteReadableTexts, TheWorkOfSmallRecordingsIsDoneSeveralAtATime) {
  const TemporaryFolder folder;
  const RecordingList list = smallOnes(folder, 2);
  if (readAheadThreads(2) == 0) GTEST_SKIP() << "this machine runs one thread at a time";
  std::latch both(2);
  const auto meet = [&](const fs::path&, const Recording&, const TextSink& write, const Progress&) {
    both.arrive_and_wait();
    write("met\n");
  };
  EXPECT_EQ(textsOf(list, {}, meet).out, "met\nmet\n");
}

TEST(WriteReadableTexts, WhatWasWrittenBeforeAFailureIsKept) {
  const TemporaryFolder folder;
  const RecordingList list = smallOnes(folder, 4);
  writeFile(list.files[0], "no recording");
  const auto failing =
      [&](const fs::path& file, const Recording&, const TextSink& write, const Progress&) {
        write(file.stem().string() + "a ");
        if (file == list.files[2]) throw FileError(file, "is broken in the middle");
        write("b\n");
      };
  const ListResult run = textsOf(list, {.begin = "header\n", .between = ""}, failing);
  EXPECT_EQ(run.exitCode, kPartlyDone);
  EXPECT_EQ(run.out, "header\n1a b\n2a 3a b\n");
  EXPECT_NE(run.err.find("0.dsa: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("2.dsa: is broken in the middle"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("2 of 4 recordings failed"), std::string::npos) << run.err;
}

TEST(WriteReadableTexts, TheFrameIsWrittenAlsoWhereNoRecordingHasText) {
  const TemporaryFolder folder;
  const auto nothing = [](const fs::path&, const Recording&, const TextSink&, const Progress&) {};
  const RecordingList list = smallOnes(folder, 3);
  EXPECT_EQ(textsOf(list, {.begin = "header\n", .between = ""}, nothing).out, "header\n");
  for (const fs::path& file : list.files) writeFile(file, "no recording");
  EXPECT_EQ(textsOf(list, {.begin = "header\n", .between = ""}, nothing).out, "");
}

// What is too long to be kept is made again when its turn comes.
TEST(WriteReadableTexts, LongTextsAreWrittenAtTheirTurn) {
  const TemporaryFolder folder;
  const RecordingList list = smallOnes(folder, 3);
  const std::string piece(1u << 20, 'x');
  const auto longText =
      [&](const fs::path&, const Recording&, const TextSink& write, const Progress&) {
        for (int i = 0; i < 6; ++i) write(piece);
        write("\n");
      };
  const ListResult run = textsOf(list, {}, longText);
  std::string one;
  for (int i = 0; i < 6; ++i) one += piece;
  EXPECT_EQ(run.exitCode, kDone);
  EXPECT_TRUE(run.out == one + "\n" + one + "\n" + one + "\n");
}

TEST(WriteReadableTexts, WhatIsNoFilesFaultEndsIt) {
  const TemporaryFolder folder;
  const auto wrong = [](const fs::path&, const Recording&, const TextSink&, const Progress&) {
    throw UsageError("wrong");
  };
  ResultOutput out;
  EXPECT_THROW(writeReadableTexts(smallOnes(folder, 3), true, {}, out, wrong), UsageError);
}

class FolderOfRecordings : public ::testing::Test {
 protected:
  // Two sound ones (11 and 21 frames), an unfinished one (40), and two that are none.
  void SetUp() override {
    synthesize(folder_ / "a.dsa");
    synthesize(folder_ / "sub/b.dsa", "2");
    writeSamples(folder_ / "sub/died.palpate", 40, false);
  }
  void addBad() {
    writeFile(folder_ / "cut.dsa", readFile(folder_ / "a.dsa").substr(0, 100));
    writeFile(folder_ / "empty.palpate", "");
  }
  std::string path() const { return folder_.path().string(); }

  TemporaryFolder folder_;
};

TEST_F(FolderOfRecordings, AnUnfinishedOneIsReadAndSaid) {
  for (const char* command : {"info", "signals"}) {
    const auto result = palpate({command, path()});
    EXPECT_EQ(result.exitCode, 0) << command;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("died.palpate: unfinished"), std::string::npos) << result.err;
    EXPECT_EQ(palpate({command, path(), "--quiet"}).err, "");
  }
  const auto verified = palpate({"verify", path()});
  EXPECT_EQ(verified.exitCode, 0);
  EXPECT_NE(verified.out.find("died.palpate: sound: 40 frames"), std::string::npos) << verified.out;
  EXPECT_NE(verified.out.find("unfinished"), std::string::npos) << verified.out;
}

// Whatever has to be tried: a bar that goes back says nothing.
TEST_F(FolderOfRecordings, ProgressOfReadingGoesForwardOnly) {
  std::string bytes = readFile(folder_ / "sub/died.palpate");
  bytes[bytes.size() - 100] = static_cast<char>(bytes[bytes.size() - 100] ^ 1);
  writeFile(folder_ / "damaged.palpate", bytes);
  for (const char* name : {"a.dsa", "sub/died.palpate", "damaged.palpate"}) {
    double last = 0.0;
    bool forward = true;
    readableRecording(folder_ / name, {}, [&](double fraction) {
      forward = forward && fraction >= last && fraction <= 1.0;
      last = fraction;
      return true;
    });
    EXPECT_TRUE(forward) << name;
    EXPECT_GE(last, 0.5) << name;
  }
}

TEST_F(FolderOfRecordings, BadFilesAreNamedAndTheOthersDone) {
  addBad();
  for (const char* command : {"info", "signals"}) {
    const auto result = palpate({command, path(), "--quiet"});
    EXPECT_EQ(result.exitCode, 3) << command;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
    for (const char* words : {"cut.dsa: ", "empty.palpate: ", "2 of 5 recordings failed"})
      EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    for (const char* name : {"a.dsa", "sub/b.dsa", "sub/died.palpate"})
      EXPECT_NE(result.out.find(folder_ / name), std::string::npos) << command << ": " << name;
    EXPECT_EQ(result.out.find("cut.dsa"), std::string::npos);
  }
}

TEST_F(FolderOfRecordings, WithoutRecordingsEveryCommandSaysSoInOneLine) {
  const TemporaryFolder empty;
  for (const Names& words :
       std::vector<Names>{{"info", empty.path()},
                          {"info", empty.path(), "--json"},
                          {"signals", empty.path()},
                          {"verify", empty.path()},
                          {"convert", empty.path(), "out", "--to-form", "npz"}}) {
    const auto result = palpate(words);
    expectOneLineError(result, 1, {empty.path().string(), "no recording"});
    EXPECT_EQ(result.out, "");
  }
}

// Rows end whole, and it says how far it came.
TEST(SignalsOfAFolder, CtrlCEndsItCleanly) {
  const TemporaryFolder folder;
  synthesize(folder / "a.dsa", "20");
  constexpr int kFiles = 3000;  // takes long enough to be interrupted
  for (int i = 0; i < kFiles; ++i)
    fs::create_hard_link(folder / "a.dsa", folder / ("b" + std::to_string(i) + ".dsa"));
  for (const int number : {SIGINT, SIGTERM}) {
    BackgroundProgram program(PALPATE_PROGRAM, {"signals", folder.path()});
    ASSERT_TRUE(program.awaitLine("area_mm2,file")) << program.err();
    program.signal(number);
    const int exitCode = program.wait();
    const std::string out = program.out();
    ASSERT_FALSE(out.empty());
    EXPECT_EQ(out.back(), '\n');
    std::map<std::string, std::size_t> rowsOfFile;
    for (std::size_t at = 0; at < out.size();) {
      const std::size_t end = out.find('\n', at);
      const std::string line = out.substr(at, end - at);
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
      ++rowsOfFile[line.substr(line.rfind(',') + 1)];
      at = end + 1;
    }
    rowsOfFile.erase("file");
    const std::string err = program.err();
    std::size_t done = 0;
    ASSERT_EQ(std::sscanf(err.c_str(), "palpate: interrupted: %zu of 3001", &done), 1) << err;
    EXPECT_LT(done, 3001u);
    // Interrupted before the first one was whole, nothing is done.
    EXPECT_EQ(exitCode, done > 0 ? 3 : 1) << err;
    const auto whole = std::count_if(rowsOfFile.begin(), rowsOfFile.end(), [](const auto& rows) {
      return rows.second == 201 * 6;
    });
    EXPECT_EQ(static_cast<std::size_t>(whole), done);
    EXPECT_LE(rowsOfFile.size(), done + 1);
  }
}

// The largest memory of any program this test has run [bytes].
std::size_t peakOfChildren() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

TEST(SignalsOfAFolder, MemoryDoesNotGrowWithTheFolder) {
  if (!kMemoryIsOurs) GTEST_SKIP() << "a sanitizer keeps memory of its own";
  const TemporaryFolder folder;
  synthesize(folder / "a.dsa", "60");
  const auto linkTo = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const fs::path link = folder / ("b" + std::to_string(i) + ".dsa");
      if (!fs::exists(link)) fs::create_hard_link(folder / "a.dsa", link);
    }
  };
  // As many as are read ahead at most (14: 8 threads and 6 more) fit into the first run.
  linkTo(14);
  ASSERT_EQ(palpate({"signals", folder.path(), "--matrix", "0"}).exitCode, 0);
  const std::size_t few = peakOfChildren();
  // 601 frames of 486 values of 2 or 4 bytes: 0.6 MB at least, 24 MB more if they were kept.
  linkTo(54);
  ASSERT_EQ(palpate({"signals", folder.path(), "--matrix", "0"}).exitCode, 0);
  EXPECT_LT(peakOfChildren() - few, 5u << 20);
}

// The second line of each table has as many cells as the first one.
TEST(UnitsRow, StandsBelowTheNamesOfEveryTable) {
  const TemporaryFolder folder;
  synthesize(folder / "a.dsa", "4");
  fs::copy_file(folder / "a.dsa", folder / "b.dsa");
  const std::map<std::string, std::string> expected = {
      {"signals", ",ms,,counts,counts,counts,counts,counts,taxels,mm^2"},
      {"slip", ",ms,,taxels,,taxels,taxels,taxels,taxels,,deg,deg,deg,,,,,,,"},
      {"slip --segments", ",,ms,ms,,taxels,deg,"},
      {"contact", ",ms,taxels,mm,mm,mm,mm,N"},
      {"contact --matrices", ",ms,,taxels,counts,mm^2,mm,mm,mm,,,,,,,mm,,,,mm,mm,mm"},
      {"contact --size", ",,,,,,mm,mm,mm,mm,mm,mm,mm,mm,mm"},
      {"grasps", ",,ms,ms,,"}};
  for (const auto& [command, units] : expected)
    for (const bool several : {false, true}) {
      Names words = {"--units-row", (several ? folder.path() : folder / "a.dsa").string()};
      if (const std::size_t blank = command.find(' '); blank != std::string::npos)
        words.insert(words.begin(), command.substr(blank + 1));
      words.insert(words.begin(), command.substr(0, command.find(' ')));
      const auto result = palpate(words);
      std::istringstream lines(result.out);
      std::string header, row;
      std::getline(lines, header);
      std::getline(lines, row);
      EXPECT_EQ(row, units + (several ? "," : "")) << command << result.err;
      EXPECT_EQ(std::count(row.begin(), row.end(), ','),
                std::count(header.begin(), header.end(), ','))
          << command;
      for (std::string line; std::getline(lines, line);) EXPECT_NE(line, row) << command;
    }
}

TEST(UnitsRow, ARecordingWithAnotherUnitFails) {
  const TemporaryFolder folder;
  fs::copy(testing::dataFolder() / "hands/flat_pad_16x16", folder / "pad");
  const auto save = [&](const char* name) {
    const HandDescription hand = readHandFolder(folder / "pad");
    ProfileBuilder builder(hand);
    builder.addFrame(1'000'000, std::vector<float>(hand.layout->numCells(), 1.0F));
    saveRecording(builder.finish({}), {}, folder / name);
  };
  save("a.palpate");
  std::string text = readFile(folder / "pad/hand.json");
  const std::string counts = "\"unit\": \"counts\"";
  text.replace(text.find(counts), counts.size(), "\"unit\": \"kPa\"");
  writeFile(folder / "pad/hand.json", text);
  save("b.palpate");
  const auto result = palpate({"signals", folder.path(), "--units-row"});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_NE(result.err.find("b.palpate: its columns or units differ"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.out.find("b.palpate"), std::string::npos);
  const auto contact = palpate({"contact", folder.path(), "--matrices", "--units-row"});
  EXPECT_NE(contact.err.find("b.palpate: its columns or units differ"), std::string::npos)
      << contact.err;
  EXPECT_EQ(palpate({"signals", folder.path()}).exitCode, 0);
  EXPECT_EQ(palpate({"signals", folder / "b.palpate", "--units-row"}).exitCode, 0);
}

}  // namespace
}  // namespace palpate::commands::recording_list_test
