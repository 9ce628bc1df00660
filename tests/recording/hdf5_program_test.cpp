// Files that libhdf5 can't read, and a program that fails in the place of palpate_hdf5.
#include "palpate/recording/hdf5_program.h"

#include <cerrno>
#include <csignal>
#include <random>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/hash.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_import.h"
#include "palpate/recording/table_source.h"

#include "recording/import_samples.h"
#include "recording/palpate_samples.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::hdf5_program_test {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

bool anyChild() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

// What opening says, one line; "opened" where it says nothing.
std::string opening(const fs::path& path) {
  try {
    openRecording(path);
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }
  return "opened";
}

std::string openingTable(const fs::path& path) {
  return testing::errorOf([&] { openTable(path); });
}

void makeRecording(const fs::path& path) {
  testing::writeSamples(path.string() + ".palpate", 300);
  saveRecording(openRecording(path.string() + ".palpate"),
                readEvents(path.string() + ".palpate").events,
                path,
                Overwrite::kReplace);
  fs::remove(path.string() + ".palpate");
}

// Makes the checksum of a changed file fit, as docs/bridges.md shows.
std::string withRenewedChecksum(std::string file) {
  constexpr std::size_t kUserBlock = 512;
  const auto rest = std::as_bytes(std::span(file).subspan(kUserBlock));
  std::string block =
      "Palpate recording in HDF5\nSHA-256 of the bytes from 512 on:\n" + sha256(rest) + "\n";
  block.resize(kUserBlock, '\0');
  return file.replace(0, kUserBlock, block);
}

// Another program in the place of palpate_hdf5, while this object exists.
class InsteadOfTheProgram {
 public:
  InsteadOfTheProgram(const fs::path& path, const std::string& script) {
    testing::writeFile(path, "#!/bin/sh\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
    setHdf5Program(path);
  }
  ~InsteadOfTheProgram() { setHdf5Program({}); }
  InsteadOfTheProgram(const InsteadOfTheProgram&) = delete;
  InsteadOfTheProgram& operator=(const InsteadOfTheProgram&) = delete;
};

TEST(Hdf5Program, howTheProgramEndedIsOneLine) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  testing::runPython(folder, R"(
import sys, h5py
with h5py.File(sys.argv[1] + '/table.h5', 'w') as f: f['x'] = [1, 2, 3]
)");
  const std::pair<const char*, const char*> ends[] = {
      {"kill -SEGV $$", "crashed"},
      {"exit 1", "crashed"},
      {"head -c 8 <&3 >/dev/null; printf abc >&3", "crashed"},
      {"kill -XCPU $$", "took too long"},
      {"exit 12", "needs more than 256 MB of memory"}};
  for (const auto& [script, end] : ends) {
    const InsteadOfTheProgram failing(folder / "failing", script);
    for (const char* name : {"a.h5", "table.h5"}) {
      const fs::path path = folder / name;
      const std::string said = name[0] == 'a' ? opening(path) : openingTable(path);
      EXPECT_EQ(said,
                path.string() + ": libhdf5 could not read it (" + end +
                    "): it is damaged, or was made to do that; use the recording or the data "
                    "that it was exported from");
    }
    EXPECT_EQ(verifyRecording(folder / "a.h5").state, VerifyReport::State::kUnreadable);
    EXPECT_FALSE(anyChild());
  }
  EXPECT_EQ(opening(folder / "a.h5"), "opened");
}

TEST(Hdf5Program, aMissingProgramIsOneLineThatNamesIt) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  setHdf5Program(folder / "nothing");
  const std::string said = opening(folder / "a.h5");
  setHdf5Program({});
  EXPECT_EQ(said,
            (folder / "a.h5").string() + ": HDF5 can't be read: " + (folder / "nothing").string() +
                " can't be started: No such file or directory; install palpate again");
  EXPECT_TRUE(hdf5Program().is_absolute());
}

TEST(Hdf5Program, aProgramThatDiesLaterIsToldOfByEachLaterCall) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  const std::size_t before = testing::leastProcessFacts().descriptors;
  {
    const Profile profile = openRecording(folder / "a.h5");
    // The only child of this process.
    ASSERT_EQ(::waitpid(-1, nullptr, WNOHANG), 0);
    const std::string children =
        testing::readFile("/proc/self/task/" + std::to_string(::getpid()) + "/children");
    ASSERT_EQ(::kill(std::stoi(children), SIGSEGV), 0);
    for (int i = 0; i < 2; ++i)
      EXPECT_NE(testing::errorOf([&] { profile.frame(0); }).find("libhdf5 could not read it"),
                std::string::npos);
  }
  EXPECT_FALSE(anyChild());
  EXPECT_EQ(testing::leastProcessFacts().descriptors, before);
}

// Of such files some crash libhdf5 1.10.8, and some hang it; this process reads on.
TEST(Hdf5Program, changedBytesWithARightChecksumEndNothing) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  const std::string whole = testing::readFile(folder / "a.h5");
  // The texts of HDF5 lie in collections that begin so.
  const std::size_t heap = whole.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  std::mt19937 random(4);
  int failures = 0;
  for (int round = 0; round < 120; ++round) {
    std::string bad = whole;
    const std::size_t from = round % 2 == 0 ? 512 : heap;
    const std::size_t within = round % 2 == 0 ? bad.size() - from : 512;
    for (int i = 0; i < 1 + round % 3; ++i)
      bad[from + random() % within] ^= static_cast<char>(1 + random() % 255);
    testing::writeFile(folder / "bad.h5", withRenewedChecksum(bad));
    const VerifyReport report = verifyRecording(folder / "bad.h5");
    EXPECT_EQ(report.message.find('\n'), std::string::npos) << report.message;
    failures += report.state == VerifyReport::State::kUnreadable;
  }
  EXPECT_GT(failures, 0);
  EXPECT_FALSE(anyChild());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "something was left";
}

constexpr const char* kChanged = R"(
import hashlib, os, sys, shutil, numpy as np, h5py
folder = sys.argv[1] + '/'
class changed:
  def __init__(self, name):
    self.path = folder + name
    shutil.copy(folder + 'a.h5', self.path)
  def __enter__(self):
    self.file = h5py.File(self.path, 'r+')
    return self.file
  def __exit__(self, *error):
    self.file.close()
    with open(self.path, 'r+b') as f:
      rest = f.read()[512:]
      f.seek(0)
      f.write((b'Palpate recording in HDF5\nSHA-256 of the bytes from 512 on:\n' +
               hashlib.sha256(rest).hexdigest().encode() + b'\n').ljust(512, b'\0'))
)";

TEST(Hdf5Program, aRecordingThatRefersToOtherFilesIsRefused) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  testing::runPython(folder, std::string(kChanged) + R"(
os.mkfifo(folder + 'fifo')
with h5py.File(folder + 'other.h5', 'w') as f: f['t'] = np.arange(300) * 1000; f.create_group('joints')
with changed('external_link.h5') as f:
  del f['tactile/time_us']; f['tactile/time_us'] = h5py.ExternalLink(folder + 'other.h5', '/t')
with changed('external_group.h5') as f:
  del f['joints']; f['joints'] = h5py.ExternalLink(folder + 'other.h5', '/joints')
with changed('soft_link.h5') as f:
  del f['tactile/time_us']
  f['outside'] = h5py.ExternalLink(folder + 'other.h5', '/')
  f['tactile/time_us'] = h5py.SoftLink('/outside/t')
with changed('external_storage.h5') as f:
  del f['tactile/time_us']
  f.create_dataset('tactile/time_us', (300,), 'i8', external=[(folder + 'fifo', 0, 2400)])
with changed('virtual.h5') as f:
  del f['tactile/time_us']
  layout = h5py.VirtualLayout((300,), 'i8')
  layout[:] = h5py.VirtualSource(folder + 'other.h5', 't', (300,))
  f.create_virtual_dataset('tactile/time_us', layout)
)");
  const auto expectRefused = [&](const char* name, const std::string& words) {
    const std::string said = opening(folder / name);
    EXPECT_NE(said.find(words), std::string::npos) << name << ": " << said;
  };
  expectRefused("external_link.h5",
                "\"tactile/time_us\" is a link to another file (external link)");
  expectRefused("external_group.h5", "\"joints\" is a link to another file (external link)");
  expectRefused("soft_link.h5", "\"tactile/time_us\" ");
  expectRefused("external_storage.h5",
                "\"tactile/time_us\" lies in other files (external storage)");
  expectRefused("virtual.h5",
                "\"tactile/time_us\" is put together of other data sets (virtual layout)");
  EXPECT_EQ(opening(folder / "a.h5"), "opened");
}

TEST(Hdf5Program, aTableThatRefersToOtherFilesIsRefused) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import os, sys, numpy as np, h5py
folder = sys.argv[1] + '/'
os.mkfifo(folder + 'fifo')
with h5py.File(folder + 'other.h5', 'w') as f: f['t'] = np.arange(50)
with h5py.File(folder + 'storage.h5', 'w') as f:
  f.create_dataset('g/t', (50,), 'i8', external=[(folder + 'fifo', 0, 400)])
with h5py.File(folder + 'virtual.h5', 'w') as f:
  layout = h5py.VirtualLayout((50,), 'i8')
  layout[:] = h5py.VirtualSource(folder + 'other.h5', 't', (50,))
  f.create_virtual_dataset('g/t', layout)
with h5py.File(folder + 'link.h5', 'w') as f:
  f['here'] = np.arange(50)
  f['t'] = h5py.ExternalLink(folder + 'other.h5', '/t')
with h5py.File(folder + 'unwritten.h5', 'w') as f:
  f.create_dataset('pad', (1 << 28, 12), 'f8', chunks=(1024, 12))
  f['time'] = np.arange(50)
)");
  EXPECT_NE(openingTable(folder / "storage.h5").find("\"g/t\" lies in other files"),
            std::string::npos);
  EXPECT_NE(openingTable(folder / "virtual.h5").find("\"g/t\" is put together of other data sets"),
            std::string::npos);
  // What a link leads to is no data set of this file.
  const auto table = openTable(folder / "link.h5");
  ASSERT_EQ(table->columns().size(), 1u);
  EXPECT_EQ(table->columns()[0].name, "here");
  // What isn't there is refused when it is wanted.
  const auto unwritten = openTable(folder / "unwritten.h5");
  const std::size_t pad[] = {0};
  const std::size_t time[] = {1};
  EXPECT_NE(testing::errorOf([&] { unwritten->start(pad, {}); }).find("\"pad\" claims more values"),
            std::string::npos);
  unwritten->start(time, {});
  TableRow row;
  EXPECT_TRUE(unwritten->next(row));
}

// Small files that claim much: 2 GB of stamps, of texts, and of numbers in one chunk.
TEST(Hdf5Program, whatAFileClaimsTakesLittleMemory) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  testing::runPython(folder, std::string(kChanged) + R"(
with changed('unwritten.h5') as f:
  del f['tactile/time_us']
  f.create_dataset('tactile/time_us', (1 << 28,), 'i8', chunks=(1024,))
with changed('contiguous.h5') as f:
  del f['tactile/time_us']
  f.create_dataset('tactile/time_us', (1 << 28,), 'i8')
with changed('texts.h5') as f:
  text = h5py.string_dtype()
  for name in ('time_us', 'end_us', 'matrix', 'kind', 'text', 'json'): del f['events'][name]
  f['events/time_us'] = np.arange(4000); f['events/end_us'] = np.arange(4000)
  f['events/matrix'] = np.zeros(4000, 'i4')
  f.create_dataset('events/kind', data=['note'] * 4000, dtype=text)
  f.create_dataset('events/json', data=[''] * 4000, dtype=text)
  # All of them are the same 200 kB in the file.
  one = f.create_dataset('one', (1,), dtype=text, chunks=(1,)); one[0] = 'x' * 200_000
  reference = one.id.read_direct_chunk((0,))[1]
  all = f.create_dataset('events/text', (4000,), dtype=text, chunks=(4000,))
  all.id.write_direct_chunk((0,), reference * 4000)
with changed('chunk.h5') as f:
  del f['tactile/time_us']
  f.create_dataset('tactile/time_us', data=np.arange(1 << 23), chunks=(1 << 23,), compression='gzip')
)");
  const std::size_t before = testing::leastProcessFacts().residentBytes;
  const auto expectRefused = [&](const char* name, const std::string& words) {
    const std::string said = opening(folder / name);
    EXPECT_NE(said.find(words), std::string::npos) << name << ": " << said;
  };
  expectRefused("unwritten.h5", "\"tactile/time_us\" claims more values than the file holds");
  expectRefused("contiguous.h5", "\"tactile/time_us\" claims more values than the file holds");
  expectRefused("texts.h5", "\"events/text\" has too many texts");
  expectRefused("chunk.h5", "\"tactile/time_us\" has chunks that are too large to be read");
  if (testing::kMemoryIsOurs) {
    EXPECT_LT(testing::processFacts().residentBytes, before + (100u << 20));
  }
}

// The stamps of a long recording don't lie in memory all at once; each is found.
TEST(Hdf5Program, stampsOfALongRecordingAreReadWhenTheyAreWanted) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  testing::runPython(folder, std::string(kChanged) + R"(
with changed('long.h5') as f:
  n = 700_000
  del f['joints/time_us']; del f['joints/angles']
  f.create_dataset('joints/time_us', data=np.arange(n) * 7 + 3, chunks=(4096,), compression='gzip')
  f.create_dataset('joints/angles', data=np.arange(n * 7.).reshape(n, 7), chunks=(4096, 7), compression='gzip')
)");
  const Profile profile = openRecording(folder / "long.h5");
  ASSERT_EQ(profile.numAngles(), 700'000u);
  for (const std::size_t i : {0u, 699'999u, 65'535u, 65'536u, 300'000u, 1u, 699'998u, 500'000u}) {
    EXPECT_EQ(profile.angleTimeUs(i), static_cast<std::int64_t>(i) * 7 + 3);
    EXPECT_EQ(profile.angles(i).deg[2], static_cast<double>(i) * 7 + 2);
  }
}

}  // namespace
}  // namespace palpate::hdf5_program_test
