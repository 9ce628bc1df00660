// The bad days of saving events: disk full, input/output errors, power cuts, kills. Afterwards the
// recording has the old events or the new ones, every sample, and takes the next change.
#include <csignal>
#include <random>

#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "recording/faulty_vfs.h"
#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::event_store_faults_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;
using Fault = FaultyVfs::Fault;

constexpr std::size_t kFrames = 60;

// Notes long enough to need pages of their own.
std::vector<Event> notes(int version) {
  std::vector<Event> events;
  for (int i = 0; i < 12; ++i)
    events.push_back({kSampleStartUs + i,
                      kSampleStartUs + i,
                      "note",
                      {},
                      std::string(1000, static_cast<char>('a' + version)) + std::to_string(i),
                      ""});
  return events;
}

fs::path makeNoted(const fs::path& folder) {
  writeSamples(folder / "source.palpate", kFrames);
  saveRecording(openRecording(folder / "source.palpate"), notes(0), folder / "r.palpate");
  fs::remove(folder / "source.palpate");
  return folder / "r.palpate";
}

void save(const fs::path& path, int version) {
  SaveEventsOptions options;
  options.vfs = FaultyVfs::name();
  saveEvents(path, readEvents(path), notes(version), options);
}

// Which notes it has; whole in any case.
int expectWhole(const fs::path& path) {
  const Profile profile = openRecording(path);
  EXPECT_EQ(profile.numFrames(), kFrames);
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    EXPECT_EQ(profile.frame(i).values, sampleFrame(i).values) << i;
  const VerifyReport report = verifyRecording(path);
  EXPECT_EQ(report.state, VerifyReport::State::kSound) << report.message;
  const EventsReport now = readEvents(path);
  EXPECT_EQ(now.damaged, 0u);
  for (int version : {0, 1, 2})
    if (now.events == notes(version)) return version;
  ADD_FAILURE() << "neither the old nor the new events";
  return -1;
}

std::int64_t operationsOfSave() {
  const TemporaryFolder folder;
  const fs::path path = makeNoted(folder.path());
  FaultyVfs vfs;
  save(path, 1);
  return vfs.operations();
}

TEST(EventStoreFaults, powerCutAtEveryOperationLeavesOldOrNew) {
  const std::int64_t operations = operationsOfSave();
  ASSERT_GT(operations, 10);
  int seenOld = 0;
  for (std::int64_t n = 1; n <= operations; ++n) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE("operation " + std::to_string(n));
      const TemporaryFolder folder;
      const TemporaryFolder after;
      const fs::path path = makeNoted(folder.path());
      std::mt19937 random(seed * 1000 + static_cast<unsigned>(n));
      bool saved = true;
      {
        FaultyVfs vfs;
        vfs.failAt(Fault::kPowerCut, n);
        try {
          save(path, 1);
        } catch (const FileError&) {
          saved = false;
        }
        vfs.writeRemains(after.path(), random);
      }
      const int version = expectWhole(after / "r.palpate");
      EXPECT_TRUE(version == 0 || version == 1);
      EXPECT_TRUE(!saved || version == 1);
      seenOld += version == 0;
      // The next one finds nothing in its way.
      saveEvents(after / "r.palpate", readEvents(after / "r.palpate"), notes(2));
      EXPECT_EQ(expectWhole(after / "r.palpate"), 2);
    }
  }
  EXPECT_GT(seenOld, 0);
}

TEST(EventStoreFaults, aFullOrFailingDiskIsSaidAndChangesNothing) {
  const std::int64_t operations = operationsOfSave();
  for (const Fault fault : {Fault::kFull, Fault::kError, Fault::kFullOnce, Fault::kErrorOnce}) {
    for (std::int64_t n = 1; n <= operations; ++n) {
      SCOPED_TRACE("operation " + std::to_string(n));
      const TemporaryFolder folder;
      const fs::path path = makeNoted(folder.path());
      bool saved = true;
      {
        FaultyVfs vfs;
        vfs.failAt(fault, n);
        try {
          save(path, 1);
        } catch (const FileError&) {
          saved = false;
        }
      }
      const int version = expectWhole(path);
      EXPECT_TRUE(!saved || version == 1);
      saveEvents(path, readEvents(path), notes(2));
      EXPECT_EQ(expectWhole(path), 2);
    }
  }
}

TEST(EventStoreFaults, killedAtAnyMomentItHasTheOldOrTheNewOnes) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 30; ++round) {
    const TemporaryFolder folder;
    const fs::path path = makeNoted(folder.path());
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      for (int version = 1;; version = 3 - version) {
        saveEvents(path, readEvents(path), notes(version));
        if (write(ends[1], &version, sizeof version) != sizeof version) _exit(1);
      }
    }
    close(ends[1]);
    int told = 0;
    for (unsigned i = 0; i <= random() % 4; ++i)
      ASSERT_EQ(read(ends[0], &told, sizeof told), static_cast<ssize_t>(sizeof told));
    // some part of a save; no clock decides anything
    volatile unsigned wait = random() % 4'000'000;
    while (wait > 0) wait = wait - 1;
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (read(ends[0], &told, sizeof told) == static_cast<ssize_t>(sizeof told)) {
    }
    close(ends[0]);
    // One save may have ended that it could not tell of any more.
    const int version = expectWhole(path);
    EXPECT_TRUE(version == told || version == 3 - told) << version << " after " << told;
    saveEvents(path, readEvents(path), {});
    EXPECT_TRUE(readEvents(path).events.empty());
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  }
}

}  // namespace
}  // namespace palpate::event_store_faults_test
