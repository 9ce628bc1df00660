// End to end with the real programs: what the emulated hand's truth says is what arrives over the
// ports, is recorded, and is exported.
#include <csignal>
#include <map>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "testing/background_program.h"
#include "testing/sdh2.h"

namespace palpate::truth_to_export_test {
namespace {
using testing::palpate;

struct TruthRow {
  bool contact = false;
  double forceN = 0.0;
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();
};

// Scans by host time [ms], a row per matrix. Of scans in one millisecond (a busy machine's hand
// catches up) the last counts.
std::map<std::int64_t, std::vector<TruthRow>> readTruth(const std::string& path) {
  std::map<std::int64_t, std::vector<TruthRow>> truth;
  std::istringstream in(testing::readFile(path));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    if (fields.size() != 10) continue;  // the last line, cut where the program was stopped
    TruthRow row;
    row.contact = fields[2] == "1";
    if (row.contact) {
      row.forceN = parseDouble(fields[3]).value();
      for (int i = 0; i < 3; ++i)
        row.centreMm[i] = parseDouble(fields[4 + static_cast<std::size_t>(i)]).value();
    }
    std::vector<TruthRow>& scan = truth[parseInteger(fields[0]).value()];
    const auto matrix = static_cast<std::size_t>(parseInteger(fields[1]).value());
    if (scan.size() <= matrix) scan.resize(matrix + 1);
    scan[matrix] = row;
  }
  return truth;
}

TEST(TruthToExport, WhatTheHandFeltIsWhatIsExported) {
  const testing::TemporaryFolder folder;
  testing::BackgroundProgram hand(PALPATE_PROGRAM,
                                  {"emulate",
                                   "--dsa",
                                   folder / "dsa",
                                   "--sdh",
                                   folder / "sdh",
                                   "--scene",
                                   "ball",
                                   "--truth",
                                   folder / "truth.csv"});
  ASSERT_TRUE(hand.awaitLine("dsa=")) << hand.err();
  const auto recorded = palpate({"record",
                                 "--dsa",
                                 folder / "dsa",
                                 "--sdh",
                                 folder / "sdh",
                                 "-o",
                                 folder / "r.palpate",
                                 "--duration",
                                 "8"});
  ASSERT_EQ(recorded.exitCode, 0) << recorded.err;
  hand.signal(SIGTERM);
  ASSERT_EQ(hand.wait(), 0) << hand.err();
  for (const char* out : {"r.dsa", "r.npz"})
    ASSERT_EQ(palpate({"convert", folder / "r.palpate", folder / out}).exitCode, 0) << out;

  const auto truth = readTruth(folder / "truth.csv");
  const Profile profile = openRecording(folder / "r.palpate");
  const Profile exported = openRecording(folder / "r.dsa");
  ASSERT_GT(profile.numFrames(), 240u);
  ASSERT_EQ(exported.numFrames(), profile.numFrames());
  EXPECT_EQ(timingOf(profile).gaps.size(), 0u);

  const HandGeometry geometry(sdh2Geometry());
  std::size_t held = 0, untouched = 0;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    ASSERT_EQ(exported.frame(i).values, frame.values) << i;
    // A frame is scanned before it arrives: a scan period and its time on the line at most.
    auto row = truth.upper_bound(frame.hostUs / 1000);
    ASSERT_NE(row, truth.begin());
    --row;
    EXPECT_LT(frame.hostUs / 1000 - row->first, 80) << "frame " << i;
    ASSERT_EQ(row->second.size(), 6u);
    const HandPose pose = geometry.pose(profile.anglesAtFrame(i)->values);
    for (std::size_t m = 0; m < 6; ++m) {
      const ConstMatrixMap values = frame.matrix(m);
      const TruthRow& is = row->second[m];
      if (!is.contact && values.maxCoeff() == 0.0F) {
        ++untouched;
        continue;
      }
      if (is.forceN < 10.0) continue;  // touching or letting go: the rubber lags behind
      Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();
      double sum = 0.0;
      for (int y = 0; y < values.rows(); ++y)
        for (int x = 0; x < values.cols(); ++x) {
          centreMm += pose.positionMm(m, y, x) * static_cast<double>(values(y, x));
          sum += static_cast<double>(values(y, x));
        }
      if (sum < 2000.0) continue;
      ++held;
      EXPECT_LT((centreMm / sum - is.centreMm).norm(), 2.0) << "frame " << i << ", matrix " << m;
    }
  }
  EXPECT_GT(held, 100u) << "three fingertips hold the ball for seconds";
  EXPECT_GT(untouched, 500u);
}

}  // namespace
}  // namespace palpate::truth_to_export_test
