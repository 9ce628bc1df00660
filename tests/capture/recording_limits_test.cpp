#include "palpate/capture/recording_limits.h"

#include <limits>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::recording_limits_test {
namespace {

TEST(RecordingLimits, WithoutLimitsARecordingGoesOnInOneFile) {
  RecordingOptions options;
  options.splitS = 60.0;
  options.stopAfterS = 5.0;
  RecordingLimits().applyTo(options);
  EXPECT_FALSE(options.stopAfterS);
  EXPECT_FALSE(options.splitS);
  EXPECT_FALSE(options.splitBytes);
  EXPECT_EQ(textOf(RecordingLimits()), "");
}

TEST(RecordingLimits, MinutesAndMegabytesBecomeSecondsAndBytes) {
  RecordingOptions options;
  options.path = "a.palpate";
  RecordingLimits{.stopAfterS = 30.0, .splitMinutes = 2.5, .splitMb = 0.1}.applyTo(options);
  EXPECT_EQ(options.stopAfterS, 30.0);
  EXPECT_EQ(options.splitS, 150.0);
  EXPECT_EQ(options.splitBytes, 100'000);
  EXPECT_NO_THROW(options.validate());
}

TEST(RecordingLimits, TheSmallestAndLargestAreAcceptedByTheRecorder) {
  using Limits = RecordingLimits;
  for (const Limits& limits :
       {Limits{
            Limits::kStopAfterS.minimum, Limits::kSplitMinutes.minimum, Limits::kSplitMb.minimum},
        Limits{Limits::kStopAfterS.maximum,
               Limits::kSplitMinutes.maximum,
               Limits::kSplitMb.maximum}}) {
    RecordingOptions options;
    options.path = "a.palpate";
    limits.applyTo(options);
    EXPECT_NO_THROW(options.validate());
  }
}

TEST(RecordingLimits, OtherValuesAreRefusedByName) {
  const auto refusal = [](const RecordingLimits& limits) -> std::string {
    RecordingOptions options;
    try {
      limits.applyTo(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.stopAfterS = 0.0}), "RecordingLimits: stopAfterS is 0, not 0.05..1e+07");
  EXPECT_EQ(refusal({.stopAfterS = std::numeric_limits<double>::quiet_NaN()}),
            "RecordingLimits: stopAfterS is nan, not 0.05..1e+07");
  EXPECT_EQ(refusal({.splitMinutes = -1.0}),
            "RecordingLimits: splitMinutes is -1, not 0.016666666666666666..1e+05");
  EXPECT_EQ(refusal({.splitMb = 2e6}), "RecordingLimits: splitMb is 2e+06, not 0.1..1e+06");
}

TEST(RecordingLimits, AreSaidInWords) {
  EXPECT_EQ(textOf({.stopAfterS = 30.0}), "stops after 30 s");
  EXPECT_EQ(textOf({.splitMb = 500.0}), "a new file every 500 MB");
  EXPECT_EQ(textOf({.stopAfterS = 1.5, .splitMinutes = 10.0, .splitMb = 500.0}),
            "stops after 1.5 s, a new file every 10 min or 500 MB");
}

}  // namespace
}  // namespace palpate::recording_limits_test
