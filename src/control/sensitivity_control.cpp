#include "palpate/control/sensitivity_control.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/statistics.h"
#include "palpate/core/time.h"

#include "control/command_answers.h"

namespace palpate {
namespace {

constexpr std::size_t kMinStamps = 10;  // number of frames needed to measure the rate
constexpr std::size_t kMaxStamps = 64;
// time limit for temperatures before the start without them
constexpr double kTemperaturesWithinS = 3.0;
constexpr std::int64_t kStaleUs = 1'000'000;  // without a frame for this time no rate is known

// Frames of one or two seconds: if step() is called less often, frames are skipped without harm.
const CaptureQueueOptions kFeed{
    .tactileItems = 256, .motionItems = 256, .eventItems = 64, .onlyHand = true};

TactileThresholds resetOf(const HandDescription& hand) {
  TactileThresholds reset;
  for (const MatrixSettings& matrix : defaultTactileSettings(hand)) {
    reset.sensitivity = matrix.sensitivity;
    reset.counts.push_back(matrix.thresholdCounts);
  }
  return reset;
}

TactileSettings settingsOf(const TactileThresholds& thresholds) {
  TactileSettings settings;
  for (const int counts : thresholds.counts) settings.push_back({thresholds.sensitivity, counts});
  return settings;
}

}  // namespace

SensitivityControl::SensitivityControl(CaptureSession& session,
                                       GraspControl& control,
                                       const Clock& clock)
    : session_(session), control_(control), clock_(clock) {}

double SensitivityControl::nowS() const {
  return static_cast<double>(clock_.monotonicUs()) / kUsPerS;
}

void SensitivityControl::begin(SensitivityMode mode, const std::string& text) {
  const bool was = status_.mode != SensitivityMode::kManual;
  status_ = {};
  status_.mode = mode;
  high_.reset();
  search_.reset();
  wanted_.reset();
  stampsUs_.clear();
  degC_.clear();
  begunS_ = nowS();
  queue_.reset();
  if (mode != SensitivityMode::kManual) queue_ = session_.subscribe("sensitivity", kFeed);
  if (mode == SensitivityMode::kManual && !was) return;
  const std::int64_t us = session_.nowUs();
  session_.note({us, us, "sensitivity_mode", std::nullopt, text, ""});
}

void SensitivityControl::beginHighSensitivity(const NoiseFloor& floor,
                                              const NoiseThresholdOptions& options) {
  options.validate();
  const std::size_t matrices = session_.device().hand().layout->numMatrices();
  const bool usable = std::any_of(
      floor.lines.begin(), floor.lines.end(), [](const auto& line) { return line.valid; });
  if (!usable) throw std::invalid_argument("the noise calibration has no valid line");
  for (const NoiseLine& line : floor.lines)
    if (line.matrix >= matrices)
      throw std::invalid_argument("the noise lines are for another hand: matrix " +
                                  std::to_string(line.matrix) + " of " + std::to_string(matrices));
  floor_ = floor;
  highOptions_ = options;
  begin(SensitivityMode::kHigh, "high sensitivity: thresholds follow the temperatures");
  status_.measuring = true;
}

void SensitivityControl::beginAdaptiveSensitivity(const SensitivitySearchOptions& options) {
  options.validate();
  searchOptions_ = options;
  searchOptions_.saturationCounts = static_cast<double>(session_.device().hand().saturationCounts);
  begin(SensitivityMode::kAdaptive, "adaptive sensitivity: the highest without saturation");
}

void SensitivityControl::endMode() { begin(SensitivityMode::kManual, "sensitivity set by hand"); }

void SensitivityControl::reset() {
  endMode();
  wanted_ = defaultTactileSettings(session_.device().hand());
  applyWantedSettings();
}

void SensitivityControl::pollReplies() {
  for (const auto& answer : pending_) {
    if (!isReady(answer)) continue;
    try {
      answer.get();
    } catch (const std::exception& error) {
      status_.failure = error.what();
    }
  }
  const bool had = !pending_.empty();
  std::erase_if(pending_, [](const auto& answer) { return isReady(answer); });
  if (had && pending_.empty()) {
    settledFromUs_ = session_.nowUs();
    stampsUs_.clear();
  }
  status_.setting = !pending_.empty();
}

// Sends the commands for the wanted settings when the hand may be changed.
void SensitivityControl::applyWantedSettings() {
  if (!wanted_ || !pending_.empty()) return;
  status_.waiting.clear();
  const TactileSettings now = session_.device().info().matrices;
  if (now.empty()) {
    status_.waiting = "no tactile controller is connected";
    return;
  }
  try {
    for (const DeviceCommand& command : commandsBetween(now, *wanted_))
      pending_.push_back(control_.change(command));
    status_.failure.clear();
    wanted_.reset();
  } catch (const DeviceError& error) {
    status_.waiting = error.what();  // repeated at the next step
  } catch (const std::invalid_argument& error) {
    status_.failure = error.what();
    wanted_.reset();
  }
  status_.setting = !pending_.empty();
}

double SensitivityControl::rateHz() const {
  if (stampsUs_.size() < kMinStamps || session_.nowUs() - stampsUs_.back() > kStaleUs)
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<std::int64_t> intervals;
  for (std::size_t i = 1; i < stampsUs_.size(); ++i)
    intervals.push_back(stampsUs_[i] - stampsUs_[i - 1]);
  const std::int64_t medianUs = upperMedian(std::move(intervals));
  return medianUs > 0 ? kUsPerS / static_cast<double>(medianUs)
                      : std::numeric_limits<double>::quiet_NaN();
}

void SensitivityControl::onFrame(const TactileFrame& frame) {
  if (frame.hostUs <= settledFromUs_) return;
  stampsUs_.push_back(frame.hostUs);
  if (stampsUs_.size() > kMaxStamps) stampsUs_.pop_front();
  if (!search_ || wanted_ || !pending_.empty()) return;
  const float maximum =
      frame.values.empty() ? 0.0F : *std::max_element(frame.values.begin(), frame.values.end());
  const auto next =
      search_->observe(static_cast<double>(frame.hostUs) / kUsPerS, static_cast<double>(maximum));
  if (!next) return;
  TactileSettings target = session_.device().info().matrices;
  for (MatrixSettings& matrix : target) matrix.sensitivity = *next;
  wanted_ = std::move(target);
}

void SensitivityControl::processFrames() {
  items_.clear();
  queue_->take(items_);
  for (const CaptureItem& item : items_) {
    if (const auto* frame = std::get_if<SharedFrame>(&item)) onFrame(**frame);
    if (const Sample* temperatures = sampleOf(item, kTemperatureSeries))
      degC_ = temperatures->values;
    // A pause of the stream must not count as a low rate.
    if (const auto* event = std::get_if<Event>(&item))
      if (event->kind == "settings" || event->kind == "gap") stampsUs_.clear();
  }
}

// The rate before the first change is the usual one.
void SensitivityControl::startHighSensitivity() {
  const double usual = rateHz();
  if (!(usual > 0.0) || (degC_.empty() && nowS() - begunS_ < kTemperaturesWithinS)) return;
  const HandDescription hand = session_.device().hand();
  NoiseFloor floor = *floor_;
  high_.emplace(std::move(floor), nearestSensors(hand), resetOf(hand), usual, highOptions_);
  status_.measuring = false;
}

void SensitivityControl::step() {
  pollReplies();
  if (!queue_) return applyWantedSettings();
  processFrames();
  if (status_.mode == SensitivityMode::kAdaptive && !search_) {
    const TactileSettings now = session_.device().info().matrices;
    if (!now.empty())
      search_.emplace(std::clamp(now[0].sensitivity, searchOptions_.least, searchOptions_.most),
                      now[0].thresholdCounts,
                      searchOptions_);
    else
      status_.waiting = "no tactile controller is connected";
  }
  if (status_.mode == SensitivityMode::kHigh && !high_) startHighSensitivity();
  if (high_ && pending_.empty() && !wanted_) {
    if (const auto next = high_->update(nowS(), degC_, rateHz())) wanted_ = settingsOf(*next);
    status_.noise = high_->status();
  }
  if (search_) {
    status_.sensitivity = search_->sensitivity();
    status_.settled = search_->settled();
    status_.highest = status_.sensitivity + searchOptions_.resolution > searchOptions_.most;
    status_.saturated = search_->saturated();
  }
  applyWantedSettings();
}

}  // namespace palpate
