#include "palpate/model/rest_span.h"

#include <limits>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::rest_span_test {
namespace {

using Values = std::vector<float>;

// Ten frames a second for three seconds; the first reading is the number of the frame.
Profile counting() {
  MatrixLayout matrix = MatrixLayout::full(1, 2, 1.0);
  matrix.touch = {.isSigned = true, .threshold = 5.0F};
  ProfileBuilder builder(std::make_shared<const SensorLayout>(std::vector{matrix}));
  for (int i = 0; i <= 30; ++i)
    builder.addReadings(7'000'000 + 100'000 * i, Values{static_cast<float>(i), -20.0F});
  return builder.finish({});
}

TEST(RestSpan, IsOfTheFramesWithin) {
  // 10, 11, 12: the mean is 11, the deviation 1.
  const Rest rest = restIn(counting(), 1.0, 1.2, RestOf::kReadings);
  EXPECT_EQ(rest.numFrames, 3u);
  EXPECT_EQ(rest.baseline, (Baseline{{11.0F, -20.0F}, {1.0F, 0.0F}}));
  const Rest seen = restIn(counting(), 1.0, 1.2, RestOf::kValues);
  EXPECT_EQ(seen.baseline, (Baseline{{11.0F, 20.0F}, {1.0F, 0.0F}})) << "magnitudes";
  EXPECT_EQ(restIn(counting(), 0.0, 3.0, RestOf::kValues).numFrames, 31u);
}

TEST(RestSpan, RefusesWhatIsNoRest) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [fromS, toS] : {std::pair(0.0, 3.1),
                                   std::pair(-0.1, 1.0),
                                   std::pair(2.0, 1.0),
                                   std::pair(0.91, 0.99),
                                   std::pair(0.0, nan),
                                   std::pair(nan, 1.0)})
    EXPECT_THROW(restIn(counting(), fromS, toS, RestOf::kValues), std::invalid_argument)
        << fromS << " " << toS;
  // It moves by 15 of a full scale of 4095: 0.2 % are 8.2.
  EXPECT_THROW(restIn(counting(), 0.0, 3.0, RestOf::kReadings), Error);
}

}  // namespace
}  // namespace palpate::rest_span_test
