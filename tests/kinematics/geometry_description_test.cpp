#include "palpate/kinematics/geometry_description.h"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace palpate::geometry_description_test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Figures of the study (chapter 4): a triangle of 66 mm, links of 86.5 and 68.5 mm.
TEST(GeometryDescription, TheSdh2HasTheLengthsOfTheStudy) {
  const GeometryDescription hand = sdh2Geometry();
  ASSERT_EQ(hand.fingers.size(), 3u);
  EXPECT_EQ(hand.numAxes, 7u);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NEAR((hand.fingers[f].baseMm - hand.fingers[(f + 1) % 3].baseMm).norm(), 66.0, 1e-12);
    ASSERT_EQ(hand.fingers[f].links.size(), 3u);
    const auto& links = hand.fingers[f].links;
    EXPECT_NEAR(std::abs(links[0].jointFromEnd.translation().z()), 16.7, 1e-9);
    EXPECT_LT((links[1].jointFromEnd.translation() - Eigen::Vector3d(86.5, 0, 0)).norm(), 1e-9);
    EXPECT_LT((links[2].jointFromEnd.translation() - Eigen::Vector3d(68.5, 0, 0)).norm(), 1e-9);
  }
  EXPECT_EQ(hand.surfaces.size(), 6u);
  EXPECT_NO_THROW(hand.validate());
}

// The bend is a circle that goes on from the flat part: same place, same direction, arc length
// kept.
TEST(GeometryDescription, ASurfaceRowLiesOnThePlaneOrTheCircle) {
  for (const double radiusMm : {kStudyFingertipRadiusMm, kEffectiveFingertipRadiusMm}) {
    const SensorSurface surface = sdh2Geometry(radiusMm).surfaces[1];
    const double bendY = 3.4 * 8.5;
    for (double row = -2.0; row < 14.0; row += 0.25) {
      const SurfaceRow at = surfaceRow(surface, 3.4, row);
      EXPECT_NEAR(std::hypot(at.normalY, at.normalZ), 1.0, 1e-15);
      if (row > 8.5) {
        EXPECT_EQ(at.zMm, 0.0);
        EXPECT_NEAR(bendY - at.yMm, (8.5 - row) * 3.4, 1e-12);
        EXPECT_EQ(at.normalZ, -1.0);
      } else {
        const double fromAxisY = at.yMm - bendY, fromAxisZ = at.zMm - radiusMm;
        EXPECT_NEAR(std::hypot(fromAxisY, fromAxisZ), radiusMm, 1e-12) << row;
        EXPECT_NEAR(std::atan2(-fromAxisY, -fromAxisZ) * radiusMm, (8.5 - row) * 3.4, 1e-12) << row;
        EXPECT_NEAR(at.normalY, fromAxisY / radiusMm, 1e-12);
      }
    }
    const SurfaceRow below = surfaceRow(surface, 3.4, 8.5),
                     above = surfaceRow(surface, 3.4, 8.5001);
    EXPECT_NEAR(below.yMm, above.yMm, 1e-3);
    EXPECT_NEAR(below.zMm, above.zMm, 1e-9);
  }
}

TEST(GeometryDescription, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(sdh2Geometry(0.0), std::invalid_argument);
  EXPECT_THROW(sdh2Geometry(-58.0), std::invalid_argument);
  EXPECT_THROW(sdh2Geometry(kNoNumber), std::invalid_argument);
  const std::function<void(GeometryDescription&)> breakages[] = {
      [](auto& hand) { hand.surfaces.pop_back(); },
      [](auto& hand) { hand.surfaces[0].place.finger = 3; },
      [](auto& hand) { hand.surfaces[5].place.link = 3; },
      [](auto& hand) { hand.surfaces[1].radiusMm = 0.0; },
      [](auto& hand) { hand.surfaces[1].radiusMm = kNoNumber; },
      [](auto& hand) { hand.surfaces[1].bendRow = kNoNumber; },
      [](auto& hand) { hand.surfaces[2].linkFromSurface.translation().y() = kNoNumber; },
      [](auto& hand) { hand.fingers[0].links[1].axis = 7; },
      [](auto& hand) { hand.fingers[0].links[1].jointFromEnd.translation().x() = kNoNumber; },
      [](auto& hand) { hand.fingers[1].baseMm.x() = kNoNumber; },
      [](auto& hand) { hand.fingers[1].baseRotation *= 2.0; },
      [](auto& hand) { hand.fingers[1].baseRotation.col(0) *= -1.0; },
  };
  for (const auto& breakIt : breakages) {
    GeometryDescription hand = sdh2Geometry();
    breakIt(hand);
    EXPECT_THROW(hand.validate(), std::invalid_argument) << &breakIt - breakages;
  }
}

}  // namespace
}  // namespace palpate::geometry_description_test
