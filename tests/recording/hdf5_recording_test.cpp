#include "palpate/recording/hdf5_recording.h"

#include <random>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
#include "recording/exchange_samples.h"
#include "recording/palpate_samples.h"
#include "recording/series_samples.h"
#include "testing/testing.h"

namespace palpate::hdf5_recording_test {
namespace {

namespace fs = std::filesystem;
using testing::expectSame;
using testing::openingError;
using testing::randomProfile;
using testing::TemporaryFolder;

const Event kOddEvent{5, 9, "note", 1, std::string("a\0b\xC0 \xC3\xBC", 7), "{\"k\":1}"};

void write(const Profile& profile, const fs::path& path, const Hdf5WriteOptions& options = {}) {
  ExportExtras extras;
  extras.provenance = {"palpate 9", "a.dsa", "00ff", "median:size=3", "", "pads"};
  extras.series.push_back(testing::rampSeries(profile.numFrames(), 1000));
  const std::vector<Event> events{kOddEvent, {7, 7, "mark", {}, "", ""}};
  writeHdf5({profile, events, {{"operator", "A. B."}, {"frames", "99"}}, extras},
            path,
            Overwrite::kReplace,
            {},
            options);
}

void writeUsual(const Profile& profile, const fs::path& path) { write(profile, path); }

TEST(Hdf5Recording, randomRecordingsComeBackBitByBit) {
  const TemporaryFolder folder;
  for (const bool floats : {false, true}) {
    for (const std::size_t frames : {0, 1, 1023, 1024, 2600}) {
      const Profile profile = randomProfile(static_cast<std::uint32_t>(frames), floats, frames);
      write(profile, folder / "a.h5");
      const Recording read = readHdf5(folder / "a.h5");
      expectSame(profile, read.profile);
      EXPECT_EQ(read.events, (std::vector<Event>{kOddEvent, {7, 7, "mark", {}, "", ""}}));
      EXPECT_EQ(read.meta.at("operator"), "A. B.");
      EXPECT_FALSE(read.meta.contains("frames"));  // of the file of the source
      EXPECT_EQ(read.provenance.filters, "median:size=3");
      EXPECT_EQ(read.provenance.sourceSha256, "00ff");
    }
  }
}

// Also by way of a native recording: what was said of the recording stays as well.
TEST(Hdf5Recording, aNativeRecordingComesBackAsItWas) {
  testing::expectNativeComesBackFrom("a.h5");
}

TEST(Hdf5Recording, realRecordingsComeBackBitByBit) {
  testing::expectRealRecordingsComeBack("a.h5", [](const Profile& profile, const fs::path& path) {
    writeHdf5({profile, {}, {}, ExportExtras{}}, path, Overwrite::kReplace);
  });
}

TEST(Hdf5Recording, theFileDoesNotDependOnTheNumberOfThreads) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(3, true, 2600);
  write(profile, folder / "1.h5", {.threads = 1});
  write(profile, folder / "4.h5", {.threads = 4});
  EXPECT_TRUE(testing::readFile(folder / "1.h5") == testing::readFile(folder / "4.h5"));
}

TEST(Hdf5Recording, severalThreadsReadAtOnce) {
  testing::expectThreadsReadAtOnce("a.h5", writeUsual);
}

TEST(Hdf5Recording, h5pyReadsArraysScalesAndUnits) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(8, false, 2000);
  write(profile, folder / "a.h5");
  std::string truth;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 15; ++k)
      sum += static_cast<double>(profile.frame(i).values[k]) * static_cast<double>(k + 1);
    truth += std::to_string(profile.frameTimeUs(i)) + " " + std::to_string(sum) + "\n";
  }
  testing::writeFile(folder / "truth", truth);
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
truth = np.loadtxt(folder + 'truth')
with h5py.File(folder + 'a.h5') as f:
  m = f['tactile/m0']
  assert m.shape == (2000, 3, 5) and m.dtype == np.uint16 and m.compression == 'gzip' and m.shuffle
  assert m.attrs['units'] == 'counts' and m.attrs['pitch_mm'] == 1.25
  assert [d.keys()[0] for d in m.dims] == ['time', 'y', 'x']
  assert np.array_equal(m.dims[0][0][:], truth[:, 0].astype(np.int64))
  assert np.allclose(m.dims[1][0][:], [0, 1.25, 2.5])
  assert np.array_equal(m[:].reshape(2000, 15) @ np.arange(1, 16), truth[:, 1])
  assert f['joints/angles'].shape == (1000, 4) and f['joints/angles'][3, 1] == -3.0
  assert f['temperatures/values'].attrs['units'] == 'degC'
  assert list(f['signals/column'].asstr()[:]) == ['m0/mean', 'm0/active']
  assert list(f['signals/values'].attrs['column_units']) == ['counts', 'taxels']
  rows = f['signals/values'][:]
  assert np.array_equal(rows[:, 0], 0.5 * np.arange(2000)) and np.array_equal(rows[:, 1], -np.arange(2000.))
  assert f['signals/time_us'][1999] == 2999
  assert f['events/kind'].asstr()[1] == 'mark' and f['events/matrix'][0] == 1 and f['events/matrix'][1] < 0
  assert f.attrs['source_file'] == 'a.dsa' and f.attrs['filters'] == 'median:size=3'
)");
}

TEST(Hdf5Recording, foreignDamagedAndNewerFilesAreOneLineEach) {
  const TemporaryFolder folder;
  write(randomProfile(1, false, 1500), folder / "a.h5");
  testing::runPython(folder, R"(
import hashlib, sys, shutil, h5py
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
with h5py.File(folder + 'foreign.h5', 'w') as f: f['x'] = [1, 2, 3]
shutil.copy(folder + 'a.h5', folder + 'touched.h5')
with h5py.File(folder + 'touched.h5', 'r+') as f: f['tactile'].attrs['note'] = 'mine'
with changed('restamped.h5') as f: f['tactile'].attrs['note'] = 'mine'
with changed('newer.h5') as f: f.attrs['format_version'] = 5
with changed('no_joints.h5') as f: del f['joints']
with changed('no_mask.h5') as f: del f['tactile/m1_static_mask']
with changed('shorter.h5') as f: f['tactile/m1'].resize(1400, axis=0)
with changed('lzf.h5') as f:
  values = f['tactile/m0'][:]; pitch = f['tactile/m0'].attrs['pitch_mm']; del f['tactile/m0']
  f.create_dataset('tactile/m0', data=values, compression='lzf', chunks=(100, 3, 5)).attrs['pitch_mm'] = pitch
with changed('stamps.h5') as f: f['tactile/time_us'][7] = 3
with changed('value.h5') as f: f['tactile/m0'][700, 0, 0] = 5000
with changed('text.h5') as f:
  del f['tactile/m0']; f['tactile/m0'] = 'hello'
)");
  const auto expectError = [&](const char* name, const std::string& words) {
    testing::expectOpeningError(folder / name, words);
  };
  expectError("foreign.h5", "palpate import");
  expectError("touched.h5", "changed by another program: its checksum doesn't fit");
  EXPECT_EQ(openingError(folder / "restamped.h5"), "");
  expectError("newer.h5", "newer Palpate");
  expectError("no_joints.h5", "the group 'joints' is missing");
  expectError("no_mask.h5", "\"tactile/m1_static_mask\" is missing");
  expectError("shorter.h5", "instead of 1500 x 1 x 2");
  expectError("lzf.h5", "filter that is not available (32000");
  expectError("stamps.h5", "does not ascend at sample 7");
  expectError("text.h5", "\"tactile/m0\" must be frames x rows x columns");
  const Profile profile = openRecording(folder / "value.h5");
  EXPECT_THROW(profile.frame(700), FormatError);
  EXPECT_EQ(verifyRecording(folder / "value.h5").state, VerifyReport::State::kUnreadable);
  EXPECT_EQ(verifyRecording(folder / "a.h5").state, VerifyReport::State::kSound);
  testing::writeFile(folder / "hello.h5", "hello");
  expectError("hello.h5", "can't be opened as HDF5");
}

TEST(Hdf5Recording, aFileThatIsCutOffAnywhereIsOneLine) {
  const TemporaryFolder folder;
  write(randomProfile(1, false, 1500), folder / "a.h5");
  const std::string whole = testing::readFile(folder / "a.h5");
  for (std::size_t length = 8; length < whole.size(); length += whole.size() / 40) {
    testing::writeFile(folder / "cut.h5", whole.substr(0, length));
    EXPECT_NE(openingError(folder / "cut.h5"), "") << length;
  }
}

// The HDF5 library itself ends the process for some of these files.
TEST(Hdf5Recording, changedBytesAnywhereAreOneLine) {
  const TemporaryFolder folder;
  write(randomProfile(1, true, 300), folder / "a.h5");
  const std::string whole = testing::readFile(folder / "a.h5");
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    std::string bad = whole;
    for (int i = 0; i < 8; ++i) bad[random() % bad.size()] ^= static_cast<char>(1 + random() % 255);
    testing::writeFile(folder / "bad.h5", bad);
    EXPECT_NE(openingError(folder / "bad.h5"), "") << round;
  }
}

// Events and meta are taken from the file that is open already; a file that took its place is not.
TEST(Hdf5Recording, aFileThatTookThePlaceOfAnOpenOneIsReadAnew) {
  const TemporaryFolder folder;
  const Profile first = randomProfile(1, false, 20);
  const Profile second = randomProfile(2, false, 30);
  write(first, folder / "a.h5");
  const Profile opened = openRecording(folder / "a.h5");
  write(second, folder / "a.h5");
  expectSame(openRecording(folder / "a.h5"), second);
  expectSame(opened, first);
}

TEST(Hdf5Recording, aFullDiskIsAnErrorAndLeavesNothing) {
  testing::expectFullDiskLeavesNothing("a.h5", writeUsual);
}

TEST(Hdf5Recording, aFileThatAnotherProgramWritesIsNotReplaced) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 10);
  write(profile, folder / "a.h5");
  const FileDescriptor other(::open((folder / "a.h5").c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_EQ(::flock(other.get(), LOCK_EX | LOCK_NB), 0);
  EXPECT_THROW(write(profile, folder / "a.h5"), FileError);
  EXPECT_NE(openingError(folder / "a.h5").find("is being written by another program"),
            std::string::npos);
  ::flock(other.get(), LOCK_UN);
  write(profile, folder / "a.h5");
}

TEST(Hdf5Recording, cancellingAndASeriesThatFailsLeaveNothing) {
  const auto fails = [](std::size_t) -> testing::SeriesRow {
    throw FormatError("a.dsa", "damaged");
  };
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 5000);
  ExportExtras extras;
  extras.series.push_back(testing::seriesOf(5000, fails));
  EXPECT_THROW(writeHdf5({profile, {}, {}, extras}, folder / "a.h5"), FormatError);
  EXPECT_THROW(writeHdf5({profile, {}, {}, ExportExtras{}},
                         folder / "a.h5",
                         Overwrite::kRefuse,
                         [](double) { return false; }),
               Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Hdf5Recording, notesCantBeAddedAndNothingIsRecovered) {
  const TemporaryFolder folder;
  write(randomProfile(1, false, 10), folder / "a.h5");
  EXPECT_THROW(recoverRecording(folder / "a.h5", folder / "b.palpate"), FileError);
  EXPECT_FALSE(fs::exists(folder / "b.palpate"));
}

}  // namespace
}  // namespace palpate::hdf5_recording_test
