#include "palpate/model/preshape.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

namespace palpate::preshape_test {
namespace {

using Angles = std::vector<double>;

// Flat fingertips meet at proximal joints of asin(36.4 / 173) = 12.1 deg: there the gap is 66 - 2
// * 86.5 sin b - 2 * 14.8 mm.
TEST(Preshape, ThePinchOfTheEmptyHandClosesUntilThePadsTouch) {
  const Angles angles = sdh2Preshape("pinch-empty").anglesDeg(1.0);
  EXPECT_EQ(angles, (Angles{90, 15, -15, -90, 0, 15, -15}));
  EXPECT_GT(sdh2Preshape("pinch-parallel").anglesDeg(1.0)[1], 0.0);
  EXPECT_LT(sdh2Preshape("pinch-parallel").anglesDeg(1.0)[1], 12.1) << "a gap stays";
}

// The table of the prior program.
TEST(Preshape, AnglesAreThoseOfTheTable) {
  EXPECT_EQ(sdh2Preshape("parallel").anglesDeg(0.0), (Angles{0, -75, 75, -75, 75, -75, 75}));
  EXPECT_EQ(sdh2Preshape("parallel").anglesDeg(1.0), (Angles{0, 7, -7, 7, -7, 7, -7}));
  EXPECT_EQ(sdh2Preshape("cylindrical").anglesDeg(0.5),
            (Angles{0, -15, 47.5, -15, 47.5, -15, 47.5}));
  EXPECT_EQ(sdh2Preshape("centrical").anglesDeg(0.0), (Angles{60, -75, 75, -75, 75, -75, 75}));
  EXPECT_EQ(sdh2Preshape("spherical").anglesDeg(1.0), (Angles{60, -15, 55, -15, 55, -15, 55}));
  EXPECT_EQ(sdh2Preshape("pinch-parallel").anglesDeg(1.0), (Angles{90, 11, -11, -90, 0, 11, -11}));
  EXPECT_EQ(sdh2Preshape("pinch-tilted").anglesDeg(1.0), (Angles{90, 0, 23, -90, 0, 0, 23}));
  EXPECT_EQ(sdh2Preshape("calibration").anglesDeg(0.3), (Angles{90, 0, 0, -90, -90, -90, -90}));
}

TEST(Preshape, EveryPoseIsWithinTheJointsRanges) {
  EXPECT_EQ(sdh2Preshapes().size(), 8u);
  for (const Preshape& preshape : sdh2Preshapes())
    for (int i = 0; i <= 100; ++i) {
      const Angles angles = preshape.anglesDeg(i / 100.0);
      ASSERT_EQ(angles.size(), sdh2().axes.size());
      for (std::size_t a = 0; a < angles.size(); ++a) {
        EXPECT_GE(angles[a], sdh2().axes[a].minimumDeg) << preshape.name << ' ' << a;
        EXPECT_LE(angles[a], sdh2().axes[a].maximumDeg) << preshape.name << ' ' << a;
      }
    }
}

TEST(Preshape, WhatIsNoneIsRefused) {
  EXPECT_THROW(sdh2Preshape("fist"), std::invalid_argument);
  EXPECT_THROW(sdh2Preshape("parallel").anglesDeg(1.01), std::invalid_argument);
  EXPECT_THROW(sdh2Preshape("parallel").anglesDeg(-0.01), std::invalid_argument);
  EXPECT_THROW(sdh2Preshape("parallel").anglesDeg(std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
}

TEST(Preshape, IsFoundByItsName) {
  const std::vector<Preshape> preshapes = {{"open", "Open", {}}, {"closed", "Closed", {}}};
  EXPECT_EQ(findPreshape(preshapes, "closed").title, "Closed");
  try {
    findPreshape(preshapes, "fist");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "no preshape 'fist'; there are: open, closed");
  }
  EXPECT_THROW(findPreshape({}, "open"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::preshape_test
