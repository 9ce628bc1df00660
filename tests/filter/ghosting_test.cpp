#include "palpate/filter/ghosting.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::ghosting_test {
namespace {

constexpr int kRows = 4, kColumns = 5;
constexpr std::size_t kPlaces = kRows * kColumns;
constexpr std::int64_t kIntervalUs = 30'000;

// Two matrices of 4 x 5 taxels.
std::shared_ptr<const SensorLayout> twoMatrices() {
  return std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>(2, MatrixLayout::full(kRows, kColumns, 1.0)));
}

struct Value {
  std::size_t frame, place;  // places of the second matrix: from 20
  float counts;
};

class GhostingTest : public ::testing::Test {
 protected:
  static Profile profileOf(std::size_t frames,
                           const std::vector<Value>& values,
                           std::shared_ptr<const SensorLayout> layout = twoMatrices()) {
    ProfileBuilder builder(layout);
    for (std::size_t i = 0; i < frames; ++i) {
      std::vector<float> all(layout->numCells(), 0.0F);
      for (const Value& value : values)
        if (value.frame == i) all[value.place] = value.counts;
      builder.addFrame(static_cast<std::int64_t>(i) * kIntervalUs, all);
    }
    return builder.finish({});
  }
  // The taxel is touched in the frames `from`..`to`, both inclusive.
  static void touch(std::vector<CellTruthMask>& truth,
                    std::size_t place,
                    std::size_t from,
                    std::size_t to,
                    CellTruth how = CellTruth::kTouched) {
    for (std::size_t i = from; i <= to; ++i) truth.at(i).at(place) = how;
  }
  static std::vector<CellTruthMask> untouched(std::size_t frames) {
    return std::vector<CellTruthMask>(frames, CellTruthMask(2 * kPlaces, CellTruth::kNothing));
  }
  static Recipe recipe(const std::string& text) { return parseRecipe(std::array{text}); }
};

void expectCounts(const BeforeAfter& got, std::uint64_t before, std::uint64_t after) {
  EXPECT_EQ(got.before, before);
  EXPECT_EQ(got.after, after);
}

TEST_F(GhostingTest, LoneTaxelsGoAndALiftedMatrixStays) {
  // Frame 0: one ghost; 1: none; 2: one in each matrix; 3: all 20 taxels of matrix 1.
  std::vector<Value> values = {{0, 7, 1.0F}, {2, 12, 2.0F}, {2, 20 + 7, 1.0F}};
  for (std::size_t i = 0; i < kPlaces; ++i) values.push_back({3, 20 + i, 2.0F});
  const GhostingReport report =
      measureGhosting(profileOf(4, values), recipe("median:size=3,masked=1"));
  EXPECT_EQ(report.frames, 4u);
  expectCounts(report.framesWithFalse, 3, 1);
  ASSERT_EQ(report.matrices.size(), 2u);
  expectCounts(report.matrices[0].falseTaxels, 2, 0);
  expectCounts(report.matrices[0].scattered, 2, 0);
  expectCounts(report.matrices[0].framesWithFalse, 2, 0);
  expectCounts(report.matrices[0].framesWhole, 0, 0);
  expectCounts(report.matrices[1].falseTaxels, 21, 20);
  expectCounts(report.matrices[1].scattered, 1, 0);
  expectCounts(report.matrices[1].framesWithFalse, 2, 1);
  expectCounts(report.matrices[1].framesWhole, 1, 1);
  const MatrixGhosting total = report.total();
  expectCounts(total.falseTaxels, 23, 20);
  expectCounts(total.framesWithFalse, 4, 1);
  EXPECT_DOUBLE_EQ(total.falseTaxels.fractionRemoved(), 3.0 / 23.0);
  EXPECT_DOUBLE_EQ(total.scattered.fractionRemoved(), 1.0);
  EXPECT_TRUE(report.contacts.empty());
  EXPECT_TRUE(std::isnan(report.touched.fractionRemoved()));
  EXPECT_EQ(report.latencyFrames, 0);
  EXPECT_GT(report.costUs, 0.0);
}

TEST_F(GhostingTest, AQuarterOfTheTaxelsIsNotAWholeMatrix) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < 5; ++i) values.push_back({0, i, 1.0F});
  for (std::size_t i = 0; i < 6; ++i) values.push_back({1, i, 1.0F});
  const Profile profile = profileOf(2, values);
  expectCounts(measureGhosting(profile, {}).matrices[0].framesWhole, 1, 1);
  expectCounts(measureGhosting(profile, {}).matrices[0].scattered, 5, 5);
  expectCounts(
      measureGhosting(profile, {}, {}, {.wholeMatrixFraction = 0.3}).total().framesWhole, 0, 0);
}

// A minimum over two frames shows a contact a frame later, with the value that was before.
TEST_F(GhostingTest, ContactsComeLaterAndShortOnesAreHidden) {
  auto truth = untouched(12);
  touch(truth, 7, 2, 5);
  touch(truth, 20 + 3, 8, 8);
  const Profile profile = profileOf(
      12, {{2, 7, 10.0F}, {3, 7, 20.0F}, {4, 7, 30.0F}, {5, 7, 30.0F}, {8, 20 + 3, 50.0F}});
  const GhostingReport report = measureGhosting(profile, recipe("temporal-min:window=2"), truth);
  EXPECT_EQ(report.latencyFrames, 1);
  expectCounts(report.framesWithFalse, 0, 0);
  expectCounts(report.touched, 5, 3);
  EXPECT_DOUBLE_EQ(report.touched.fractionRemoved(), 0.4);
  EXPECT_DOUBLE_EQ(report.touchedSumBefore, 140.0);
  EXPECT_DOUBLE_EQ(report.touchedSumAfter, 60.0);
  ASSERT_EQ(report.contacts.size(), 2u);
  const ContactGhosting& first = report.contacts[0];
  EXPECT_EQ(first.matrix, 0u);
  EXPECT_EQ(first.begin, 2u);
  EXPECT_EQ(first.end, 6u);
  EXPECT_EQ(first.firstBefore, 2u);
  EXPECT_EQ(first.firstAfter, 3u);
  EXPECT_EQ(first.delayFrames(), 1);
  expectCounts(first.taxels, 4, 3);
  EXPECT_DOUBLE_EQ(first.sumBefore, 90.0);
  EXPECT_DOUBLE_EQ(first.sumAfter, 60.0);
  EXPECT_EQ(report.contacts[1].matrix, 1u);
  EXPECT_EQ(report.contacts[1].firstAfter, std::nullopt);
  EXPECT_EQ(report.hidden(), 1u);
  EXPECT_DOUBLE_EQ(report.meanDelayFrames(), 1.0);
  EXPECT_DOUBLE_EQ(report.largestDelayFrames(), 1.0);
}

// A filter that remembers shows a contact that has gone: false taxels that were not there before.
TEST_F(GhostingTest, WhatStaysBehindAContactIsFalse) {
  auto truth = untouched(9);
  touch(truth, 7, 3, 4);
  const Profile profile = profileOf(9, {{3, 7, 30.0F}, {4, 7, 30.0F}});
  const GhostingReport report = measureGhosting(profile, recipe("running-mean:window=3"), truth);
  expectCounts(report.matrices[0].falseTaxels, 0, 2);
  EXPECT_TRUE(std::isnan(report.matrices[0].falseTaxels.fractionRemoved()));
  expectCounts(report.touched, 2, 2);
  EXPECT_EQ(report.contacts.at(0).delayFrames(), 0);
  // A mean over three frames is 10, 20, then 20, 10 counts.
  const auto above = [&](double counts) {
    return measureGhosting(
        profile, recipe("running-mean:window=3"), truth, {.activeAboveCounts = counts});
  };
  expectCounts(above(10.0).matrices[0].falseTaxels, 0, 1);
  EXPECT_EQ(above(10.0).contacts.at(0).delayFrames(), 1);
}

TEST_F(GhostingTest, FramesThatAreHeldBackBelongToTheirOwnTruth) {
  auto truth = untouched(9);
  touch(truth, 7, 4, 4);
  const Profile profile = profileOf(9, {{4, 7, 30.0F}});
  const GhostingReport report =
      measureGhosting(profile, recipe("running-mean:window=3,centred=1"), truth);
  EXPECT_EQ(report.frames, 9u);
  expectCounts(report.matrices[0].falseTaxels, 0, 2);  // frames 3 and 5
  expectCounts(report.touched, 1, 1);
  EXPECT_EQ(report.contacts.at(0).delayFrames(), 0);
}

TEST_F(GhostingTest, FaintContactIsNeitherTrueNorFalse) {
  auto truth = untouched(3);
  touch(truth, 7, 0, 2, CellTruth::kFaint);
  const GhostingReport report = measureGhosting(profileOf(3, {{1, 7, 1.0F}}), {}, truth);
  expectCounts(report.total().falseTaxels, 0, 0);
  expectCounts(report.touched, 0, 0);
  EXPECT_TRUE(report.contacts.empty());
}

TEST_F(GhostingTest, AContactMayNeedSeveralTaxels) {
  auto truth = untouched(6);
  touch(truth, 7, 1, 4);
  touch(truth, 8, 1, 4);
  const Profile profile = profileOf(
      6, {{1, 7, 5.0F}, {2, 7, 5.0F}, {3, 7, 5.0F}, {3, 8, 5.0F}, {4, 7, 5.0F}, {4, 8, 5.0F}});
  const auto contacts = [&](int least) {
    return measureGhosting(profile, recipe("temporal-min:window=2"), truth, {.minTaxels = least})
        .contacts;
  };
  EXPECT_EQ(contacts(1).at(0).firstBefore, 1u);
  EXPECT_EQ(contacts(1).at(0).firstAfter, 2u);
  EXPECT_EQ(contacts(2).at(0).firstBefore, 3u);
  EXPECT_EQ(contacts(2).at(0).firstAfter, 4u);
  EXPECT_TRUE(contacts(3).empty());  // never seen before the filter either
}

// The same taxel flickers through two minima of a stretch, and through none that begins anew.
TEST_F(GhostingTest, FiltersOverTimeBeginAnewWhereTheyShould) {
  const Profile profile = profileOf(4, {{2, 7, 1.0F}});
  const Recipe minimum = recipe("temporal-min:window=2");
  expectCounts(measureGhosting(profile, minimum).total().falseTaxels, 1, 0);
  const auto restarted = measureGhosting(profile, minimum, {}, {.restartsUs = {2 * kIntervalUs}});
  expectCounts(restarted.total().falseTaxels, 1, 1);
}

TEST_F(GhostingTest, MaskedTaxelsDoNotCount) {
  std::vector<MatrixLayout> matrices(2, MatrixLayout::full(kRows, kColumns, 1.0));
  matrices[0].dynamicMask[7] = 0;
  const auto layout = std::make_shared<const SensorLayout>(matrices);
  const auto report = measureGhosting(profileOf(1, {{0, 7, 9.0F}, {0, 8, 9.0F}}, layout), {});
  expectCounts(report.total().falseTaxels, 1, 1);
}

TEST_F(GhostingTest, OfNothingThereIsNothingToSay) {
  const GhostingReport report = measureGhosting(profileOf(0, {}), recipe("median3d"));
  EXPECT_EQ(report.frames, 0u);
  expectCounts(report.total().falseTaxels, 0, 0);
  EXPECT_TRUE(std::isnan(report.meanDelayFrames()));
  EXPECT_TRUE(std::isnan(report.largestDelayFrames()));
  EXPECT_EQ(report.costUs, 0.0);
}

// Counted by a Python script that shares nothing with this program (bz2, xml, struct), the minimum
// of two frames too.
TEST_F(GhostingTest, CountsTheRealRecordingAsAnIndependentScriptDoes) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Profile profile =
      openRecording(*folder / "misc" / "ghosting_motivation_threshold_calibration.dsa");
  const GhostingReport report = measureGhosting(profile, recipe("temporal-min:window=2"));
  EXPECT_EQ(report.frames, 541u);
  expectCounts(report.framesWithFalse, 488, 486);
  expectCounts(report.total().falseTaxels, 38827, 34593);
  const std::array<std::uint64_t, 6> all = {1598, 26752, 0, 11, 0, 10466};
  const std::array<std::uint64_t, 6> scattered = {1598, 605, 0, 11, 0, 3};
  const std::array<std::uint64_t, 6> frames = {160, 488, 0, 9, 0, 162};
  const std::array<std::uint64_t, 6> whole = {0, 446, 0, 0, 0, 159};
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(report.matrices[m].falseTaxels.before, all[m]);
    EXPECT_EQ(report.matrices[m].scattered.before, scattered[m]);
    EXPECT_EQ(report.matrices[m].framesWithFalse.before, frames[m]);
    EXPECT_EQ(report.matrices[m].framesWhole.before, whole[m]);
  }
}

// The chain for high sensitivity: a taxel that flickers is gone, a touch of one taxel comes a frame
// later, as it was.
TEST_F(GhostingTest, HighSensitivityKeepsATouchOfOneTaxel) {
  auto truth = untouched(10);
  touch(truth, 7, 3, 6);
  const Profile profile = profileOf(10,
                                    {{1, 7, 1.0F},
                                     {3, 7, 1.0F},
                                     {4, 7, 9.0F},
                                     {5, 7, 4.0F},
                                     {6, 7, 9.0F},
                                     {5, 20 + 9, 2.0F},
                                     {8, 20 + 9, 2.0F}});
  const GhostingReport report = measureGhosting(profile, highSensitivityRecipe(), truth);
  expectCounts(report.total().falseTaxels, 3, 0);
  expectCounts(report.touched, 4, 3);
  EXPECT_DOUBLE_EQ(report.touchedSumAfter, 22.0);
  EXPECT_EQ(report.contacts.at(0).delayFrames(), 1);
  EXPECT_EQ(report.latencyFrames, 1);
}

TEST_F(GhostingTest, RefusesWhatMakesNoSense) {
  const Profile profile = profileOf(2, {});
  const auto truth = untouched(2);
  EXPECT_THROW(measureGhosting(profile, {}, untouched(3)), std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, std::vector<CellTruthMask>(2, CellTruthMask(3))),
               std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, truth, {.minTaxels = 0}), std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, truth, {.activeAboveCounts = -1.0}),
               std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, truth, {.activeAboveCounts = std::nan("")}),
               std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, truth, {.activeAboveCounts = 1e10}),
               std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, truth, {.wholeMatrixFraction = 1.5}),
               std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, recipe("median:matrices=2"), truth), std::invalid_argument);
  EXPECT_THROW(measureGhosting(profile, {}, {}, {}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::ghosting_test
