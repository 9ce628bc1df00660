#include "palpate/model/series.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::series_test {
namespace {

const SeriesDescription kWrist{"wrist", "reference_force", {{"fz", "N"}, {"tz", "N m"}}, "w.csv"};

TEST(Series, ANameIsALetterThenLettersDigitsUnderscores) {
  validate(kWrist);
  for (const char* name : {"", "Wrist", "1st", "_a", "a b", "a/b", "ä"}) {
    SeriesDescription series = kWrist;
    series.name = name;
    EXPECT_THROW(validate(series), std::invalid_argument) << name;
  }
  SeriesDescription longest = kWrist;
  longest.name = std::string(kMaxSeriesName, 'a');
  validate(longest);
  longest.name += 'a';
  EXPECT_THROW(validate(longest), std::invalid_argument);
}

TEST(Series, ColumnsHaveNamesOfTheirOwn) {
  for (const std::vector<Column>& columns : {std::vector<Column>{},
                                             {{"", "N"}},
                                             {{"a", ""}, {"a", "N"}},
                                             {{"a\n", ""}},
                                             std::vector<Column>(kMaxColumns + 1, {"a", ""})}) {
    SeriesDescription series = kWrist;
    series.columns = columns;
    EXPECT_THROW(validate(series), std::invalid_argument);
  }
}

TEST(Series, ANameIsMadeOfAnyText) {
  EXPECT_EQ(seriesName("Wrist Fz"), "wrist_fz");
  EXPECT_EQ(seriesName("12 / acc.x (g)"), "acc_x_g");
  EXPECT_EQ(seriesName("°C"), "c");
  EXPECT_EQ(seriesName(""), "series");
  EXPECT_EQ(seriesName(std::string(200, 'A')), std::string(kMaxSeriesName, 'a'));
}

TEST(Series, AProfileHasThoseOfItsHandFirst) {
  ProfileBuilder builder(defaultHand());
  const std::size_t wrist = builder.addSeries(kWrist);
  EXPECT_EQ(wrist, kHandSeries);
  EXPECT_THROW(builder.addSeries(kWrist), std::invalid_argument);
  SeriesDescription taken = kWrist;
  taken.name = "angles";
  EXPECT_THROW(builder.addSeries(taken), std::invalid_argument);
  builder.addAngles(5, std::vector<double>(7, 1.0));
  const double missing = std::numeric_limits<double>::quiet_NaN();
  builder.addSample({10, {1.5, missing}, wrist, 3});
  builder.addSample({20, {2.5, -1.0}, wrist});
  EXPECT_THROW(builder.addSample({20, {2.5, -1.0}, wrist}), std::invalid_argument);
  EXPECT_THROW(builder.addSample({30, {2.5}, wrist}), std::invalid_argument);
  EXPECT_THROW(builder.addAngles(6, std::vector<double>(7, missing)), std::invalid_argument);
  const Profile profile = builder.finish({});
  ASSERT_EQ(profile.series().size(), 3u);
  EXPECT_EQ(profile.series()[kAngleSeries].columns.size(), 7u);
  EXPECT_EQ(profile.series()[kAngleSeries].role, "joint_angles");
  EXPECT_EQ(profile.series()[wrist], kWrist);
  EXPECT_EQ(profile.seriesNamed("wrist"), wrist);
  EXPECT_EQ(profile.seriesNamed("temperatures"), std::nullopt) << "it has no samples";
  ASSERT_EQ(profile.numSamples(wrist), 2u);
  EXPECT_EQ(profile.sample(wrist, 0).deviceUs, 3);
  EXPECT_EQ(profile.sample(wrist, 1).deviceUs, std::nullopt);
  EXPECT_TRUE(std::isnan(profile.sample(wrist, 0).values[1]));
  EXPECT_EQ(profile.sampleAt(wrist, 19), 0u);
  EXPECT_EQ(profile.sampleAt(wrist, 20), 1u);
  EXPECT_EQ(profile.sampleAt(wrist, 1), 0u) << "the first one also before";
  EXPECT_THROW(profile.sample(wrist, 2), std::out_of_range);
  EXPECT_THROW(profile.numSamples(3), std::out_of_range);
}

}  // namespace
}  // namespace palpate::series_test
