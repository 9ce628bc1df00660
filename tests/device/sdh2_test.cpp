#include "palpate/device/sdh2.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/model/hand_file.h"

namespace palpate::sdh2_test {
namespace {

// Figures of the manual and of the survey of recordings.
TEST(Sdh2, IsTheHandWithTheDsaController) {
  EXPECT_EQ(sdh2().layout->numTaxels(), 456u);
  EXPECT_EQ(sdh2().axes.size(), 7u);
  EXPECT_EQ(sdh2().temperatureSensors.size(), 9u);
  EXPECT_EQ(sdh2().saturationCounts, kSdh2SaturationCounts);
  EXPECT_EQ(sdh2().maximumCounts, 4095.0F);
  EXPECT_EQ(sdh2().file->controller, "DSACON32-M");
  EXPECT_EQ(sdh2().file, defaultHand().file) << "it is the hand that is meant where none is named";
}

TEST(Sdh2, HasPreshapesOfSevenAxes) {
  EXPECT_EQ(sdh2Preshapes().size(), 8u);
  for (const Preshape& preshape : sdh2Preshapes()) EXPECT_EQ(preshape.joints.size(), 7u);
  EXPECT_EQ(sdh2Preshape("centrical").name, "centrical");
  EXPECT_THROW(sdh2Preshape("fist"), std::invalid_argument);
  EXPECT_EQ(sdh2Sensor().matrices.size(), 6u);
}

}  // namespace
}  // namespace palpate::sdh2_test
