// Events saved into recordings that lie on disk: what is written, what is refused, and what readers
// see.
#include "palpate/recording/event_store.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::event_store_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

const Event kGap{kSampleStartUs + 50, kSampleStartUs + 90, "gap", {}, "no frames", "{}"};
const Event kLabel{kSampleStartUs + 10, kSampleStartUs + 10, "label", 2, "b\xC3\xA4ll", ""};
const Event kNote{kSampleStartUs + 70, kSampleStartUs + 99, "note", {}, "one\ntwo \"3\"", ""};
const Event kSegment{
    kSampleStartUs + 20, kSampleStartUs + 80, "segment", {}, "ball", "{\"quality\":0.5}"};

std::vector<Event> sortedByTime(std::vector<Event> events) {
  std::stable_sort(
      events.begin(), events.end(), [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
  return events;
}

// A finished recording of either form with a gap and a label.
fs::path makeRecording(const fs::path& folder, const std::string& ending, std::size_t frames = 30) {
  writeSamples(folder / "source.palpate", frames);
  const fs::path path = folder / ("r" + ending);
  saveRecording(openRecording(folder / "source.palpate"), std::vector{kGap, kLabel}, path);
  fs::remove(folder / "source.palpate");
  return path;
}

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

class EventStore : public ::testing::TestWithParam<const char*> {};

TEST_P(EventStore, addsChangesAndRemovesWhatAPersonNoted) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const std::string before = dumped(openRecording(path));
  Event renamed = kLabel;
  renamed.text = "foam ball";
  for (const std::vector<Event>& events :
       {std::vector{kGap, kLabel, kNote},
        std::vector{kSegment, kNote, kGap},
        std::vector{kNote, kNote, renamed, kGap},  // the same twice
        std::vector{kGap},
        std::vector{kLabel, kGap}}) {
    saveEvents(path, readEvents(path), events);
    const EventsReport now = readEvents(path);
    EXPECT_EQ(now.events, sortedByTime(events));
    EXPECT_EQ(now.damaged, 0u);
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  }
  EXPECT_TRUE(dumped(openRecording(path)) == before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()),
            GetParam() == std::string(".dsa") ? 2 : 1);
}

TEST_P(EventStore, whatHappenedCantBeChanged) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const EventsReport asRead = readEvents(path);
  Event shorter = kGap;
  --shorter.t1Us;
  Event backwards = kNote;
  backwards.t1Us = backwards.tUs - 1;
  Event nothing = kNote;
  nothing.kind.clear();
  Event endless = kNote;
  endless.text.assign(kMaxEventBytes, 'x');
  for (const std::vector<Event>& events : {std::vector{kLabel},
                                           std::vector{kLabel, shorter},
                                           std::vector{kLabel, kGap, kGap},
                                           std::vector{kGap, backwards},
                                           std::vector{kGap, nothing},
                                           std::vector{kGap, endless}})
    EXPECT_THROW(saveEvents(path, asRead, events), std::invalid_argument);
  EXPECT_EQ(readEvents(path).events, asRead.events);
}

TEST_P(EventStore, whatSomebodyElseChangedIsNotOverwritten) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const EventsReport asRead = readEvents(path);
  saveEvents(path, asRead, std::vector{kGap, kLabel, kNote});
  expectContains(fileErrorOf([&] {
                   saveEvents(path, asRead, std::vector{kGap, kSegment});
                 }),
                 "changed by someone else; open it again");
  EXPECT_EQ(readEvents(path).events, (std::vector{kLabel, kGap, kNote}));
  // What is there already is no conflict: a failure that was reported may have been none.
  saveEvents(path, asRead, std::vector{kNote, kGap, kLabel});
}

TEST_P(EventStore, aRecordingThatIsGoneGetsNoNotes) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const EventsReport asRead = readEvents(path);
  fs::rename(path, folder / "elsewhere");
  expectContains(fileErrorOf([&] { saveEvents(path, asRead, std::vector{kGap}); }),
                 "has since been deleted or moved");
  EXPECT_FALSE(fs::exists(path));
}

TEST_P(EventStore, aLinkLeadsToTheRecording) {
  const TemporaryFolder folder;
  const TemporaryFolder links;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const fs::path link = links / (std::string("link") + GetParam());
  fs::create_symlink(path, link);
  const EventsReport asRead = readEvents(link);
  std::vector<Event> events = asRead.events;
  events.push_back(kNote);
  saveEvents(link, asRead, events);
  EXPECT_EQ(readEvents(link).events, sortedByTime(events));
  EXPECT_TRUE(fs::is_symlink(link));
}

TEST_P(EventStore, readOnlyFilesAndFoldersAreSaid) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), GetParam());
  const EventsReport asRead = readEvents(path);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  expectContains(fileErrorOf([&] { saveEvents(path, asRead, std::vector{kGap}); }),
                 "is in a folder that can't be written");
  fs::permissions(folder.path(), fs::perms::owner_all);
  const fs::path file = path.string() + (GetParam() == std::string(".dsa") ? ".notes.json" : "");
  fs::permissions(file, fs::perms::owner_read);
  expectContains(fileErrorOf([&] { saveEvents(path, asRead, std::vector{kGap}); }), "is read-only");
  EXPECT_EQ(readEvents(path).events, asRead.events);
}

INSTANTIATE_TEST_SUITE_P(Forms, EventStore, ::testing::Values(".palpate", ".dsa"));

TEST(EventStoreKinds, onlyWhatAPersonSaysIsNoted) {
  for (const char* kind : {"label", "mark", "note", "recipe", "segment", "sensor_settings", "tare"})
    EXPECT_TRUE(isUserEvent({0, 0, kind, {}, "", ""})) << kind;
  for (const char* kind : {"gap", "settings", "grasp", "motion", "link", "clock", "alarm", ""})
    EXPECT_FALSE(isUserEvent({0, 0, kind, {}, "", ""})) << kind;
}

TEST(EventStoreState, aRecordingInProgressOrUnfinishedIsRefused) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  {
    PalpateWriter writer(path, sdh2().layout);
    addSamples(writer, 0, 20);
    writer.addEvent(kLabel);
    writer.commit();
    expectContains(fileErrorOf([&] { saveEvents(path, readEvents(path), std::vector{kNote}); }),
                   "is being recorded");
  }
  const std::string bytes = readFile(path);
  expectContains(fileErrorOf([&] { saveEvents(path, readEvents(path), std::vector{kNote}); }),
                 "palpate recover");
  EXPECT_TRUE(readFile(path) == bytes);
  EXPECT_EQ(recoverRecording(path, folder / "out.palpate").state, RecoverReport::State::kWhole);
  saveEvents(folder / "out.palpate", readEvents(folder / "out.palpate"), std::vector{kNote});
  EXPECT_EQ(readEvents(folder / "out.palpate").events, std::vector{kNote});
}

TEST(EventStoreState, twoThatSaveAtOnceHarmNothing) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), ".palpate");
  std::atomic<int> saved = 0;
  const auto add = [&](std::int64_t from) {
    for (std::int64_t i = from; i < from + 20;) {
      try {
        const EventsReport asRead = readEvents(path);
        std::vector<Event> events = asRead.events;
        events.push_back({i, i, "note", {}, "n", ""});
        saveEvents(path, asRead, events);
        ++saved;
        ++i;
      } catch (const FileError&) {  // the other one was faster
      }
    }
  };
  std::thread other([&] { add(1000); });
  add(2000);
  other.join();
  EXPECT_EQ(readEvents(path).events.size(), 2u + 40u);
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
}

TEST(EventStoreReaders, anOpenProfileNeitherHindersNorIsHindered) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), ".palpate", 3000);
  const Profile open = openRecording(path);
  std::atomic<bool> stop = false;
  std::atomic<std::size_t> read = 0;
  std::vector<std::thread> readers;
  for (unsigned seed = 0; seed < 2; ++seed)
    readers.emplace_back([&, seed] {
      TactileFrame frame;
      for (std::size_t i = seed * 997; !stop; i += 1499) {
        open.readFrame(i % 3000, frame);
        ASSERT_EQ(frame.values, sampleFrame(i % 3000).values);
        ++read;
      }
    });
  for (int round = 0; round < 30; ++round) {
    saveEvents(path, readEvents(path), std::vector{kGap, kNote});
    saveEvents(path, readEvents(path), std::vector{kLabel, kGap, kSegment});
  }
  stop = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_GT(read, 0u);
  // Opened before, it reads on when another one has taken its name.
  fs::remove(path);
  EXPECT_EQ(open.frame(2999).values, sampleFrame(2999).values);
}

TEST(EventStoreReaders, anotherProcessAlwaysReadsTheOldOrTheNewOnes) {
  const TemporaryFolder folder;
  const fs::path path = makeRecording(folder.path(), ".palpate", 300);
  const std::vector one{kLabel, kGap, kNote};
  const std::vector two{kSegment, kGap};
  saveEvents(path, readEvents(path), one);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    int wrong = 0;
    for (int round = 0; round < 100; ++round) {
      if (write(ends[1], "r", 1) != 1) _exit(2);  // the next save runs beside this round
      try {
        const EventsReport now = readEvents(path);
        const Profile profile = openRecording(path);
        if (now.damaged > 0 || (now.events != one && now.events != two) ||
            profile.numFrames() != 300 || !profile.info().warnings.empty())
          ++wrong;
      } catch (const std::exception& error) {
        std::fprintf(stderr, "reading: %s\n", error.what());
        ++wrong;
      }
    }
    _exit(wrong == 0 ? 0 : 1);
  }
  close(ends[1]);
  char told = 0;
  int rounds = 0;
  for (; read(ends[0], &told, 1) == 1; ++rounds) {
    const EventsReport now = readEvents(path);
    saveEvents(path, now, now.events == one ? two : one);
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(rounds, 100);
}

TEST(EventStoreDamage, damagedEventsStay) {
  const TemporaryFolder folder;
  const fs::path native = makeRecording(folder.path(), ".palpate");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(native.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database,
               "INSERT INTO event VALUES(9, 1, 1, 'label', NULL, 'hurt', '', 12345)",
               nullptr,
               nullptr,
               nullptr);
  sqlite3_close(database);
  EventsReport asRead = readEvents(native);
  EXPECT_EQ(asRead.damaged, 1u);
  saveEvents(native, asRead, std::vector{kGap, kNote});
  EXPECT_EQ(readEvents(native).damaged, 1u);
  EXPECT_EQ(readEvents(native).events, (std::vector{kGap, kNote}));

  const fs::path dsa = makeRecording(folder.path(), ".dsa");
  const fs::path sidecar = dsa.string() + ".notes.json";
  std::string text = readFile(sidecar);
  text.insert(text.find('[') + 1, "{\"t_us\": \"hurt\"},");
  writeFile(sidecar, text);
  asRead = readEvents(dsa);
  EXPECT_EQ(asRead.damaged, 1u);
  saveEvents(dsa, asRead, std::vector{kGap, kNote});
  EXPECT_EQ(readEvents(dsa).damaged, 1u);
  expectContains(readFile(sidecar), "hurt");
}

TEST(EventStoreDamage, aSidecarWithoutEventsGoes) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 5);
  const fs::path path = folder / "r.dsa";
  saveRecording(openRecording(folder / "a.palpate"), {}, path);
  const fs::path sidecar = path.string() + ".notes.json";
  saveEvents(path, readEvents(path), std::vector{kNote});
  EXPECT_TRUE(fs::exists(sidecar));
  saveEvents(path, readEvents(path), {});
  EXPECT_FALSE(fs::exists(sidecar));
  writeFile(sidecar, "nonsense");
  EXPECT_THROW(saveEvents(path, {}, std::vector{kNote}), FormatError);
  EXPECT_EQ(readFile(sidecar), "nonsense");
  fs::remove(sidecar);
  ASSERT_EQ(::mkfifo(sidecar.c_str(), 0600), 0);
  EXPECT_THROW(readEvents(path), FileError) << "nobody may ever write into it";
}

}  // namespace
}  // namespace palpate::event_store_test
