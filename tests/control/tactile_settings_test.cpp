#include "palpate/control/tactile_settings.h"

#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::tactile_settings_test {
namespace {

TactileSettings same(double sensitivity, int counts) {
  return TactileSettings(6, {sensitivity, counts});
}

TEST(TactileSettings, AResetIsThatOfTheStudy) {
  const TactileSettings settings = defaultTactileSettings(sdh2());
  ASSERT_EQ(settings.size(), 6u);
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(settings[m].sensitivity, 0.5);
    EXPECT_EQ(settings[m].thresholdCounts, m % 2 == 0 ? 150 : 300);  // even ones are proximal
  }
}

TEST(TactileSettings, NothingIsSentWhereNothingChanges) {
  EXPECT_TRUE(commandsBetween(same(0.5, 150), same(0.5, 150)).empty());
  // The controller keeps single precision.
  EXPECT_TRUE(commandsBetween(same(static_cast<double>(0.3F), 150), same(0.3, 150)).empty());
}

TEST(TactileSettings, OneCommandWhereAllBecomeAlike) {
  const auto commands = commandsBetween(same(0.5, 150), same(0.75, 150));
  ASSERT_EQ(commands.size(), 1u);
  const auto& all = std::get<SetSensitivity>(commands[0]);
  EXPECT_FALSE(all.matrix.has_value());
  EXPECT_EQ(all.sensitivity, 0.75);
}

TEST(TactileSettings, OneCommandForEachMatrixThatChanges) {
  TactileSettings to = same(0.5, 150);
  to[1].thresholdCounts = 300;
  to[4].thresholdCounts = 20;
  to[4].sensitivity = 1.0;
  const auto commands = commandsBetween(same(0.5, 150), to);
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(std::get<SetSensitivity>(commands[0]).matrix, 4);
  EXPECT_EQ(std::get<SetThreshold>(commands[1]).matrix, 1);
  EXPECT_EQ(std::get<SetThreshold>(commands[1]).counts, 300);
  EXPECT_EQ(std::get<SetThreshold>(commands[2]).matrix, 4);
  EXPECT_EQ(std::get<SetThreshold>(commands[2]).counts, 20);
}

TEST(TactileSettings, OneMatrixThatBecomesLikeTheOthersIsOneCommandForIt) {
  TactileSettings from = same(0.5, 150);
  from[3].thresholdCounts = 99;
  const auto commands = commandsBetween(from, same(0.5, 150));
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(std::get<SetThreshold>(commands[0]).matrix, 3);
}

TEST(TactileSettings, RefusesWhatIsOutOfRange) {
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(commandsBetween(same(0.5, 150), same(wrong, 150)), std::invalid_argument);
  for (const int wrong : {-1, 4096})
    EXPECT_THROW(commandsBetween(same(0.5, 150), same(0.5, wrong)), std::invalid_argument);
  EXPECT_THROW(commandsBetween(same(0.5, 150), TactileSettings(4)), std::invalid_argument);
}

TEST(TactileSettings, SurviveAsText) {
  TactileSettings settings = same(0.1, 4095);
  settings[2] = {1.0 / 3.0, 0};
  const TactileSettings back = parseTactileSettings(toJson(settings));
  ASSERT_EQ(back.size(), 6u);
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(back[m].sensitivity, settings[m].sensitivity);
    EXPECT_EQ(back[m].thresholdCounts, settings[m].thresholdCounts);
  }
}

TEST(TactileSettings, TextThatIsNoneIsAnError) {
  for (const char* wrong :
       {"",
        "7",
        "{}",
        R"({"matrices": 3})",
        R"({"matrices": [{"sensitivity": 0.5}]})",
        R"({"matrices": [{"sensitivity": "much", "threshold_counts": 1}]})",
        R"({"matrices": [{"sensitivity": 2, "threshold_counts": 1}]})",
        R"({"matrices": [{"sensitivity": 0.5, "threshold_counts": 99999999999}]})"})
    EXPECT_THROW(parseTactileSettings(wrong), Error) << wrong;
}

}  // namespace
}  // namespace palpate::tactile_settings_test
