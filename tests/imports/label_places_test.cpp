// Labels of values are found as the columns of an import are.
#include "palpate/imports/label_places.h"

#include <gtest/gtest.h>

#include "imports/import_samples.h"

namespace palpate::label_places_test {
namespace {

using testing::pad;
using Places = std::vector<std::size_t>;

Places placesOf(const HandDescription& hand, const std::vector<std::string>& labels) {
  std::vector<std::string> notes;
  return placesOfLabels(hand, labels, notes);
}

TEST(LabelPlaces, NumbersAreTheTaxels) {
  EXPECT_EQ(placesOf(pad(2, 3), {"p5", "p4", "p3", "p2", "p1", "p0"}), (Places{5, 4, 3, 2, 1, 0}));
  EXPECT_EQ(placesOf(pad(2, 3), {"x0y0", "x0y1", "x1y0", "x1y1", "x2y0", "x2y1"}),
            (Places{0, 3, 1, 4, 2, 5}));
  // As a sorted map prints them.
  EXPECT_EQ(placesOf(pad(3, 4),
                     {"p0", "p1", "p10", "p11", "p2", "p3", "p4", "p5", "p6", "p7", "p8", "p9"}),
            (Places{0, 1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(LabelPlaces, NamesAreTheMatrices) {
  EXPECT_EQ(placesOf(testing::twoPads(),
                     {"right0", "right1", "right2", "right3", "left3", "left2", "left1", "left0"}),
            (Places{4, 5, 6, 7, 3, 2, 1, 0}));
}

TEST(LabelPlaces, WhatTheLabelsLeaveOpenIsTakenInTheirOrder) {
  EXPECT_EQ(placesOf(pad(1, 3), {"c", "a", "b"}), (Places{0, 1, 2}));
  EXPECT_EQ(placesOf(pad(1, 3), {"a", "b"}), Places{});
}

// Of a place without a taxel nothing is sent.
TEST(LabelPlaces, FewerLabelsThanPlacesAreTheTaxels) {
  MatrixLayout matrix = MatrixLayout::full(2, 2, 2.0);
  matrix.staticMask[1] = 0;
  const HandDescription hand = testing::handOf({matrix});
  EXPECT_EQ(placesOf(hand, {"t2", "t0", "t1"}), (Places{2, 0, 1}));
  EXPECT_EQ(placesOf(hand, {"t3", "t2", "t1", "t0"}), (Places{3, 2, 1, 0}));
}

TEST(LabelPlaces, WhatIsGuessedIsNoted) {
  std::vector<std::string> notes;
  placesOfLabels(pad(2, 2), {"p_0_0", "p_0_1", "p_1_0", "p_1_1"}, notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("are taken for row and column, in this order"), std::string::npos);
}

TEST(LabelPlaces, ManyLabelsAreFoundAtOnce) {
  std::vector<std::string> labels;
  for (int i = 63'999; i >= 0; --i) labels.push_back("A" + std::to_string(i));
  const Places places = placesOf(pad(250, 256), labels);
  ASSERT_EQ(places.size(), labels.size());
  EXPECT_EQ(places.front(), 63'999u);
  EXPECT_EQ(places.back(), 0u);
}

}  // namespace
}  // namespace palpate::label_places_test
