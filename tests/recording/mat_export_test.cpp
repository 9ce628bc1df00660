#include "palpate/recording/mat_export.h"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
#include "recording/palpate_samples.h"
#include "recording/series_samples.h"
#include "testing/testing.h"

namespace palpate::mat_export_test {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

// Frames 0, 1, .. of one pad of 2 x 3 taxels: taxel k of frame i has 10 i + k counts.
Profile pads(std::size_t frames, float offset = 0.0F) {
  ProfileBuilder builder(std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(2, 3, 2.5)}));
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<float> values;
    for (std::size_t k = 0; k < 6; ++k) values.push_back(static_cast<float>(10 * i + k) + offset);
    builder.addFrame(1'000'000 + static_cast<std::int64_t>(i) * 10, values);
    builder.addAngles(1'000'000 + static_cast<std::int64_t>(i) * 10,
                      std::vector<double>{static_cast<double>(i), 0.25});
  }
  return builder.finish({});
}

void write(const Profile& profile, const fs::path& path) {
  ExportExtras extras;
  extras.provenance = {"palpate 9", "a.dsa", "00ff", "", "", "pad"};
  extras.series.push_back(testing::seriesOf(4, [](std::size_t i) {
    const auto row = static_cast<double>(i);
    return testing::SeriesRow{100 + static_cast<std::int64_t>(i), 1.5 * row, -row};
  }));
  const std::vector<Event> events{{5, 9, "note", 0, "\xC3\xBC \xF0\x9F\x98\x80", ""}};
  writeMat({profile, events, {{"operator", "A. B."}}, extras}, path);
}

TEST(MatExport, scipyReadsStructuresOfArraysAndTexts) {
  const TemporaryFolder folder;
  write(pads(300), folder / "a.mat");
  write(pads(3, 0.5F), folder / "f.mat");
  testing::runPython(folder, R"(
import sys, numpy as np, scipy.io
folder = sys.argv[1] + '/'
a = scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)
m = a['tactile']['m0']
assert m.shape == (3, 2, 300) and m.dtype == np.uint16, (m.shape, m.dtype)
expected = (10 * np.arange(300)[:, None] + np.arange(6)).reshape(300, 2, 3)
assert np.array_equal(m.transpose(2, 1, 0), expected)
assert a['tactile']['units'] == 'counts' and a['tactile']['m0_name'] == 'matrix 0'
assert np.array_equal(a['tactile']['time_us'], 1000000 + 10 * np.arange(300))
assert np.allclose(a['tactile']['m0_x'], [0, 2.5, 5])
assert a['joints']['angles'].shape == (2, 300) and a['joints']['angles'][0, 7] == 7.0
assert np.array_equal(a['signals']['values'], [[0, 1.5, 3, 4.5], [0, -1, -2, -3]])
assert list(a['signals']['column']) == ['m0/mean', 'm0/active'] and a['signals']['units'][1] == 'taxels'
assert np.array_equal(a['signals']['time_us'], [100, 101, 102, 103])
raw = scipy.io.loadmat(folder + 'a.mat')
assert raw['events']['text'][0, 0][0, 0][0] == '\u00fc \ufffd', raw['events']['text'][0, 0][0, 0]
assert a['provenance']['source_file'] == 'a.dsa' and a['provenance']['program'] == 'palpate 9'
assert 'A. B.' in list(a['meta']['value'])
f = scipy.io.loadmat(folder + 'f.mat', simplify_cells=True)['tactile']
assert f['m0'].dtype == np.float32 and f['m0'][2, 1, 1] == 15.5 and f['m0_active'].all()
)");
}

// A recording of which only the number of frames is known.
class Endless final : public ProfileStorage {
 public:
  std::size_t numFrames() const override { return 400'000'000; }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    return static_cast<std::int64_t>(frame);
  }
  void readFrame(std::size_t, TactileFrame&) const override { throw Error("was read"); }
  std::size_t numSamples(std::size_t) const override { return 0; }
  std::int64_t sampleTimeUs(std::size_t, std::size_t) const override { return 0; }
  Sample sample(std::size_t, std::size_t) const override { return {}; }
};

TEST(MatExport, moreThanTheFormatHoldsIsRefusedBeforeAFrameIsRead) {
  const TemporaryFolder folder;
  const Profile profile({}, pads(1).hand(), std::make_shared<Endless>());
  try {
    write(profile, folder / "a.mat");
    FAIL();
  } catch (const FileError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("at most 2 GB per variable, 'tactile' would have"), std::string::npos)
        << line;
    EXPECT_NE(line.find("write .h5"), std::string::npos) << line;
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(MatExport, aFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const Profile profile = pads(400);
  for (const rlim_t bytes : {0, 130, 1500}) {
    const auto full = [&] {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{bytes, bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      try {
        write(profile, folder / "a.mat");
      } catch (const FileError&) {
        ::_exit(7);
      }
      ::_exit(0);
    };
    EXPECT_EXIT(full(), ::testing::ExitedWithCode(7), "") << bytes;
    EXPECT_TRUE(fs::is_empty(folder.path())) << bytes;
  }
}

TEST(MatExport, isNotReadBack) {
  const TemporaryFolder folder;
  write(pads(3), folder / "a.mat");
  EXPECT_THROW(openRecording(folder / "a.mat"), FormatError);
}

}  // namespace
}  // namespace palpate::mat_export_test
