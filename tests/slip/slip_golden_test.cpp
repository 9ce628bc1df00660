// Compares slip on two real recordings with the results of an independent program (its conventions
// and flaws: docs/notes/slip.md).
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/slip/slip_tracker.h"

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::slip_golden_test {
namespace {

struct Row {
  std::size_t frame = 0;
  std::size_t matrix = 0;
  std::map<std::string, double> values;
  double at(const char* name) const { return values.at(name); }
};

std::map<std::string, std::vector<Row>> goldenRows(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  // Lines end in CR LF.
  const auto nextLine = [&] {
    const bool more = static_cast<bool>(std::getline(in, line));
    if (more && !line.empty() && line.back() == '\r') line.pop_back();
    return more;
  };
  nextLine();
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::map<std::string, std::vector<Row>> rows;
  while (nextLine()) {
    std::istringstream cells(line);
    std::string file;
    std::getline(cells, file, ',');
    Row row;
    std::size_t i = 1;
    for (std::string cell; std::getline(cells, cell, ','); ++i)
      // "-nan" is the roundness of a border without length, which is 0 here.
      row.values[names.at(i)] = cell == "-nan" ? 0.0 : parseDouble(cell).value();
    row.frame = static_cast<std::size_t>(row.at("frame"));
    row.matrix = static_cast<std::size_t>(row.at("matrix"));
    rows[file].push_back(row);
  }
  return rows;
}

TEST(SlipGolden, AgreesOnEveryRow) {
  const auto golden = testing::goldenFolder();
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(golden);
  PALPATE_NEED(recordings);
  std::size_t rowsSeen = 0;
  std::size_t stepsSeen = 0;
  std::size_t turnsSeen = 0;
  for (const auto& [file, rows] : goldenRows(*golden / "slip.csv")) {
    const Profile profile = readDsa(*recordings / file);
    SensorSlipTracker centroid(profile.layout());
    SlipTrackerOptions options;
    options.method = SlipMethod::kAlcazar;
    SensorSlipTracker alcazar(profile.layout(), options);
    std::vector<ContactOutline> outlines;
    std::vector<RotationTracker> rotations(profile.layout().numMatrices());
    // The reference of that program needs two taxels, its measurements more.
    RotationOptions two;
    two.minTaxels = 2;
    std::vector<RotationTracker> sinceReference(profile.layout().numMatrices(),
                                                RotationTracker(two));
    for (const MatrixLayout& matrix : profile.layout().matrices())
      outlines.emplace_back(matrix.rows, matrix.columns);
    std::vector<int> measurableInARow(profile.layout().numMatrices(), 0);

    auto row = rows.begin();
    TactileFrame frame;
    for (std::size_t n = 0; n < profile.numFrames() && row != rows.end(); ++n) {
      profile.readFrame(n, frame);
      const auto& motions = centroid.update(frame);
      const auto& halves = alcazar.update(frame);
      for (std::size_t m = 0; m < motions.size(); ++m) {
        const SlipMotion& motion = motions[m];
        measurableInARow[m] = motion.afterGap ? 0 : measurableInARow[m];
        measurableInARow[m] = motion.active >= 2 ? measurableInARow[m] + 1 : 0;
        const ConstMatrixMap matrix = std::as_const(frame).matrix(m);
        const ContactMoments moments = contactMoments(matrix);
        const double roundness = outlines[m].describeLikeStudy(matrix).roundness;
        const SlipRotation& rotation = rotations[m].update(moments, roundness);
        const SlipRotation& since = sinceReference[m].update(moments, roundness);
        if (row == rows.end() || row->frame != n || row->matrix != m) continue;
        SCOPED_TRACE(file + " frame " + std::to_string(n) + " matrix " + std::to_string(m));
        ++rowsSeen;
        EXPECT_EQ(motion.active, static_cast<int>(row->at("active")));
        // The columns belong to the rotation of that program; without a rotation they are stale.
        if (row->at("ok_rotation") > 0) {
          EXPECT_NEAR(motion.x, row->at("centroid_x"), 3e-6);
          EXPECT_NEAR(motion.y, row->at("centroid_y"), 3e-6);
        }
        EXPECT_EQ(motion.refValid, row->at("ok_translation") > 0);
        if (row->at("ok_translation") > 0) {
          EXPECT_NEAR(motion.refDx, row->at("slip_ref_x"), 5e-6);
          EXPECT_NEAR(motion.refDy, row->at("slip_ref_y"), 5e-6);
        }
        // The step of that program spans two frames and is twice as large as the one here. After an
        // interruption of contact it continues from the last frame before it; the tracker here does
        // not.
        if (measurableInARow[m] > 2) {
          ++stepsSeen;
          EXPECT_TRUE(halves[m].valid);
          EXPECT_NEAR(2.0 * halves[m].dx, row->at("slip_x"), 5e-6);
          EXPECT_NEAR(2.0 * halves[m].dy, row->at("slip_y"), 5e-6);
        }
        const bool turns = row->at("ok_rotation") > 0;
        EXPECT_EQ(rotation.reliable, turns);
        if (turns) {
          ++turnsSeen;
          EXPECT_NEAR(rotation.axis.lambda1, row->at("lambda1"), 1e-8 * (1 + row->at("lambda1")));
          EXPECT_NEAR(rotation.axis.lambda2, row->at("lambda2"), 1e-8 * (1 + row->at("lambda1")));
          EXPECT_NEAR(rotation.axis.studyEccentricity, row->at("eccentricity"), 1e-8);
          EXPECT_NEAR(rotation.axis.skewX, row->at("skew_x"), 1e-6);
          EXPECT_NEAR(rotation.axis.skewY, row->at("skew_y"), 1e-6);
          EXPECT_NEAR(roundness, row->at("compactness"), 1e-6);
          // 0 and 180 deg are the same axis.
          EXPECT_NEAR(std::remainder(rotation.axis.orientationDeg - row->at("orientation"), 180.0),
                      0.0,
                      1e-6);
          if (rotation.valid && row->at("slip_angle") != 0.0 &&
              std::abs(std::abs(row->at("slip_angle")) - 90.0) > 1e-6) {
            EXPECT_NEAR(rotation.rotationDeg, row->at("slip_angle"), 1e-5);
          }
          // A change by exactly 90 deg may go either way, which leaves a permanent difference of
          // half a turn.
          if (since.refValid) {
            EXPECT_NEAR(
                std::remainder(since.refRotationDeg - row->at("slip_angle_ref"), 180.0), 0.0, 1e-5);
          }
        }
        ++row;
      }
    }
    EXPECT_TRUE(row == rows.end()) << file;
  }
  EXPECT_EQ(rowsSeen, 2487U);
  EXPECT_GT(stepsSeen, 2000U);
  EXPECT_GT(turnsSeen, 2000U);
}

}  // namespace
}  // namespace palpate::slip_golden_test
