#include "palpate/calibration/tare.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/statistics.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr std::size_t kFewestFrames = 3;

// One window of the recording: mean and standard deviation per place.
struct Window {
  UnloadedWindow frames;
  std::vector<float> mean, sd;
};

class WindowSums {
 public:
  explicit WindowSums(std::size_t places) : sum_(places), squares_(places) {}
  void add(std::span<const float> values) {
    for (std::size_t p = 0; p < values.size(); ++p) {
      const double v = static_cast<double>(values[p]);
      sum_[p] += v;
      squares_[p] += v * v;
    }
    ++frames_;
  }
  std::size_t frames() const noexcept { return frames_; }
  Window finish(UnloadedWindow frames) {
    Window window;
    window.frames = frames;
    const auto n = static_cast<double>(frames_);
    for (std::size_t p = 0; p < sum_.size(); ++p) {
      const double mean = sum_[p] / n;
      window.mean.push_back(static_cast<float>(mean));
      window.sd.push_back(
          static_cast<float>(std::sqrt(std::max(squares_[p] / n - mean * mean, 0.0))));
    }
    std::fill(sum_.begin(), sum_.end(), 0.0);
    std::fill(squares_.begin(), squares_.end(), 0.0);
    frames_ = 0;
    return window;
  }

 private:
  std::vector<double> sum_, squares_;
  std::size_t frames_ = 0;
};

// The asked length, or as much as it takes to hold the fewest frames [s].
double windowLengthS(const Profile& profile, double askedS) {
  constexpr std::size_t kMaxIntervals = 4096;
  std::vector<float> intervals;
  for (std::size_t i = 1; i < profile.numFrames() && intervals.size() < kMaxIntervals; ++i)
    intervals.push_back(static_cast<float>(profile.frameTimeUs(i) - profile.frameTimeUs(i - 1)));
  if (intervals.empty()) return askedS;
  const double usualS = static_cast<double>(upperMedian(std::span(intervals))) / kUsPerS;
  return std::max(askedS, usualS * static_cast<double>(kFewestFrames));
}

std::vector<Window> windowsOf(const Profile& profile, double windowS, const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  std::vector<Window> windows;
  WindowSums sums(profile.layout().numCells());
  TactileFrame frame;
  std::size_t begin = 0;
  const auto close = [&](std::size_t end) {
    if (sums.frames() >= kFewestFrames)
      windows.push_back(sums.finish({begin, end}));
    else if (sums.frames() > 0)
      sums.finish({begin, end});
    begin = end + 1;
  };
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    if (i > begin && static_cast<double>(profile.frameTimeUs(i) - profile.frameTimeUs(begin)) >=
                         windowS * kUsPerS)
      close(i - 1);
    profile.readFrame(i, frame);
    sums.add(frame.values);
  }
  if (profile.numFrames() > 0) close(profile.numFrames() - 1);
  return windows;
}

float largest(const std::vector<float>& values, std::size_t offset, std::size_t count) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(offset);
  return *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(count));
}

MatrixTare tareOf(const std::vector<Window>& windows,
                  std::size_t offset,
                  std::size_t count,
                  const TareOptions& options,
                  std::span<float> zero) {
  MatrixTare tare;
  std::vector<const Window*> calm;
  double calmest = 0.0;
  for (const Window& window : windows) {
    if (static_cast<double>(largest(window.sd, offset, count)) > options.maxSdCounts) continue;
    const auto rest = static_cast<double>(largest(window.mean, offset, count));
    calmest = calm.empty() ? rest : std::min(calmest, rest);
    calm.push_back(&window);
  }
  if (calm.empty()) {
    tare.note = windows.empty() ? "the recording is too short"
                                : "never still: something moves in every window";
    return tare;
  }
  if (calmest > options.maxRestCounts) {
    tare.note = "never unloaded: its calmest window reads " + fixedText(calmest, 0) + " counts";
    return tare;
  }
  std::erase_if(calm, [&](const Window* window) {
    return static_cast<double>(largest(window->mean, offset, count)) >
           calmest + options.sameRestCounts;
  });
  std::vector<float> means(calm.size());
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t w = 0; w < calm.size(); ++w) means[w] = calm[w]->mean[offset + p];
    const float atRest = upperMedian(std::span(means));
    zero[offset + p] = atRest;
    tare.raisedTaxels += atRest > 0.0F ? 1 : 0;
    tare.largestZero = std::max(tare.largestZero, static_cast<double>(atRest));
  }
  for (const Window* window : calm) {
    if (!tare.windows.empty() && tare.windows.back().end + 1 == window->frames.begin)
      tare.windows.back().end = window->frames.end;
    else
      tare.windows.push_back(window->frames);
  }
  tare.valid = true;
  return tare;
}

// Share of the frames that lie in unloaded windows, 0..1.
double shareAtRest(const MatrixTare& matrix, std::size_t numFrames) {
  std::size_t frames = 0;
  for (const UnloadedWindow& window : matrix.windows) frames += window.end - window.begin + 1;
  return numFrames > 0 ? static_cast<double>(frames) / static_cast<double>(numFrames) : 0.0;
}

}  // namespace

void TareOptions::validate() const {
  constexpr OptionCheck check{"TareOptions"};
  check(kWindowS, "windowS", windowS);
  check(kMaxRestCounts, "maxRestCounts", maxRestCounts);
  check(sameRestCounts >= 0.0, "sameRestCounts", sameRestCounts);
  check(maxSdCounts >= 0.0, "maxSdCounts", maxSdCounts);
}

bool Tare::any() const {
  return std::any_of(zero.begin(), zero.end(), [](float z) { return z > 0.0F; });
}

Tare findTare(const Profile& profile, const TareOptions& options, const Progress& progress) {
  options.validate();
  const SensorLayout& layout = profile.layout();
  Tare tare;
  tare.zero.assign(layout.numCells(), 0.0F);
  const std::vector<Window> windows =
      windowsOf(profile, windowLengthS(profile, options.windowS), progress);
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    tare.matrices.push_back(
        tareOf(windows, layout.offset(m), layout.matrix(m).numCells(), options, tare.zero));
  return tare;
}

bool wasAtRest(const MatrixTare& matrix, std::size_t numFrames, double leastShare) {
  return matrix.valid && shareAtRest(matrix, numFrames) >= leastShare;
}

std::string notAtRest(const Tare& tare, const Profile& profile, double leastShare) {
  std::string text;
  for (std::size_t m = 0; m < tare.matrices.size(); ++m) {
    const MatrixTare& matrix = tare.matrices[m];
    if (wasAtRest(matrix, profile.numFrames(), leastShare)) continue;
    const double touched = 1.0 - shareAtRest(matrix, profile.numFrames());
    text += text.empty() ? "not at rest: " : "; ";
    text += profile.hand().matrixName(m) + " (";
    text += matrix.valid ? "touched or moved in " + fixedText(100.0 * touched, 0) + " % of the time"
                         : matrix.note;
    text += ")";
  }
  return text;
}

void applyTare(const Tare& tare, std::span<float> values) {
  if (tare.zero.size() != values.size())
    throw std::invalid_argument("applyTare: " + std::to_string(tare.zero.size()) + " zeros for " +
                                std::to_string(values.size()) + " values");
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = values[p] > tare.zero[p] ? values[p] - tare.zero[p] : 0.0F;
}

Json jsonOf(const Tare& tare, const SensorLayout& layout) {
  Json matrices = Json::array();
  for (std::size_t m = 0; m < tare.matrices.size(); ++m) {
    const MatrixTare& one = tare.matrices[m];
    Json zero = Json::array(), windows = Json::array();
    for (std::size_t p = 0; p < layout.matrix(m).numCells(); ++p)
      zero.push(static_cast<double>(tare.zero[layout.offset(m) + p]));
    for (const UnloadedWindow& window : one.windows)
      windows.push(Json::array().push(window.begin).push(window.end));
    Json json = Json::object();
    json.set("index", m).set("valid", one.valid).set("largest_zero", one.largestZero);
    json.set("raised_taxels", one.raisedTaxels)
        .set("zero", std::move(zero))
        .set("windows", std::move(windows));
    if (!one.note.empty()) json.set("note", one.note);
    matrices.push(std::move(json));
  }
  return Json::object().set("matrices", std::move(matrices));
}

Tare tareFrom(const Json& json, const SensorLayout& layout) {
  const Json matrices = json.at("matrices");
  if (!matrices.isArray() || matrices.size() != layout.numMatrices())
    throw Error("tare: not of a sensor with " + std::to_string(layout.numMatrices()) + " matrices");
  Tare tare;
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const Json one = matrices.at(m), zero = one.at("zero"), windows = one.at("windows");
    if (zero.size() != layout.matrix(m).numCells())
      throw Error("tare: matrix " + std::to_string(m) + " has " + std::to_string(zero.size()) +
                  " zeros, not " + std::to_string(layout.matrix(m).numCells()));
    MatrixTare back;
    back.valid = one.at("valid").isBool() && one.at("valid").asBool();
    for (std::size_t p = 0; p < zero.size(); ++p) {
      const double value = zero.at(p).asDouble();
      if (!(value >= 0.0)) throw Error("tare: matrix " + std::to_string(m) + " has a zero below 0");
      tare.zero.push_back(static_cast<float>(value));
      back.raisedTaxels += value > 0.0 ? 1 : 0;
      back.largestZero = std::max(back.largestZero, value);
    }
    for (std::size_t w = 0; w < windows.size(); ++w) {
      const auto begin = windows.at(w).at(0).asInteger(), end = windows.at(w).at(1).asInteger();
      if (begin < 0 || end < begin)
        throw Error("tare: matrix " + std::to_string(m) +
                    " has a window that ends before it begins");
      back.windows.push_back({static_cast<std::size_t>(begin), static_cast<std::size_t>(end)});
    }
    tare.matrices.push_back(std::move(back));
  }
  return tare;
}

}  // namespace palpate
