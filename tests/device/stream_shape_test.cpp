// How many values an item of a hand has, and which are refused.
#include "palpate/device/stream_shape.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "device/stream_hands.h"

namespace palpate::testing::stream_shape_test {
namespace {

TEST(StreamShape, TakesPlacesOrTaxels) {
  const StreamShape shape(smallHand());
  EXPECT_EQ(shape.numPlaces(), 4u);
  EXPECT_EQ(shape.numTaxels(), 3u);
  EXPECT_TRUE(shape.fits(StreamItemKind::kFrame, 4));
  EXPECT_TRUE(shape.fits(StreamItemKind::kFrame, 3));
  EXPECT_FALSE(shape.fits(StreamItemKind::kFrame, 5));
  EXPECT_TRUE(shape.fits(StreamItemKind::kAngles, 2));
  EXPECT_TRUE(shape.fits(StreamItemKind::kTemperatures, 1));
  EXPECT_EQ(shape.expected(StreamItemKind::kFrame), "4 (places) or 3 (taxels)");
}

TEST(StreamShape, AHandWithoutAxesTakesNoAngles) {
  const StreamShape shape(padHand({{2, 2}}));
  EXPECT_FALSE(shape.fits(StreamItemKind::kAngles, 0));
  EXPECT_EQ(shape.expected(StreamItemKind::kAngles), "none: the hand has no axes");
  EXPECT_EQ(shape.expected(StreamItemKind::kFrame), "4");
}

TEST(StreamShape, ValuesOfTaxelsMoveToTheirPlaces) {
  const StreamShape shape(smallHand());
  std::vector<float> values{1, 2, 3, 99};
  EXPECT_EQ(shape.arrange(values, 3), "");
  EXPECT_EQ(values, (std::vector<float>{1, 0, 2, 3}));
}

TEST(StreamShape, EachMatrixHasItsOwnFullScale) {
  HandDescription hand = padHand({{1, 2}, {2, 2}});
  MatrixLayout masked = MatrixLayout::full(1, 2, 2.0);
  masked.staticMask[1] = 0;
  hand.layout =
      std::make_shared<const SensorLayout>(std::vector{masked, MatrixLayout::full(2, 2, 2.0)});
  hand.matrices[1].maximumCounts = 255.0F;
  const StreamShape shape(hand);
  const auto arranged = [&](std::vector<float> values, std::size_t count) {
    values.resize(6);
    return shape.arrange(values, count);
  };
  EXPECT_EQ(arranged({4095, 0, 255, 0, 0, 255}, 6), "");
  EXPECT_EQ(arranged({4095, 0, 255, 256, 0, 0}, 6), "value 4 is 256, not in 0..255 counts");
  EXPECT_EQ(arranged({4095, 255, 0, 0, 255}, 5), "");
  EXPECT_EQ(arranged({4095, 256, 0, 0, 255}, 5), "value 2 is 256, not in 0..255 counts");
  EXPECT_EQ(arranged({4096, 255, 0, 0, 255}, 5), "value 1 is 4096, not in 0..4095 counts");
}

TEST(StreamShape, AMaskedPlaceIsZeroWhateverWasSent) {
  const StreamShape shape(smallHand());
  std::vector<float> values{1, NAN, 3, 4};
  EXPECT_EQ(shape.arrange(values, 4), "");
  EXPECT_EQ(values, (std::vector<float>{1, 0, 3, 4}));
}

TEST(StreamShape, NamesTheValueThatIsOutOfRange) {
  const StreamShape shape(padHand({{1, 3}}));
  const auto arranged = [&](std::vector<float> values) { return shape.arrange(values, 3); };
  EXPECT_EQ(arranged({0, 4095, 1}), "");
  EXPECT_EQ(arranged({0, -3, 1}), "value 2 is -3, not in 0..4095 counts");
  EXPECT_EQ(arranged({0, 1, 4096}), "value 3 is 4096, not in 0..4095 counts");
  EXPECT_EQ(arranged({NAN, 1, 2}), "value 1 is nan: 0 is kept");
  EXPECT_EQ(arranged({1, 2, std::numeric_limits<float>::infinity()}), "value 3 is inf: 0 is kept");
}

TEST(StreamShape, TheRangeIsInTheUnitOfTheHand) {
  HandDescription hand = padHand({{1, 1}});
  hand.unit = "kPa";
  hand.maximumCounts = 250.0F;
  std::vector<float> values{300.5F};
  EXPECT_EQ(StreamShape(hand).arrange(values, 1), "value 1 is 300.5, not in 0..250 kPa");
}

TEST(StreamShape, AnglesMustBeFinite) {
  const StreamShape shape(smallHand());
  EXPECT_EQ(shape.check(std::vector<double>{-90.0, 1e3}), "");
  EXPECT_EQ(shape.check(std::vector<double>{-90.0, NAN}), "value 2 is nan");
}

TEST(StreamShape, RefusesAHandThatCantSend) {
  EXPECT_THROW(StreamShape(HandDescription{}), std::invalid_argument);
  HandDescription hand = padHand({{1, 1}});
  hand.maximumCounts = 0.0F;
  EXPECT_THROW(StreamShape{hand}, std::invalid_argument);
}

TEST(StreamShape, ReadsADescription) {
  const StreamShape shape(padHand({{2, 3}}));
  const StreamDescription good = readStreamDescription(
      R"({"name":"pad","serial":"P7","firmware":"1.2","matrices":[{"rows":2,"columns":3}]})",
      shape);
  EXPECT_EQ(good.serial, "P7");
  EXPECT_EQ(good.firmware, "1.2");
  EXPECT_EQ(good.mismatch, "");
  EXPECT_EQ(readStreamDescription("{}", shape).mismatch, "");
  EXPECT_EQ(readStreamDescription(R"({"matrices":[{"rows":3,"columns":2}]})", shape).mismatch,
            "matrix 0 of the sender has 3 x 2 places, that of the chosen hand 2 x 3");
  EXPECT_EQ(readStreamDescription(R"({"matrices":[{"rows":2,"columns":3,"components":3}]})", shape)
                .mismatch,
            "matrix 0 of the sender has 3 components per taxel, that of the chosen hand 1");
  EXPECT_EQ(readStreamDescription(R"({"matrices":[]})", shape).mismatch,
            "the sender has 0 matrices, the chosen hand 1");
  EXPECT_THROW(readStreamDescription("[]", shape), Error);
  EXPECT_THROW(readStreamDescription("{", shape), Error);
  EXPECT_THROW(readStreamDescription(R"({"matrices":[{"rows":"2"}]})", shape), Error);
}

}  // namespace
}  // namespace palpate::testing::stream_shape_test
