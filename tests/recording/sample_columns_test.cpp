#include "recording/sample_columns.h"

#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::sample_columns_test {
namespace {

using Names = std::vector<std::string>;

HandDescription slidingHand() {
  HandDescription hand;
  hand.layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  hand.axes.resize(2);
  hand.axes[0].name = "base";
  hand.axes[1].name = "jaw";
  hand.axes[1].isSliding = true;
  hand.temperatureSensors = {{"motor"}};
  return hand;
}

TEST(SampleColumns, whatTheHandDoesNotDescribeHasNoName) {
  const auto angles = angleColumns(slidingHand(), 3);
  EXPECT_EQ(columnNames(angles), (Names{"base", "jaw", ""}));
  EXPECT_EQ(columnUnits(angles), (Names{"deg", "mm", ""}));
  EXPECT_EQ(columnNames(angleColumns(slidingHand(), 1)), Names{"base"});
  const auto temperatures = temperatureColumns(slidingHand(), 2);
  EXPECT_EQ(columnNames(temperatures), (Names{"motor", ""}));
  EXPECT_EQ(columnUnits(temperatures), (Names{"degC", "degC"}));
}

TEST(SampleColumns, withoutSamplesTheyAreThoseOfTheHand) {
  const HandDescription hand = slidingHand();
  ProfileBuilder builder(hand.layout);
  builder.addAngles(5, std::vector<double>{1.0, 2.0, 3.0});
  const Profile built = builder.finish({});
  const Profile empty = ProfileBuilder(hand.layout).finish({});
  const WrittenSamples angles = writtenSamples(built, kAngleSeries);
  EXPECT_EQ(angles.count, 1u);
  EXPECT_EQ(angles.timeUs(0), 5);
  EXPECT_EQ(angles.values(0), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(angles.columns.size(), 3u);
  EXPECT_EQ(writtenSamples(empty, kAngleSeries).columns.size(), empty.hand().axes.size());
  EXPECT_EQ(writtenSamples(built, kTemperatureSeries).columns.size(),
            built.hand().temperatureSensors.size());
}

TEST(SampleColumns, anEventOfNoMatrixHasTheGivenNumber) {
  const std::vector<Event> events{{1, 2, "note", {}, "a", "{}"}, {3, 3, "gap", 4, "", ""}};
  const EventColumns<double> columns(events, -1.0);
  EXPECT_EQ(columns.timesUs, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(columns.endsUs, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(columns.kinds, (Names{"note", "gap"}));
  EXPECT_EQ(columns.matrices, (std::vector<double>{-1.0, 4.0}));
  EXPECT_EQ(columns.texts, (Names{"a", ""}));
  EXPECT_EQ(columns.jsons, (Names{"{}", ""}));
}

}  // namespace
}  // namespace palpate::sample_columns_test
