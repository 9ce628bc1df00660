#include "palpate/live/live_measurement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/recording/recording_losses.h"

namespace palpate {
namespace {

const HandDescription& withLayout(const HandDescription& hand) {
  if (!hand.layout) throw std::invalid_argument("LiveMeasurement: the hand has no layout");
  return hand;
}

double secondsBetween(std::int64_t fromUs, std::int64_t toUs) {
  return static_cast<double>(toUs - fromUs) / kUsPerS;
}

std::string framesText(std::uint64_t count) {
  return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

// Frames that a gap event reports as lost; 0 where it doesn't say, or speaks of other items.
std::uint64_t framesLostIn(const Event& event) {
  for (const RecordingLoss& loss : lossesOf({&event, 1}))
    if (loss.stream == "tactile") return loss.lost;
  return 0;
}

}  // namespace

void LiveMeasurementOptions::validate() const {
  const auto require = [](bool good, const char* what, double is) {
    if (!good)
      throw std::invalid_argument(std::string("LiveMeasurementOptions: ") + what + ", is " +
                                  numberText(is));
  };
  require(seconds >= 1.0 && seconds <= 3600.0, "seconds must be 1..3600", seconds);
  require(maxTravelDeg > 0.0 && std::isfinite(maxTravelDeg),
          "maxTravelDeg must be above 0",
          maxTravelDeg);
  require(firstFrameWithinS > 0.0 && std::isfinite(firstFrameWithinS),
          "firstFrameWithinS must be above 0",
          firstFrameWithinS);
}

LiveMeasurement::LiveMeasurement(HandDescription hand, const LiveMeasurementOptions& options)
    : options_(options), hand_(std::move(hand)), builder_(withLayout(hand_)) {
  options_.validate();
  for (const MatrixLayout& matrix : hand_.layout->matrices()) numScanned_ += matrix.numEnabled();
}

void LiveMeasurement::add(const CaptureItem& item) {
  if (state_ != State::kRunning) return;
  if (const auto* frame = std::get_if<SharedFrame>(&item))
    addFrame(**frame);
  else if (const Sample* angles = sampleOf(item, kAngleSeries))
    addAngles(*angles);
  else if (const Sample* temperatures = sampleOf(item, kTemperatureSeries))
    addTemperatures(*temperatures);
  else if (const auto* event = std::get_if<Event>(&item))
    addEvent(*event);
}

void LiveMeasurement::addFrame(const TactileFrame& frame) {
  if (frame.layout != hand_.layout && (!frame.layout || !(*frame.layout == *hand_.layout)))
    return fail("the scanned taxels differ from those at the start");
  const bool first = numFrames() == 0;
  if (!first && frame.hostUs > lastUs_ && gaps_.afterGap(frame.hostUs))
    return fail("no frames for " + fixedText(secondsBetween(lastUs_, frame.hostUs), 1) + " s");
  try {
    builder_.addFrame(frame.hostUs, frame.values, frame.deviceUs);
  } catch (const std::invalid_argument&) {
    ++numUnusable_;
    return;
  }
  if (first) {
    firstUs_ = frame.hostUs;
    gaps_.afterGap(frame.hostUs);
  }
  lastUs_ = frame.hostUs;
  if (secondsBetween(firstUs_, lastUs_) >= options_.seconds) state_ = State::kComplete;
}

void LiveMeasurement::addAngles(const Sample& angles) {
  try {
    builder_.addAngles(angles.hostUs, angles.values);
  } catch (const std::invalid_argument&) {
    return;  // angles only tell whether the hand moves; the next ones do, too
  }
  if (firstDeg_.empty()) firstDeg_ = angles.values;
  for (std::size_t axis = 0; axis < std::min(firstDeg_.size(), angles.values.size()); ++axis) {
    const double travelDeg = std::abs(angles.values[axis] - firstDeg_[axis]);
    if (travelDeg <= options_.maxTravelDeg) continue;
    const std::string name =
        axis < hand_.axes.size() ? hand_.axes[axis].name : "joint " + std::to_string(axis);
    return fail("the hand moved: " + name + " by " + fixedText(travelDeg, 1) + " deg");
  }
}

void LiveMeasurement::addTemperatures(const Sample& temperatures) {
  try {
    builder_.addTemperatures(temperatures.hostUs, temperatures.values);
  } catch (const std::invalid_argument&) {
    return;  // the previous temperature holds until the next one
  }
}

void LiveMeasurement::addEvent(const Event& event) {
  if (event.kind == "gap") numLost_ += framesLostIn(event);
  if (event.kind == "settings") fail("the sensor's settings were changed");
  if (event.kind == "motion") fail("the hand was commanded: " + event.text);
}

void LiveMeasurement::noteSilence(double seconds) {
  const std::size_t frames = numFrames();
  const double usualS =
      frames > 1 ? secondsBetween(firstUs_, lastUs_) / static_cast<double>(frames - 1) : 0.0;
  const double longestS = frames == 0 ? options_.firstFrameWithinS
                          : frames == 1
                              ? std::max(options_.firstFrameWithinS, gapThresholdS(usualS))
                              : gapThresholdS(usualS);
  if (seconds > longestS) fail("no frames for " + fixedText(seconds, 1) + " s");
}

void LiveMeasurement::fail(std::string why) {
  if (state_ != State::kRunning) return;
  state_ = State::kFailed;
  failure_ = std::move(why);
}

double LiveMeasurement::secondsLeft() const noexcept {
  if (state_ == State::kComplete) return 0.0;
  return std::max(options_.seconds - secondsBetween(firstUs_, lastUs_), 0.0);
}

std::vector<std::string> LiveMeasurement::warnings() const {
  std::vector<std::string> lines;
  if (numLost_ > 0)
    lines.push_back(framesText(numLost_) + (numLost_ == 1 ? " was lost" : " were lost"));
  if (numUnusable_ > 0)
    lines.push_back(framesText(numUnusable_) + " without a valid time or value left out");
  return lines;
}

Profile LiveMeasurement::takeProfile(ProfileInfo info) {
  if (state_ != State::kComplete) throw std::logic_error("LiveMeasurement: it isn't complete");
  if (std::exchange(taken_, true)) throw std::logic_error("LiveMeasurement: its profile was taken");
  info.format = kLiveMeasurementFormat;
  info.warnings = warnings();
  return builder_.finish(std::move(info));
}

}  // namespace palpate
