#include "control/grasp_texts.h"

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr float kRiseCounts = 10.0F;   // a smaller rise is noise
constexpr double kFarOverLimit = 1.5;  // the report mentions a rise to this multiple of the limit

}  // namespace

std::string millisecondsText(std::int64_t us) {
  return fixedText(static_cast<double>(us) / 1e3, 0);
}

std::string silenceText(std::int64_t silenceUs) {
  return "no tactile frames for " + millisecondsText(silenceUs) + " ms";
}

std::string GraspStateMachine::heldText() const {
  return "finished: held for " + numberText(report_.request.holding.holdS) + " s, " +
         counted(static_cast<std::uint64_t>(report_.slips), "slip") + ", limit " +
         std::to_string(limit_) + " counts" +
         (report_.friction ? ", friction about " + fixedText(*report_.friction, 2)
                           : std::string()) +
         "; the hand keeps holding";
}

std::string GraspStateMachine::placeOf(const TaxelPeak& peak) const {
  return hand_.matrixName(peak.matrix) + ", x " + std::to_string(peak.column) + ", y " +
         std::to_string(peak.row) + ": " + numberText(peak.counts) + " counts";
}

std::string GraspStateMachine::forceText(std::size_t finger) const {
  return "finger " + std::to_string(finger) + ": " + fixedText(forces_->forcesN()[finger], 2) +
         " N";
}

std::string GraspStateMachine::timesText() const {
  return fixedText(timesLimit(), 1) + " times the limit";
}

// Text such as "; rose to 3222 counts after the stop, 16 times the limit: close more slowly", or
// empty. With a limit in newtons: "; rose to 23.1 N (2859 counts) after the stop, ..".
std::string GraspStateMachine::riseText() const {
  if (!report_.peakAfterStop || report_.peakAfterStop->counts < report_.peak.counts + kRiseCounts)
    return {};
  double times = timesLimitOf(*report_.peakAfterStop);
  std::string reached = numberText(report_.peakAfterStop->counts) + " counts";
  if (report_.forceFinger) {
    times = report_.forceAfterStopN /
            forceLimitOf(report_.request, *report_.forceFinger).value_or(report_.forceN);
    reached = fixedText(report_.forceAfterStopN, 1) + " N (" + reached + ")";
  }
  std::string text = "; rose to " + reached + " after the stop";
  if (times >= kFarOverLimit && !approach_)
    text += ", " + fixedText(times, 1) + " times the limit: close more slowly";
  return text;
}

// Text such as "; finger 1: 5.78 N, above its limit of 3 N: close more slowly" of a grasp that its
// limit in counts has stopped, or empty.
std::string GraspStateMachine::overForceText() const {
  const auto over = fingerOverForce(report_.request, forces_, report_.forceFinger);
  if (!over) return {};
  return "; " + forceText(*over) + ", above its limit of " +
         numberText(*forceLimitOf(report_.request, *over)) + " N: close more slowly";
}

std::string GraspStateMachine::restText() const {
  std::string text = "; at its end ";
  if (report_.forceFinger) text += fixedText(forces_->forcesN()[*report_.forceFinger], 2) + " N, ";
  text += numberText(report_.peakAtRest->counts) + " counts";
  const double times = timesLimit();
  return times > kKeptToLimit || times < kKeptFromLimit ? text + ", " + timesText() : text;
}

std::string GraspStateMachine::limitText() const {
  std::string text = "limit " + std::to_string(limit_) + " counts" + overForceText();
  if (!isStillRisen()) return text;
  const int highest = report_.request.holding.maxLimitCounts;
  if (report_.peakAfterStop->counts <= static_cast<float>(highest) ||
      peak_.counts <= static_cast<float>(highest))
    return text + riseText();
  return text + "; rose to " + numberText(report_.peakAfterStop->counts) +
         " counts after the stop, above its highest limit of " + std::to_string(highest) +
         ": close more slowly";
}

std::string GraspStateMachine::holdingText(std::int64_t monoUs) const {
  const auto seconds =
      static_cast<std::int64_t>(static_cast<double>(monoUs - heldFromUs_) / kUsPerS);
  const auto slips = static_cast<std::uint64_t>(report_.slips);
  const std::string answered =
      report_.slips == answeredSlips_
          ? counted(slips, "slip") + " answered"
          : counted(slips, "slip") + ", " + std::to_string(answeredSlips_) + " answered";
  return "holding for " + std::to_string(seconds) + " s, " + answered + ": " + limitText();
}

}  // namespace palpate
