#include "palpate/slip/most_probable_surface.h"

#include <cmath>
#include <stdexcept>

#include "palpate/slip/learned_surface.h"

#include "slip_scene.h"
#include "testing/counted_allocations.h"
#include "testing/testing.h"

namespace palpate::most_probable_surface_test {
namespace {

using testing::idealReading;
using testing::reading;
using testing::viewOf;

const MatrixLayout kLayout = MatrixLayout::full(14, 6, 3.4);
const RegistrationOptions kRegistration{.noiseCounts = 5.0, .relativeError = 0.001};

TEST(MostProbableSurface, BeginsWithWhatItsFrameRead) {
  SyntheticSlip slip({}, 3);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    const MatrixValues values = reading(slip, contact);
    MostProbableSurface surface(kLayout);
    ASSERT_TRUE(surface.set(viewOf(values), 5.0));
    EXPECT_EQ(surface.frames(), 1);
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 6; ++x) {
        if (values(y, x) > 0.0F) {
          // Three standard deviations of the noise.
          EXPECT_NEAR(
              surface.at(static_cast<float>(x), static_cast<float>(y)).value, values(y, x), 15.0F)
              << nameOf(shape) << " " << x << " " << y;
        }
      }
  }
}

// Rms error of the values between the taxels, against a frame that was not learned from.
template <typename Surface>
double errorAfter(int frames, const SyntheticContact& start) {
  const SyntheticSensor sensor;
  SyntheticSlip slip(sensor, 3);
  Surface surface(sensor.layout);
  EXPECT_TRUE(surface.set(viewOf(reading(slip, start)), 5.0));
  for (int i = 0; i < frames; ++i) {
    SyntheticContact moved = start;
    RegistrationResult known;
    known.motion.dx = 0.5 * std::sin(0.7 * i);
    known.motion.dy = 0.5 * std::sin(1.1 * i);
    moved.x += known.motion.dx;
    moved.y += known.motion.dy;
    surface.learn(viewOf(reading(slip, moved)), known, kRegistration);
  }
  double squares = 0.0;
  int count = 0;
  for (const double shift : {-0.45, 0.25, 0.5}) {
    SyntheticContact moved = start;
    moved.x += shift;
    moved.y += 0.5;
    const MatrixValues ideal = idealReading(moved, sensor);
    for (int y = 1; y < 13; ++y)
      for (int x = 1; x < 5; ++x) {
        if (ideal(y, x) < 200.0F) continue;
        const float value =
            surface.at(static_cast<float>(x - shift), static_cast<float>(y) - 0.5F).value;
        squares += std::pow(static_cast<double>(value - ideal(y, x)), 2);
        ++count;
      }
  }
  return std::sqrt(squares / count);
}

TEST(MostProbableSurface, LearnsShapesWithEdgesFasterThanTheLearnedSurface) {
  for (const SlipShape shape : slipShapes()) {
    if (!hasEdge(shape)) continue;
    SyntheticContact start;
    start.shape = shape;
    EXPECT_LT(errorAfter<MostProbableSurface>(12, start),
              0.8 * errorAfter<LearnedSurface>(12, start))
        << nameOf(shape);
    EXPECT_LT(errorAfter<MostProbableSurface>(60, start),
              0.3 * errorAfter<MostProbableSurface>(0, start))
        << nameOf(shape);
  }
}

TEST(MostProbableSurface, RegistersAMotionOfHalfATaxel) {
  SyntheticSlip slip({}, 8);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    MostProbableSurface surface(kLayout);
    ASSERT_TRUE(surface.set(viewOf(reading(slip, contact)), 5.0));
    contact.x += 0.4;
    contact.y -= 0.3;
    const RegistrationResult found =
        registerFrame(surface, viewOf(reading(slip, contact)), {}, kRegistration);
    ASSERT_TRUE(found.converged) << nameOf(shape);
    EXPECT_NEAR(found.motion.dx, 0.4, 0.1) << nameOf(shape);
    EXPECT_NEAR(found.motion.dy, -0.3, 0.1) << nameOf(shape);
  }
}

TEST(MostProbableSurface, AllocatesNothingPerFrame) {
  SyntheticSlip slip({}, 3);
  const MatrixValues values = reading(slip, {});
  MostProbableSurface surface(kLayout);
  testing::countAllocations();
  surface.set(viewOf(values), 5.0);
  surface.learn(viewOf(values), {}, kRegistration);
  registerFrame(surface, viewOf(values), {}, kRegistration);
  EXPECT_EQ(testing::allocationsCounted(), 0);
}

TEST(MostProbableSurface, NothingIsNoKey) {
  MostProbableSurface surface(kLayout);
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  EXPECT_FALSE(surface.set(viewOf(nothing), 5.0));
  EXPECT_TRUE(surface.empty());
  EXPECT_EQ(surface.frames(), 0);
  EXPECT_FALSE(registerFrame(surface, viewOf(nothing), {}, {}).converged);
  EXPECT_THROW(registerFrame(surface, viewOf(MatrixValues::Zero(2, 2)), {}, {}),
               std::invalid_argument);
  EXPECT_NO_THROW(MostProbableSurface(MatrixLayout::full(1, 1, 3.4)));
}

TEST(MostProbableSurface, RefusesBadOptions) {
  for (const MostProbableSurfaceOptions& bad :
       {MostProbableSurfaceOptions{.priorSd = 0.0},
        MostProbableSurfaceOptions{.interpolationSd = -1.0},
        MostProbableSurfaceOptions{.belowThresholdSd = 0.0},
        MostProbableSurfaceOptions{.outsideSd = 0.0},
        MostProbableSurfaceOptions{.processNoiseRatio = -1.0},
        MostProbableSurfaceOptions{.forgottenPerFrame = 0.6},
        MostProbableSurfaceOptions{.startIterations = 0},
        MostProbableSurfaceOptions{.iterations = 0}})
    EXPECT_THROW(MostProbableSurface(kLayout, bad), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::most_probable_surface_test
