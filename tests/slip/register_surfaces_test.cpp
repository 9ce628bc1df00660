// The method `register` refines strong contacts that end inside the matrix by another surface than
// all other contacts. These are contacts for which it has to choose rightly.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "palpate/slip/slip_tracker.h"

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::register_surfaces_test {
namespace {

using testing::reading;
using testing::viewOf;

constexpr double kThreshold = 120.0;

SlipTracker registerTracker() {
  SlipTrackerOptions options;
  options.method = SlipMethod::kRegister;
  return SlipTracker(MatrixLayout::full(14, 6, 3.4), options);
}

class Readings {
 public:
  Readings(std::uint64_t seed, double noise) : random_(seed), noise_(noise) {}
  // load(x, y): load of the contact [counts].
  const MatrixValues& read(const std::function<double(double, double)>& load) {
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 6; ++x) {
        const double value = std::round(load(x, y) + noise_ * normal_(random_));
        values_(y, x) = value < kThreshold ? 0.0F : static_cast<float>(std::min(value, 4095.0));
      }
    return values_;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double noise_ = 0.0;
  MatrixValues values_ = MatrixValues::Zero(14, 6);
};

// The load depends on the row only, as that of a bottle, and changes by a fifth. The direction
// along the band is degenerate in most frames.
TEST(RegisterSurfaces, ABandAcrossTheMatrixTellsNothingOfItsMotionAlongItself) {
  for (const std::uint64_t seed : {21U, 22U, 23U, 24U}) {
    Readings readings(seed, 5.0);
    SlipTracker tracker = registerTracker();
    int degenerate = 0;
    double across = 0.0;
    for (int i = 0; i < 150; ++i) {
      const double peak = 800.0 * (1.0 + 0.2 * std::sin(0.05 * i));
      const SlipMotion& motion = tracker.update(viewOf(readings.read([&](double, double y) {
        return peak * std::max(0.0, 1.0 - std::pow((y - 6.2) / 2.3, 2));
      })));
      if (i == 0) continue;
      degenerate += motion.degenerate == 1 && std::abs(motion.degenerateX) > 0.99 ? 1 : 0;
      across = std::max(across, std::abs(motion.refDy));
    }
    EXPECT_GT(degenerate, 110) << seed;
    EXPECT_LT(across, 0.03) << seed;
  }
}

// As that of a bottle that is grasped: it becomes a band. Nothing moves.
TEST(RegisterSurfaces, AContactThatGrowsOverBothSidesBecomesABand) {
  for (const std::uint64_t seed : {31U, 32U, 33U, 34U}) {
    Readings readings(seed, 5.0);
    SlipTracker tracker = registerTracker();
    double worst = 0.0;
    int degenerate = 0;
    for (int i = 0; i < 200; ++i) {
      const double grown = std::min(1.0, i / 100.0);
      const double length = 1.8 + 15.0 * grown * grown;
      const SlipMotion& motion = tracker.update(viewOf(readings.read([&](double x, double y) {
        return (700.0 + 500.0 * grown) *
               std::max(0.0, 1.0 - std::pow((x - 2.5) / length, 2) - std::pow((y - 6.2) / 2.2, 2));
      })));
      worst = std::max(worst, std::hypot(motion.refDx, motion.refDy));
      if (i > 100 && motion.degenerate > 0) ++degenerate;
    }
    EXPECT_GT(degenerate, 40) << seed;
    EXPECT_LT(worst, 0.5) << seed;
  }
}

// It grows over both sides and shrinks again, twice. Where the surface changes, the motion goes on.
TEST(RegisterSurfaces, TheMotionGoesOnWhereTheSurfaceChanges) {
  for (const std::uint64_t seed : {61U, 62U, 63U}) {
    Readings readings(seed, 5.0);
    SlipTracker tracker = registerTracker();
    int keys = 0;
    for (int i = 0; i <= 240; ++i) {
      const double length = 2.0 + 3.0 * (1.0 - std::cos(0.05236 * i));
      const double before = tracker.last().refDx;
      const SlipMotion& motion = tracker.update(viewOf(readings.read([&](double x, double y) {
        return 900.0 *
               std::max(0.0, 1.0 - std::pow((x - 2.5) / length, 2) - std::pow((y - 6.2) / 2.2, 2));
      })));
      if (i == 0 || !motion.newKey) continue;
      ++keys;
      EXPECT_LT(std::abs(motion.refDx - before), 0.05) << seed << " " << i;
    }
    EXPECT_GE(keys, 2) << seed;
    // Twice over the sides: the surface does not change to and fro.
    EXPECT_LE(keys, 6) << seed;
  }
}

// Few taxels, little above the threshold or the noise.
TEST(RegisterSurfaces, AWeakContactRests) {
  for (const double peak : {175.0, 250.0}) {
    int counted = 0;
    for (std::uint64_t seed = 41; seed < 71; ++seed) {
      Readings readings(seed, 5.0);
      SlipTracker tracker = registerTracker();
      for (int i = 0; i < 100; ++i) {
        const SlipMotion& motion = tracker.update(viewOf(readings.read([&](double x, double y) {
          return peak * std::exp(-0.5 * (std::pow(x - 2.45, 2) + std::pow(y - 6.45, 2)));
        })));
        if (!motion.refValid) continue;
        ++counted;
        EXPECT_LT(std::hypot(motion.refDx, motion.refDy), 0.35) << peak << " " << seed << " " << i;
      }
    }
    EXPECT_GT(counted, 2900) << peak;
  }
}

TEST(RegisterSurfaces, AContactThatMovesOverASideAndBackIsWhereItWas) {
  constexpr double kFrom = 2.5;
  constexpr int kFrames = 160;
  for (const SlipShape shape : slipShapes()) {
    SyntheticSlip slip({}, 51);
    SlipTracker tracker = registerTracker();
    for (int i = 0; i <= kFrames; ++i) {
      SyntheticContact contact;
      contact.shape = shape;
      contact.x = kFrom + 1.25 * (1.0 - std::cos(2.0 * std::numbers::pi * i / kFrames));
      const SlipMotion& motion = tracker.update(viewOf(reading(slip, contact)));
      if (i == 0) continue;
      const double moved = contact.x - kFrom;
      EXPECT_LT(std::hypot(motion.refDx - moved, motion.refDy), i == kFrames ? 0.012 : 0.035)
          << nameOf(shape) << " " << i;
    }
  }
}

}  // namespace
}  // namespace palpate::register_surfaces_test
