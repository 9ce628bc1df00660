#include "palpate/signals/characteristic_signals.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/filter/recipe.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include <palpate/model/hand_description.h>

#include "testing/testing.h"

namespace palpate::characteristic_signals_test {
namespace {

TEST(CharacteristicSignals, OfAMatrixComputedByHand) {
  const MatrixLayout layout = MatrixLayout::full(5, 5, 2.0);
  MatrixValues values = MatrixValues::Zero(5, 5);
  values(2, 2) = 16.0F;
  values(0, 4) = 8.0F;
  const CharacteristicSignals signals = characteristicSignals(values, layout);
  EXPECT_DOUBLE_EQ(signals.mean, 12.0);
  EXPECT_DOUBLE_EQ(signals.minimum, 8.0);
  EXPECT_DOUBLE_EQ(signals.maximum, 16.0);
  EXPECT_DOUBLE_EQ(signals.sum, 24.0);
  EXPECT_EQ(signals.active, 2);
  EXPECT_DOUBLE_EQ(signals.areaMm2, 8.0);
  // [1 2 1]/4 both ways, border replicated. The middle spreads 16 over 9 taxels: 4, 4 x 2, 4 x 1.
  // The corner: 8 * 9/16 = 4.5 in the corner, 8 * 3/16 = 1.5 on both sides, 8 * 1/16 = 0.5 on the
  // diagonal, which the middle's patch also reaches (1 + 0.5). 12 taxels are active, sum 24.
  EXPECT_NEAR(signals.filteredMean, 24.0 / 12.0, 1e-4);
}

TEST(CharacteristicSignals, OfAPartOfAMatrixLookAtThatPartOnly) {
  MatrixValues values = MatrixValues::Constant(4, 4, 1000.0F);
  values.block(1, 1, 2, 2) << 1.0F, 2.0F, 3.0F, 6.0F;
  const CharacteristicSignals signals =
      characteristicSignals(values.block(1, 1, 2, 2), MatrixLayout::full(2, 2, 1.0));
  EXPECT_DOUBLE_EQ(signals.sum, 12.0);
  EXPECT_DOUBLE_EQ(signals.maximum, 6.0);
}

TEST(CharacteristicSignals, OfAnEmptyMatrixAreZero) {
  const CharacteristicSignals signals =
      characteristicSignals(MatrixValues::Zero(3, 3), MatrixLayout::full(3, 3, 1.0));
  EXPECT_EQ(signals.mean, 0.0);
  EXPECT_EQ(signals.filteredMean, 0.0);
  EXPECT_EQ(signals.minimum, 0.0);
  EXPECT_EQ(signals.maximum, 0.0);
  EXPECT_EQ(signals.active, 0);
}

TEST(CharacteristicSignals, OfTheWholeFrameAverageTaxelsNotMatrices) {
  TactileFrame frame(sdh2().layout);
  frame.matrix(0)(3, 3) = 100.0F;
  frame.matrix(1)(8, 2) = 200.0F;
  frame.matrix(1)(8, 3) = 300.0F;
  const CharacteristicSignals whole = wholeFrameSignals(frame);
  EXPECT_DOUBLE_EQ(whole.mean, 200.0);
  EXPECT_DOUBLE_EQ(whole.minimum, 100.0);
  EXPECT_DOUBLE_EQ(whole.maximum, 300.0);
  EXPECT_EQ(whole.active, 3);
  EXPECT_NEAR(whole.areaMm2, 3 * 3.4 * 3.4, 1e-9);
  EXPECT_EQ(characteristicSignals(frame).size(), 6u);
  EXPECT_DOUBLE_EQ(characteristicSignals(frame)[1].mean, 250.0);
}

Profile threeFrames() {
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  builder.addFrame(1000, values);
  values[100] = 50.0F;
  builder.addFrame(2000, values);
  values[100] = 20.0F;
  builder.addFrame(3000, values);
  return builder.finish({});
}

TEST(SignalTable, HoldsEveryFrameAndFindsTheLargestSum) {
  const SignalTable table = SignalTable::of(threeFrames());
  EXPECT_EQ(table.numFrames(), 3u);
  EXPECT_EQ(table.numMatrices(), 6u);
  EXPECT_EQ(table.at(2, 1).sum, 20.0);  // place 100 is in matrix 1 (84..161)
  EXPECT_EQ(table.at(0, 1).sum, 0.0);
  EXPECT_EQ(table.frameOfLargestSum(), 1u);
  EXPECT_THROW(table.at(3, 0), std::out_of_range);
  EXPECT_THROW(table.at(0, 6), std::out_of_range);
}

// analyst M7. By hand: taxels that have left the contact hold 100, 100 and 1 (less than 1 % of
// 600).
TEST(CharacteristicSignals, MeansOfAFilteredFrameCountTheTaxelsThatStillHoldAValue) {
  MatrixLayout layout = MatrixLayout::full(1, 4, 2.0);
  TactileFrame frame(std::make_shared<const SensorLayout>(std::vector<MatrixLayout>{layout}));
  frame.setFiltered({600.0F, 100.0F, 100.0F, 1.0F}, {true, false, false, false});
  const CharacteristicSignals signals = characteristicSignals(frame, 0);
  EXPECT_DOUBLE_EQ(signals.mean, 800.0 / 3.0);
  EXPECT_DOUBLE_EQ(signals.sum, 600.0) << "of the contact";
  EXPECT_EQ(signals.active, 1);
  EXPECT_EQ(signals.areaMm2, 4.0);
  EXPECT_EQ(signals.minimum, 600.0);
  EXPECT_EQ(signals.maximum, 600.0);
  EXPECT_DOUBLE_EQ(wholeFrameSignals(frame).mean, 800.0 / 3.0);
  // A contact is never longer than the recorded one.
  frame.setFiltered({600.0F, 100.0F, 100.0F, 1.0F}, {false, false, false, false});
  EXPECT_EQ(characteristicSignals(frame, 0).mean, 0.0);
  EXPECT_EQ(characteristicSignals(frame, 0).filteredMean, 0.0);
}

// analyst M7: the weak taxels leave a contact first; what a filter over time still holds of the
// strong ones must not become a mean that was never measured.
TEST(CharacteristicSignals, TheMeanOfFilteredValuesNeverExceedsWhatWasMeasured) {
  HandDescription hand;
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(5, 4, 2.0)});
  ProfileBuilder builder(hand);
  for (int i = 0; i < 90; ++i) {
    std::vector<float> values(20, 0.0F);
    const float load = i < 10   ? 0.0F
                       : i < 50 ? 1.0F
                                : std::max(0.0F, 1.0F - 0.12F * static_cast<float>(i - 50));
    // Each taxel has a threshold of 60 counts, as a sensor has.
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = std::max(0.0F, std::round(load * 50.0F * static_cast<float>(k + 1) - 60.0F));
    builder.addFrame(i * 31'000, values);
  }
  const Profile profile = builder.finish({});
  const SignalTable measured = SignalTable::of(profile);
  for (const char* filter : {"kalman", "kalman:q=0.1", "running-mean:window=7", "rts"}) {
    const Recipe recipe = parseRecipe(std::vector<std::string>{filter});
    const SignalTable table = SignalTable::of(filteredProfile(profile, recipe));
    for (const SignalKind kind : {SignalKind::kMean, SignalKind::kFilteredMean}) {
      double largest = 0.0;
      for (std::size_t i = 0; i < 90; ++i)
        largest = std::max(largest, valueOf(measured.at(i, 0), kind));
      for (std::size_t i = 0; i < 90; ++i)
        EXPECT_LE(valueOf(table.at(i, 0), kind), largest)
            << filter << ", frame " << i << ", " << signalName(kind);
    }
  }
}

TEST(SignalTable, CanBeCancelled) {
  EXPECT_THROW(SignalTable::of(threeFrames(), [](double) { return false; }), Cancelled);
}

TEST(CharacteristicSignals, AllInOneAreTheSameNumbers) {
  TactileFrame frame(sdh2().layout);
  frame.matrix(0)(3, 3) = 100.0F;
  frame.matrix(1)(8, 2) = 200.0F;
  frame.matrix(1)(8, 3) = 300.0F;
  std::vector<CharacteristicSignals> rows(3);
  allSignals(frame, rows);
  auto expected = characteristicSignals(frame);
  expected.push_back(wholeFrameSignals(frame));
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const SignalKind kind : kAllSignalKinds)
      EXPECT_EQ(valueOf(rows[i], kind), valueOf(expected[i], kind)) << "row " << i;
}

TEST(CharacteristicSignals, OfReadingsHaveTheSumsOfTheirComponents) {
  MatrixLayout matrix = MatrixLayout::full(1, 3, 2.0);
  matrix.touch = {.components = 3, .isSigned = true, .threshold = 5.0F};
  matrix.dynamicMask[2] = 0;
  TactileFrame frame(std::make_shared<SensorLayout>(std::vector{matrix, matrix}));
  // Taxels that aren't touched count, those that aren't scanned don't.
  frame.readings = {3, -2, 60, 0, 0, 1, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const auto rest = std::make_shared<Baseline>();
  rest->rest = std::vector<float>(18, 0.0F);
  rest->rest[4] = 2.0F;  // y of the second taxel
  decideTouch(frame, rest);
  std::vector<CharacteristicSignals> rows;
  allSignals(frame, rows);
  const std::array<double, 3> expected = {3.0, -4.0, 61.0};
  EXPECT_EQ(rows.at(0).force, expected);
  EXPECT_EQ(characteristicSignals(frame, 0).force, expected);
  EXPECT_EQ(valueOf(rows[0], SignalKind::kX), 3.0);
  EXPECT_EQ(valueOf(rows[0], SignalKind::kY), -4.0);
  EXPECT_EQ(valueOf(rows[0], SignalKind::kZ), 61.0);
  EXPECT_DOUBLE_EQ(valueOf(rows[0], SignalKind::kNorm), std::sqrt(9.0 + 16.0 + 3721.0));
  EXPECT_EQ(valueOf(rows[1], SignalKind::kNorm), 0.0);
  EXPECT_TRUE(std::isnan(rows.at(2).force[2])) << "each matrix has axes of its own";
  frame.readings.clear();  // as filters do
  EXPECT_TRUE(std::isnan(characteristicSignals(frame, 0).force[2]));
  EXPECT_EQ(characteristicSignals(TactileFrame(sdh2().layout), 0).force[2], 0.0);
}

TEST(SignalKinds, ComponentsAreThoseOfReadingsOnly) {
  ASSERT_EQ(signalKinds(false).size(), kAllSignalKinds.size());
  EXPECT_TRUE(std::ranges::equal(signalKinds(false), kAllSignalKinds));
  ASSERT_EQ(signalKinds(true).size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(signalKinds(true)[i]), i);
    EXPECT_EQ(isComponent(signalKinds(true)[i]), i >= 7);
    EXPECT_EQ(signalKindNamed(signalName(signalKinds(true)[i])), signalKinds(true)[i]);
  }
  EXPECT_EQ(signalName(SignalKind::kNorm), "norm");
}

// docs/manual/columns.md: the columns of palpate signals.
TEST(SignalNames, AreThoseOfTheTables) {
  std::set<std::string_view> names;
  for (const SignalKind kind : kAllSignalKinds) {
    EXPECT_EQ(signalKindNamed(signalName(kind)), kind);
    names.insert(signalName(kind));
  }
  EXPECT_EQ(names,
            (std::set<std::string_view>{
                "mean", "filtered_mean", "min", "max", "sum", "active", "area_mm2"}));
  EXPECT_EQ(signalKindNamed("median"), std::nullopt);
}

using Row = std::vector<std::string>;

TEST(SignalTextTable, ARowPerMatrixAndAllLast) {
  const HandDescription hand = sdh2();
  TactileFrame frame(hand.layout);
  frame.matrix(1)(7, 2) = 100.0F;
  frame.matrix(1)(7, 3) = 300.0F;
  frame.matrix(4)(0, 0) = 50.0F;
  const TextTable table = signalTextTable(frame, hand);
  ASSERT_EQ(table.numRows, hand.matrices.size() + 1);
  ASSERT_EQ(table.header.size(), 8u);
  const Row one = table.row(1);
  EXPECT_EQ(one[0], hand.matrixName(1));
  EXPECT_EQ(one[1], "2");
  EXPECT_EQ(one[2], "200");  // the mean of 100 and 300
  EXPECT_EQ(one[4], "300");
  EXPECT_EQ(one[5], "100");
  EXPECT_EQ(one[6], "400");
  EXPECT_DOUBLE_EQ(std::stod(one[7]), 2 * 3.4 * 3.4);  // two taxels of 3.4 mm
  const Row all = table.row(hand.matrices.size());
  EXPECT_EQ(all[0], "all");
  EXPECT_EQ(all[1], "3");
  EXPECT_EQ(all[2], "150");
  EXPECT_EQ(all[6], "450");
  EXPECT_EQ(table.row(0)[1], "0") << "nothing touches this matrix";
}

}  // namespace
}  // namespace palpate::characteristic_signals_test
