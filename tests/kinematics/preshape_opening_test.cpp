#include "palpate/kinematics/preshape_opening.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

#include "testing/sdh2.h"

namespace palpate::preshape_opening_test {
namespace {

const HandGeometry& hand() {
  static const HandGeometry geometry(sdh2Geometry());
  return geometry;
}

// Fingers 0 and 2 of this preshape face each other, and finger 1 is turned away. The proximal joint
// goes from -72 to 11 deg while the distal one keeps the fingertip upright; with it at b the flat
// parts of the fingertips are
//   66 - 2 * 86.5 sin b - 2 * 14.8 mm
// apart (dimensions of the hand; as in object_size_test). From about 30 mm on they are the parts
// that are nearest to each other.
TEST(PreshapeOpening, OfAPinchIsTheDistanceOfItsFingertips) {
  for (const double sizeMm : {4.0, 7.0, 12.5, 20.0, 28.0}) {
    const double b = std::asin((66.0 - 29.6 - sizeMm) / 173.0) * 180.0 / std::numbers::pi;
    const double exact = (b + 72.0) / 83.0;
    const auto ratio = touchRatioOf(hand(), sdh2Preshape("pinch-parallel"), sizeMm);
    ASSERT_TRUE(ratio) << sizeMm;
    EXPECT_GE(*ratio, exact - 1e-6) << sizeMm;
    EXPECT_LE(*ratio, exact + 0.01) << sizeMm << ": in steps of 0.01";
  }
  // Closed, with b = 11 deg, they are 3.4 mm apart.
  EXPECT_EQ(touchRatioOf(hand(), sdh2Preshape("pinch-parallel"), 3.3), std::nullopt);
  EXPECT_EQ(touchRatioOf(hand(), sdh2Preshape("pinch-parallel"), 0.0), std::nullopt);
}

// Before the ratio no pad of finger 1 is as near to one of the two that are opposite to it.
TEST(PreshapeOpening, NoOppositePadsAreNearerBefore) {
  const Preshape& preshape = sdh2Preshape("parallel");
  const auto apartMm = [&](double ratio) {
    const HandPose pose = hand().pose(preshape.anglesDeg(ratio));
    double nearest = std::numeric_limits<double>::infinity();
    // Taxels in the middle of the flat part of a fingertip.
    for (const std::size_t opposite : {std::size_t{1}, std::size_t{5}})
      for (int x = 0; x < 6; ++x)
        for (int other = 0; other < 6; ++other)
          nearest = std::min(
              nearest, (pose.positionMm(3, 10, x) - pose.positionMm(opposite, 10, other)).norm());
    return nearest;
  };
  double last = 2.0;
  for (double sizeMm = 20.0; sizeMm <= 160.0; sizeMm += 20.0) {
    const auto ratio = touchRatioOf(hand(), preshape, sizeMm);
    ASSERT_TRUE(ratio) << sizeMm;
    EXPECT_GT(*ratio, 0.0) << sizeMm;
    EXPECT_LE(*ratio, last) << sizeMm << ": a larger object is touched no later";
    last = *ratio;
    for (double before = 0.0; before < *ratio - 0.005; before += 0.01)
      EXPECT_GT(apartMm(before), sizeMm) << sizeMm << ' ' << before;
  }
}

TEST(PreshapeOpening, AnObjectLargerThanTheOpenHandIsTouchedAtOnce) {
  EXPECT_EQ(touchRatioOf(hand(), sdh2Preshape("parallel"), 1000.0), 0.0);
}

TEST(PreshapeOpening, BadValuesAreRefused) {
  const Preshape& preshape = sdh2Preshape("parallel");
  EXPECT_THROW(touchRatioOf(hand(), preshape, -1.0), std::invalid_argument);
  EXPECT_THROW(touchRatioOf(hand(), preshape, std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
  EXPECT_THROW(touchRatioOf(hand(), preshape, std::numeric_limits<double>::infinity()),
               std::invalid_argument);
  Preshape two = preshape;
  two.joints.resize(2);
  EXPECT_THROW(touchRatioOf(hand(), two, 50.0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::preshape_opening_test
