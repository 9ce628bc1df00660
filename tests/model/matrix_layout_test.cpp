#include "palpate/model/matrix_layout.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "testing/testing.h"

namespace palpate::matrix_layout_test {
namespace {

TEST(MatrixLayout, CountsPlacesTaxelsAndEnabledOnes) {
  MatrixLayout layout = MatrixLayout::full(2, 3, 3.4);
  layout.staticMask[0] = 0;
  layout.dynamicMask[5] = 0;
  EXPECT_EQ(layout.numCells(), 6u);
  EXPECT_EQ(layout.numTaxels(), 5u);
  EXPECT_EQ(layout.numEnabled(), 4u);
  EXPECT_FALSE(layout.exists(0, 0));
  EXPECT_TRUE(layout.exists(1, 2));
  EXPECT_FALSE(layout.enabled(1, 2));
  EXPECT_FALSE(layout.exists(2, 0));
  EXPECT_FALSE(layout.exists(0, -1));
  EXPECT_DOUBLE_EQ(layout.taxelAreaMm2(), 3.4 * 3.4);
}

TEST(MatrixLayout, RefusesNonsense) {
  EXPECT_THROW(MatrixLayout::full(0, 3, 3.4), std::invalid_argument);
  EXPECT_THROW(MatrixLayout::full(3, 257, 3.4), std::invalid_argument);
  EXPECT_THROW(MatrixLayout::full(65535, 65535, 3.4), std::invalid_argument);
  EXPECT_THROW(MatrixLayout::full(-1, -1, 3.4), std::invalid_argument);
  EXPECT_THROW(MatrixLayout::full(3, 3, 0.0), std::invalid_argument);
  EXPECT_THROW(MatrixLayout::full(3, 3, std::nan("")), std::invalid_argument);
  MatrixLayout layout = MatrixLayout::full(3, 3, 1.0);
  layout.dynamicMask.pop_back();
  EXPECT_THROW(layout.validate(), std::invalid_argument);
}

TEST(TaxelPitch, IsOneNumberOrTwo) {
  const TaxelPitch square = 3.4, novel(5.28, 10.28);
  EXPECT_TRUE(square.isSquare());
  EXPECT_FALSE(novel.isSquare());
  EXPECT_DOUBLE_EQ(novel.areaMm2(), 54.2784);
  EXPECT_DOUBLE_EQ(square.lengthMm(3.0, -4.0), 17.0);
  EXPECT_DOUBLE_EQ(TaxelPitch(2.0, 6.0).lengthMm(1.5, 2.0 / 3.0), 5.0);
  EXPECT_EQ(pitchJson(square).text(-1), "3.4");
  EXPECT_EQ(pitchJson(novel).text(-1), "[5.28,10.28]");
  EXPECT_EQ(pitchText(square), "3.4 mm");
  EXPECT_EQ(pitchText(novel), "5.28 x 10.28 mm");
  EXPECT_EQ(pitchText(novel, 1), "5.3 x 10.3 mm");
}

TEST(TaxelPitch, BelongsToTheLayout) {
  const MatrixLayout matrix = MatrixLayout::full(2, 3, {5.28, 10.28});
  EXPECT_DOUBLE_EQ(matrix.taxelAreaMm2(), 54.2784);
  EXPECT_FALSE(matrix == MatrixLayout::full(2, 3, 5.28));
  EXPECT_FALSE(SensorLayout({MatrixLayout::full(2, 3, 5.28), matrix}).hasSquareTaxels());
  EXPECT_TRUE(SensorLayout({MatrixLayout::full(2, 3, 5.28)}).hasSquareTaxels());
  for (const double wrong : {0.0, -1.0, 1001.0, std::nan("")}) {
    EXPECT_THROW(MatrixLayout::full(2, 3, {5.28, wrong}), std::invalid_argument) << wrong;
    EXPECT_THROW(MatrixLayout::full(2, 3, {wrong, 5.28}), std::invalid_argument) << wrong;
  }
}

TEST(SensorLayout, PutsMatricesOneAfterTheOther) {
  const SensorLayout layout({MatrixLayout::full(2, 3, 3.4), MatrixLayout::full(4, 5, 1.0)});
  EXPECT_EQ(layout.numMatrices(), 2u);
  EXPECT_EQ(layout.numCells(), 26u);
  EXPECT_EQ(layout.offset(0), 0u);
  EXPECT_EQ(layout.offset(1), 6u);
  EXPECT_THROW(layout.offset(2), std::out_of_range);
  EXPECT_THROW(SensorLayout(std::vector<MatrixLayout>{}), std::invalid_argument);
}

TEST(RequireMatrix, SaysWhichTheSensorHas) {
  const SensorLayout layout({MatrixLayout::full(2, 2, 1.0), MatrixLayout::full(3, 3, 1.0)});
  EXPECT_NO_THROW(requireMatrix("a.dsa", layout, std::nullopt));
  EXPECT_NO_THROW(requireMatrix("a.dsa", layout, 1));
  try {
    requireMatrix("a.dsa", layout, 2);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.dsa: has no matrix 2, only 0..1");
  }
}

}  // namespace
}  // namespace palpate::matrix_layout_test
