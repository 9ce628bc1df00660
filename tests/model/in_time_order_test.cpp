#include "palpate/model/in_time_order.h"

#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::in_time_order_test {
namespace {

using Kind = InTimeOrder::Kind;

Profile profileAt(const std::vector<std::int64_t>& framesUs,
                  const std::vector<std::int64_t>& anglesUs,
                  const std::vector<std::int64_t>& temperaturesUs) {
  const std::vector<double> value{1.0};
  ProfileBuilder builder(
      std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)}));
  for (const std::int64_t us : framesUs) builder.addFrame(us, std::vector<float>{0.0F});
  for (const std::int64_t us : anglesUs) builder.addAngles(us, value);
  for (const std::int64_t us : temperaturesUs) builder.addTemperatures(us, value);
  return builder.finish({});
}

std::vector<Event> eventsAt(const std::vector<std::int64_t>& timesUs) {
  std::vector<Event> events(timesUs.size());
  for (std::size_t i = 0; i < events.size(); ++i) events[i].tUs = timesUs[i];
  return events;
}

std::vector<InTimeOrder::Item> allOf(InTimeOrder order) {
  std::vector<InTimeOrder::Item> items;
  while (const auto item = order.next()) {
    items.push_back(*item);
    EXPECT_EQ(order.take(), item);
  }
  EXPECT_EQ(order.take(), std::nullopt);
  return items;
}

TEST(InTimeOrder, ofEqualTimesEventsTemperaturesAnglesFrames) {
  EXPECT_EQ(allOf({profileAt({10, 20}, {5, 20}, {20, 30}), eventsAt({20, 40})}),
            (std::vector<InTimeOrder::Item>{{Kind::kSample, kAngleSeries, 0, 5},
                                            {Kind::kFrame, 0, 0, 10},
                                            {Kind::kEvent, 0, 0, 20},
                                            {Kind::kSample, kTemperatureSeries, 0, 20},
                                            {Kind::kSample, kAngleSeries, 1, 20},
                                            {Kind::kFrame, 0, 1, 20},
                                            {Kind::kSample, kTemperatureSeries, 1, 30},
                                            {Kind::kEvent, 0, 1, 40}}));
}

TEST(InTimeOrder, eventsKeepTheirOrder) {
  EXPECT_EQ(allOf({profileAt({10, 20}, {}, {}), eventsAt({15, 5})}),
            (std::vector<InTimeOrder::Item>{{Kind::kFrame, 0, 0, 10},
                                            {Kind::kEvent, 0, 0, 15},
                                            {Kind::kEvent, 0, 1, 5},
                                            {Kind::kFrame, 0, 1, 20}}));
}

TEST(InTimeOrder, mayBeEmptyAndReachTheEndOfTime) {
  EXPECT_TRUE(allOf({profileAt({}, {}, {}), eventsAt({})}).empty());
  EXPECT_EQ(allOf({profileAt({}, {}, {}), eventsAt({INT64_MAX})}).size(), 1u);
}

}  // namespace
}  // namespace palpate::in_time_order_test
