#include "gui/appearance/hand_unit.h"

#include <gtest/gtest.h>

#include <palpate/model/hand_file.h>

namespace palpate::gui::hand_unit_test {
namespace {

HandDescription scaled(float fullScale) {
  HandDescription hand = builtInHand("flat_pad_16x16");
  hand.maximumCounts = fullScale;
  return hand;
}

TEST(HandUnit, FullScaleHasThreeDigits) {
  EXPECT_EQ(decimalsOf(scaled(65535.0F)), 0);
  EXPECT_EQ(decimalsOf(scaled(100.0F)), 0);
  EXPECT_EQ(decimalsOf(scaled(40.0F)), 1);
  EXPECT_EQ(decimalsOf(scaled(10.0F)), 1);
  EXPECT_EQ(decimalsOf(scaled(1.0F)), 2);
  EXPECT_EQ(decimalsOf(scaled(1e-9F)), 6);
}

TEST(HandUnit, IsThatOfTheDescription) {
  EXPECT_EQ(unitOf(builtInHand("sdh2")), "counts");
  EXPECT_EQ(unitOf(builtInHand("sole")), "kPa");
}

}  // namespace
}  // namespace palpate::gui::hand_unit_test
