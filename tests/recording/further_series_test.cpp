// Series beside those of the hand in the forms of a file.
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_format.h"

#include "imports/import_samples.h"
#include "testing/testing.h"

namespace palpate::further_series_test {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const SeriesDescription kWrist{
    "wrist", "reference_force", {{"fx", "N"}, {"f\xC3\xBC, z", ""}}, "tcp:localhost:1"};
const SeriesDescription kImu{"imu", "", {{"acc", "m/s^2"}}, ""};
const SeriesDescription kSilent{"silent", "trigger", {{"on", ""}}, "nobody"};

// A pad of one taxel; a wrist with missing values and times of its own, some of them of its own
// clock; an IMU at another rate; a series that nothing came from.
Profile profileOf(std::vector<SeriesDescription> further = {kWrist, kImu, kSilent}) {
  HandDescription hand;
  hand.name = "pad";
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(hand);
  for (const SeriesDescription& each : further) builder.addSeries(each);
  for (int i = 0; i < 500; ++i) {
    const std::int64_t us = 1'000'000 + 1'000 * i;
    builder.addFrame(us, std::vector<float>{static_cast<float>(i % 7)});
    if (further.empty()) continue;
    builder.addSample(kHandSeries,
                      us + 3,
                      std::vector<double>{0.1 * i, i % 3 == 0 ? kNan : -i},
                      i % 4 == 0 ? std::nullopt : std::optional<std::int64_t>(17 * i - 40));
    if (further.size() > 1 && i % 5 == 0)
      builder.addSample(kHandSeries + 1, us + 7, std::vector<double>{9.81});
  }
  return builder.finish({});
}

void expectSameSeries(const Profile& a, const Profile& b) {
  ASSERT_EQ(a.series(), b.series());
  ASSERT_EQ(a.numFrames(), b.numFrames());
  for (std::size_t s = 0; s < a.series().size(); ++s) {
    ASSERT_EQ(a.numSamples(s), b.numSamples(s)) << s;
    for (std::size_t i = 0; i < a.numSamples(s); ++i) {
      const Sample x = a.sample(s, i);
      const Sample y = b.sample(s, i);
      ASSERT_EQ(x.hostUs, y.hostUs) << i;
      ASSERT_EQ(x.deviceUs, y.deviceUs) << i;
      ASSERT_EQ(x.series, y.series);
      ASSERT_EQ(x.values.size(), y.values.size());
      for (std::size_t k = 0; k < x.values.size(); ++k)
        ASSERT_TRUE(x.values[k] == y.values[k] ||
                    (std::isnan(x.values[k]) && std::isnan(y.values[k])))
            << i;
    }
  }
}

TEST(FurtherSeries, comeBackFromEveryFormThatIsReadBack) {
  const TemporaryFolder folder;
  const Profile profile = profileOf();
  for (const char* name : {"a.palpate", "a.h5", "a.mcap"}) {
    SCOPED_TRACE(name);
    saveRecording(profile, {}, folder / name);
    expectSameSeries(profile, openRecording(folder / name));
    EXPECT_EQ(verifyRecording(folder / name).state, VerifyReport::State::kSound);
  }
}

TEST(FurtherSeries, csvHasAFileForEach) {
  const TemporaryFolder folder;
  const SaveReport saved = saveRecording(profileOf(), {}, folder / "a.csv");
  EXPECT_EQ(saved.beside,
            (std::vector<fs::path>{folder / "a.csv.wrist.csv", folder / "a.csv.imu.csv"}));
  const std::string wrist = testing::readFile(folder / "a.csv.wrist.csv");
  EXPECT_TRUE(
      wrist.starts_with("sample,time_ms,fx_N,\"f\xC3\xBC, z\",time_us,device_time_us\n"
                        "0,1000,0,,1000003,\n"
                        "1,1001,0.1,-1,1001003,-23\n"))
      << wrist.substr(0, 200);
  EXPECT_TRUE(testing::readFile(folder / "a.csv.imu.csv")
                  .starts_with("sample,time_ms,acc_m/s^2,time_us\n0,1000,9.81,1000007\n"));
  EXPECT_FALSE(fs::exists(folder / "a.csv.silent.csv"));
}

TEST(FurtherSeries, otherProgramsReadArraysAndWhatTheyAre) {
  const TemporaryFolder folder;
  const Profile profile = profileOf();
  for (const char* name : {"a.npz", "a.mat", "a.h5"}) saveRecording(profile, {}, folder / name);
  testing::runPython(folder, R"(
import json, sys, numpy as np, scipy.io, h5py
folder = sys.argv[1] + '/'
i = np.arange(500)
values = np.stack([0.1 * i, np.where(i % 3 == 0, np.nan, -i)], 1)
device = np.where(i % 4 == 0, -2**63, 17 * i - 40)
a = np.load(folder + 'a.npz', allow_pickle=False)
assert np.array_equal(a['wrist'], values, equal_nan=True)
assert np.array_equal(a['wrist_time_us'], 1000003 + 1000 * i)
assert np.array_equal(a['wrist_device_time_us'], device)
assert a['imu'].shape == (100, 1) and 'imu_device_time_us' not in a and a['silent'].shape == (0, 1)
series = json.loads(str(a['meta']))['series']
assert [s['name'] for s in series] == ['wrist', 'imu', 'silent']
assert series[0]['role'] == 'reference_force' and series[0]['columns'][0] == {'name': 'fx', 'unit': 'N'}
m = scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)['series']
assert np.array_equal(m['wrist']['values'].T, values, equal_nan=True)
assert [str(unit) if len(unit) else '' for unit in m['wrist']['units']] == ['N', '']
assert np.array_equal(m['wrist']['device_time_us'], device) and 'device_time_us' not in m['imu']
f = h5py.File(folder + 'a.h5')
assert f.attrs['format_version'] == 3 and f['series'].attrs['names'] == 'wrist,imu,silent'
assert np.array_equal(f['series/wrist/values'][:], values, equal_nan=True)
assert list(f['series/wrist/unit'].asstr()[:]) == ['N', '']
assert np.array_equal(f['series/wrist/device_time_us'][:], device)
)");
}

TEST(FurtherSeries, aRecordingWithoutThemKeepsItsVersions) {
  const TemporaryFolder folder;
  for (const char* name : {"a.h5", "a.mcap", "a.npz"})
    saveRecording(profileOf({}), {}, folder / name);
  testing::runPython(folder, R"(
import json, sys, numpy as np, h5py
folder = sys.argv[1] + '/'
assert h5py.File(folder + 'a.h5').attrs['format_version'] == 1 and 'series' not in h5py.File(folder + 'a.h5')
assert 'series' not in json.loads(str(np.load(folder + 'a.npz')['meta']))
)");
  expectSameSeries(profileOf({}), openRecording(folder / "a.mcap"));
}

TEST(FurtherSeries, namesThatAFormCantHoldAreRefusedWithTheRemedy) {
  const TemporaryFolder folder;
  const auto expectRefused = [&](const std::string& name, const char* file) {
    SeriesDescription series = kWrist;
    series.name = name;
    const std::string error =
        testing::errorOf([&] { saveRecording(profileOf({series}), {}, folder / file); });
    EXPECT_NE(error.find("can't hold the series '" + name + "'"), std::string::npos) << error;
    EXPECT_NE(error.find("write .h5 or .palpate"), std::string::npos) << error;
  };
  for (const char* name : {"m0", "meta", "time_us", "angle_time_ms"}) expectRefused(name, "a.npz");
  expectRefused(std::string(32, 'a'), "a.mat");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Every byte that is changed costs the chunks that it is in, and never gives a wrong value.
TEST(FurtherSeries, aDamagedMcapFileLosesNothingElse) {
  const TemporaryFolder folder;
  const Profile profile = profileOf();
  SaveExtras extras;
  extras.mcap.chunkBytes = 4096;
  extras.mcap.compression = McapCompression::kNone;
  saveRecording(profile, {}, folder / "a.mcap", Overwrite::kRefuse, {}, extras);
  const std::string whole = testing::readFile(folder / "a.mcap");
  std::size_t salvaged = 0;
  for (std::size_t at = 100; at < whole.size(); at += whole.size() / 60) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x41);
    testing::writeFile(folder / "b.mcap", bytes);
    try {
      const Profile read = recoverMcap(folder / "b.mcap").profile;
      for (std::size_t s = kHandSeries; s < read.series().size(); ++s)
        for (std::size_t i = 0; i < read.numSamples(s); ++i) {
          const std::size_t k = *profile.sampleAt(s, read.sampleTimeUs(s, i));
          ASSERT_EQ(profile.sampleTimeUs(s, k), read.sampleTimeUs(s, i));
          ASSERT_EQ(profile.sample(s, k).deviceUs, read.sample(s, i).deviceUs);
          ASSERT_EQ(std::bit_cast<std::uint64_t>(profile.sample(s, k).values[0]),
                    std::bit_cast<std::uint64_t>(read.sample(s, i).values[0]));
        }
      if (read.series().size() > kHandSeries && read.numSamples(kHandSeries) > 300) ++salvaged;
    } catch (const Error&) {
      // Its description is damaged.
    }
  }
  EXPECT_GT(salvaged, 20u);
}

TEST(FurtherSeries, anHdf5FileWithoutWhatItNamesIsOneLine) {
  const TemporaryFolder folder;
  saveRecording(profileOf(), {}, folder / "a.h5");
  testing::runPython(folder, R"(
import hashlib, shutil, sys, h5py
folder = sys.argv[1] + '/'
def change(name, how):
  path = folder + name
  shutil.copy(folder + 'a.h5', path)
  with h5py.File(path, 'r+') as f: how(f)
  with open(path, 'r+b') as f:
    rest = f.read()[512:]
    f.seek(0)
    f.write((b'Palpate recording in HDF5\nSHA-256 of the bytes from 512 on:\n' +
             hashlib.sha256(rest).hexdigest().encode() + b'\n').ljust(512, b'\0'))
def replace(f, name, value):
  del f[name]
  f[name] = value
change('group.h5', lambda f: f.__delitem__('series/imu'))
change('names.h5', lambda f: f['series'].attrs.__setitem__('names', 'wrist,wrist'))
change('width.h5', lambda f: replace(f, 'series/wrist/column', ['one']))
change('device.h5', lambda f: replace(f, 'series/wrist/device_time_us', [1, 2]))
change('infinite.h5', lambda f: f['series/wrist/values'].__setitem__((7, 0), float('inf')))
)");
  const auto errorOf = [&](const char* name) {
    return testing::errorOf([&] { openRecording(folder / name); });
  };
  EXPECT_NE(errorOf("group.h5").find("series/imu"), std::string::npos) << errorOf("group.h5");
  EXPECT_NE(errorOf("names.h5").find("two series have the name wrist"), std::string::npos)
      << errorOf("names.h5");
  EXPECT_NE(errorOf("width.h5").find("a different number of columns"), std::string::npos)
      << errorOf("width.h5");
  EXPECT_NE(errorOf("device.h5").find("device_time_us"), std::string::npos) << errorOf("device.h5");
  const Profile infinite = openRecording(folder / "infinite.h5");
  EXPECT_NO_THROW(infinite.sample(kHandSeries, 6));
  EXPECT_THROW(infinite.sample(kHandSeries, 7), FormatError);
}

}  // namespace
}  // namespace palpate::further_series_test
