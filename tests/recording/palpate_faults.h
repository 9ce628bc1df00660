// Runs of a recorder under faults, for the short and the long form of their tests (R1, R2, R3).
#pragma once

#include <csignal>
#include <random>

#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "recording/faulty_vfs.h"
#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::testing {

constexpr std::size_t kRunFrames = 40;

// Every frame is the one that was written under its number; at least `committed` are there.
inline void expectFrames(const std::filesystem::path& path,
                         std::size_t committed,
                         std::size_t most) {
  const Profile profile = openRecording(path);
  EXPECT_GE(profile.numFrames(), committed);
  EXPECT_LE(profile.numFrames(), most);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    const TactileFrame expected = sampleFrame(i);
    ASSERT_EQ(frame.hostUs, expected.hostUs) << i;
    ASSERT_EQ(frame.values, expected.values) << i;
  }
  for (std::size_t i = 0; i < profile.numAngles(); ++i)
    ASSERT_EQ(profile.angles(i).values, sampleAngles(i).values) << i;
  const VerifyReport report = verifyRecording(path);
  EXPECT_EQ(report.state, VerifyReport::State::kSound) << report.message;
}

struct RunResult {
  bool created = false;
  bool finished = false;
  std::size_t failures = 0;   // calls that threw FileError
  std::size_t committed = 0;  // frames that the writer said were on disk
};

// Records kRunFrames frames and goes on after every failure, as a recorder does.
inline RunResult record(const std::filesystem::path& path) {
  RunResult result;
  PalpateWriterOptions options;
  options.vfs = FaultyVfs::name();
  std::unique_ptr<PalpateWriter> writer;
  try {
    writer = std::make_unique<PalpateWriter>(
        path, sdh2().layout, std::map<std::string, std::string>{}, options);
  } catch (const FileError&) {
    ++result.failures;
    return result;
  }
  result.created = true;
  for (std::size_t i = 0; i < kRunFrames; ++i) {
    try {
      addSamples(*writer, i, i + 1);
    } catch (const FileError&) {
      ++result.failures;
      // The sample that the call brought is kept; those behind it in this round are still to come.
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
        try {
          writer->addSample(sampleAngles(k));
        } catch (const std::invalid_argument&) {  // there already
        } catch (const FileError&) {
        }
      }
      try {
        writer->addFrame(sampleFrame(i));
      } catch (const std::invalid_argument&) {
      } catch (const FileError&) {
      }
    }
    result.committed = static_cast<std::size_t>(writer->framesOnDisk());
  }
  for (int attempt = 0; attempt < 2 && !result.finished; ++attempt) {
    try {
      writer->finish();
      result.finished = true;
    } catch (const FileError&) {
      ++result.failures;
    }
  }
  result.committed = static_cast<std::size_t>(writer->framesOnDisk());
  return result;
}

inline std::int64_t operationsOfRun() {
  static const std::int64_t operations = [] {
    const TemporaryFolder folder;
    FaultyVfs vfs;
    EXPECT_TRUE(record(folder / "r.palpate").finished);
    return vfs.operations();
  }();
  return operations;
}

// R2. The power goes at the n-th operation; then the remains of the disk are opened.
inline void cutPowerAt(std::int64_t n, unsigned seed) {
  SCOPED_TRACE("operation " + std::to_string(n) + ", seed " + std::to_string(seed));
  const TemporaryFolder folder;
  const TemporaryFolder after;
  std::mt19937 random(seed);
  RunResult result;
  {
    FaultyVfs vfs;
    vfs.failAt(FaultyVfs::Fault::kPowerCut, n);
    result = record(folder / "r.palpate");
    vfs.writeRemains(after.path(), random);
  }
  if (!result.created) return;  // the power went before there was a recording
  expectFrames(after / "r.palpate", result.committed, kRunFrames);
}

// R3. From the n-th operation on nothing can be written.
inline void failForGoodAt(FaultyVfs::Fault fault, std::int64_t n) {
  SCOPED_TRACE("operation " + std::to_string(n));
  const TemporaryFolder folder;
  RunResult result;
  {
    FaultyVfs vfs;
    vfs.failAt(fault, n);
    result = record(folder / "r.palpate");
    // The very last operations only tidy up; their failure may pass unnoticed.
    EXPECT_TRUE(result.failures > 0 || result.finished);
  }
  if (!result.created) {
    EXPECT_FALSE(std::filesystem::exists(folder / "r.palpate"));
    return;
  }
  expectFrames(folder / "r.palpate", result.committed, kRunFrames);
}

// R3. Only the n-th operation fails: the next commit brings everything.
inline void failOnceAt(FaultyVfs::Fault fault, std::int64_t n) {
  SCOPED_TRACE("operation " + std::to_string(n));
  const TemporaryFolder folder;
  RunResult result;
  {
    FaultyVfs vfs;
    vfs.failAt(fault, n);
    result = record(folder / "r.palpate");
  }
  if (!result.created) return;
  EXPECT_TRUE(result.finished);
  expectFrames(folder / "r.palpate", kRunFrames, kRunFrames);
}

// R1, without the port. A process of its own records as fast as it can, tells through a pipe how
// many frames are committed, and is killed when it has told of `commits`; `spin` varies the moment
// within.
inline void killAfter(unsigned commits, unsigned spin) {
  SCOPED_TRACE("after " + std::to_string(commits) + " commits");
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "r.palpate";
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    PalpateWriter writer(path, sdh2().layout);
    std::int64_t told = 0;
    for (std::size_t i = 0;; ++i) {
      addSamples(writer, i, i + 1);
      if (writer.framesOnDisk() == told) continue;
      told = writer.framesOnDisk();
      if (write(ends[1], &told, sizeof told) != sizeof told) _exit(1);
    }
  }
  close(ends[1]);
  std::int64_t committed = 0;
  std::int64_t told = 0;
  for (unsigned i = 0; i <= commits; ++i)
    if (read(ends[0], &told, sizeof told) == sizeof told) committed = told;
  volatile unsigned wait = spin % 200'000;  // some part of a commit; no clock decides anything
  while (wait > 0) wait = wait - 1;
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  while (read(ends[0], &told, sizeof told) == sizeof told) committed = told;
  close(ends[0]);
  ASSERT_GT(committed, 0);
  // One commit may have ended that it could not tell of any more.
  expectFrames(path, static_cast<std::size_t>(committed), static_cast<std::size_t>(committed) + 8);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.path().extension() != ".lock" ? 1 : 0;
  EXPECT_LE(files, 2u);  // itself and its rollback journal
}

}  // namespace palpate::testing
