#include "palpate/recording/gap_events.h"

#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::gap_events_test {
namespace {

// Frames at 1 s, 2 s and 5 s: the gap is between the last two.
TEST(GapEvents, AnEventTouchesAGapWithItsEndsToo) {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(layout);
  for (const std::int64_t us : {1'000'000, 2'000'000, 5'000'000})
    builder.addFrame(us, std::vector<float>{0.0F});
  const Profile profile = builder.finish({});
  const Gap gap{.frame = 1, .seconds = 3.0};
  const auto touches = [&](std::int64_t fromUs, std::int64_t toUs) {
    return touchesGap({fromUs, toUs, "gap", {}, "lost", ""}, gap, profile);
  };
  EXPECT_TRUE(touches(3'000'000, 4'000'000)) << "within";
  EXPECT_TRUE(touches(0, 9'000'000)) << "around";
  EXPECT_TRUE(touches(0, 2'000'000)) << "ends with the frame before";
  EXPECT_FALSE(touches(0, 1'999'999));
  EXPECT_TRUE(touches(5'000'000, 5'000'000)) << "begins with the frame behind";
  EXPECT_FALSE(touches(5'000'001, 9'000'000));
}

}  // namespace
}  // namespace palpate::gap_events_test
