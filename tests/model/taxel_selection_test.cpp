#include "palpate/model/taxel_selection.h"

#include <stdexcept>

#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::taxel_selection_test {
namespace {

SensorLayout smallSensor() {
  MatrixLayout pad = MatrixLayout::full(3, 4, 3.4);
  pad.staticMask[0] = 0;  // row 0, column 0: no taxel there
  return SensorLayout({pad, MatrixLayout::full(2, 2, 3.4)});
}

TEST(TaxelSelection, TakesRectanglesWhateverTheOrderOfTheirCorners) {
  TaxelSelection selection(smallSensor());
  EXPECT_TRUE(selection.empty());
  selection.add(0, 2, 3, 1, 1);
  EXPECT_EQ(selection.count(), 6u);
  EXPECT_TRUE(selection.contains(0, 1, 1));
  EXPECT_TRUE(selection.contains(0, 2, 3));
  EXPECT_FALSE(selection.contains(0, 0, 1));
  EXPECT_FALSE(selection.contains(1, 1, 1));
}

TEST(TaxelSelection, ClampsToTheMatrixAndPassesOverPlacesWithoutATaxel) {
  TaxelSelection selection(smallSensor());
  selection.add(0, -5, -5, 0, 1);
  EXPECT_EQ(selection.count(), 1u) << "(0, 0) has no taxel";
  selection.addAll(0);
  EXPECT_EQ(selection.count(), 11u);
  selection.toggle(0, 0, 0);
  EXPECT_EQ(selection.count(), 11u);
}

TEST(TaxelSelection, TogglesAndForgets) {
  TaxelSelection selection(smallSensor());
  selection.toggle(1, 1, 0);
  EXPECT_TRUE(selection.contains(1, 1, 0));
  EXPECT_EQ(selection.mask(1), (Mask{0, 0, 1, 0}));
  selection.toggle(1, 1, 0);
  EXPECT_TRUE(selection.empty());
  selection.addAll(1);
  selection.clear();
  EXPECT_TRUE(selection.empty());
  EXPECT_EQ(selection.numMatrices(), 2u);
}

TEST(TaxelSelection, RefusesPlacesThatAreNotThere) {
  TaxelSelection selection(smallSensor());
  EXPECT_THROW((void)selection.contains(2, 0, 0), std::out_of_range);
  EXPECT_THROW((void)selection.contains(0, 3, 0), std::out_of_range);
  EXPECT_THROW((void)selection.contains(0, 0, -1), std::out_of_range);
  EXPECT_THROW(selection.toggle(0, 0, 4), std::out_of_range);
  EXPECT_THROW(selection.addAll(2), std::out_of_range);
}

TEST(TaxelSelection, AsTextAndBack) {
  const SensorLayout sensor = smallSensor();
  TaxelSelection selection(sensor);
  EXPECT_EQ(selection.text(), "");
  selection.add(0, 0, 1, 0, 2);
  selection.toggle(1, 1, 1);
  EXPECT_EQ(selection.text(), "0:1,2;1:3");
  EXPECT_EQ(TaxelSelection::fromText("0:1,2;1:3", sensor), selection);
  EXPECT_EQ(TaxelSelection::fromText("", sensor), TaxelSelection(sensor));
  for (const char* bad :
       {"0", "0:", "0:0", "0:12", "2:1", "0:1,", "0:1;", "0:1 ", "x", "0:1;;1:3", "-1:2"})
    EXPECT_FALSE(TaxelSelection::fromText(bad, sensor)) << bad;
}

TEST(TaxelSelection, KnowsItsSensor) {
  const TaxelSelection selection(smallSensor());
  EXPECT_TRUE(selection.sameSensor(TaxelSelection(smallSensor())));
  EXPECT_FALSE(selection.sameSensor(TaxelSelection()));
}

}  // namespace
}  // namespace palpate::taxel_selection_test
