// The whole way on the emulated sensor, whose truth is known: weights on a stamp at three
// temperatures, steps found and fitted, the pressure model made, other weights at other
// temperatures read back within the stated band.
#include <cmath>

#include "palpate/calibration/pressure_map.h"

#include "calibration/stamped_sensor.h"
#include "testing/testing.h"

namespace palpate::emulated_pressure_test {
namespace {
using namespace testing;

TEST(EmulatedPressure, KnownWeightsAreReadBackWithinTheStatedBand) {
  const Calibration calibration = calibrated();
  ASSERT_EQ(calibration.samples.size(), 27u) << "one step per weight";
  for (const PressureSample& sample : calibration.samples) EXPECT_TRUE(sample.used);
  ASSERT_TRUE(calibration.pressure.valid());
  EXPECT_LT(calibration.pressure.gain.looRmse, 3.0) << "as good as the real rig";
  int read = 0, kpaInside = 0, forceInside = 0;
  std::uint64_t seed = 1000;
  for (const double degC : {31.0, 38.0, 41.0})
    for (double kpa = 25.0; kpa <= 70.0; kpa += 5.0) {
      const Profile profile = stamped(kpa, degC, seed++, 6.0);
      PressureMap map(calibration, profile.hand());
      PressureFrame out;
      TactileFrame frame;
      for (std::size_t i = 0; i < profile.numFrames(); ++i) {
        profile.readFrame(i, frame);
        map.apply(frame, profile.temperatures(0).values, out);
      }
      const MatrixPressure& contact = out.matrices[kMatrix];
      EXPECT_TRUE(contact.inRange) << kpa << " kPa at " << degC;
      EXPECT_TRUE(contact.compensated);
      ++read;
      kpaInside += std::abs(contact.kpa - kpa) <= 2.0 * contact.sdKpa ? 1 : 0;
      const double forceN = kpa * kStampMm2 * 1e-3;
      forceInside += std::abs(contact.forceN - forceN) <= 2.0 * contact.sdForceN ? 1 : 0;
      EXPECT_LT(contact.sdKpa, 5.0);
      for (std::size_t m = 0; m < out.matrices.size(); ++m)
        EXPECT_EQ(out.matrices[m].forceN > 0.0, m == kMatrix);
    }
  EXPECT_GE(kpaInside, 0.9 * read) << "of " << read;
  EXPECT_GE(forceInside, 0.9 * read) << "of " << read;
}

}  // namespace
}  // namespace palpate::emulated_pressure_test
