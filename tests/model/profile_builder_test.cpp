#include "palpate/model/profile_builder.h"

#include <cmath>
#include <stdexcept>

#include "palpate/model/hand_file.h"

#include "testing/testing.h"

namespace palpate::profile_builder_test {
namespace {

std::shared_ptr<const SensorLayout> smallLayout() {
  return std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(2, 2, 1.0)});
}

std::vector<float> frameOf(float value) { return {value, 0.0F, value, 1.0F}; }

TEST(ProfileBuilder, RefusesWhatIsNoTimeSeries) {
  ProfileBuilder builder(smallLayout());
  builder.addFrame(10, frameOf(1.0F));
  EXPECT_THROW(builder.addFrame(10, frameOf(1.0F)), std::invalid_argument);
  EXPECT_THROW(builder.addFrame(9, frameOf(1.0F)), std::invalid_argument);
  EXPECT_THROW(builder.addFrame(11, std::vector<float>(3)), std::invalid_argument);
  EXPECT_THROW(builder.addFrame(11, frameOf(std::nanf(""))), std::invalid_argument);
  builder.addAngles(1, std::vector<double>{1.0, 2.0});
  EXPECT_THROW(builder.addAngles(2, std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(builder.addAngles(2, std::vector<double>{1.0, HUGE_VAL}), std::invalid_argument);
  EXPECT_THROW(builder.addTemperatures(1, std::vector<double>{}), std::invalid_argument);
  EXPECT_EQ(builder.numFrames(), 1u);
  EXPECT_EQ(builder.lastAngleUs(), 1);
  EXPECT_EQ(builder.lastTemperatureUs(), std::nullopt);
}

TEST(ProfileBuilder, HandsOverWhatItHasAndStartsAnew) {
  ProfileBuilder builder(smallLayout());
  builder.addFrame(10, frameOf(1.0F));
  builder.addAngles(10, std::vector<double>{1.0, 2.0});
  ProfileInfo info;
  info.serial = "7";
  const Profile first = builder.finish(info);
  EXPECT_EQ(first.numFrames(), 1u);
  EXPECT_EQ(first.hand().axes.size(), 2u);
  EXPECT_EQ(first.info().serial, "7");
  EXPECT_EQ(builder.numFrames(), 0u);
  builder.addFrame(5, frameOf(0.5F));  // earlier than before: it is another profile
  EXPECT_EQ(builder.finish({}).info().valueType, ValueType::kFloat);
  EXPECT_EQ(first.info().valueType, ValueType::kCounts);
}

// Otherwise a cropped or filtered recording would be that of an unknown sensor.
TEST(ProfileBuilder, KeepsTheHandItWasGiven) {
  const HandDescription& hand = builtInHand("parallel_gripper");
  ProfileBuilder builder(hand);
  builder.addFrame(10, std::vector<float>(hand.layout->numCells(), 1.0F));
  const Profile profile = builder.finish({});
  EXPECT_EQ(profile.hand().name, hand.name);
  EXPECT_EQ(profile.hand().file, hand.file);
  EXPECT_EQ(profile.hand().axes.size(), hand.axes.size());
  builder.addAngles(10, std::vector<double>{1.0, 2.0, 3.0});
  EXPECT_EQ(builder.finish({}).hand().axes.size(), 3u) << "as many as there are";
}

}  // namespace
}  // namespace palpate::profile_builder_test
