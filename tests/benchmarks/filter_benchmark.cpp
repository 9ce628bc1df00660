// Filters over the six matrices of a hand, all loaded; OpenCV on the same frame beside each.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "palpate/device/sdh2.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/hand_description.h"

namespace {

using namespace palpate;

// Every taxel has a value of its own: no shortcut for empty matrices.
std::vector<TactileFrame> loadedFrames() {
  std::mt19937 random(1);
  std::vector<TactileFrame> frames(16, TactileFrame(sdh2().layout));
  for (TactileFrame& frame : frames)
    for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m)
      for (int y = 0; y < frame.layout->matrix(m).rows; ++y)
        for (int x = 0; x < frame.layout->matrix(m).columns; ++x)
          if (frame.layout->matrix(m).enabled(y, x))
            frame.matrix(m)(y, x) = static_cast<float>(1 + random() % 3500);
  return frames;
}

class Last final : public FrameSink {
 public:
  void take(TactileFrame& frame) override { benchmark::DoNotOptimize(frame.values.data()); }
};

// One frame after the other through a recipe, at 230 frames/s by their stamps.
void filterHand(benchmark::State& state, const char* text) {
  const std::vector<TactileFrame> frames = loadedFrames();
  const std::string texts[] = {text};
  Last last;
  FilterChain chain(parseRecipe(texts), last);
  TactileFrame frame = frames[0];
  std::int64_t stampUs = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    frame.values = frames[i++ % frames.size()].values;
    frame.hostUs = stampUs += 4348;
    chain.push(frame);
  }
}

enum class Reference { kMedian, kGaussian, kBilateral };

void filterHandByOpenCv(benchmark::State& state, Reference which) {
  cv::setNumThreads(1);
  std::vector<TactileFrame> frames = loadedFrames();
  std::size_t i = 0;
  cv::Mat out;
  for (auto _ : state) {
    TactileFrame& frame = frames[i++ % frames.size()];
    for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
      const MatrixLayout& layout = frame.layout->matrix(m);
      const cv::Mat in(
          layout.rows, layout.columns, CV_32F, frame.values.data() + frame.layout->offset(m));
      if (which == Reference::kMedian) cv::medianBlur(in, out, 3);
      if (which == Reference::kGaussian)
        cv::GaussianBlur(in, out, {3, 3}, 0.849322, 0, cv::BORDER_REPLICATE);
      if (which == Reference::kBilateral)
        cv::bilateralFilter(in, out, 3, 50, 3, cv::BORDER_REPLICATE);
      benchmark::DoNotOptimize(out.data);
    }
  }
}

// The default chain of high sensitivity: below 43 us is below 1 % of a core at 230 frames/s.
void defaultChain(benchmark::State& state) {
  filterHand(state, recipeText(highSensitivityRecipe()).c_str());
}

BENCHMARK(defaultChain);
BENCHMARK_CAPTURE(filterHand, nothing, "(median)");
BENCHMARK_CAPTURE(filterHand, median, "median");
BENCHMARK_CAPTURE(filterHandByOpenCv, median, Reference::kMedian);
BENCHMARK_CAPTURE(filterHand, gaussian, "gaussian");
BENCHMARK_CAPTURE(filterHandByOpenCv, gaussian, Reference::kGaussian);
BENCHMARK_CAPTURE(filterHand, bilateral, "bilateral");
BENCHMARK_CAPTURE(filterHandByOpenCv, bilateral, Reference::kBilateral);
BENCHMARK_CAPTURE(filterHand, median3d, "median3d");
BENCHMARK_CAPTURE(filterHand, minMedian, "min-median");
BENCHMARK_CAPTURE(filterHand, box, "box");
BENCHMARK_CAPTURE(filterHand, median5x5, "median:size=5");
BENCHMARK_CAPTURE(filterHand, opening, "opening:shape=ellipse,size=5");
BENCHMARK_CAPTURE(filterHand, nonLocalMeans, "nlm");
BENCHMARK_CAPTURE(filterHand, runningMean, "running-mean");
BENCHMARK_CAPTURE(filterHand, temporalMin, "temporal-min");
BENCHMARK_CAPTURE(filterHand, kalman, "kalman");
BENCHMARK_CAPTURE(filterHand, savitzkyGolay, "savitzky-golay:window=7");
BENCHMARK_CAPTURE(filterHand, lowPass, "low-pass:order=4");

}  // namespace
