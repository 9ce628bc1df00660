#include "palpate/control/grasp_request.h"

#include <algorithm>
#include <stdexcept>

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

Json parameters(const GraspRequest& request) {
  Json json = Json::object();
  json.set("mode", nameOf(request.mode)).set("preshape", request.preshape);
  if (request.startRatio) json.set("start", *request.startRatio);
  json.set("close", request.closeRatio).set("velocity_deg_per_s", request.velocityDegPerS);
  if (request.mode != GraspMode::kPlain) json.set("limit_counts", request.limitCounts);
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

void GraspRequest::validate() const {
  sdh2Preshape(preshape);
  if (startRatio) requireRange("start ratio", *startRatio, 0.0, 1.0, "");
  requireRange("close ratio", closeRatio, 0.0, 1.0, "");
  requireRange("velocity", velocityDegPerS, kMinGraspDegPerS, kMaxGraspDegPerS, " deg/s");
  if (mode != GraspMode::kPlain)
    requireRange("limit", limitCounts, kMinGraspLimitCounts, kMaxGraspLimitCounts, " counts");
  if (mode == GraspMode::kSlip) holding.validate(limitCounts);
}

void HoldingOptions::validate(int limitCounts) const {
  requireRange("hold time", holdS, 0.0, 86'400.0, " s");
  requireRange("settle time", settleS, 0.0, 60.0, " s");
  requireRange("rest time", restS, 0.0, 60.0, " s");
  requireRange("rise of the limit", raiseCounts, 1, kMaxGraspLimitCounts, " counts");
  requireRange("highest limit", maxLimitCounts, limitCounts, kMaxGraspLimitCounts, " counts");
  requireRange("calm time", noSlipS, 0.01, 86'400.0, " s");
  requireRange("weight", weightN, 0.0, 1000.0, " N");
  requireRange("force per count", newtonsPerCount, 0.0, 1.0, " N");
}

MoveJoints motionTo(const GraspRequest& request, double closeRatio, const HandDescription& hand) {
  request.validate();
  MoveJoints move;
  move.targetDeg = sdh2Preshape(request.preshape).anglesDeg(closeRatio);
  if (move.targetDeg.size() != hand.axes.size())
    throw std::invalid_argument("grasp: the preshape has " + std::to_string(move.targetDeg.size()) +
                                " axes, the hand " + std::to_string(hand.axes.size()));
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis) {
    const AxisDescription& is = hand.axes[axis];
    requireRange(is.name.c_str(), move.targetDeg[axis], is.minimumDeg, is.maximumDeg, " deg");
    move.velocityDegPerS.push_back(std::min(request.velocityDegPerS, is.maximumVelocityDegPerS));
  }
  move.ramp = request.mode != GraspMode::kPlain;
  return move;
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
  std::vector<UnmeasurableLimit> unfelt = unmeasurableLimits(hand, settings, maxLimitOf(request));
  const Preshape& preshape = sdh2Preshape(request.preshape);
  std::erase_if(unfelt, [&](const UnmeasurableLimit& each) {
    return each.matrix < hand.matrices.size() && !movesWith(preshape, hand.matrices[each.matrix]);
  });
  return unfelt;
}

bool isOpening(const GraspRequest& request) {
  return request.mode == GraspMode::kPlain && request.closeRatio == 0.0 && !request.startRatio;
}

std::string kindOf(const GraspRequest& request) {
  return isOpening(request) ? "opening" : std::string(nameOf(request.mode)) + " grasp";
}

std::string describe(const GraspRequest& request) {
  std::string text = kindOf(request) + ": " + request.preshape;
  if (isOpening(request)) return text + ", " + numberText(request.velocityDegPerS) + " deg/s";
  if (request.startRatio) text += ", from " + numberText(*request.startRatio);
  text += std::string(request.startRatio ? " to " : ", to ") + numberText(request.closeRatio) +
          ", " + numberText(request.velocityDegPerS) + " deg/s";
  if (request.mode != GraspMode::kPlain)
    text += ", limit " + std::to_string(request.limitCounts) + " counts";
  if (request.mode == GraspMode::kSlip)
    text += ", up to " + std::to_string(request.holding.maxLimitCounts);
  return text;
}

RecordingEvent beginEvent(const GraspReport& report) {
  return {report.beginUs,
          report.beginUs,
          "grasp",
          {},
          describe(report.request),
          parameters(report.request).text(-1)};
}

RecordingEvent endEvent(const GraspReport& report) {
  Json json = parameters(report.request);
  json.set("outcome", nameOf(report.outcome));
  RecordingEvent event{report.beginUs, report.endUs, "grasp", {}, report.text, {}};
  if (report.outcome == GraspOutcome::kLimitReached || report.peak.counts > 0.0F) {
    event.matrix = static_cast<int>(report.peak.matrix);
    json.set("matrix", report.peak.matrix)
        .set("x", report.peak.column)
        .set("y", report.peak.row)
        .set("counts", static_cast<double>(report.peak.counts));
  }
  if (report.peakAfterStop)
    json.set("reached_counts", static_cast<double>(report.peakAfterStop->counts))
        .set("reached_matrix", report.peakAfterStop->matrix);
  if (report.request.mode == GraspMode::kSlip) {
    json.set("last_limit_counts", report.limitCounts).set("slips", report.slips);
    if (report.countsAtSlip) json.set("counts_at_slip", *report.countsAtSlip);
    if (report.friction) json.set("friction", *report.friction);
  }
  if (!report.heldAxes.empty()) json.set("held_axes", jsonList(report.heldAxes));
  event.json = json.text(-1);
  return event;
}

RecordingEvent noteEvent(const GraspReport& report, const GraspStep& note, std::int64_t hostUs) {
  Json json = Json::object();
  json.set("mode", nameOf(report.request.mode))
      .set("action", note.action)
      .set("limit_counts", note.limitCounts);
  RecordingEvent event{hostUs, hostUs, "grasp", {}, note.text, {}};
  if (note.matrix) {
    event.matrix = static_cast<int>(*note.matrix);
    json.set("matrix", *note.matrix);
  }
  event.json = json.text(-1);
  return event;
}

}  // namespace palpate
