#include "palpate/signals/histogram.h"

#include <limits>
#include <stdexcept>

#include "reference_signals.h"
#include "testing/testing.h"

namespace palpate::histogram_test {
namespace {

// 100 (a + b + 0.3 a^2) of two noises.
std::vector<double> bumpy() {
  const std::vector<double> a = testing::referenceNoise(1), b = testing::referenceNoise(2);
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i)
    values.push_back(100.0 * (a[i] + b[i] + 0.3 * a[i] * a[i]));
  return values;
}

// numpy 1.24: numpy.histogram(values, "auto"), and with 5 bins.
TEST(Histogram, IsNumPys) {
  const Histogram automatic = histogramOf(bumpy());
  EXPECT_EQ(automatic.counts,
            (std::vector<std::size_t>{10, 14, 28, 51, 70, 69, 66, 66, 71, 51, 46, 29, 26, 3}));
  EXPECT_NEAR(automatic.low, -88.38821768, 1e-8);
  EXPECT_NEAR(automatic.width, 13.7903666081, 1e-9);
  EXPECT_EQ(histogramOf(bumpy(), 5).counts, (std::vector<std::size_t>{48, 167, 185, 149, 51}));
}

TEST(Histogram, LeavesOutWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Histogram histogram = histogramOf(std::vector{1.0, nan, 2.0, 2.0, 3.0}, 2);
  EXPECT_EQ(histogram.notFinite, 1u);
  EXPECT_EQ(histogram.counts, (std::vector<std::size_t>{1, 3}));  // 2 begins the second bin
  EXPECT_EQ(histogram.width, 1.0);
}

TEST(Histogram, OfOneValueOrNone) {
  const Histogram same = histogramOf(std::vector{7.0, 7.0, 7.0});
  EXPECT_EQ(same.counts, std::vector<std::size_t>{3});
  EXPECT_EQ(same.low, 6.5);
  EXPECT_EQ(same.width, 1.0);
  EXPECT_TRUE(histogramOf({}).counts.empty());
  EXPECT_THROW(histogramOf(std::vector{1.0}, 1001), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::histogram_test
