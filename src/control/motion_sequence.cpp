#include "palpate/control/motion_sequence.h"

#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

using Kind = SequenceStep::Kind;

constexpr double kMaxStepS = 86'400.0;
constexpr std::int64_t kSequenceVersion = 1;
// The answers of a changed tactile setting take about half a second; a step of a sequence waits
// for them.
constexpr double kSettingsS = 5.0;

bool isMotion(const SequenceStep& step) {
  return step.kind != Kind::kHold && step.kind != Kind::kWait;
}

GraspRequest requestOf(const SequenceStep& step) {
  if (step.kind == Kind::kPose) return motionTo(step.pose, step.request.velocityDegPerS);
  return step.request;
}

const char* nameOf(Kind kind) {
  switch (kind) {
    case Kind::kOpen:
      return "open";
    case Kind::kPose:
      return "pose";
    case Kind::kGrasp:
      return "grasp";
    case Kind::kHold:
      return "hold";
    case Kind::kWait:
      break;
  }
  return "wait";
}

Kind kindFrom(const JsonField& field) {
  const std::string name = field.text();
  for (const Kind kind : {Kind::kOpen, Kind::kPose, Kind::kGrasp, Kind::kHold, Kind::kWait})
    if (name == nameOf(kind)) return kind;
  field.fail("must be open, pose, grasp, hold or wait, not '" + shortened(name) + "'");
}

void validateStep(const SequenceStep& step, const HandDescription& hand) {
  if (!isMotion(step)) {
    if (!(step.seconds >= 0.0 && step.seconds <= kMaxStepS))
      throw std::invalid_argument(numberText(step.seconds) + " s is not in 0..86400 s");
    return;
  }
  if (step.kind == Kind::kPose)
    if (const std::string problem = problemOf(step.pose, hand); !problem.empty())
      throw std::invalid_argument(problem);
  const GraspRequest request = requestOf(step);
  if (step.kind == Kind::kOpen && !isOpening(request))
    throw std::invalid_argument("opening goes to the close ratio 0, plain");
  if (request.mode == GraspMode::kSlip && request.holding.holdS <= 0.0)
    throw std::invalid_argument("a slip-aware grasp in a sequence needs a time to hold");
  if (request.startRatio) motionTo(request, *request.startRatio, hand);
  motionTo(request, request.closeRatio, hand);
}

Json jsonOf(const SequenceStep& step) {
  Json json = Json::object();
  json.set("step", nameOf(step.kind));
  if (!isMotion(step)) return json.set("seconds", step.seconds);
  const GraspRequest& request = step.request;
  json.set("velocity_deg_per_s", request.velocityDegPerS);
  if (step.kind == Kind::kPose) return json.set("pose", jsonOf(step.pose));
  json.set("preshape", request.preshape);
  if (step.kind == Kind::kOpen) return json;
  json.set("mode", nameOf(request.mode)).set("close", request.closeRatio);
  if (request.startRatio) json.set("start", *request.startRatio);
  if (request.mode == GraspMode::kPlain) return json;
  json.set("limit_counts", request.limitCounts);
  if (!request.fingerLimitCounts.empty())
    json.set("finger_limit_counts", jsonList(request.fingerLimitCounts));
  if (!request.forceLimitsN.empty()) json.set("force_limit_n", jsonList(request.forceLimitsN));
  json.set("keeps_limit", request.keepsLimit);
  if (!request.object.empty()) json.set("object", request.object);
  if (request.touchRatio) json.set("touch_ratio", *request.touchRatio);
  if (request.mode != GraspMode::kSlip) return json;
  const HoldingOptions& holding = request.holding;
  json.set("hold_s", holding.holdS)
      .set("most_limit_counts", holding.maxLimitCounts)
      .set("calm_s", holding.noSlipS)
      .set("loosen", holding.loosen)
      .set("weight_n", holding.weightN)
      .set("newtons_per_count", holding.newtonsPerCount);
  return json;
}

constexpr double kAnyNumber = 1e9;  // ranges are checked by GraspRequest::validate()

void readGrasp(const JsonField& field, GraspRequest& request) {
  const std::string mode = field.required("mode").text();
  bool known = false;
  for (const GraspMode each : {GraspMode::kPlain, GraspMode::kReactive, GraspMode::kSlip})
    if (mode == nameOf(each)) {
      request.mode = each;
      known = true;
    }
  if (!known)
    field.at("mode").fail("must be plain, reactive or slip, not '" + shortened(mode) + "'");
  const auto number = [&](const char* key, double usual) {
    return field.number(key, usual, -kAnyNumber, kAnyNumber);
  };
  const auto whole = [&](const char* key, int usual) {
    return static_cast<int>(field.integer(key, usual, -1'000'000, 1'000'000));
  };
  request.closeRatio = number("close", request.mode == GraspMode::kPlain ? 0.5 : 1.0);
  if (field.has("start")) request.startRatio = number("start", 0.0);
  request.limitCounts = whole("limit_counts", request.limitCounts);
  if (field.has("finger_limit_counts"))
    for (const JsonField& each : field.at("finger_limit_counts").items(100))
      request.fingerLimitCounts.push_back(static_cast<int>(each.integer(-1'000'000, 1'000'000)));
  if (field.has("force_limit_n"))
    for (const JsonField& each : field.at("force_limit_n").items(100))
      request.forceLimitsN.push_back(each.number(-kAnyNumber, kAnyNumber));
  if (field.has("keeps_limit")) request.keepsLimit = field.at("keeps_limit").flag();
  if (field.has("object")) request.object = field.at("object").text();
  if (field.has("touch_ratio")) request.touchRatio = number("touch_ratio", 0.0);
  HoldingOptions& holding = request.holding;
  holding.holdS = number("hold_s", holding.holdS);
  holding.maxLimitCounts = whole("most_limit_counts", holding.maxLimitCounts);
  holding.noSlipS = number("calm_s", holding.noSlipS);
  if (field.has("loosen")) holding.loosen = field.at("loosen").flag();
  holding.weightN = number("weight_n", holding.weightN);
  holding.newtonsPerCount = number("newtons_per_count", holding.newtonsPerCount);
}

SequenceStep stepFrom(const JsonField& field) {
  SequenceStep step;
  step.kind = kindFrom(field.required("step"));
  if (!isMotion(step)) {
    step.seconds = field.required("seconds").number(0.0, kMaxStepS);
    return step;
  }
  step.request.velocityDegPerS =
      field.required("velocity_deg_per_s").number(kMinGraspDegPerS, kMaxGraspDegPerS);
  if (step.kind == Kind::kPose) {
    step.pose = savedPoseFrom(field.required("pose"));
    return step;
  }
  step.request.preshape = field.required("preshape").text();
  if (step.kind == Kind::kOpen)
    step.request.closeRatio = 0.0;
  else
    readGrasp(field, step.request);
  return step;
}

}  // namespace

std::string describe(const SequenceStep& step) {
  if (!isMotion(step))
    return std::string(nameOf(step.kind)) + ": " + numberText(step.seconds) + " s";
  std::string text = describe(requestOf(step));
  if (step.kind == Kind::kGrasp && step.request.mode == GraspMode::kSlip)
    text += ", holds " + numberText(step.request.holding.holdS) + " s";
  return text;
}

void MotionSequence::validate(const HandDescription& of) const {
  if (steps.empty()) throw std::invalid_argument("the sequence has no step");
  if (steps.size() > kMaxSteps)
    throw std::invalid_argument("the sequence has more than " + std::to_string(kMaxSteps) +
                                " steps");
  if (repetitions < 1 || repetitions > kMaxRepetitions)
    throw std::invalid_argument("repetitions " + std::to_string(repetitions) + " is not in 1.." +
                                std::to_string(kMaxRepetitions));
  if (hand != of.name) throw std::invalid_argument("the sequence is of another hand: " + hand);
  for (std::size_t i = 0; i < steps.size(); ++i) try {
      validateStep(steps[i], of);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("step " + std::to_string(i + 1) + ": " + error.what());
    }
}

std::string sequenceText(const MotionSequence& sequence) {
  Json json = Json::object();
  json.set("format", "palpate-sequence")
      .set("version", kSequenceVersion)
      .set("hand", sequence.hand)
      .set("repetitions", sequence.repetitions);
  Json steps = Json::array();
  for (const SequenceStep& step : sequence.steps) steps.push(jsonOf(step));
  json.set("steps", std::move(steps));
  return json.text() + "\n";
}

MotionSequence parseSequence(std::string_view text, const std::filesystem::path& file) {
  const JsonField root = JsonField::parse(text, file, "the sequence");
  if (!root.has("format") || root.at("format").text() != "palpate-sequence")
    root.fail("is not a sequence: 'format' must be \"palpate-sequence\"");
  root.required("version").integer(1, kSequenceVersion);
  MotionSequence sequence;
  sequence.hand = root.required("hand").text();
  sequence.repetitions =
      static_cast<int>(root.integer("repetitions", 1, 1, MotionSequence::kMaxRepetitions));
  for (const JsonField& each : root.required("steps").items(MotionSequence::kMaxSteps))
    sequence.steps.push_back(stepFrom(each));
  return sequence;
}

std::string SequenceRun::place() const {
  std::string text =
      "step " + std::to_string(status_.step + 1) + " of " + std::to_string(sequence_.steps.size());
  if (sequence_.repetitions > 1)
    text += ", " + std::to_string(status_.repetition + 1) + " of " +
            std::to_string(sequence_.repetitions) + " times";
  return text;
}

bool SequenceRun::usesTactile() const {
  const SequenceStep& step = sequence_.steps[status_.step];
  return step.kind == Kind::kHold;
}

void SequenceRun::begin(MotionSequence sequence, const HandDescription& hand, std::int64_t hostUs) {
  const std::lock_guard lock(mutex_);
  if (status_.running)
    throw DeviceError(DeviceFault::kRefused, "sequence", "refused: a sequence runs; stop it first");
  sequence.validate(hand);
  const GraspStatus now = control_.status();
  if (now.phase != GraspPhase::kIdle)
    throw DeviceError(DeviceFault::kRefused,
                      "sequence",
                      "refused: the hand is " + std::string(nameOf(now.phase)) + "; stop it first");
  if (!now.cannotMove.empty())
    throw DeviceError(
        DeviceFault::kRefused, "sequence", "refused: the hand can't move: " + now.cannotMove);
  if (!now.tooHot.empty())
    throw DeviceError(
        DeviceFault::kRefused, "sequence", "refused: the hand is too hot: " + now.tooHot);
  sequence_ = std::move(sequence);
  status_ = {};
  stopsBefore_ = now.stopsAsked;
  beginStep(hostUs);
  status_.running = true;
}

// Throws when the motion is refused.
void SequenceRun::beginStep(std::int64_t hostUs) {
  const SequenceStep& step = sequence_.steps[status_.step];
  sinceUs_ = hostUs;
  status_.text = place() + ": " + describe(step);
  // A stop since the begin of the sequence refuses it, whichever thread it came from.
  if (isMotion(step)) control_.grasp(requestOf(step), stopsBefore_);
}

void SequenceRun::finish(const std::string& text, bool failed) {
  status_.running = false;
  status_.failed = failed;
  status_.text = text;
}

void SequenceRun::end(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (!status_.running) return;
  const std::string at = place();
  // Ended first: whatever follows, no further step begins.
  finish("sequence ended in " + at + ": " + why, true);
  control_.stop();
}

void SequenceRun::next(std::int64_t hostUs) {
  if (status_.step + 1 < sequence_.steps.size()) {
    ++status_.step;
  } else if (status_.repetition + 1 < sequence_.repetitions) {
    status_.step = 0;
    ++status_.repetition;
  } else {
    return finish(
        "sequence finished: " + std::to_string(sequence_.steps.size()) + " steps" +
            (sequence_.repetitions > 1 ? ", " + std::to_string(sequence_.repetitions) + " times"
                                       : ""),
        false);
  }
  try {
    beginStep(hostUs);
  } catch (const std::exception& error) {
    finish("sequence ended in " + place() + ": " + error.what(), true);
  }
}

void SequenceRun::step(std::int64_t hostUs) {
  const std::lock_guard lock(mutex_);
  if (!status_.running) return;
  const GraspStatus now = control_.status();
  const std::string at = "sequence ended in " + place() + ": ";
  if (now.stopsAsked != stopsBefore_) return finish(at + "the hand was stopped", true);
  if (!now.tooHot.empty()) {
    finish(at + "too hot: " + now.tooHot, true);
    return control_.stop();
  }
  const SequenceStep& step = sequence_.steps[status_.step];
  if (isMotion(step)) {
    const std::string own = describe(requestOf(step));
    const std::string another = at + "the hand does something else";
    if (now.request && describe(*now.request) != own) return finish(another, true);
    if (now.phase != GraspPhase::kIdle || !now.last || now.last->beginUs < sinceUs_) return;
    const GraspReport& last = *now.last;
    if (describe(last.request) != own) return finish(another, true);
    const bool reached = last.outcome == GraspOutcome::kFinished ||
                         (last.outcome == GraspOutcome::kLimitReached && step.kind == Kind::kGrasp);
    if (!reached) return finish(at + last.text, true);
    if (step.kind != Kind::kGrasp && !last.heldAxes.empty()) {
      // Blocked on its way: motors that push are stopped.
      finish(at + last.text, true);
      return control_.stop();
    }
    return next(hostUs);
  }
  if (now.phase != GraspPhase::kIdle || (now.last && now.last->beginUs > sinceUs_))
    return finish(at + "the hand does something else", true);
  if (!now.cannotMove.empty()) return finish(at + "the hand can't move: " + now.cannotMove, true);
  if (usesTactile() && !now.cannotReact.empty() && !now.changesSetting)
    return finish(at + now.cannotReact, true);
  const double seconds = static_cast<double>(hostUs - sinceUs_) / kUsPerS;
  if (seconds < step.seconds) return;
  // A setting that is being changed must be done before the next grasp under tactile control.
  if (now.changesSetting && seconds < step.seconds + kSettingsS) return;
  next(hostUs);
}

}  // namespace palpate
