#include "palpate/emulator/physical_hand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::testing::physical_hand_test {
namespace {

Scene sceneOf(const std::string& name) { return loadScene(name, dataFolder() / "scenes"); }

// A scene without its script: the test moves the hand itself.
Scene quietScene(const std::string& name) {
  Scene scene = sceneOf(name);
  scene.script.clear();
  return scene;
}

std::vector<std::uint16_t> scanAt(PhysicalHand& hand, double timeS) {
  hand.advanceTo(timeS);
  std::vector<std::uint16_t> counts(sdh2().layout->numCells());
  hand.scan(counts);
  return counts;
}

std::vector<int> activeFingers(const std::vector<std::uint16_t>& counts) {
  std::vector<int> fingers;
  for (std::size_t m = 0; m < 6; ++m) {
    const auto from = counts.begin() + static_cast<std::ptrdiff_t>(sdh2().layout->offset(m));
    const auto to = from + static_cast<std::ptrdiff_t>(sdh2().layout->matrix(m).numCells());
    const int finger = static_cast<int>(m) / 2;
    if (std::any_of(from, to, [](std::uint16_t value) { return value > 0; }) &&
        (fingers.empty() || fingers.back() != finger))
      fingers.push_back(finger);
  }
  return fingers;
}

void close(PhysicalHand& hand, const std::string& preshape, double velocity = 40.0) {
  hand.joints().setVelocities(std::vector<double>(7, velocity));
  hand.joints().setTargets(sdh2Preshape(preshape).anglesDeg(1.0));
  hand.joints().startMotion();
}

TEST(PhysicalHand, AnOpenHandFeelsNothingAndStaysOpen) {
  PhysicalHand hand(sceneOf("empty"));
  for (const double timeS : {0.0, 1.0, 60.0, 3600.0, 86'400.0}) {
    const auto counts = scanAt(hand, timeS);
    EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 0);
    for (const MatrixTruth& truth : hand.truth()) EXPECT_FALSE(truth.contact);
  }
  EXPECT_EQ(hand.joints().angles(), sdh2Preshape("centrical").anglesDeg(0.0));
}

TEST(PhysicalHand, ClosingOnEachObjectTouchesItWithAtLeastTwoFingers) {
  for (const char* name : {"ball", "foam_ball", "bottle", "pen", "box", "slipping_handle"}) {
    const Scene scene = quietScene(name);
    PhysicalHand hand(scene);
    close(hand, scene.preshape);
    EXPECT_GE(activeFingers(scanAt(hand, 8.0)).size(), 2u) << name;
    double force = 0.0;
    for (const MatrixTruth& truth : hand.truth()) force += truth.forceN;
    EXPECT_GT(force, 10.0) << name;
    // Torque limits of three fingers: 1400 N mm at 15 mm from the distal joint, 2100 N mm at 20 mm
    // from the proximal one.
    EXPECT_LT(force, 3.0 * (1400.0 / 15.0 + 2100.0 / 20.0)) << name << ": motors give up before";
  }
}

// The scripts of the scenes grasp and release by themselves.
TEST(PhysicalHand, ObjectsAreWhereTheScriptMovedThem) {
  Scene scene = quietScene("ball");
  scene.script = {{1.0, MoveObject{0, {0.0, 0.0, 10.0}, 1.0}}};
  PhysicalHand hand(scene);
  ASSERT_EQ(hand.objects().size(), 1u);
  EXPECT_EQ(hand.objects()[0].positionMm, scene.objects[0].positionMm);
  EXPECT_EQ(hand.objects()[0].shape.sizeMm, scene.objects[0].shape.sizeMm);
  hand.advanceTo(3.0);
  const Eigen::Vector3d moved = hand.objects()[0].positionMm - scene.objects[0].positionMm;
  EXPECT_TRUE(moved.isApprox(Eigen::Vector3d(0.0, 0.0, 10.0), 1e-6)) << moved.transpose();
}

TEST(PhysicalHand, ScriptsGraspAndRelease) {
  for (const char* name : {"ball", "foam_ball", "bottle", "pen", "box", "slipping_handle"}) {
    PhysicalHand hand(sceneOf(name));
    EXPECT_EQ(activeFingers(scanAt(hand, 1.0)).size(), 0u) << name;
    EXPECT_GE(activeFingers(scanAt(hand, 8.0)).size(), 2u) << name;
    EXPECT_EQ(activeFingers(scanAt(hand, 25.0)).size(), 0u) << name;
  }
}

// ball.json: grasps at 1.5 s, releases at 9 s, again after 16 s.
TEST(PhysicalHand, ItTellsWhatTheScriptDoesUntilSomebodyElseOrders) {
  PhysicalHandOptions options;
  options.repeatsScript = true;
  PhysicalHand hand(sceneOf("ball"), options);
  const auto at = [&](double timeS) {
    hand.advanceTo(timeS);
    return hand.ownMotion();
  };
  EXPECT_EQ(at(1.0), "open");
  EXPECT_EQ(at(1.7), "closing");
  EXPECT_EQ(at(8.0), "holding an object");
  EXPECT_EQ(at(9.3), "opening");
  EXPECT_EQ(at(16.5), "open");
  EXPECT_EQ(at(17.7), "closing");
  hand.joints().stop();
  EXPECT_EQ(at(18.0), "");
  EXPECT_EQ(PhysicalHand(quietScene("ball")).ownMotion(), "") << "no script";
  PhysicalHand once(sceneOf("ball"));
  once.advanceTo(9.3);
  EXPECT_EQ(once.ownMotion(), "opening") << "the last order is still under way";
  once.advanceTo(15.0);
  EXPECT_EQ(once.ownMotion(), "") << "the script has ended";
}

TEST(PhysicalHand, FingersStopAtAHardObject) {
  const Scene scene = quietScene("box");
  PhysicalHand hand(scene);
  close(hand, "parallel");
  hand.advanceTo(8.0);
  const std::vector<double> wanted = sdh2Preshape("parallel").anglesDeg(1.0);
  for (const std::size_t axis : {1u, 3u, 5u}) {
    EXPECT_LT(hand.joints().angles()[axis], wanted[axis] - 3.0) << axis;
    EXPECT_EQ(hand.joints().states()[axis], AxisState::kBlockedClockwise) << axis;
  }
  EXPECT_FALSE(hand.joints().moving());
}

// A sphere pressed into a flat pad by d: the force of the elastic foundation is k * integral of the
// depth over the contact area = k pi d^2 (R - d/3).
TEST(PhysicalHand, ForceOfASphereOnAFlatPadIsTheFoundationsIntegral) {
  const HandGeometry geometry(sdh2Geometry());
  const auto angles = sdh2Preshape("centrical").anglesDeg(0.0);
  const HandPose pose = geometry.pose(angles);
  constexpr double kRadiusMm = 25.0, kDepthMm = 1.2;
  Scene scene;
  SceneObject ball;
  ball.shape = {ShapeKind::kSphere, Eigen::Vector3d::Constant(2 * kRadiusMm)};
  ball.stiffnessNPerMm3 = 1e4;
  ball.massKg = 0.0;
  ball.fixed = true;
  // Above the centre of a proximal pad, between taxels.
  ball.positionMm = pose.pointMm(2, 2.5 * 3.4, 6.5 * 3.4) +
                    pose.normalAt(2, 2.5 * 3.4, 6.5 * 3.4) * (kRadiusMm - kDepthMm);
  scene.objects.push_back(ball);
  PhysicalHandOptions options;
  PhysicalHand hand(scene, options);
  scanAt(hand, 0.02);
  const double k = options.rubberNPerMm3 * 1e4 / (options.rubberNPerMm3 + 1e4);
  const double expected = k * std::numbers::pi * kDepthMm * kDepthMm * (kRadiusMm - kDepthMm / 3.0);
  ASSERT_TRUE(hand.truth()[2].contact);
  EXPECT_NEAR(hand.truth()[2].forceN, expected, 0.05 * expected) << "taxels of 3.4 mm sample it";
  // Spreading by the rubber preserves the force: pressure times area, summed over all taxels.
  double sum = 0.0;
  for (const double kpa : hand.pressureKpa()) sum += kpa * 1e-3 * 3.4 * 3.4;
  EXPECT_NEAR(sum, hand.truth()[2].forceN, 1e-9);
  // The centre of pressure is where the sphere presses.
  const Eigen::Vector3d centre(hand.truth()[2].xMm, hand.truth()[2].yMm, hand.truth()[2].zMm);
  EXPECT_LT((centre - pose.pointMm(2, 2.5 * 3.4, 6.5 * 3.4)).norm(), 0.2);
}

TEST(PhysicalHand, ThreeFingersBalanceOnABall) {
  PhysicalHand hand(quietScene("ball"));
  close(hand, "centrical");
  scanAt(hand, 10.0);
  EXPECT_NEAR(hand.truth()[1].forceN, hand.truth()[3].forceN, 0.05);
  EXPECT_NEAR(hand.truth()[1].forceN, hand.truth()[5].forceN, 0.05);
}

// Along the normals there is no friction: an object beside the centre is pushed there, however
// rough it is, and both fingers press it equally.
TEST(PhysicalHand, AnObjectBesideTheMiddleIsPushedThere) {
  for (const double friction : {0.3, 0.9, 3.0}) {
    Scene scene = quietScene("pen");
    scene.objects[0].friction = friction;
    scene.objects[0].positionMm.y() += 6.0;
    PhysicalHand hand(scene);
    close(hand, "pinch-parallel", 30.0);
    scanAt(hand, 9.0);
    const MatrixTruth one = hand.truth()[1], other = hand.truth()[5];
    EXPECT_GT(one.forceN, 5.0) << friction;
    EXPECT_NEAR(one.forceN, other.forceN, 0.05 * one.forceN) << friction;
    EXPECT_NEAR(one.yMm, -other.yMm, 1.0) << friction;
  }
}

// A pinched sphere under a torque about y, the direction of the grasp. Each contact of force F
// resists by its area, up to friction * F * radius of gyration, and by its distance from that axis
// (the pads are tilted: they touch below the centre), up to friction * F * distance.
TEST(PhysicalHand, ATorqueAboveWhatThePrintsHoldTurnsTheObject) {
  for (const double share : {0.85, 1.25}) {
    constexpr double kRadiusMm = 20.0, kFriction = 0.6;
    Scene scene = quietScene("pen");
    SceneObject& ball = scene.objects[0];
    ball.shape = {ShapeKind::kSphere, Eigen::Vector3d::Constant(2.0 * kRadiusMm)};
    ball.massKg = 0.0;
    ball.friction = kFriction;
    const auto pinched = [&] {
      auto hand = std::make_unique<PhysicalHand>(scene);
      close(*hand, "pinch-parallel", 30.0);
      scanAt(*hand, 9.9);
      return hand;
    };
    const MatrixTruth contact = pinched()->truth()[1];
    ASSERT_GT(contact.forceN, 5.0);
    // Elastic foundation: F = pi k R d^2, contact radius a with a^2 = 2 R d, and a paraboloid
    // pressure, whose mean square distance from its centre is a^2 / 3.
    const double k = 0.15 * 20.0 / (0.15 + 20.0);
    const double depth = std::sqrt(contact.forceN / (std::numbers::pi * k * kRadiusMm));
    const double contactRadiusMm = std::sqrt(2.0 * kRadiusMm * depth / 3.0);
    const double belowMm = 150.0 - contact.zMm;
    const double holds =
        2.0 * kFriction * contact.forceN *
        (contactRadiusMm * std::sqrt(1.0 - belowMm * belowMm / (kRadiusMm * kRadiusMm)) +
         std::abs(belowMm));
    scene.script = {{10.0, LoadObject{0, {0, 0, 0}, {0, share * holds, 0}, 0.1}}};
    const auto hand = pinched();
    scanAt(*hand, 12.0);
    const double turned = std::abs(hand->truth()[1].turnDeg - contact.turnDeg);
    if (share < 1.0)
      EXPECT_LT(turned, 0.2) << share;
    else
      EXPECT_GT(turned, 3.0) << share;
  }
}

// A box between two fingers and the thumb: the thumb takes the force of both fingers, except for
// the friction of pads that are tilted by about ten degrees (0.5 * 60 N * sin 10).
TEST(PhysicalHand, TheThumbHoldsAgainstBothFingers) {
  PhysicalHand hand(quietScene("box"));
  close(hand, "parallel", 30.0);
  scanAt(hand, 9.0);
  const double fingers = hand.truth()[1].forceN + hand.truth()[5].forceN;
  EXPECT_GT(fingers, 20.0);
  EXPECT_NEAR(hand.truth()[3].forceN,
              fingers,
              0.5 * 60.0 * std::sin(10.0 * std::numbers::pi / 180.0) + 1.0);
}

TEST(PhysicalHand, AFixedObjectIsNotPushedAway) {
  Scene scene = quietScene("pen");
  scene.objects[0].fixed = true;
  scene.objects[0].positionMm.y() += 6.0;
  PhysicalHand hand(scene);
  close(hand, "pinch-parallel", 30.0);
  scanAt(hand, 9.0);
  EXPECT_TRUE(hand.truth()[5].contact);
  EXPECT_NEAR(hand.truth()[5].yMm, 6.0 + 7.0, 1.5) << "the pen's near side, 7 mm from its middle";
}

TEST(PhysicalHand, ASofterObjectTouchesMoreTaxelsWithLess) {
  PhysicalHand hard(quietScene("ball")), soft(quietScene("foam_ball"));
  close(hard, "centrical");
  close(soft, "centrical");
  const auto hardCounts = scanAt(hard, 10.0), softCounts = scanAt(soft, 10.0);
  const auto active = [](const std::vector<std::uint16_t>& counts) {
    return std::count_if(counts.begin(), counts.end(), [](std::uint16_t v) { return v > 0; });
  };
  EXPECT_GT(active(softCounts), active(hardCounts));
  EXPECT_LT(*std::max_element(softCounts.begin(), softCounts.end()),
            *std::max_element(hardCounts.begin(), hardCounts.end()) / 2);
}

// Values of the real hand for the objects after which the scenes are named (two recordings of the
// study, loaded frames): hockey ball 18 active taxels on a fingertip, peak 2640..3258 counts; foam
// ball 26, peak 1165..1860.
TEST(PhysicalHand, GraspsReadLikeRecordedOnes) {
  const auto fingertip = [](const char* scene) {
    PhysicalHand hand(quietScene(scene));
    close(hand, "centrical", 30.0);
    const auto counts = scanAt(hand, 7.0);
    int active = 0;
    std::uint16_t peak = 0;
    for (std::size_t p = 84; p < 162; ++p) {
      active += counts[p] > 0;
      peak = std::max(peak, counts[p]);
    }
    return std::pair(active, peak);
  };
  const auto [ballActive, ballPeak] = fingertip("ball");
  EXPECT_NEAR(ballActive, 18, 4);
  EXPECT_NEAR(ballPeak, 2950, 450);
  const auto [foamActive, foamPeak] = fingertip("foam_ball");
  EXPECT_NEAR(foamActive, 26, 7);
  EXPECT_NEAR(foamPeak, 1500, 400);
}

TEST(PhysicalHand, ABottleIsWrappedByAllSixPads) {
  PhysicalHand hand(sceneOf("bottle"));
  const auto counts = scanAt(hand, 8.0);
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_TRUE(hand.truth()[m].contact) << m;
    const auto from = counts.begin() + static_cast<std::ptrdiff_t>(sdh2().layout->offset(m));
    const auto peak = *std::max_element(
        from, from + static_cast<std::ptrdiff_t>(sdh2().layout->matrix(m).numCells()));
    EXPECT_GT(peak, 500) << m;
    EXPECT_LT(peak, 3500) << m << ": not saturated";
  }
}

TEST(PhysicalHand, AHandleThatIsPulledSlipsAndStopsWhenThePullEnds) {
  PhysicalHand hand(sceneOf("slipping_handle"));
  scanAt(hand, 6.9);
  const MatrixTruth before = hand.truth()[1];
  scanAt(hand, 7.5);
  EXPECT_NEAR(hand.truth()[1].slipYTaxels, before.slipYTaxels, 0.1) << "friction holds at first";
  scanAt(hand, 9.5);
  // Pulled up, towards the fingertips, that is, against y.
  EXPECT_LT(hand.truth()[1].slipYTaxels, before.slipYTaxels - 2.0);
  EXPECT_LT(hand.truth()[5].slipYTaxels, before.slipYTaxels - 2.0);
  scanAt(hand, 10.2);
  const double rested = hand.truth()[1].slipYTaxels;
  scanAt(hand, 10.9);
  EXPECT_NEAR(hand.truth()[1].slipYTaxels, rested, 0.02);
  const double unturned = hand.truth()[1].turnDeg;
  scanAt(hand, 14.0);
  EXPECT_NEAR(std::abs(hand.truth()[1].turnDeg - unturned), 25.0, 1.5);
  EXPECT_NEAR(hand.truth()[1].turnDeg, -hand.truth()[5].turnDeg, 1.5) << "seen from both sides";
}

// The slip in the truth is the motion of the pressure on the matrix: its centroid moves with a
// small object.
TEST(PhysicalHand, SlipInTaxelsIsTheMotionOfThePrint) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose(sdh2Preshape("centrical").anglesDeg(0.0));
  Scene scene;
  SceneObject ball;
  ball.shape = {ShapeKind::kSphere, Eigen::Vector3d::Constant(24.0)};
  ball.fixed = true;
  ball.massKg = 0.0;
  const Eigen::Vector3d at = pose.pointMm(0, 2.0 * 3.4, 4.0 * 3.4);
  const Eigen::Vector3d normal = pose.normalAt(0, 2.0 * 3.4, 4.0 * 3.4);
  ball.positionMm = at + normal * 10.5;
  scene.objects.push_back(ball);
  const Eigen::Vector3d by = pose.pointMm(0, 3.5 * 3.4, 7.0 * 3.4) - at;
  scene.script.push_back({0.1, MoveObject{0, by, 1.0}});
  PhysicalHand hand(scene);
  scanAt(hand, 0.1);
  EXPECT_NEAR(hand.truth()[0].slipXTaxels, 0.0, 1e-6);
  scanAt(hand, 1.3);
  EXPECT_NEAR(hand.truth()[0].slipXTaxels, 1.5, 0.01);
  EXPECT_NEAR(hand.truth()[0].slipYTaxels, 3.0, 0.01);
  const Eigen::Vector3d centre(hand.truth()[0].xMm, hand.truth()[0].yMm, hand.truth()[0].zMm);
  EXPECT_LT((centre - at - by).norm(), 0.4);
}

// A ball that is moved over a pad: the rubber is stretched for 0.3 mm, then the ball slides.
TEST(PhysicalHand, ShearGrowsToTheFrictionAndFollowsTheMotion) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose(sdh2Preshape("centrical").anglesDeg(0.0));
  const auto pointMm = [&](double xMm, double yMm) {
    return Eigen::Vector3d(pose.pointMm(0, 2.0 * 3.4 + xMm, 4.0 * 3.4 + yMm));
  };
  Scene scene;
  SceneObject ball;
  ball.shape = {ShapeKind::kSphere, Eigen::Vector3d::Constant(24.0)};
  ball.fixed = true;
  ball.massKg = 0.0;
  ball.friction = 0.5;
  ball.positionMm = pointMm(0.0, 0.0) + pose.normalAt(0, 2.0 * 3.4, 4.0 * 3.4) * 10.5;
  scene.objects.push_back(ball);
  scene.script.push_back({0.1, MoveObject{0, pointMm(0.15, 0.0) - pointMm(0.0, 0.0), 0.1}});
  scene.script.push_back({1.0, MoveObject{0, pointMm(0.0, -4.0) - pointMm(0.0, 0.0), 1.0}});
  PhysicalHand hand(scene);
  const auto shearAt = [&](double timeS) {
    scanAt(hand, timeS);
    const MatrixTruth truth = hand.truth()[0];
    EXPECT_GT(truth.forceN, 0.0);
    return Eigen::Vector2d(truth.shearXN / truth.forceN, truth.shearYN / truth.forceN);
  };
  EXPECT_LT(shearAt(0.05).norm(), 1e-6);
  const Eigen::Vector2d stretched = shearAt(0.5);  // by half of 0.3 mm
  EXPECT_NEAR(stretched.x(), 0.25, 0.01);
  EXPECT_NEAR(stretched.y(), 0.0, 0.01);
  const Eigen::Vector2d sliding = shearAt(2.5);
  EXPECT_NEAR(sliding.x(), 0.0, 0.01);
  EXPECT_NEAR(sliding.y(), -0.5, 0.01);
}

TEST(PhysicalHand, ShearOfAHeldObjectCarriesItsLoadWithinTheFriction) {
  const Scene scene = sceneOf("slipping_handle");
  PhysicalHand hand(scene);
  double largest = 0.0;
  for (double timeS = 1.0; timeS < 15.0; timeS += 0.5) {
    scanAt(hand, timeS);
    for (const MatrixTruth& truth : hand.truth()) {
      const double shear = std::hypot(truth.shearXN, truth.shearYN);
      EXPECT_LE(shear, scene.objects[0].friction * truth.forceN + 1e-9) << timeS;
      largest = std::max(largest, shear);
    }
  }
  EXPECT_GT(largest, 1.0) << "it is pulled with 18 N";
}

TEST(PhysicalHand, SettingsOfTheScriptReachTheSensor) {
  Scene scene;
  scene.script = {{1.0, SetSceneThreshold{std::nullopt, 0}},
                  {2.0, SetSceneThreshold{1, 200}},
                  {3.0, SetSceneSensitivity{3, 1.0}}};
  PhysicalHand hand(scene);
  const auto silent = scanAt(hand, 0.9);
  EXPECT_EQ(*std::max_element(silent.begin(), silent.end()), 0);
  const auto noisy = scanAt(hand, 1.1);
  EXPECT_GT(noisy[0], 20);
  EXPECT_GT(noisy[100], 20);
  const auto quieter = scanAt(hand, 2.1);
  EXPECT_GT(quieter[0], 20);
  EXPECT_EQ(quieter[100], 0);
  hand.advanceTo(3.1);
  EXPECT_EQ(hand.settings()[3].sensitivity, 1.0);
  EXPECT_EQ(hand.settings()[2].sensitivity, 0.5);
}

TEST(PhysicalHand, MotorsWarmUpUnderLoadAndCoolDown) {
  PhysicalHand hand(quietScene("bottle"));
  const std::vector<double> cold = hand.temperatures();
  ASSERT_EQ(cold.size(), 9u);
  for (const double degC : cold) {
    EXPECT_GE(degC, 34.0);
    EXPECT_LE(degC, 49.0);
  }
  close(hand, "cylindrical");
  hand.advanceTo(5.0);
  hand.advanceTo(1800.0);
  const std::vector<double> warm = hand.temperatures();
  for (const std::size_t axis : {1u, 2u, 3u, 4u, 5u, 6u})
    EXPECT_GT(warm[axis], cold[axis] + 1.5) << axis;
  EXPECT_LT(*std::max_element(warm.begin(), warm.end()), 70.0);
  hand.joints().setPower(std::vector<bool>(7, false));
  hand.advanceTo(9000.0);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_LT(hand.temperatures()[i], std::max(warm[i], cold[i] + 1.0)) << i;
}

TEST(PhysicalHand, OnceAClientMovesTheHandTheScriptLeavesItToHim) {
  PhysicalHand hand(sceneOf("ball"));  // grasps at 1.5 s
  hand.advanceTo(1.0);
  const std::vector<double> open = sdh2Preshape("parallel").anglesDeg(0.0);
  hand.joints().setTargets(open);
  hand.joints().startMotion();
  hand.advanceTo(8.0);
  for (std::size_t i = 0; i < open.size(); ++i)
    EXPECT_NEAR(hand.joints().angles()[i], open[i], 1e-9) << i;
}

TEST(PhysicalHand, TheSameSceneGivesTheSameFrames) {
  PhysicalHand a(sceneOf("ball")), b(sceneOf("ball"));
  for (int i = 1; i < 200; ++i) EXPECT_EQ(scanAt(a, i * 0.0315), scanAt(b, i * 0.0315));
}

// A sphere on a flat pad of another hand: force and place of the elastic foundation, as for the
// SDH-2 above; the values are those of the pad's characteristics (hand.json).
TEST(PhysicalHand, AnotherHandIsPressedInItsOwnUnit) {
  const HandDescription& sole = builtInHand("sole");
  PhysicalHandOptions options;
  options.hand = sole;
  Scene scene;
  SceneObject ball;
  ball.shape = {ShapeKind::kSphere, Eigen::Vector3d::Constant(200.0)};
  ball.stiffnessNPerMm3 = 1e4;
  ball.fixed = true;
  ball.positionMm = {-4.0, 20.0, 98.0};  // 2 mm deep
  scene.objects.push_back(ball);
  PhysicalHand hand(scene, options);
  EXPECT_EQ(hand.hand().name, sole.name);
  hand.advanceTo(0.5);
  std::vector<float> values(sole.layout->numCells());
  hand.measure(values);
  ASSERT_TRUE(hand.truth()[0].contact);
  const double k = options.rubberNPerMm3 * 1e4 / (options.rubberNPerMm3 + 1e4);
  const double forceN = k * std::numbers::pi * 2.0 * 2.0 * (100.0 - 2.0 / 3.0);
  EXPECT_NEAR(hand.truth()[0].forceN, forceN, 0.05 * forceN);
  EXPECT_NEAR(hand.truth()[0].xMm, -4.0, 0.3);
  EXPECT_NEAR(hand.truth()[0].yMm, 20.0, 0.3);
  // The taxels read kilopascals: their sum times the area of a taxel is the force, less what is
  // subtracted from each and lies below the threshold of the dead zone.
  double sumKpa = 0.0, active = 0.0;
  for (const float value : values) {
    sumKpa += static_cast<double>(value);
    active += value > 0.0F ? 1.0 : 0.0;
  }
  // Creep adds up to 5 %; the subtracted offset is 4 kPa minus the rest value of 1.
  EXPECT_NEAR((sumKpa + 3.0 * active) * 64.0 * 1e-3, forceN, 0.08 * forceN);
}

TEST(PhysicalHand, TheAxesOfAnotherHandStopAtTheirForce) {
  // A gripper of 80 N closes on a stiff box of 60 mm: each finger stands at 30 mm, less the
  // indentation of 80 N on 14 x 6 taxels of 3.4 mm.
  const HandDescription& gripper = builtInHand("parallel_gripper");
  PhysicalHandOptions options;
  options.hand = gripper;
  Scene scene =
      parseScene(R"({"objects": [{"shape": "box", "size_mm": [60, 100, 200], "fixed": true,
        "stiffness_n_per_mm3": 10000}],
      "script": [{"at_s": 0.1, "grasp": {"close": 1}}]})",
                 "box.json",
                 gripper);
  PhysicalHand hand(scene, options);
  hand.advanceTo(15.0);
  std::vector<float> values(gripper.layout->numCells());
  hand.measure(values);
  const double forceN = hand.truth()[0].forceN;
  EXPECT_NEAR(forceN, hand.truth()[1].forceN, 1e-6);
  // The one axis carries both fingers.
  EXPECT_NEAR(forceN + hand.truth()[1].forceN, 80.0, 2.0);
  const double k = options.rubberNPerMm3 * 1e4 / (options.rubberNPerMm3 + 1e4);
  EXPECT_NEAR(hand.joints().angles()[0], 30.0 - forceN / (k * 84 * 3.4 * 3.4), 1e-3);
}

TEST(PhysicalHand, WrongOptionsAreRefused) {
  PhysicalHandOptions options;
  options.rubberNPerMm3 = 0.0;
  EXPECT_THROW(PhysicalHand({}, options), std::invalid_argument);
  options = {};
  options.motorNmm.assign(6, 1000.0);
  EXPECT_THROW(PhysicalHand({}, options), std::invalid_argument);
  options = {};
  options.stepS = 1.0;
  EXPECT_THROW(PhysicalHand({}, options), std::invalid_argument);
  PhysicalHand hand({});
  EXPECT_THROW(hand.advanceTo(std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_THROW(hand.advanceTo(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  hand.advanceTo(1.0);
  hand.advanceTo(0.5);
  EXPECT_EQ(hand.timeS(), 1.0) << "never back";
}

// The times at which a hand begins to touch and to be free again, looked at every 0.1 s.
std::vector<double> touchesUntil(PhysicalHand& hand, double endS) {
  std::vector<double> times;
  bool touched = false;
  for (int tenth = static_cast<int>(std::lround(10.0 * hand.timeS())) + 1; tenth <= 10.0 * endS;
       ++tenth) {
    const bool now = !activeFingers(scanAt(hand, tenth / 10.0)).empty();
    if (now != touched) times.push_back(tenth / 10.0);
    touched = now;
  }
  return times;
}

PhysicalHand demoHand() {
  PhysicalHandOptions options;
  options.repeatsScript = true;
  return PhysicalHand(sceneOf("ball"), options);
}

// L-m29
TEST(PhysicalHand, ARepeatedScriptGraspsAndReleasesAgainAndAgain) {
  const double periodS = sceneOf("ball").repeatS;
  ASSERT_GT(periodS, 0.0);
  PhysicalHand hand = demoHand();
  const std::vector<double> times = touchesUntil(hand, 3.0 * periodS);
  ASSERT_EQ(times.size(), 6u) << "three grasps, each released";
  for (std::size_t i = 2; i < times.size(); ++i)
    EXPECT_NEAR(times[i], times[i - 2] + periodS, 0.3) << i;
  PhysicalHand once(sceneOf("ball"));
  EXPECT_EQ(touchesUntil(once, 3.0 * periodS).size(), 2u) << "nobody asked for a repetition";
}

TEST(PhysicalHand, AfterAnyOrderOfTheUserARepeatedScriptNeverMovesTheHand) {
  const double periodS = sceneOf("ball").repeatS;
  const std::pair<const char*, std::function<void(JointMotion&)>> orders[] = {
      {"stop", [](JointMotion& joints) { joints.stop(); }},
      {"motors off", [](JointMotion& joints) { joints.setPower(std::vector<bool>(7, false)); }},
      {"motors on, which they are",
       [](JointMotion& joints) { joints.setPower(std::vector<bool>(7, true)); }},
      {"motion to where it is", [](JointMotion& joints) { joints.startMotion(); }}};
  // At rest before the first grasp, while it closes, while it holds, at rest in the second pass.
  for (const double atS : {0.5, 2.5, 7.0, 2.0 * periodS - 0.5})
    for (const auto& [name, order] : orders) {
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(atS) + " s");
      PhysicalHand hand = demoHand();
      hand.advanceTo(atS);
      order(hand.joints());
      const std::uint64_t orderCount = hand.joints().orderCount();
      // A motion that was ordered may end.
      hand.advanceTo(atS + 6.0);
      const std::vector<double> angles = hand.joints().angles();
      for (double timeS = atS + 6.0; timeS < atS + 6.0 + 3.0 * periodS; timeS += 0.5) {
        hand.advanceTo(timeS);
        ASSERT_EQ(hand.joints().angles(), angles) << "at " << timeS << " s";
      }
      EXPECT_EQ(hand.joints().orderCount(), orderCount) << "the script ordered something";
    }
}

}  // namespace
}  // namespace palpate::testing::physical_hand_test
