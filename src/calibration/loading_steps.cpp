#include "palpate/calibration/loading_steps.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/statistics.h"
#include "palpate/core/time.h"
#include "palpate/model/timing.h"

namespace palpate {
namespace {

// A release is noticed where the signal crosses releaseFraction; it began a little earlier.
constexpr std::size_t kFramesOfRelease = 2;

std::vector<bool> gapsBehind(const StepSignal& signal) {
  std::vector<std::int64_t> stamps;
  for (const double t : signal.timeS) stamps.push_back(std::llround(t * kUsPerS));
  std::vector<bool> behind(stamps.size(), false);
  for (const Gap& gap : timingOf(stamps).gaps) behind[gap.frame] = true;
  return behind;
}

// Returns the last frame before the load is removed.
std::size_t beforeRelease(std::span<const double> values,
                          const LoadingStep& step,
                          double releaseFraction) {
  const std::size_t middle = step.begin + (step.end - step.begin) / 2;
  const auto secondHalf = values.subspan(middle, step.end - middle + 1);
  const double level = upperMedian(std::vector(secondHalf.begin(), secondHalf.end()));
  std::size_t end = step.end;
  while (end > middle && !(values[end] >= releaseFraction * level)) --end;
  return end - std::min(end - middle, kFramesOfRelease);
}

}  // namespace

void LoadingStepOptions::validate() const {
  constexpr OptionCheck check{"LoadingStepOptions"};
  check(kAboveCounts, "aboveCounts", aboveCounts);
  check(kMinDurationS, "minDurationS", minDurationS);
  check(minFrames >= 6, "minFrames", static_cast<double>(minFrames));
  check(OptionRange{0.0, 1.0}, "releaseFraction", releaseFraction);
}

StepSignal stepSignal(const Profile& profile,
                      std::size_t matrix,
                      SignalKind signal,
                      const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  const MatrixLayout layout = profile.layout().matrix(matrix);
  const std::size_t first = profile.layout().offset(matrix);
  std::vector<bool> wasOn(layout.numCells(), false);
  const float saturation = profile.hand().saturationOf(matrix);
  StepSignal out;
  out.timeS.reserve(profile.numFrames());
  out.values.reserve(profile.numFrames());
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    out.timeS.push_back(static_cast<double>(frame.hostUs - profile.frameTimeUs(0)) / kUsPerS);
    const std::span<const float> values = std::span(frame.values).subspan(first, layout.numCells());
    int saturated = 0, switched = 0, active = 0;
    for (std::size_t place = 0; place < values.size(); ++place) {
      const bool on = isTouched(values[place]);
      active += on ? 1 : 0;
      saturated += values[place] >= saturation ? 1 : 0;
      switched += on != wasOn[place] ? 1 : 0;
      wasOn[place] = on;
    }
    const auto matrixValues = std::as_const(frame).matrix(matrix);
    out.values.push_back(active > 0 ? valueOf(characteristicSignals(matrixValues, layout), signal)
                                    : 0.0);
    out.activeTaxels.push_back(active);
    out.saturatedTaxels.push_back(saturated);
    out.toggledTaxels.push_back(i == 0 ? 0 : switched);
  }
  return out;
}

std::vector<LoadingStep> findLoadingSteps(const StepSignal& signal,
                                          const LoadingStepOptions& options) {
  options.validate();
  const std::size_t n = signal.values.size();
  if (signal.timeS.size() != n)
    throw std::invalid_argument("findLoadingSteps: times and values differ in number");
  const std::vector<bool> gapBehind = gapsBehind(signal);
  const auto loaded = [&](std::size_t i) { return signal.values[i] > options.aboveCounts; };
  std::vector<LoadingStep> steps;
  for (std::size_t i = 0; i < n;) {
    if (!loaded(i)) {
      ++i;
      continue;
    }
    LoadingStep step;
    step.beginSeen = i > 0 && !gapBehind[i - 1];
    step.begin = step.beginSeen ? i - 1 : i;
    std::size_t last = i, unloaded = 0;
    bool cut = gapBehind[i];
    std::size_t next = i + 1;
    for (; next < n && !cut && unloaded <= options.bridgedFrames; ++next) {
      if (loaded(next)) {
        step.flickerFrames += next - last - 1;
        last = next;
        unloaded = 0;
      } else {
        ++unloaded;
      }
      cut = gapBehind[next];
    }
    step.end = last;
    step.released = unloaded > options.bridgedFrames;
    if (step.released) step.end = beforeRelease(signal.values, step, options.releaseFraction);
    const bool lasts = signal.timeS[step.end] - signal.timeS[step.begin] >= options.minDurationS;
    if (lasts && step.end - step.begin + 1 >= options.minFrames) steps.push_back(step);
    i = std::max(next, last + 1);
  }
  return steps;
}

}  // namespace palpate
