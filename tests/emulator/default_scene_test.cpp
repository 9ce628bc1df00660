// The default scenes of the hands of data/hands and of hands without files: every matrix is
// touched, where the object is, and the values fit the description.
#include "palpate/emulator/default_scene.h"

#include <memory>

#include <gtest/gtest.h>

#include "palpate/emulator/emulated_geometry.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

#include "device/stream_hands.h"

namespace palpate::testing::default_scene_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::unique_ptr<PhysicalHand> emulated(const HandDescription& hand) {
  PhysicalHandOptions options;
  options.hand = hand;
  return std::make_unique<PhysicalHand>(defaultScene(hand), options);
}

std::vector<float> valuesAt(PhysicalHand& hand, double timeS) {
  hand.advanceTo(timeS);
  std::vector<float> values(hand.hand().layout->numCells());
  hand.measure(values);
  return values;
}

// Centre of the values of a matrix: column and row.
Vector2d centroid(const HandDescription& hand,
                  std::size_t matrix,
                  const std::vector<float>& values) {
  const MatrixLayout& layout = hand.layout->matrix(matrix);
  Vector2d sum = Vector2d::Zero();
  double weight = 0.0;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const double value =
          values[hand.layout->offset(matrix) + static_cast<std::size_t>(y * layout.columns + x)];
      sum += value * Vector2d(x, y);
      weight += value;
    }
  return sum / weight;
}

float largest(const HandDescription& hand, std::size_t matrix, const std::vector<float>& values) {
  const std::size_t first = hand.layout->offset(matrix);
  float most = 0.0F;
  for (std::size_t i = 0; i < hand.layout->matrix(matrix).numCells(); ++i)
    most = std::max(most, values[first + i]);
  return most;
}

TEST(DefaultScene, EveryMatrixOfEveryHandIsTouchedWithinItsScale) {
  for (const BuiltInHand& each : builtInHands()) {
    SCOPED_TRACE(each.key);
    const HandDescription& hand = *each.hand;
    const auto model = emulated(hand);
    const bool grasps = each.key != "flat_pad_16x16" && each.key != "sole";
    const double cycleS =
        grasps ? kGraspCycleS : kPadCycleS * static_cast<double>(hand.layout->numMatrices());
    std::vector<float> peaks(hand.layout->numMatrices());
    for (double s = 0.0; s < cycleS; s += 0.1) {
      const std::vector<float> values = valuesAt(*model, s);
      for (std::size_t m = 0; m < peaks.size(); ++m)
        peaks[m] = std::max(peaks[m], largest(hand, m, values));
      std::size_t place = 0;
      for (std::size_t m = 0; m < peaks.size(); ++m)
        for (const std::uint8_t exists : hand.layout->matrix(m).staticMask) {
          if (exists == 0) {
            EXPECT_EQ(values[place], 0.0F);
          }
          ++place;
        }
    }
    for (std::size_t m = 0; m < peaks.size(); ++m) {
      EXPECT_GT(peaks[m], 0.1F * hand.maximumCounts) << hand.matrices[m].name;
      EXPECT_LE(peaks[m], hand.maximumCounts) << hand.matrices[m].name;
    }
  }
}

TEST(DefaultScene, AnUntouchedHandReadsNothing) {
  for (const BuiltInHand& each : builtInHands()) {
    if (each.key == "sdh2") continue;  // its controller has a threshold of its own
    const auto model = emulated(*each.hand);
    std::size_t active = 0, all = 0;
    for (int i = 0; i < 20; ++i)
      for (const float value : valuesAt(*model, 0.02 * i)) {
        active += value > 0.0F ? 1 : 0;
        ++all;
      }
    EXPECT_LT(static_cast<double>(active), 0.002 * static_cast<double>(all)) << each.key;
  }
}

// The surfaces of the flat pad and the sole are the plane z = 0: taxel (row, column) is at the
// origin of hand.json plus the pitch to +x per column and to -y per row.
TEST(DefaultScene, TheContactOfAPadIsWhereTheSphereIs) {
  struct Plane {
    const char* key;
    double leftMm, topMm, pitchMm;
  };
  for (const Plane& plane :
       {Plane{"flat_pad_16x16", -37.5, 37.5, 5.0}, {"sole", -44.0, 124.0, 8.0}}) {
    SCOPED_TRACE(plane.key);
    const HandDescription& hand = builtInHand(plane.key);
    const Scene scene = defaultScene(hand);
    ASSERT_EQ(scene.objects.size(), 1u);
    const Vector3d atMm = scene.objects[0].positionMm;
    const auto model = emulated(hand);
    const auto expectAt = [&](double timeS, double slideMm) {
      const Vector2d expected((atMm.x() + slideMm - plane.leftMm) / plane.pitchMm,
                              (plane.topMm - atMm.y()) / plane.pitchMm);
      EXPECT_LT((centroid(hand, 0, valuesAt(*model, timeS)) - expected).norm(), 0.25) << timeS;
    };
    const double slideMm = 0.2 * hand.layout->matrix(0).columns * plane.pitchMm;
    expectAt(1.8, 0.0);
    expectAt(4.3, slideMm);
    expectAt(6.9, 0.0);
    // Sliding is slip, rolling back is none (but for the indentation, which shortens the lever).
    EXPECT_NEAR(model->truth()[0].slipXTaxels * plane.pitchMm, slideMm, 0.03 * slideMm);
    // Rolled back by the slide: the angle is the way over the radius.
    const double radiusMm = scene.objects[0].shape.sizeMm.x() / 2.0;
    const auto& roll = [&]() -> const TurnObject& {
      for (const ScriptStep& step : scene.script)
        if (const auto* turn = std::get_if<TurnObject>(&step.action)) return *turn;
      throw std::logic_error("no roll");
    }();
    EXPECT_NEAR(roll.byDeg.norm() * 3.14159265358979 / 180.0 * radiusMm, slideMm, 1e-9);
  }
}

// The gripper's fingers are planes across x: left column = (y + 8.5) / 3.4, right column =
// (8.5 - y) / 3.4, row = (80 - z) / 3.4 (hand.json). They meet the sphere at its radius.
TEST(DefaultScene, TheGripperTouchesTheSphereOnBothSides) {
  const HandDescription& hand = builtInHand("parallel_gripper");
  const Scene scene = defaultScene(hand);
  ASSERT_EQ(scene.objects.size(), 1u);
  const Vector3d atMm = scene.objects[0].positionMm;
  EXPECT_NEAR(atMm.x(), 0.0, 1e-6);
  const auto model = emulated(hand);
  const std::vector<float> values = valuesAt(*model, 4.9);
  const double row = (80.0 - atMm.z()) / 3.4;
  EXPECT_LT((centroid(hand, 0, values) - Vector2d((atMm.y() + 8.5) / 3.4, row)).norm(), 0.25);
  EXPECT_LT((centroid(hand, 1, values) - Vector2d((8.5 - atMm.y()) / 3.4, row)).norm(), 0.25);
  // The one axis is the travel of each finger from the closed hand, so half of the opening.
  const double travelMm = model->joints().angles().at(0);
  const double radiusMm = scene.objects[0].shape.sizeMm.x() / 2.0;
  EXPECT_LT(travelMm, radiusMm);
  EXPECT_GT(travelMm, radiusMm - 4.0);
  // Pulled by two pitches: the contact moves by two rows.
  EXPECT_NEAR(centroid(hand, 0, valuesAt(*model, 7.4)).y() - row, 2.0, 0.3);
}

TEST(DefaultScene, FourFingersCloseOnASphereEach) {
  const HandDescription& hand = builtInHand("four_fingers");
  const Scene scene = defaultScene(hand);
  ASSERT_EQ(scene.objects.size(), 4u);
  const auto model = emulated(hand);
  const std::vector<float> values = valuesAt(*model, 4.9);
  const HandGeometry geometry(describeGeometry(hand));
  const HandPose pose = geometry.pose(model->joints().angles());
  for (std::size_t m = 0; m < 4; ++m) {
    ASSERT_GT(largest(hand, m, values), 0.1F * hand.maximumCounts) << m;
    // The contact is around the foot of the sphere's centre on the plane of the fingertip.
    const Vector3d foot = pose.baseFromMatrix(m).inverse() * scene.objects[m].positionMm / 4.0;
    EXPECT_LT((centroid(hand, m, values) - foot.head<2>()).norm(), 0.3) << m;
  }
}

TEST(DefaultScene, AHandWithoutFilesIsTouchedOnAPlane) {
  const HandDescription hand = padHand({{4, 4}, {1, 1}, {2, 6}});
  const auto model = emulated(hand);
  for (std::size_t m = 0; m < 3; ++m) {
    const std::vector<float> values = valuesAt(*model, kPadCycleS * static_cast<double>(m) + 1.8);
    for (std::size_t other = 0; other < 3; ++other)
      EXPECT_EQ(largest(hand, other, values) > 0.1F * hand.maximumCounts, other == m)
          << m << " " << other;
  }
}

TEST(DefaultScene, RepeatsForAnHour) {
  const Scene scene = defaultScene(builtInHand("sole"));
  EXPECT_EQ(scene.script.size(), 5u * 450u);
  EXPECT_LE(scene.script.back().atS, 3600.0);
}

}  // namespace
}  // namespace palpate::testing::default_scene_test
