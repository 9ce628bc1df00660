// Filters over time, and over space and time, against closed forms and slow loops.
#include "palpate/filter/frame_filter.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "palpate/device/sdh2.h"
#include "palpate/filter/filter_catalog.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::frame_filter_test {
namespace {

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override { frames.push_back(frame); }
  std::vector<TactileFrame> frames;
};

// One taxel, as long as the series.
std::vector<double> filteredSeries(const std::string& text, const std::vector<double>& series) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 1, 1.0)});
  const auto filter = makeFrameFilter(parseFilterStep(text), layout);
  Collector out;
  std::int64_t us = 0;
  for (const double value : series) {
    TactileFrame frame(layout);
    frame.hostUs = us += 30'000;
    frame.values[0] = static_cast<float>(value);
    filter->push(frame, out);
  }
  filter->finish(out);
  std::vector<double> values;
  us = 0;
  for (const TactileFrame& frame : out.frames) {
    EXPECT_EQ(frame.hostUs, us += 30'000) << text;  // every frame, in order
    values.push_back(static_cast<double>(frame.values[0]));
  }
  EXPECT_EQ(values.size(), series.size()) << text;
  return values;
}

std::vector<double> impulse(std::size_t size, std::size_t at) {
  std::vector<double> series(size, 0.0);
  series[at] = 1.0;
  return series;
}

void expectNear(const std::vector<double>& got,
                const std::vector<double>& expected,
                double tolerance,
                const std::string& what) {
  ASSERT_EQ(got.size(), expected.size()) << what;
  for (std::size_t i = 0; i < got.size(); ++i)
    EXPECT_NEAR(got[i], expected[i], tolerance) << what << " at " << i;
}

// Filters without the frequency 0.
bool passesNoConstant(const FilterKind& kind) {
  return kind.name == "high-pass" || kind.name == "band-pass";
}

TEST(TemporalFilters, ImpulsesShowTheWeights) {
  expectNear(filteredSeries("running-mean", impulse(12, 6)),
             {0, 0, 0, 0, 0, 0, .2, .2, .2, .2, .2, 0},
             1e-7,
             "causal mean");
  expectNear(filteredSeries("running-mean:centred=1", impulse(12, 6)),
             {0, 0, 0, 0, .2, .2, .2, .2, .2, 0, 0, 0},
             1e-7,
             "centred mean");
  const auto g = [](double t) { return std::exp(-t * t / (2 * 1.5 * 1.5)); };
  const double half = g(0) + g(1) + g(2) + g(3) + g(4);
  expectNear(filteredSeries("temporal-gaussian", impulse(12, 6)),
             {0, 0, 0, 0, 0, 0, g(0) / half, g(1) / half, g(2) / half, g(3) / half, g(4) / half, 0},
             1e-7,
             "causal Gaussian");
  const double whole = g(0) + 2 * g(1) + 2 * g(2);
  expectNear(
      filteredSeries("temporal-gaussian:centred=1", impulse(12, 6)),
      {0, 0, 0, 0, g(2) / whole, g(1) / whole, g(0) / whole, g(1) / whole, g(2) / whole, 0, 0, 0},
      1e-7,
      "centred Gaussian");
  // Savitzky and Golay 1964, window 5.
  expectNear(filteredSeries("savitzky-golay:centred=1", impulse(13, 6)),
             {0, 0, 0, 0, -3 / 35., 12 / 35., 17 / 35., 12 / 35., -3 / 35., 0, 0, 0, 0},
             1e-7,
             "smoothing");
  expectNear(filteredSeries("savitzky-golay:order=3,derivative=1,centred=1", impulse(13, 6)),
             {0, 0, 0, 0, -1 / 12., 8 / 12., 0, -8 / 12., 1 / 12., 0, 0, 0, 0},
             1e-7,
             "cubic slope");
  expectNear(filteredSeries("savitzky-golay:derivative=2,centred=1", impulse(13, 6)),
             {0, 0, 0, 0, 2 / 7., -1 / 7., -2 / 7., -1 / 7., 2 / 7., 0, 0, 0, 0},
             1e-7,
             "curvature");
}

TEST(TemporalFilters, TheWindowIsShorterAtTheEnds) {
  const std::vector<double> series = {6, 0, 3, 9};
  expectNear(filteredSeries("running-mean:window=3", series), {6, 3, 3, 4}, 1e-6, "causal");
  expectNear(
      filteredSeries("running-mean:window=3,centred=1", series), {3, 3, 4, 6}, 1e-6, "centred");
  expectNear(filteredSeries("temporal-min", series), {6, 0, 0, 0}, 0, "causal minimum");
  expectNear(filteredSeries("temporal-min:centred=1", series), {0, 0, 0, 3}, 0, "centred minimum");
  // Longer than the recording, and a recording of one frame.
  expectNear(filteredSeries("running-mean:window=101,centred=1", series),
             {4.5, 4.5, 4.5, 4.5},
             1e-6,
             "long");
  for (const FilterKind& kind : filterKinds()) {
    if (kind.name == "threshold" || kind.name == "baseline") continue;  // 7 is below, or no rest
    const double expected = passesNoConstant(kind) ? 0 : 7;
    expectNear(filteredSeries(kind.name, {7}), {expected}, 1e-5, kind.name);
    if (kind.option("centred") != nullptr)
      expectNear(filteredSeries(kind.name + ":centred=1", {7}), {expected}, 1e-5, kind.name);
  }
}

TEST(TemporalFilters, ConstantsStay) {
  const std::vector<double> series(30, 1234.5);
  for (const FilterKind& kind : filterKinds()) {
    if (kind.name == "kelvin-voigt" || kind.name == "baseline") continue;  // what stays is 0
    const std::vector<double> expected =
        passesNoConstant(kind) ? std::vector<double>(30, 0.0) : series;
    expectNear(filteredSeries(kind.name, series), expected, 2e-3, kind.name);
    if (kind.option("centred") != nullptr)
      expectNear(filteredSeries(kind.name + ":centred=1", series), expected, 2e-3, kind.name);
  }
}

TEST(TemporalFilters, PolynomialsPassThroughSavitzkyGolayFromTheFirstFrameToTheLast) {
  std::vector<double> parabola;
  std::vector<double> slope;
  for (int i = 0; i < 20; ++i) {
    parabola.push_back(500 + 30.0 * i - 1.25 * i * i);
    slope.push_back(30.0 - 2.5 * i);
  }
  for (const char* centred : {"", ",centred=1"}) {
    expectNear(filteredSeries(std::string("savitzky-golay:window=7") + centred, parabola),
               parabola,
               1e-4,
               "value");
    const auto got =
        filteredSeries(std::string("savitzky-golay:window=7,derivative=1") + centred, parabola);
    // Causal: two frames make a line, three a parabola.
    for (std::size_t i = centred[0] == 0 ? 2 : 0; i < got.size(); ++i)
      EXPECT_NEAR(got[i], slope[i], 1e-4) << i;
  }
  // Of fewer frames than the window.
  const std::vector<double> three = {1, 4, 9};
  expectNear(
      filteredSeries("savitzky-golay:window=9,centred=1", three), three, 1e-5, "three frames");
}

TEST(TemporalFilters, TheZeroOrderKalmanFilterReachesItsSteadyGain) {
  std::vector<double> step(200, 0.0);
  std::fill(step.begin() + 100, step.end(), 1000.0);
  const auto got = filteredSeries("kalman", step);
  // x_k = 1000 (1 - (1 - K)^k) with K = 0.270156.
  for (std::size_t i = 100; i < 140; ++i)
    EXPECT_NEAR(
        got[i], 1000.0 * (1.0 - std::pow(1.0 - 0.270156, static_cast<double>(i) - 99.0)), 2e-3)
        << i;
  // And what is left of it long after is nothing.
  std::vector<double> gone(300, 0.0);
  std::fill(gone.begin() + 100, gone.begin() + 110, 1000.0);
  EXPECT_EQ(filteredSeries("kalman", gone).back(), 0.0);
}

TEST(TemporalFilters, TheSmootherIsSymmetricAndWithoutDelay) {
  const auto got = filteredSeries("rts", impulse(201, 100));
  for (std::size_t i = 1; i < 60; ++i) EXPECT_NEAR(got[100 - i], got[100 + i], 1e-6) << i;
  // Steady smoother: K / (2 - K) (1 - K)^|n|.
  const double gain = 0.270156;
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(got[100 + i], gain / (2 - gain) * std::pow(1 - gain, static_cast<double>(i)), 1e-6)
        << i;
  EXPECT_EQ(filteredSeries("kalman:centred=1", impulse(201, 100)), got);
}

TEST(SpatioTemporalFilters, AreWhatTheyAreCalled) {
  std::vector<MatrixLayout> matrices = {sdh2().layout->matrix(1), MatrixLayout::full(9, 6, 3.4)};
  const auto layout = std::make_shared<const SensorLayout>(matrices);
  std::mt19937 random(3);
  std::vector<TactileFrame> input(12, TactileFrame(layout));
  for (TactileFrame& frame : input)
    for (float& value : frame.values)
      value = random() % 3 ? static_cast<float>(random() % 4096) : 0.0F;
  struct Case {
    const char* text;
    int radius;
    int before;  // frames of the window
    int after;
    bool minimumFirst;
  };
  for (const Case& one : {Case{"median3d", 1, 2, 0, false},
                          Case{"median3d:centred=1", 1, 1, 1, false},
                          Case{"median3d:size=5,window=3", 2, 2, 0, false},
                          Case{"median3d:window=5,centred=1", 1, 2, 2, false},
                          Case{"min-median", 1, 2, 0, true},
                          Case{"min-median:window=2,size=5", 2, 1, 0, true},
                          Case{"min-median:centred=1", 1, 1, 1, true}}) {
    const auto filter = makeFrameFilter(parseFilterStep(one.text), layout);
    Collector out;
    for (TactileFrame frame : input) filter->push(frame, out);
    filter->finish(out);
    ASSERT_EQ(out.frames.size(), input.size());
    const int last = static_cast<int>(input.size()) - 1;
    for (int k = 0; k <= last; ++k) {
      for (std::size_t m = 0; m < matrices.size(); ++m) {
        const MatrixLayout& shape = matrices[m];
        for (int y = 0; y < shape.rows; ++y) {
          for (int x = 0; x < shape.columns; ++x) {
            const auto frameAt = [&](int i) -> const TactileFrame& {
              return input[static_cast<std::size_t>(std::clamp(i, 0, last))];
            };
            float expected = frameAt(k).matrix(m)(y, x);
            if (shape.enabled(y, x)) {
              std::vector<float> values;
              for (int dy = -one.radius; dy <= one.radius; ++dy) {
                for (int dx = -one.radius; dx <= one.radius; ++dx) {
                  const int fromY = std::clamp(y + dy, 0, shape.rows - 1);
                  const int fromX = std::clamp(x + dx, 0, shape.columns - 1);
                  if (!shape.enabled(fromY, fromX)) continue;
                  std::vector<float> times;
                  for (int i = k - one.before; i <= k + one.after; ++i)
                    times.push_back(frameAt(i).matrix(m)(fromY, fromX));
                  if (one.minimumFirst)
                    values.push_back(*std::min_element(times.begin(), times.end()));
                  else
                    values.insert(values.end(), times.begin(), times.end());
                }
              }
              std::sort(values.begin(), values.end());
              expected = values[(values.size() - 1) / 2];
            }
            ASSERT_EQ(out.frames[static_cast<std::size_t>(k)].matrix(m)(y, x), expected)
                << one.text << " frame " << k << " matrix " << m << " row " << y << " column " << x;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace palpate::frame_filter_test
