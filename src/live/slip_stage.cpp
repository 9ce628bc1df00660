#include "palpate/live/slip_stage.h"

#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

std::string textOf(double pathTaxels, double turnDeg) {
  return "slip: " + fixedText(pathTaxels, 2) + " taxels, " + fixedText(turnDeg, 1) + " degrees";
}

// Whether the hand opens after an event of a grasp (control/grasp_request.h, beginEvent() and
// endEvent()); nothing: the event tells neither.
std::optional<bool> opensAfter(const Event& event) {
  if (event.kind != "grasp" || event.json.empty()) return std::nullopt;
  try {
    const Json json = Json::parse(event.json);
    if (json.contains("outcome")) return false;
    if (!json.contains("mode")) return std::nullopt;
    return json.at("mode").asString() == "plain" && !json.contains("start") &&
           json.contains("close") && json.at("close").asDouble() == 0.0;
  } catch (const Error&) {
    return std::nullopt;  // another program's event
  }
}

}  // namespace

SlipDetectorOptions liveSlipOptions() {
  SlipDetectorOptions options;
  options.method = SlipMethod::kCentroid;
  options.reference = SlipReference::kWhenAtRest;
  return options;
}

SlipStage::SlipStage(HandDescription hand, const SlipDetectorOptions& options)
    : hand_(std::move(hand)), options_(options) {
  options_.validate();
}

void SlipStage::setOptions(const SlipDetectorOptions& options) {
  options.validate();
  const std::lock_guard lock(mutex_);
  options_ = options;
  changed_ = true;
}

SlipDetectorOptions SlipStage::options() const {
  const std::lock_guard lock(mutex_);
  return options_;
}

void SlipStage::setReference(std::optional<std::size_t> matrix) {
  const std::lock_guard lock(mutex_);
  referenceRequests_.push_back(matrix);
}

void SlipStage::reset() {
  resetDetection();
  ordered_ = opens_ = false;
}

void SlipStage::resetDetection() {
  for (SlipDetector& detector : detectors_) detector.reset();
  slipping_.assign(slipping_.size(), std::nullopt);
}

// After changed settings the counts have another meaning, so the reference is no longer valid.
void SlipStage::onEvent(const Event& event) {
  if (event.kind == "settings") resetDetection();
  const bool ordered = opensAfter(event).value_or(ordered_);
  if (std::exchange(ordered_, ordered) != ordered) setOpens(ordered_);
}

void SlipStage::setOpens(bool opens) {
  // What moved while it opened is no slip of what it holds then.
  if (std::exchange(opens_, opens) && !opens) resetDetection();
}

void SlipStage::applyReferenceRequests(const SensorLayout& layout) {
  const std::lock_guard lock(mutex_);
  if (changed_ || detectors_.size() != layout.numMatrices()) {
    detectors_.clear();  // with the masks of the frame, not those of the hand
    for (std::size_t m = 0; m < layout.numMatrices(); ++m)
      detectors_.emplace_back(layout.matrix(m), withScaleOf(hand_, m, options_));
    slipping_.assign(detectors_.size(), std::nullopt);
    changed_ = false;
  }
  dueRequests_.swap(referenceRequests_);
  referenceRequests_.clear();
}

void SlipStage::onFrame(LiveResults& results, std::vector<Event>& out) {
  const TactileFrame& frame = *results.frame;
  applyReferenceRequests(*frame.layout);
  setOpens(ordered_ || (opensByItself && opensByItself()));
  jointsDeg_.clear();
  if (results.angles)
    jointsDeg_.assign(results.angles->values.begin(), results.angles->values.end());
  results.slip.resize(detectors_.size());
  for (std::size_t m = 0; m < detectors_.size(); ++m) {
    results.slip[m] = detectors_[m].update(frame.matrix(m), frame.hostUs, jointsDeg_);
    for (const std::optional<std::size_t>& matrix : dueRequests_) {
      if (matrix.value_or(m) != m) continue;
      detectors_[m].setReference();
      results.slip[m] = detectors_[m].last();
    }
    if (opens_) {
      SlipDetection unjudged;
      unjudged.motion = results.slip[m].motion;
      results.slip[m] = unjudged;
    }
    emitSlipEvents(m, results.slip[m], frame.hostUs, out);
  }
  dueRequests_.clear();
}

void SlipStage::emitSlipEvents(std::size_t matrix,
                               const SlipDetection& detection,
                               std::int64_t hostUs,
                               std::vector<Event>& out) {
  auto& slip = slipping_[matrix];
  const int number = static_cast<int>(matrix);
  if (detection.slipping && !slip) {
    slip = Slipping{.sinceUs = hostUs};
    out.push_back({hostUs, hostUs, "slip", number, "slip begins", {}});
  }
  if (!slip) return;
  if (detection.motion.valid) {
    slip->dx += detection.motion.dx;
    slip->dy += detection.motion.dy;
    slip->pathTaxels += std::hypot(detection.motion.dx, detection.motion.dy);
  }
  if (detection.motion.rotation.valid) slip->turnDeg += detection.motion.rotation.rotationDeg;
  if (detection.slipping) return;
  Json json = Json::object();
  json.set("dx_taxels", slip->dx)
      .set("dy_taxels", slip->dy)
      .set("path_taxels", slip->pathTaxels)
      .set("turn_deg", slip->turnDeg);
  out.push_back({slip->sinceUs,
                 hostUs,
                 "slip",
                 number,
                 textOf(slip->pathTaxels, slip->turnDeg),
                 json.text(-1)});
  slip.reset();
}

}  // namespace palpate
