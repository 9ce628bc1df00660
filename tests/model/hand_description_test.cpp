#include "palpate/model/hand_description.h"

#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::hand_description_test {
namespace {

TEST(HandDescription, Sdh2HasTheSensorsOfTheSurvey) {
  const HandDescription& hand = sdh2();
  ASSERT_EQ(hand.layout->numMatrices(), 6u);
  EXPECT_EQ(hand.layout->numCells(), 486u);
  EXPECT_EQ(hand.layout->numTaxels(), 456u);
  for (std::size_t m = 0; m < 6; ++m) {
    const MatrixLayout& matrix = hand.layout->matrix(m);
    EXPECT_EQ(matrix.rows, m % 2 == 0 ? 14 : 13);
    EXPECT_EQ(matrix.columns, 6);
    EXPECT_EQ(matrix.numTaxels(), m % 2 == 0 ? 84u : 68u);
  }
  EXPECT_EQ(hand.axes.size(), 7u);
  EXPECT_EQ(hand.temperatureSensors.size(), 9u);
  EXPECT_EQ(hand.matrixName(1), "finger 0 distal");
  EXPECT_EQ(hand.matrixName(4), "finger 2 proximal");
}

TEST(HandDescription, FingertipsLackTheirUpperCorners) {
  const MatrixLayout& distal = sdh2().layout->matrix(3);
  for (int y = 0; y < 13; ++y) {
    EXPECT_EQ(distal.exists(y, 0), y >= 5) << y;
    EXPECT_EQ(distal.exists(y, 5), y >= 5) << y;
    EXPECT_TRUE(distal.exists(y, 1)) << y;
  }
}

TEST(HandDescription, FingersStandSideBySideWithTheirTipsOnTop) {
  for (std::size_t m = 0; m < 6; ++m) {
    const MatrixDescription& matrix = sdh2().matrices[m];
    EXPECT_EQ(matrix.pictureColumn, static_cast<int>(m / 2));
    EXPECT_EQ(matrix.pictureRow, m % 2 == 1 ? 0 : 1);
  }
}

TEST(HandDescription, RecognisesTheSdh2BySizesAndKeepsTheFilesMasks) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[0].dynamicMask.assign(84, 0);
  const HandDescription hand = describeHand(SensorLayout(matrices), 7, 9);
  EXPECT_EQ(hand.name, sdh2().name);
  EXPECT_EQ(hand.layout->matrix(0).numEnabled(), 0u);
  EXPECT_EQ(hand.axes[6].name, "finger 2 distal");
}

TEST(HandDescription, EachMatrixHasItsOwnSaturation) {
  HandDescription hand = describeHand(
      SensorLayout({MatrixLayout::full(1, 2, 1.0), MatrixLayout::full(1, 2, 1.0)}), 0, 0);
  hand.maximumCounts = hand.saturationCounts = 1000.0F;
  hand.matrices[1].maximumCounts = 250.0F;
  hand.matrices[1].saturationCounts = 200.0F;
  EXPECT_EQ(hand.maximumOf(0), 1000.0F);
  EXPECT_EQ(hand.maximumOf(1), 250.0F);
  EXPECT_EQ(hand.saturationOf(7), 1000.0F) << "no such matrix";
  EXPECT_EQ(hand.saturationText(), "200 or 1000");
  TactileFrame frame;
  frame.layout = hand.layout;
  frame.values = {999.0F, 1000.0F, 199.0F, 250.0F};
  EXPECT_EQ(numSaturated(hand, frame), 2u);
  frame.values.pop_back();
  EXPECT_EQ(numSaturated(hand, frame), 0u) << "a frame of another sensor";
}

TEST(HandDescription, DescribesWhatItDoesNotKnow) {
  const HandDescription hand = describeHand(SensorLayout({MatrixLayout::full(2, 3, 1.0),
                                                          MatrixLayout::full(2, 3, 1.0),
                                                          MatrixLayout::full(2, 3, 1.0)}),
                                            2,
                                            1);
  EXPECT_EQ(hand.matrixName(2), "matrix 2");
  EXPECT_EQ(hand.matrixName(7), "matrix 7");
  EXPECT_EQ(hand.matrices[2].pictureColumn, 0);  // three matrices: a grid of two columns
  EXPECT_EQ(hand.matrices[2].pictureRow, 1);
  EXPECT_EQ(hand.axes.size(), 2u);
  EXPECT_EQ(hand.temperatureSensors.size(), 1u);
}

}  // namespace
}  // namespace palpate::hand_description_test
