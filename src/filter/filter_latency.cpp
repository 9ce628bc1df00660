// Delay and length of a chain of filters (filter_chain.h), found by sending a step of load through
// the chain.
#include <algorithm>
#include <cmath>

#include "palpate/core/time.h"
#include "palpate/filter/filter_chain.h"

namespace palpate {
namespace {

constexpr int kPlaces = 1;        // rows and columns of the matrix of the trial
constexpr float kLoad = 1000.0F;  // counts
constexpr int kMaxFrames = 4096;
constexpr double kForgotten = 1e-9;
constexpr std::size_t kMaxMemory = 5000;
// Frames of the mean rate of a Butterworth filter.
constexpr std::size_t kFramesOfRate = 64;
// Where stamps are irregular, the frames may be this much closer than on average.
constexpr double kCloserFrames = 2.0;

// Counts the frames until the middle of the matrix has half the load.
class StepWatcher final : public FrameSink {
 public:
  void take(TactileFrame& frame) override {
    const float middle = frame.matrix(0)(kPlaces / 2, kPlaces / 2);
    if (!arrived_ && middle >= kLoad / 2) arrived_ = frames_;
    ++frames_;
  }
  std::optional<int> arrived() const { return arrived_; }

 private:
  int frames_ = 0;
  std::optional<int> arrived_;
};

// Returns the recipe for the trial: for all matrices, and without steps that use future frames. The
// load is the same on all taxels, so that filters over space change nothing.
Recipe tried(const Recipe& recipe) {
  Recipe causal;
  for (FilterStep step : recipe.steps) {
    if (!step.enabled || !step.causal() || step.kind().domain == FilterDomain::kSpatial) continue;
    if (step.kind().domain == FilterDomain::kSpatioTemporal) step.explicitOptions["size"] = 1;
    step.matrices.clear();
    causal.steps.push_back(std::move(step));
  }
  return causal;
}

std::optional<std::size_t> memoryOf(const FilterStep& step, double rateHz) {
  if (step.kind().option("window") != nullptr) {
    const auto window = static_cast<std::size_t>(step.integer("window"));
    // At the beginning of a stretch, the polynomial also uses later frames.
    return step.name == "savitzky-golay" ? 2 * window : window - 1;
  }
  if (step.kind().domain == FilterDomain::kSpatial) return 0;
  if (!step.causal()) return std::nullopt;
  if (const auto butterworth = butterworthOf(step)) {
    const double frames = kCloserFrames * butterworthLength(*butterworth, rateHz);
    if (!(frames < static_cast<double>(kMaxMemory))) return std::nullopt;
    return static_cast<std::size_t>(frames) + kFramesOfRate;
  }
  if (step.name != "kalman") return kMaxMemory;
  const double q = step.value("q");
  const double r = step.value("r");
  const double gain = (std::sqrt(q * q + 4.0 * q * r) - q) / (2.0 * r);
  if (gain >= 1.0) return 1;
  if (gain <= 0.0) return std::nullopt;
  return std::min(kMaxMemory,
                  static_cast<std::size_t>(std::ceil(std::log(kForgotten) / std::log1p(-gain))));
}

}  // namespace

std::optional<int> latencyFrames(const Recipe& recipe, double rateHz) {
  const Recipe causal = tried(recipe);
  const auto memory = filterLengthFrames(causal, rateHz);
  const double intervalUs = kUsPerS / rateHz;
  const int before =
      static_cast<int>(std::min<std::size_t>(memory.value_or(kMaxFrames), kMaxMemory)) + 2;
  StepWatcher watcher;
  FilterChain chain(causal, watcher);
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(kPlaces, kPlaces, 1.0)});
  TactileFrame frame(layout);
  for (int i = 0; i < before + kMaxFrames && !watcher.arrived(); ++i) {
    frame.layout = layout;
    frame.values.assign(layout->numCells(), i < before ? 0.0F : kLoad);
    frame.hostUs = std::llround(i * intervalUs);
    chain.push(frame);
  }
  if (!watcher.arrived()) return std::nullopt;
  return *watcher.arrived() - before;
}

std::optional<int> latencyFrames(const FilterStep& step, double rateHz) {
  Recipe recipe;
  recipe.steps.push_back(step);
  recipe.steps.back().enabled = true;
  return latencyFrames(recipe, rateHz);
}

std::optional<std::size_t> filterLengthFrames(const Recipe& recipe, double rateHz) {
  std::size_t sum = 0;
  for (const FilterStep& step : recipe.steps) {
    if (!step.enabled) continue;
    const auto memory = memoryOf(step, rateHz);
    if (!memory) return std::nullopt;
    sum += *memory;
  }
  return sum;
}

}  // namespace palpate
