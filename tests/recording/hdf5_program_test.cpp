// Files that libhdf5 can't read, and a program that fails in the place of palpate_hdf5.
#include "palpate/recording/hdf5_program.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <random>
#include <sstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/hash.h"
#include "palpate/imports/recording_import.h"
#include "palpate/imports/table_source.h"
#include "palpate/recording/hdf5_process.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
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

// The only child of this process.
int childOfThis() {
  return std::stoi(
      testing::readFile("/proc/self/task/" + std::to_string(::getpid()) + "/children"));
}

// A counter of a process: "rchar" [bytes that it has read], "syscr" [its calls to read].
std::uint64_t readCounter(int process, const std::string& name) {
  std::istringstream lines(testing::readFile("/proc/" + std::to_string(process) + "/io"));
  std::string key;
  for (std::uint64_t value = 0; lines >> key >> value;)
    if (key == name + ":") return value;
  ADD_FAILURE() << "no counter " << name;
  return 0;
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

// Makes the checksum of a changed file fit, as docs/notes/exchange_formats.md shows.
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
      {"kill -PROF $$", "took too long"},
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

// It neither reads nor ends by itself.
TEST(Hdf5Program, aProgramThatAnswersWronglyAndLivesOnIsEnded) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  for (const char* answer :
       {R"(printf '\0\0\0\0\0' >&3)", R"(printf '\377\377\377\377\0' >&3)", "exec 3>&-"}) {
    const InsteadOfTheProgram failing(folder / "failing", std::string(answer) + "; exec sleep 100");
    const std::string said = opening(folder / "a.h5");
    EXPECT_NE(said.find("libhdf5 could not read it (gave no valid answer)"), std::string::npos)
        << said;
    EXPECT_FALSE(anyChild());
  }
}

// The window waits for the values of a frame.
TEST(Hdf5Program, aProgramThatAnswersNoMoreIsEndedSoon) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  const Profile profile = openRecording(folder / "a.h5");
  ASSERT_EQ(::kill(childOfThis(), SIGSTOP), 0);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 2; ++i) {
    const std::string said = testing::errorOf([&] { profile.frame(0); });
    EXPECT_NE(said.find("libhdf5 could not read it (took too long)"), std::string::npos) << said;
  }
  // 2 s, and what a busy machine needs; an import has 60 s.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  EXPECT_FALSE(anyChild());
}

TEST(Hdf5Program, aProgramThatTheSystemEndsIsNoFaultOfTheFile) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  const Profile profile = openRecording(folder / "a.h5");
  ASSERT_EQ(::kill(childOfThis(), SIGKILL), 0);
  EXPECT_EQ(testing::errorOf([&] { profile.frame(0); }),
            (folder / "a.h5").string() +
                ": can't be read: the program that reads it was ended by the system (out of "
                "memory?); try again");
}

TEST(Hdf5Program, aTableThatTakesTooLongIsToldHowToWriteItAnew) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, h5py
with h5py.File(sys.argv[1] + '/table.h5', 'w') as f: f['x'] = [1, 2, 3]
)");
  const auto table = openTable(folder / "table.h5");
  const std::size_t columns[] = {0};
  table->start(columns, {});
  ASSERT_EQ(::kill(childOfThis(), SIGPROF), 0);  // as the system does it
  TableRow row;
  EXPECT_EQ(testing::errorOf([&] { table->next(row); }),
            (folder / "table.h5").string() +
                ": \"x\" takes too long to read: its chunks don't match rows; write it again with "
                "larger chunks");
}

// Chunks have nothing to do with it: a damaged netCDF kept the library busy with its names of axes.
TEST(Hdf5Program, namesOfAxesThatTakeTooLongAreNotBlamedOnChunks) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, h5py
with h5py.File(sys.argv[1] + '/table.h5', 'w') as f: f['x'] = [1, 2, 3]
)");
  const FileDescriptor file(::open((folder / "table.h5").c_str(), O_RDONLY | O_CLOEXEC));
  Hdf5Process reading(folder / "table.h5", file.get(), Hdf5Use::kImport);
  ASSERT_EQ(::kill(childOfThis(), SIGPROF), 0);
  EXPECT_EQ(testing::errorOf([&] { reading.axisNames("x"); }),
            (folder / "table.h5").string() +
                ": libhdf5 could not read it (took too long): it is damaged, or was made to do "
                "that; use the recording or the data that it was exported from");
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
    ASSERT_EQ(::waitpid(-1, nullptr, WNOHANG), 0);
    ASSERT_EQ(::kill(childOfThis(), SIGSEGV), 0);
    for (int i = 0; i < 2; ++i)
      EXPECT_NE(testing::errorOf([&] { profile.frame(0); }).find("libhdf5 could not read it"),
                std::string::npos);
  }
  EXPECT_FALSE(anyChild());
  EXPECT_EQ(testing::leastProcessFacts().descriptors, before);
}

// Anybody can put a program into a folder such as /tmp.
TEST(Hdf5Program, isFoundOnlyBesideThisOneOrInItsInstallation) {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& place) {
    fs::create_directories((folder / place).parent_path());
    testing::writeFile(folder / place, "");
    return folder / place;
  };
  const auto foundFor = [&](const std::string& binary) { return hdf5ProgramOf(folder / binary); };
  put("palpate_hdf5");
  put("libexec/palpate/palpate_hdf5");
  put("x/palpate_hdf5");
  EXPECT_EQ(foundFor("x/y/palpate"), folder / "x/y/palpate_hdf5") << "which isn't there";
  EXPECT_EQ(foundFor("x/palpate"), folder / "x/palpate_hdf5");
  EXPECT_EQ(foundFor("bin/palpate"), folder / "libexec/palpate/palpate_hdf5");
  EXPECT_EQ(foundFor("lib/python3/dist-packages/palpate.so"),
            folder / "libexec/palpate/palpate_hdf5");
  EXPECT_EQ(foundFor("python3/dist-packages/palpate.so"),
            folder / "python3/dist-packages/palpate_hdf5");
  // These tests lie in a folder of the build.
  EXPECT_TRUE(fs::is_regular_file(hdf5Program()));
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
                "\"tactile/time_us\" is stored in other files (external storage)");
  expectRefused("virtual.h5",
                "\"tactile/time_us\" is assembled from other data sets (virtual layout)");
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
  EXPECT_NE(openingTable(folder / "storage.h5").find("\"g/t\" is stored in other files"),
            std::string::npos);
  EXPECT_NE(openingTable(folder / "virtual.h5").find("\"g/t\" is assembled from other data sets"),
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
  const auto expectRefused = [&](const char* name, const std::string& words) {
    const std::uint64_t memory = testing::memoryOf([&] {
      const std::string said = opening(folder / name);
      EXPECT_NE(said.find(words), std::string::npos) << name << ": " << said;
      return said.find(words) != std::string::npos;
    });
    if (testing::kMemoryIsOurs) {
      EXPECT_LT(memory, 256u << 20) << name;
    }
  };
  expectRefused("unwritten.h5", "\"tactile/time_us\" claims more values than the file holds");
  expectRefused("contiguous.h5", "\"tactile/time_us\" claims more values than the file holds");
  expectRefused("texts.h5", "\"events/text\" has too many texts");
  expectRefused("chunk.h5", "\"tactile/time_us\" has chunks that are too large to be read");
}

// Those behind the first 4 MB of names are no columns.
TEST(Hdf5Program, namesOfATableTakeLittleMemory) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, h5py
with h5py.File(sys.argv[1] + '/names.h5', 'w') as f:
  for i in range(2000): f['%04d' % i + 3996 * 'x'] = [1]
)");
  EXPECT_EQ(openTable(folder / "names.h5")->columns().size(), (4u << 20) / 4000);
}

// Each chunk holds a few of a thousand columns: those of a band of rows are kept.
TEST(Hdf5Program, chunksOfATableAreReadOnce) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
with h5py.File(sys.argv[1] + '/table.h5', 'w') as f:
  values = np.arange(4096 * 1024, dtype='u8') * 2654435761 % (1 << 24)
  f.create_dataset('x', data=values.astype('f4').reshape(4096, 1024), chunks=(4096, 16), compression='gzip', compression_opts=1)
)");
  const auto table = openTable(folder / "table.h5");
  const int child = childOfThis();
  const std::uint64_t before = readCounter(child, "rchar");
  const std::size_t columns[] = {0};
  table->start(columns, {});
  TableRow row;
  std::size_t rows = 0;
  for (; table->next(row); ++rows)
    ASSERT_EQ(row.values[7], (1024 * rows + 7) * 2654435761u % (1u << 24));
  EXPECT_EQ(rows, 4096u);
  EXPECT_LT(readCounter(child, "rchar") - before, 2 * fs::file_size(folder / "table.h5"));
}

TEST(Hdf5Program, manyEventsAreReadBack) {
  const TemporaryFolder folder;
  testing::writeSamples(folder / "a.palpate", 10);
  std::vector<Event> events;
  for (int i = 0; i < 50'000; ++i)
    events.push_back({i, i + 1, "note", {}, "event " + std::to_string(i), ""});
  saveRecording(openRecording(folder / "a.palpate"), events, folder / "a.h5");
  EXPECT_TRUE(readEvents(folder / "a.h5").events == events);
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
    EXPECT_EQ(profile.angles(i).values[2], static_cast<double>(i) * 7 + 2);
  }
}

// More than lie in memory at a time; a chunk is as long as a piece of them.
TEST(Hdf5Program, aTimeOfALongRecordingIsFoundWithOnePieceOfStamps) {
  const TemporaryFolder folder;
  makeRecording(folder / "a.h5");
  testing::runPython(folder, std::string(kChanged) + R"(
with changed('long.h5') as f:
  n = 40 << 16
  del f['joints/time_us']; del f['joints/angles']
  f.create_dataset('joints/time_us', data=np.arange(n) * 7 + 3, chunks=(1 << 16,), compression='gzip')
  f.create_dataset('joints/angles', data=np.zeros((n, 1), 'f4'), chunks=(1 << 16, 1), compression='gzip')
)");
  const Profile profile = openRecording(folder / "long.h5");
  EXPECT_EQ(profile.angleSampleAt(2), 0u);
  EXPECT_EQ(profile.angleSampleAt(3), 0u);
  EXPECT_EQ(profile.angleSampleAt(INT64_MAX), profile.numAngles() - 1);
  const int child = childOfThis();
  const std::uint64_t before = readCounter(child, "syscr");
  for (std::size_t i = 0; i < 40; ++i) {
    const std::size_t sample = (i * 17 % 40 << 16) + 65'535 * (i % 2);
    const auto timeUs = static_cast<std::int64_t>(sample) * 7 + 3;
    EXPECT_EQ(profile.angleSampleAt(timeUs), sample);
    EXPECT_EQ(profile.angleSampleAt(timeUs + 6), sample);
  }
  EXPECT_LE(readCounter(child, "syscr") - before, 2u * 40);
}

}  // namespace
}  // namespace palpate::hdf5_program_test
