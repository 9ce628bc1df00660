#include "palpate/recognition/pinch_hand.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

#include "recognition/pinch_profile.h"
#include "testing/sdh2.h"

namespace palpate::pinch_hand_test {
namespace {

TEST(PinchHand, OfTheSdh2AreItsDistalPads) {
  const PinchHand& hand = sdh2PinchHand();
  EXPECT_NO_THROW(hand.validate());
  for (const std::size_t pad : hand.pads) EXPECT_EQ(sdh2().matrices[pad].segment, "distal");
  EXPECT_EQ(sdh2().matrices[hand.pads[0]].finger, 0);
  EXPECT_EQ(sdh2().matrices[hand.pads[1]].finger, 2);
}

TEST(PinchHand, KnowsItsOwnRecordings) {
  EXPECT_EQ(sdh2PinchHand().mismatch(testing::pinchProfile({{50.0, 1.0F, 1.0F}})), "");
  EXPECT_NE(sdh2PinchHand().mismatch(testing::otherSensorProfile(3)), "");
  ProfileBuilder builder(sdh2().layout);
  builder.addAngles(0, std::vector<double>(3, 0.0));
  EXPECT_EQ(sdh2PinchHand().mismatch(builder.finish({})),
            "a recording of another hand: 3 joint angles instead of 7");
}

TEST(PinchHand, WhatDoesNotFitIsRefused) {
  const auto refused = [](auto change) {
    PinchHand hand = sdh2PinchHand();
    change(hand);
    EXPECT_THROW(hand.validate(), std::invalid_argument);
  };
  refused([](PinchHand& hand) { hand.pads = {1, 1}; });
  refused([](PinchHand& hand) { hand.pads = {1, 6}; });
  refused([](PinchHand& hand) { hand.otherPads = {{1, 9}}; });
  refused([](PinchHand& hand) { hand.secondPadGain = 0.0; });
  refused([](PinchHand& hand) { hand.fullScaleCounts = std::nan(""); });
  refused([](PinchHand& hand) { hand.imageSize = 12; });
  refused([](PinchHand& hand) { hand.largestCounts = {1.0, -1.0}; });
  refused([](PinchHand& hand) { hand.gripAxes = {7}; });
  refused([](PinchHand& hand) { hand.studyGeometry = nullptr; });
}

}  // namespace
}  // namespace palpate::pinch_hand_test
