#include "palpate/model/touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

// Of the readings of one matrix.
struct MatrixReadings {
  const MatrixLayout& layout;
  std::span<const float> readings;
  const Baseline* baseline;
  std::size_t first;  // of the matrix among all readings

  // Finite for any two readings.
  float difference(std::size_t i) const {
    return std::clamp(
        readings[first + i] - (baseline ? baseline->rest[first + i] : 0.0F), -kLargest, kLargest);
  }
  float limit(std::size_t i) const {
    const float noise = baseline && !baseline->noise.empty() ? baseline->noise[first + i] : 0.0F;
    return std::max(layout.touch.threshold, layout.touch.sigmas * noise);
  }
};

void requireSize(std::size_t size, std::size_t wanted, const char* what) {
  if (size != wanted)
    throw std::invalid_argument(std::string(what) + ": expected " + std::to_string(wanted) +
                                " readings, got " + std::to_string(size));
}

}  // namespace

std::shared_ptr<const Baseline> baselineAt(const Baselines& baselines, std::int64_t timeUs) {
  if (baselines.empty()) return nullptr;
  const auto later = std::upper_bound(
      baselines.begin(), baselines.end(), timeUs, [](std::int64_t us, const auto& each) {
        return us < each.first;
      });
  return (later == baselines.begin() ? later : std::prev(later))->second;
}

void decideTouch(TactileFrame& frame, std::shared_ptr<const Baseline> baseline) {
  if (frame.readings.empty()) return;
  const SensorLayout& layout = *frame.layout;
  requireSize(frame.readings.size(), layout.numReadings(), "frame");
  if (baseline) requireSize(baseline->rest.size(), layout.numReadings(), "baseline");
  if (baseline && !baseline->noise.empty())
    requireSize(baseline->noise.size(), layout.numReadings(), "noise of the baseline");
  frame.values.assign(layout.numCells(), 0.0F);
  frame.filtered.assign(layout.numCells(), 0.0F);
  bool same = true;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixReadings of{
        layout.matrix(m), frame.readings, baseline.get(), layout.readingOffset(m)};
    const TouchRule& rule = of.layout.touch;
    const auto step = static_cast<std::size_t>(rule.components);
    float* const values = frame.values.data() + layout.offset(m);
    float* const shown = frame.filtered.data() + layout.offset(m);
    for (std::size_t place = 0; place < of.layout.numCells(); ++place) {
      if (of.layout.staticMask[place] == 0) continue;
      const std::size_t z = place * step + step - 1;
      shown[place] = rule.isSigned ? std::abs(of.difference(z)) : of.difference(z);
      const float length =
          step == 3 ? std::min(std::hypot(of.difference(z - 2), of.difference(z - 1), shown[place]),
                               kLargest)
                    : shown[place];
      float limit = of.limit(z);
      for (std::size_t k = place * step; k < z; ++k) limit = std::max(limit, of.limit(k));
      // Something that only shears is touched, too.
      if (length > limit)
        values[place] = shown[place] = std::max(shown[place], std::numeric_limits<float>::min());
      same = same && values[place] == shown[place];
    }
  }
  if (same) frame.filtered.clear();
  frame.baseline = std::move(baseline);
}

std::array<float, 3> forceAt(const TactileFrame& frame, const TaxelPlace& place) {
  const MatrixLayout& layout = frame.layout->matrix(place.matrix);
  const auto cell = static_cast<std::size_t>(place.y * layout.columns + place.x);
  if (frame.readings.empty())
    return {0.0F, 0.0F, frame.allValues().at(frame.layout->offset(place.matrix) + cell)};
  const MatrixReadings of{
      layout, frame.readings, frame.baseline.get(), frame.layout->readingOffset(place.matrix)};
  if (layout.touch.components == 1) return {0.0F, 0.0F, of.difference(cell)};
  return {of.difference(3 * cell), of.difference(3 * cell + 1), of.difference(3 * cell + 2)};
}

namespace {

constexpr std::size_t kMaxReadings = std::size_t{1} << 26;  // that a baseline is taken of: 256 MB
constexpr std::size_t kFramesThatTell = 16;                 // whether readings are at rest
constexpr double kRestSigmas = 3.0;
constexpr double kRestShare = 0.002;  // of the full scale

// Mean and variance of every reading of frames.
struct Moments {
  std::vector<double> means, variances;
};
Moments momentsOf(std::span<const float> readings, std::size_t numFrames) {
  const std::size_t count = readings.size() / numFrames;
  const auto n = static_cast<double>(numFrames);
  Moments of{std::vector<double>(count), std::vector<double>(count)};
  for (std::size_t i = 0; i < readings.size(); ++i)
    of.means[i % count] += static_cast<double>(readings[i]);
  for (double& mean : of.means) mean /= n;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double off = static_cast<double>(readings[i]) - of.means[i % count];
    of.variances[i % count] += off * off;
  }
  for (double& variance : of.variances) variance /= n - 1.0;
  return of;
}

void requireAtRest(std::span<const float> readings, std::size_t numFrames, double fullScale) {
  if (fullScale <= 0.0 || numFrames < kFramesThatTell) return;
  const std::size_t half = numFrames / 2;
  const std::size_t ofFirst = readings.size() / numFrames * half;
  const Moments first = momentsOf(readings.first(ofFirst), half);
  const Moments second = momentsOf(readings.subspan(ofFirst), numFrames - half);
  std::size_t moving = 0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < first.means.size(); ++i) {
    const double change = std::abs(second.means[i] - first.means[i]);
    // Of what begins to press within one half the other one knows the noise.
    const double noise = std::sqrt(std::min(first.variances[i], second.variances[i]));
    if (change <= kRestSigmas * noise || change <= kRestShare * fullScale) continue;
    ++moving;
    farthest = std::max(farthest, change);
  }
  if (moving > 0)
    throw Error("no baseline was taken: " + counted(moving, "reading") + " moved, by up to " +
                fixedText(farthest, 1) + "; take it while nothing touches the sensor");
}

}  // namespace

void RestMeter::add(std::span<const float> readings) {
  if (numFrames_ > 0) requireSize(readings.size(), readings_.size() / numFrames_, "frame");
  if (readings_.size() + readings.size() > kMaxReadings)
    throw std::invalid_argument("a baseline of more than " + std::to_string(numFrames_) +
                                " frames: take a shorter span");
  readings_.insert(readings_.end(), readings.begin(), readings.end());
  ++numFrames_;
}

Baseline RestMeter::baseline() const {
  if (numFrames_ < 2)
    throw std::invalid_argument("a baseline needs at least two frames, there are " +
                                std::to_string(numFrames_));
  requireAtRest(readings_, numFrames_, fullScale_);
  const Moments of = momentsOf(readings_, numFrames_);
  Baseline baseline;
  for (const double mean : of.means) baseline.rest.push_back(static_cast<float>(mean));
  for (const double variance : of.variances)
    baseline.noise.push_back(static_cast<float>(std::sqrt(variance)));
  return baseline;
}

std::string baselineText(const Baseline& baseline, std::size_t numFrames) {
  const auto [low, high] = std::minmax_element(baseline.rest.begin(), baseline.rest.end());
  std::string text =
      counted(numFrames, "frame") + ": " + counted(baseline.rest.size(), "reading") + " at rest";
  if (low != baseline.rest.end())
    text += " from " + fixedText(static_cast<double>(*low), 1) + " to " +
            fixedText(static_cast<double>(*high), 1);
  if (!baseline.noise.empty())
    text += ", noise up to " + fixedText(static_cast<double>(*std::max_element(
                                             baseline.noise.begin(), baseline.noise.end())),
                                         1);
  return text;
}

namespace {

// The shortest number that says the same float.
Json numberOf(float value) { return parseDouble(numberText(value)).value(); }
Json numbersOf(const std::vector<float>& values) { return jsonList(values, numberOf); }

std::vector<float> floatsOf(const Json& list) {
  std::vector<float> values;
  for (std::size_t i = 0; i < list.size(); ++i) {
    values.push_back(static_cast<float>(list.at(i).asDouble()));
    if (!std::isfinite(values.back())) throw Error("a reading is not a number");
  }
  return values;
}

}  // namespace

Event baselineEvent(const Baseline& baseline, std::int64_t timeUs, const char* kind) {
  const bool isTaken = std::ranges::count(baseline.rest, 0.0F) < std::ssize(baseline.rest);
  Event event{timeUs,
              timeUs,
              kind,
              {},
              isTaken ? "the readings at rest" : "none was taken: 0 everywhere",
              ""};
  Json json = Json::object().set("rest", numbersOf(baseline.rest));
  if (!baseline.noise.empty()) json.set("noise", numbersOf(baseline.noise));
  event.json = json.text(-1);
  if (event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
    throw Error("a baseline of " + std::to_string(baseline.rest.size()) +
                " readings is longer than an event may be");
  return event;
}

namespace {
Baselines baselinesOfKind(const char* kind,
                          std::span<const Event> events,
                          const SensorLayout& layout,
                          std::size_t* wrong) {
  Baselines baselines;
  for (const Event& event : events) {
    if (event.kind != kind) continue;
    try {
      const Json json = Json::parse(event.json);
      Baseline read{floatsOf(json.at("rest")), floatsOf(json.at("noise"))};
      requireSize(read.rest.size(), layout.numReadings(), "baseline");
      if (!read.noise.empty()) requireSize(read.noise.size(), layout.numReadings(), "noise");
      baselines.emplace_back(event.tUs, std::make_shared<const Baseline>(std::move(read)));
    } catch (const std::exception&) {
      if (wrong) ++*wrong;
    }
  }
  std::stable_sort(baselines.begin(), baselines.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  return baselines;
}
}  // namespace

Baselines baselinesOf(std::span<const Event> events,
                      const SensorLayout& layout,
                      std::size_t* wrong) {
  Baselines recorded = baselinesOfKind(kBaselineKind, events, layout, wrong);
  Baselines later = baselinesOfKind(kNewBaselineKind, events, layout, wrong);
  return later.empty() ? recorded : later;
}

Baselines recordedBaselinesOf(std::span<const Event> events, const SensorLayout& layout) {
  return baselinesOfKind(kBaselineKind, events, layout, nullptr);
}

std::vector<Event> baselineEvents(const Baselines& baselines) {
  std::vector<Event> events;
  for (const auto& [timeUs, baseline] : baselines)
    events.push_back(baselineEvent(*baseline, timeUs));
  return events;
}

SensorLayout withoutTouchRules(const SensorLayout& layout) {
  std::vector<MatrixLayout> matrices = layout.matrices();
  for (MatrixLayout& matrix : matrices) matrix.touch = {};
  return SensorLayout(std::move(matrices));
}

std::string readingsText(const SensorLayout& layout) {
  std::vector<std::string> kinds;
  for (const MatrixLayout& matrix : layout.matrices()) {
    const TouchRule& rule = matrix.touch;
    std::string kind = rule.components == 1
                           ? std::string()
                           : counted(static_cast<std::uint64_t>(rule.components), "component");
    if (rule.isSigned) kind += kind.empty() ? "signed" : ", signed";
    if (!kind.empty() && std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(kind);
  }
  std::string text;
  for (const std::string& kind : kinds) text += (text.empty() ? "" : "; ") + kind;
  return text;
}

std::string touchRulesText(const SensorLayout& layout) {
  return jsonList(layout.matrices(),
                  [](const MatrixLayout& matrix) {
                    const TouchRule& rule = matrix.touch;
                    return Json::object()
                        .set("components", rule.components)
                        .set("signed", rule.isSigned)
                        .set("threshold", numberOf(rule.threshold))
                        .set("sigmas", numberOf(rule.sigmas));
                  })
      .text(-1);
}

SensorLayout withTouchRules(const SensorLayout& layout, std::string_view text) {
  const Json rules = Json::parse(text);
  std::vector<MatrixLayout> matrices = layout.matrices();
  if (rules.size() != matrices.size()) throw Error("the rules of touch are not one per matrix");
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const Json rule = rules.at(m);
    const std::int64_t components = rule.at("components").asInteger();
    matrices[m].touch = {components == 3   ? 3
                         : components == 1 ? 1
                                           : 0,
                         rule.at("signed").asBool(),
                         static_cast<float>(rule.at("threshold").asDouble()),
                         static_cast<float>(rule.at("sigmas").asDouble())};
  }
  try {
    return SensorLayout(std::move(matrices));
  } catch (const std::invalid_argument& error) {
    throw Error(std::string("the rules of touch are invalid: ") + error.what());
  }
}

}  // namespace palpate
