#include "palpate/control/grasp_request.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/control/finger_forces.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

// Also refuses NaN.
void requireRange(const char* field, double value, double least, double most, const char* unit) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument(std::string("grasp: ") + field + " " + numberText(value) +
                              " is not in " + numberText(least) + ".." + numberText(most) + unit);
}

void requireRange(const char* field, double value, const OptionRange& range) {
  const std::string unit = *range.unit ? std::string(" ") + range.unit : "";
  requireRange(field, value, range.minimum, range.maximum, unit.c_str());
}

// A joint a little beyond its range, as a real one can be, stays where it is within the range.
constexpr double kBeyondRangeDeg = 1.0;
// Under tactile control the hand may be pressing already: see MoveJoints::answerLimitS.
constexpr double kTactileAnswerLimitS = 0.2;

// The limits as text: "200 counts", "200, 150, 200 counts".
template <typename Values>
std::string listText(const Values& values) {
  std::string text;
  for (const auto value : values)
    text += (text.empty() ? "" : ", ") + numberText(static_cast<double>(value));
  return text;
}

Json parameters(const GraspRequest& request) {
  Json json = Json::object();
  json.set("mode", nameOf(request.mode));
  if (isJointMotion(request)) {
    Json targets = Json::array();
    for (const std::optional<double>& each : request.targetDeg) targets.push(orNull(each));
    json.set("target_deg", std::move(targets));
    if (!request.title.empty()) json.set("title", request.title);
  } else {
    json.set("preshape", request.preshape);
  }
  if (request.startRatio) json.set("start", *request.startRatio);
  if (!isJointMotion(request)) json.set("close", request.closeRatio);
  json.set("velocity_deg_per_s", request.velocityDegPerS);
  if (request.mode != GraspMode::kPlain) {
    json.set("limit_counts", request.limitCounts);
    if (!request.fingerLimitCounts.empty())
      json.set("finger_limit_counts", jsonList(request.fingerLimitCounts));
    if (!request.forceLimitsN.empty()) json.set("force_limit_n", jsonList(request.forceLimitsN));
    json.set("keeps_limit", keepsLimit(request));
    if (!request.object.empty()) json.set("object", request.object);
  }
  if (request.mode == GraspMode::kSlip) {
    const HoldingOptions& holding = request.holding;
    json.set("raise_counts", holding.raiseCounts)
        .set("most_limit_counts", holding.maxLimitCounts)
        .set("settle_s", holding.settleS)
        .set("calm_s", holding.noSlipS);
    if (holding.holdS > 0.0) json.set("hold_s", holding.holdS);
    if (holding.loosen) json.set("loosen", true);
    if (holding.weightN > 0.0) json.set("weight_n", holding.weightN);
  }
  return json;
}

}  // namespace

const HandDescription& movableHand() { return sdh2(); }

std::size_t numMovableFingers() { return numFingers(movableHand()); }

std::string_view nameOf(GraspMode mode) {
  if (mode == GraspMode::kSlip) return "slip";
  return mode == GraspMode::kReactive ? "reactive" : "plain";
}

std::string_view nameOf(GraspOutcome outcome) {
  switch (outcome) {
    case GraspOutcome::kNone:
      break;
    case GraspOutcome::kFinished:
      return "finished";
    case GraspOutcome::kLimitReached:
      return "limit_reached";
    case GraspOutcome::kStopped:
      return "stopped";
    case GraspOutcome::kRelaxed:
      return "relaxed";
    case GraspOutcome::kStreamLost:
      return "stream_dead";
    case GraspOutcome::kPortGone:
      return "port_gone";
    case GraspOutcome::kFailed:
      return "failed";
    case GraspOutcome::kRefused:
      return "refused";
  }
  return "running";
}

namespace {

void validateLimits(const GraspRequest& request) {
  requireRange("limit", request.limitCounts, GraspRequest::kLimitCounts);
  const std::size_t fingers = numMovableFingers();
  if (!request.fingerLimitCounts.empty() && request.fingerLimitCounts.size() != fingers)
    throw std::invalid_argument("grasp: " + std::to_string(request.fingerLimitCounts.size()) +
                                " limits for a hand with " + std::to_string(fingers) + " fingers");
  for (const int limit : request.fingerLimitCounts)
    requireRange("limit of a finger", limit, kMinGraspLimitCounts, request.limitCounts, " counts");
  if (request.forceLimitsN.size() > 1 && request.forceLimitsN.size() != fingers)
    throw std::invalid_argument("grasp: " + std::to_string(request.forceLimitsN.size()) +
                                " force limits for a hand with " + std::to_string(fingers) +
                                " fingers");
  for (const double limitN : request.forceLimitsN)
    requireRange("force limit", limitN, kMinForceLimitN, kMaxForceLimitN, " N");
}

}  // namespace

void GraspRequest::validate() const {
  sdh2Preshape(preshape);
  if (startRatio) requireRange("start ratio", *startRatio, 0.0, 1.0, "");
  requireRange("close ratio", closeRatio, kCloseRatio);
  requireRange("velocity", velocityDegPerS, kVelocityDegPerS);
  if (mode != GraspMode::kPlain) validateLimits(*this);
  if (touchRatio) requireRange("touch ratio", *touchRatio, 0.0, 1.0, "");
  if (object.size() > kMaxObjectBytes || object.find('\n') != std::string::npos)
    throw std::invalid_argument(
        "grasp: the name of the object must be one line of at most 100 bytes");
  if (isJointMotion(*this)) {
    if (mode == GraspMode::kSlip)
      throw std::invalid_argument("grasp: a slip-aware grasp needs a preshape, not joint angles");
    if (startRatio)
      throw std::invalid_argument("grasp: a motion to joint angles has no start ratio");
  }
  if (mode == GraspMode::kSlip) holding.validate(limitCounts);
}

void HoldingOptions::validate(int limitCounts) const {
  requireRange("hold time", holdS, kHoldS);
  requireRange("settle time", settleS, 0.0, 60.0, " s");
  requireRange("rest time", restS, 0.0, 60.0, " s");
  requireRange("rise of the limit", raiseCounts, 1, kMaxGraspLimitCounts, " counts");
  requireRange("highest limit", maxLimitCounts, limitCounts, kMaxGraspLimitCounts, " counts");
  requireRange("calm time", noSlipS, kNoSlipS);
  requireRange("weight", weightN, kWeightN);
  requireRange("force per count", newtonsPerCount, kNewtonsPerCount);
}

namespace {

// The targets of a motion to joint angles; an axis without a target stays where it is.
std::vector<double> jointTargets(const GraspRequest& request,
                                 const HandDescription& hand,
                                 const std::vector<double>& presentDeg) {
  std::vector<double> targets;
  for (std::size_t axis = 0; axis < std::min(request.targetDeg.size(), hand.axes.size()); ++axis) {
    const AxisDescription& is = hand.axes[axis];
    if (request.targetDeg[axis]) {
      targets.push_back(*request.targetDeg[axis]);
      continue;
    }
    if (presentDeg.size() != hand.axes.size())
      throw std::invalid_argument("grasp: the present angle of " + is.name +
                                  " is not known: it can't stay where it is");
    const double present = presentDeg[axis];
    requireRange(("present angle of " + is.name).c_str(),
                 present,
                 is.minimumDeg - kBeyondRangeDeg,
                 is.maximumDeg + kBeyondRangeDeg,
                 " deg");
    targets.push_back(std::clamp(present, is.minimumDeg, is.maximumDeg));
  }
  return targets;
}

}  // namespace

MoveJoints motionTo(const GraspRequest& request,
                    double closeRatio,
                    const HandDescription& hand,
                    const std::vector<double>& presentDeg) {
  request.validate();
  MoveJoints move;
  const bool toAngles = isJointMotion(request);
  const std::size_t given = toAngles ? request.targetDeg.size() : hand.axes.size();
  if (given == hand.axes.size())
    move.targetDeg = toAngles ? jointTargets(request, hand, presentDeg)
                              : sdh2Preshape(request.preshape).anglesDeg(closeRatio);
  if (move.targetDeg.size() != hand.axes.size())
    throw std::invalid_argument(
        (toAngles ? "grasp: the pose has " + std::to_string(given)
                  : "grasp: the preshape has " + std::to_string(move.targetDeg.size())) +
        " axes, the hand " + std::to_string(hand.axes.size()));
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis) {
    const AxisDescription& is = hand.axes[axis];
    requireRange(is.name.c_str(), move.targetDeg[axis], is.minimumDeg, is.maximumDeg, " deg");
    move.velocityDegPerS.push_back(std::min(request.velocityDegPerS, is.maximumVelocityDegPerS));
  }
  move.ramp = request.mode != GraspMode::kPlain;
  if (request.mode != GraspMode::kPlain) move.answerLimitS = kTactileAnswerLimitS;
  move.limitsAnswersAtRest = request.mode == GraspMode::kSlip || keepsLimit(request);
  return move;
}

int limitOf(const GraspRequest& request, int finger) {
  const std::vector<int>& limits = request.fingerLimitCounts;
  if (limits.empty()) return request.limitCounts;
  if (finger >= 0 && static_cast<std::size_t>(finger) < limits.size())
    return limits[static_cast<std::size_t>(finger)];
  return *std::min_element(limits.begin(), limits.end());
}

std::optional<double> forceLimitOf(const GraspRequest& request, std::size_t finger) {
  const std::vector<double>& limits = request.forceLimitsN;
  if (limits.empty()) return std::nullopt;
  return limits.size() == 1 ? limits[0] : limits.at(finger);
}

int maxLimitOf(const GraspRequest& request) {
  return request.mode == GraspMode::kSlip
             ? std::max(request.limitCounts, request.holding.maxLimitCounts)
             : request.limitCounts;
}

std::vector<UnmeasurableLimit> unmeasurableLimits(const HandDescription& hand,
                                                  const std::vector<MatrixSettings>& settings,
                                                  const GraspRequest& request) {
  if (request.mode == GraspMode::kPlain) return {};
  const int most = maxLimitOf(request);
  std::vector<UnmeasurableLimit> unfelt;
  if (request.fingerLimitCounts.empty()) unfelt = unmeasurableLimits(hand, settings, most);
  for (std::size_t m = 0; m < hand.matrices.size() && !request.fingerLimitCounts.empty(); ++m) {
    const int lower = request.limitCounts - limitOf(request, hand.matrices[m].finger);
    for (UnmeasurableLimit& each : unmeasurableLimits(hand, settings, most - lower))
      if (each.matrix == m) unfelt.push_back(std::move(each));
  }
  if (isJointMotion(request)) return unfelt;  // any finger may move
  const Preshape& preshape = sdh2Preshape(request.preshape);
  std::erase_if(unfelt, [&](const UnmeasurableLimit& each) {
    return each.matrix < hand.matrices.size() && !movesWith(preshape, hand.matrices[each.matrix]);
  });
  return unfelt;
}

int highestMeasurableLimit(const HandDescription& hand,
                           const std::vector<MatrixSettings>& settings,
                           GraspRequest request) {
  constexpr int kStepCounts = 50;
  request.fingerLimitCounts.clear();
  for (int limit = kMaxGraspLimitCounts; limit >= kMinGraspLimitCounts; limit -= kStepCounts) {
    request.limitCounts = request.holding.maxLimitCounts = limit;
    if (unmeasurableLimits(hand, settings, request).empty()) return limit;
  }
  return 0;
}

bool isOpening(const GraspRequest& request) {
  return request.mode == GraspMode::kPlain && request.closeRatio == 0.0 && !request.startRatio &&
         !isJointMotion(request);
}

bool keepsLimit(const GraspRequest& request) {
  return request.keepsLimit && request.mode != GraspMode::kPlain && !isJointMotion(request);
}

bool isJointMotion(const GraspRequest& request) { return !request.targetDeg.empty(); }

std::string kindOf(const GraspRequest& request) {
  if (isJointMotion(request))
    return request.mode == GraspMode::kPlain ? "motion" : "reactive motion";
  return isOpening(request) ? "opening" : std::string(nameOf(request.mode)) + " grasp";
}

std::string describe(const GraspRequest& request) {
  const bool toAngles = isJointMotion(request);
  std::string text = kindOf(request) + ": " +
                     (!toAngles               ? request.preshape
                      : request.title.empty() ? std::string("to joint angles")
                                              : request.title);
  const std::string velocity = ", " + numberText(request.velocityDegPerS) + " deg/s";
  if (isOpening(request)) return text + velocity;
  if (request.startRatio) text += ", from " + numberText(*request.startRatio);
  if (!toAngles)
    text += std::string(request.startRatio ? " to " : ", to ") + numberText(request.closeRatio);
  text += velocity;
  if (request.mode != GraspMode::kPlain) {
    text += ", limit " +
            (request.fingerLimitCounts.empty() ? std::to_string(request.limitCounts)
                                               : listText(request.fingerLimitCounts)) +
            " counts";
    if (!request.forceLimitsN.empty()) text += ", " + listText(request.forceLimitsN) + " N";
    if (keepsLimit(request)) text += ", kept";
    if (!request.object.empty()) text += ", of " + request.object;
  }
  if (request.mode == GraspMode::kSlip)
    text += ", up to " + std::to_string(request.holding.maxLimitCounts);
  return text;
}

Event beginEvent(const GraspReport& report) {
  return {report.beginUs,
          report.beginUs,
          "grasp",
          {},
          describe(report.request),
          parameters(report.request).text(-1)};
}

Event endEvent(const GraspReport& report) {
  Json json = parameters(report.request);
  json.set("outcome", nameOf(report.outcome));
  // The reading is observed until half a second after the stop.
  const bool atLimit = report.outcome == GraspOutcome::kLimitReached && report.limitUs > 0;
  Event event{report.beginUs,
              atLimit ? std::max(report.beginUs, report.limitUs) : report.endUs,
              "grasp",
              {},
              report.text,
              {}};
  if (report.outcome == GraspOutcome::kLimitReached || isTouched(report.peak.counts)) {
    event.matrix = static_cast<int>(report.peak.matrix);
    json.set("matrix", report.peak.matrix)
        .set("x", report.peak.column)
        .set("y", report.peak.row)
        .set("counts", static_cast<double>(report.peak.counts));
  }
  if (report.forceFinger)
    json.set("force_finger", *report.forceFinger)
        .set("force_n", report.forceN)
        .set("reached_n", report.forceAfterStopN);
  if (report.peakAfterStop)
    json.set("reached_counts", static_cast<double>(report.peakAfterStop->counts))
        .set("reached_matrix", report.peakAfterStop->matrix);
  if (report.peakAtRest) json.set("kept_counts", static_cast<double>(report.peakAtRest->counts));
  if (report.touch) json.set("touch_ratio", report.touch->ratio);
  if (report.request.mode == GraspMode::kSlip) {
    json.set("last_limit_counts", report.limitCounts).set("slips", report.slips);
    if (report.countsAtSlip) json.set("counts_at_slip", *report.countsAtSlip);
    if (report.friction) json.set("friction", *report.friction);
  }
  if (!report.heldAxes.empty()) json.set("held_axes", jsonList(report.heldAxes));
  event.json = json.text(-1);
  return event;
}

Event noteEvent(const GraspReport& report, const GraspStep& note, std::int64_t hostUs) {
  Json json = Json::object();
  json.set("mode", nameOf(report.request.mode))
      .set("action", note.action)
      .set("limit_counts", note.limitCounts);
  Event event{hostUs, hostUs, "grasp", {}, note.text, {}};
  if (note.matrix) {
    event.matrix = static_cast<int>(*note.matrix);
    json.set("matrix", *note.matrix);
  }
  event.json = json.text(-1);
  return event;
}

}  // namespace palpate
