#include "palpate/capture/contact_trigger.h"

#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::contact_trigger_test {
namespace {

// A frame in which so many taxels read `value`.
TactileFrame pressed(std::int64_t hostUs, std::size_t taxels, float value = 500.0F) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = hostUs;
  for (std::size_t i = 0; i < taxels; ++i) frame.values[i * 7] = value;
  return frame;
}

TEST(ContactTrigger, AFewTaxelsOrAFewFramesAreNoise) {
  ContactTrigger trigger;
  for (std::int64_t t = 0; t < 20; ++t) trigger.add(pressed(t, 2));
  EXPECT_FALSE(trigger.firstContactUs()) << "two taxels";
  for (std::int64_t t = 20; t < 50; ++t) trigger.add(pressed(t, t % 3 == 0 ? 0 : 400 / 10));
  EXPECT_FALSE(trigger.firstContactUs()) << "two frames in a row";
}

TEST(ContactTrigger, AContactBeginsWithTheFirstOfItsFrames) {
  ContactTrigger trigger;
  trigger.add(pressed(10, 0));
  trigger.add(pressed(20, 3));
  trigger.add(pressed(30, 3));
  EXPECT_EQ(trigger.touchingSinceUs(), 20);
  EXPECT_FALSE(trigger.firstContactUs());
  trigger.add(pressed(40, 5));
  EXPECT_EQ(trigger.firstContactUs(), 20);
  EXPECT_FALSE(trigger.releasedUs());
}

TEST(ContactTrigger, ItIsReleasedUntilItIsTouchedAgainForLong) {
  ContactTrigger trigger;
  for (std::int64_t t = 0; t < 5; ++t) trigger.add(pressed(t, 10));
  trigger.add(pressed(5, 0));
  trigger.add(pressed(6, 10));
  trigger.add(pressed(7, 10));
  EXPECT_EQ(trigger.releasedUs(), 5) << "two frames are noise";
  trigger.add(pressed(8, 10));
  EXPECT_FALSE(trigger.releasedUs());
  trigger.add(pressed(9, 1));
  EXPECT_EQ(trigger.releasedUs(), 9);
  EXPECT_EQ(trigger.firstContactUs(), 0) << "the first contact stays the first one";
}

TEST(ContactTrigger, TheThresholdIsExceededNotReached) {
  ContactTrigger trigger({.threshold = 500.0, .taxels = 1, .frames = 1});
  trigger.add(pressed(1, 10, 500.0F));
  EXPECT_FALSE(trigger.firstContactUs());
  trigger.add(pressed(2, 1, 501.0F));
  EXPECT_EQ(trigger.firstContactUs(), 2);
}

TEST(ContactTrigger, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(ContactTrigger({.threshold = -1.0}), std::invalid_argument);
  EXPECT_THROW(ContactTrigger({.taxels = 0}), std::invalid_argument);
  EXPECT_THROW(ContactTrigger({.frames = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::contact_trigger_test
