// The command `palpate grasp --sdh PORT [--dsa PORT] --preshape NAME ..` moves a hand and prints
// its states.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "palpate/calibration/calibration.h"
#include "palpate/capture/capture_session.h"
#include "palpate/control/grasp_control.h"
#include "palpate/control/motion_sequence.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"
#include "palpate/core/time.h"
#include "palpate/device/last_stop.h"
#include "palpate/device/live_hand.h"
#include "palpate/interop/remote_fields.h"
#include "palpate/kinematics/preshape_opening.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"

namespace palpate::commands {
namespace {

constexpr int kGraspLookMs = 20;
constexpr std::int64_t kNoticeUs = 5'000'000;  // while no stop is answered
constexpr double kPortBackS = 10.0;            // beyond the end of the motion
constexpr std::size_t kMaxSequenceBytes = 10'000'000;

// What is bound to options of the command line.
struct GraspChoices {
  GraspRequest request = {};
  std::optional<double> closeRatio = {};
  std::optional<int> limitCounts = {}, mostLimitCounts = {};
  double massKg = 0.0;
  std::optional<double> objectMm = {};
  double waitS = 15.0;
};

CommandSpec graspSpec(GraspChoices& choices) {
  GraspRequest& request = choices.request;
  HoldingOptions& holding = request.holding;
  return {
      .synopsis = "palpate grasp --sdh PORT [--dsa PORT] --preshape NAME [--close R] ..",
      .purpose =
          "Moves a hand. The mode 'plain' moves to the preshape at close ratio R (0 open .. 1 "
          "closed, default 0.5), without regard to contact. 'reactive' opens to the preshape, then "
          "closes to R (default 1), slowly where it is expected to touch, stops when the first "
          "taxel exceeds N counts, and moves by small steps until the reading at rest is N. 'slip' "
          "does "
          "the same and then holds the object: when the object slips, the hand closes again, to a "
          "limit raised by 300 counts. It ends with Ctrl-C or after --hold seconds. Ctrl-C stops "
          "the hand. Prints a line per state: seconds, state, text. After the command the motors "
          "stay on and hold the object. NAME: parallel, cylindrical, centrical, spherical, "
          "pinch-parallel, pinch-tilted, pinch-empty, calibration.",
      .options =
          {{"sdh", "PORT", "motion controller"},
           {"dsa", "PORT", "tactile controller; 'reactive' and 'slip' need it"},
           {"preshape", "NAME", "preshape: pose of the fingers before they close"},
           bound("close",
                 "R",
                 "close ratio",
                 choices.closeRatio,
                 GraspRequest::kCloseRatio,
                 numberText(request.closeRatio) + ", under tactile control 1"),
           bound("velocity",
                 "V",
                 "velocity of the joints",
                 request.velocityDegPerS,
                 GraspRequest::kVelocityDegPerS),
           boundChoice("mode",
                       "MODE",
                       "",
                       request.mode,
                       wordsOf(kAllGraspModes, [](GraspMode each) { return nameOf(each); })),
           bound("limit",
                 "N",
                 "limit of 'reactive' and 'slip'",
                 choices.limitCounts,
                 GraspRequest::kLimitCounts,
                 std::to_string(request.limitCounts)),
           {"object",
            "NAME",
            "of 'reactive' and 'slip': name of the object; the program remembers where grasps "
            "touch it"},
           bound("object-size",
                 "MM",
                 "width of the object: close fast to this width",
                 choices.objectMm,
                 {0.1, kLargestObjectMm, "mm"}),
           {"quick",
            "",
            "close at V deg/s all the way and stay where the hand stops; doesn't keep the limit"},
           {"finger-limits", "N0,N1,..", "instead of --limit: a limit for each finger, in counts"},
           {"force-limit",
            "F[,F1,..]",
            "also stops when a finger presses harder than F newtons; F,F1,..: each finger; " +
                numberText(kMinForceLimitN) + ".." + numberText(kMaxForceLimitN) +
                ", needs --calibration"},
           {"calibration", "FILE", "the calibration that measures --force-limit"},
           bound("most",
                 "N",
                 "of 'slip': maximum of the rising limit",
                 choices.mostLimitCounts,
                 GraspRequest::kLimitCounts,
                 std::to_string(holding.maxLimitCounts)),
           bound("hold",
                 "S",
                 "of 'slip': end after this time; the hand keeps holding",
                 holding.holdS,
                 HoldingOptions::kHoldS,
                 "until Ctrl-C"),
           bound("calm",
                 "S",
                 "of 'slip': lower the limit again after this time without slip",
                 holding.noSlipS,
                 HoldingOptions::kNoSlipS),
           bound("loosen", "of 'slip': let the hand open slowly to a lower limit", holding.loosen),
           bound("object-mass",
                 "KG",
                 "of 'slip': open slowly once, until the object slips, and measure the friction",
                 choices.massKg,
                 HoldingOptions::kMassKg,
                 ""),
           bound("newtons-per-count",
                 "F",
                 "of a calibration, for the friction",
                 holding.newtonsPerCount,
                 HoldingOptions::kNewtonsPerCount,
                 ""),
           {"sequence",
            "FILE",
            "run the steps that the window saved (dock Hand), instead of a grasp"},
           bound("wait",
                 "S",
                 "give up when the hand doesn't answer",
                 choices.waitS,
                 StartLimits::kFirstFrameS)},
      .example =
          "palpate grasp --sdh /dev/ttyUSB1 --dsa /dev/ttyUSB0 --preshape centrical "
          "--mode reactive",
      .maxArguments = 0};
}

void holdingOf(const CommandLine& given, const GraspChoices& choices, GraspRequest& request) {
  for (const char* option : {"most", "hold", "calm", "loosen", "object-mass", "newtons-per-count"})
    if (given.has(option) && request.mode != GraspMode::kSlip)
      throw UsageError("--" + std::string(option) + " needs --mode slip");
  constexpr double kGravity = 9.81;  // [m/s^2]
  HoldingOptions& holding = request.holding;
  holding.maxLimitCounts =
      choices.mostLimitCounts.value_or(std::max(holding.maxLimitCounts, request.limitCounts));
  if (holding.maxLimitCounts < request.limitCounts)
    throw UsageError("--most " + std::to_string(holding.maxLimitCounts) +
                     " is below the limit of " + std::to_string(request.limitCounts) + " counts");
  holding.weightN = kGravity * choices.massKg;
}

// Limits of single fingers, and limits in newtons.
void fingerLimitsOf(const CommandLine& given, GraspRequest& request) {
  const auto limits = given.text("finger-limits");
  const auto forces = given.text("force-limit");
  for (const char* option : {"finger-limits", "force-limit"})
    if (given.has(option) && request.mode == GraspMode::kPlain)
      throw UsageError("--" + std::string(option) + " needs --mode reactive or slip");
  if (limits && given.has("limit"))
    throw UsageError("--limit and --finger-limits exclude one another");
  if (given.has("force-limit") != given.has("calibration"))
    throw UsageError("--force-limit and --calibration need one another");
  if (limits) {
    for (const double limit : numbersOf(*limits, "finger-limits", numMovableFingers())) {
      if (limit != std::floor(limit) || limit < kMinGraspLimitCounts ||
          limit > kMaxGraspLimitCounts)
        throw UsageError("--finger-limits: " + numberText(limit) + " is not a count in " +
                         std::to_string(kMinGraspLimitCounts) + ".." +
                         std::to_string(kMaxGraspLimitCounts));
      request.fingerLimitCounts.push_back(static_cast<int>(limit));
    }
    request.limitCounts =
        *std::max_element(request.fingerLimitCounts.begin(), request.fingerLimitCounts.end());
  }
  if (!forces) return;
  request.forceLimitsN = numbersOf(*forces, "force-limit", 0);
  // The limit in counts stays as a second one, as high as it can be.
  if (!limits && !given.has("limit") && request.mode == GraspMode::kReactive)
    request.limitCounts = kMaxGraspLimitCounts;
}

// How the limit is kept.
void approachOf(const CommandLine& given, std::optional<double> size, GraspRequest& request) {
  for (const char* option : {"object", "object-size", "quick"})
    if (given.has(option) && request.mode == GraspMode::kPlain)
      throw UsageError("--" + std::string(option) + " needs --mode reactive or slip");
  for (const char* option : {"object", "object-size"})
    if (given.has(option) && given.has("quick"))
      throw UsageError("--" + std::string(option) + " and --quick exclude one another");
  request.keepsLimit = request.mode != GraspMode::kPlain && !given.has("quick");
  request.object = given.text("object").value_or("");
  if (!size) return;
  const HandGeometry geometry(describeGeometry(movableHand()));
  request.touchRatio =
      touchRatioOf(geometry, findPreshape(movableHand().file->preshapes, request.preshape), *size);
  if (!request.touchRatio)
    throw UsageError("--object-size: the closed hand is wider than " + numberText(*size) + " mm");
}

GraspRequest graspRequestOf(const CommandLine& given, const GraspChoices& choices) {
  GraspRequest request = choices.request;
  const bool feels = request.mode != GraspMode::kPlain;
  if (feels) {
    request.startRatio = 0.0;
    request.closeRatio = 1.0;
  }
  const auto preshape = given.text("preshape");
  if (!preshape)
    throw UsageError("grasp needs --preshape NAME; 'palpate grasp --help' lists the names");
  try {
    request.preshape = findPreshape(defaultHand().file->preshapes, *preshape).name;
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  request.closeRatio = choices.closeRatio.value_or(request.closeRatio);
  if (choices.limitCounts && !feels) throw UsageError("--limit needs --mode reactive or slip");
  request.limitCounts = choices.limitCounts.value_or(request.limitCounts);
  fingerLimitsOf(given, request);
  holdingOf(given, choices, request);
  approachOf(given, choices.objectMm, request);
  try {
    request.validate();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return request;
}

// Prints state lines such as "0.523 closing" at once, so that a reader can follow.
class StateLines {
 public:
  explicit StateLines(bool quiet) : quiet_(quiet), startUs_(systemClock().monotonicUs()) {}
  void show(std::string_view state, const std::string& text = {}) const {
    if (quiet_) return;
    const double seconds = static_cast<double>(systemClock().monotonicUs() - startUs_) / 1e6;
    std::printf("%s %s%s%s\n",
                fixedText(seconds, 3).c_str(),
                std::string(state).c_str(),
                text.empty() ? "" : ": ",
                escapedLine(text).c_str());
    std::fflush(stdout);
  }

 private:
  bool quiet_;
  std::int64_t startUs_;
};

// Waits until the hand can do what was requested. Throws the reason when it cannot.
void awaitHand(const GraspControl& control,
               const GraspRequest& request,
               double limitS,
               Interruption& interruption) {
  const std::int64_t endUs = systemClock().monotonicUs() + static_cast<std::int64_t>(limitS * 1e6);
  while (true) {
    const GraspStatus status = control.status();
    const std::string& why =
        request.mode == GraspMode::kPlain ? status.cannotMove : status.cannotReact;
    if (why.empty()) return;
    if (systemClock().monotonicUs() > endUs) throw Error("the hand can't grasp: " + why);
    if (interruption.waitForSignal(kGraspLookMs))
      throw Error("interrupted before anything was moved");
  }
}

// The text often begins with the state: "closing", "stopping: stopped by the user".
void showState(const StateLines& lines, std::string_view state, const std::string& text) {
  const std::string begin = std::string(state) + ": ";
  if (text == state) return lines.show(state);
  lines.show(state, text.starts_with(begin) ? text.substr(begin.size()) : text);
}

// Shows the condition of the hand when it changes, before the line with the reason: the last
// line is how the grasp ended.
void showHand(const StateLines& lines,
              const ExplainedCondition& now,
              std::optional<HandCondition>& shown) {
  if (std::exchange(shown, now.condition) == now.condition) return;
  const bool bad =
      now.condition == HandCondition::kNotProtected || now.condition == HandCondition::kGone;
  lines.show("hand", std::string(nameOf(now.condition)) + (bad ? ": " + now.sentence : ""));
}

GraspReport follow(GraspControl& control, const StateLines& lines, Interruption& interruption) {
  std::int64_t nextNoticeUs = 0;
  std::optional<HandCondition> shown = HandCondition::kReady;
  while (true) {
    if (interruption.waitForSignal(kGraspLookMs)) {
      control.stop();
      nextNoticeUs = 0;
    }
    for (const GraspChange& change : control.takeChanges()) {
      showHand(lines, change.condition, shown);
      if (change.report) {
        showState(lines, nameOf(change.report->outcome), change.text);
        return *change.report;
      }
      showState(lines, nameOf(change.phase), change.text);
    }
    const GraspStatus status = control.status();
    const std::int64_t nowUs = systemClock().monotonicUs();
    if (status.phase != GraspPhase::kStopping || status.cannotMove.empty() || nowUs < nextNoticeUs)
      continue;
    lines.show("stopping",
               "no stop is answered: if the hand moves, switch its power off; the command ends "
               "when the hand answers, or 10 s after its motion must have ended");
    nextNoticeUs = nowUs + kNoticeUs;
  }
}

// The motion port was unplugged: a hand that may move is stopped when the port is back, if that is
// soon enough.
[[noreturn]] void awaitPort(const GraspControl& control,
                            const GraspReport& report,
                            const StateLines& lines,
                            Interruption& interruption) {
  const double remainingS = report.remainingMotionS.value_or(0.0);
  if (remainingS == 0.0) throw Error(report.text);
  const double limitS = remainingS + kPortBackS;
  lines.show("waiting",
             "up to " + fixedText(limitS, 0) +
                 " s for the motion port: plug it in again, or switch the hand's power off; until "
                 "then nothing can stop the motion");
  const std::int64_t endUs = systemClock().monotonicUs() + std::llround(limitS * kUsPerS);
  while (systemClock().monotonicUs() < endUs && !interruption.waitForSignal(kGraspLookMs))
    if (!control.status().portGone)
      throw Error(
          "the motion port was unplugged in a motion; it is back, and the hand was stopped");
  throw Error(report.text + "; state unknown: use the power switch");
}

TouchMemory knownTouches() {
  try {
    return loadTouches(touchesFile());
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + "; delete or repair it, or leave out --object");
  }
}

// A grasp is done whether or not its touch can be remembered. The file is read again: another
// program may have written it meanwhile.
void remember(const GraspReport& report) {
  try {
    TouchMemory touches = loadTouches(touchesFile());
    if (touches.learn(report)) saveTouches(touches, touchesFile());
  } catch (const Error& error) {
    sayLine(std::string("where the object was touched is not remembered: ") + error.what());
  }
}

MotionSequence sequenceOf(const CommandLine& given) {
  for (const char* option : {"preshape", "close", "velocity", "mode", "limit"})
    if (given.has(option))
      throw UsageError("--sequence excludes --" + std::string(option) +
                       ": its steps have their own");
  const std::filesystem::path file = *given.text("sequence");
  MotionSequence sequence = parseSequence(readTextFile(file, kMaxSequenceBytes), file);
  try {
    sequence.validate(movableHand());
  } catch (const std::invalid_argument& error) {
    throw FileError(file, error.what());
  }
  return sequence;
}

// Whether a step needs the tactile stream.
bool feels(const MotionSequence& sequence) {
  return std::any_of(sequence.steps.begin(), sequence.steps.end(), [](const SequenceStep& step) {
    return step.kind == SequenceStep::Kind::kHold || step.request.mode != GraspMode::kPlain;
  });
}

int runSequence(const MotionSequence& sequence,
                CaptureSession& session,
                GraspControl& control,
                const StateLines& lines,
                Interruption& interruption) {
  SequenceRun run(control);
  run.begin(sequence, session.device().hand(), session.nowUs());
  std::optional<HandCondition> hand = HandCondition::kReady;
  for (std::string shown; run.running();) {
    for (const GraspChange& change : control.takeChanges()) showHand(lines, change.condition, hand);
    if (shown != run.status().text) lines.show("sequence", shown = run.status().text);
    if (interruption.waitForSignal(kGraspLookMs)) control.stop();
  }
  if (!run.status().failed) {
    lines.show("finished", run.status().text);
    return kDone;
  }
  if (const auto gone = control.status().portGone) awaitPort(control, *gone, lines, interruption);
  throw Error(run.status().text);
}

int exitCodeOf(const GraspReport& report) {
  switch (report.outcome) {
    case GraspOutcome::kFinished:
    case GraspOutcome::kLimitReached:
      return kDone;
    case GraspOutcome::kStopped:
      // Without a holding time, holding until it is stopped is what was requested.
      if (report.held && report.request.holding.holdS == 0.0) return kDone;
      std::fputs("palpate: stopped before the grasp was done\n", stderr);
      return kPartlyDone;
    default:
      throw Error(report.text);
  }
}

}  // namespace

int graspCommand(const Arguments& words) {
  GraspChoices choices;
  const CommandLine given(graspSpec(choices), words);
  if (given.helpShown()) return kDone;
  std::optional<MotionSequence> sequence;
  if (given.has("sequence")) sequence = sequenceOf(given);
  GraspRequest request;
  if (!sequence)
    request = graspRequestOf(given, choices);
  else if (feels(*sequence))
    request.mode = GraspMode::kReactive;  // waits for the tactile stream, too
  LiveHandOptions ports;
  ports.sdhPort = given.text("sdh").value_or("");
  ports.dsaPort = given.text("dsa").value_or("");
  if (ports.sdhPort.empty()) throw UsageError("grasp needs --sdh PORT");
  if (ports.dsaPort.empty() && request.mode != GraspMode::kPlain)
    throw UsageError(
        (sequence ? std::string("the sequence") : "--mode " + std::string(nameOf(request.mode))) +
        " needs --dsa PORT: it stops by the readings of the taxels");
  std::optional<Calibration> calibration;
  if (const auto file = given.text("calibration")) calibration = loadCalibration(*file);
  if (const std::string problem = stopProgramProblem(); !problem.empty()) sayLine(problem);
  const StateLines lines(given.quiet());
  Interruption interruption;
  CaptureSession session(std::make_unique<LiveHand>(std::move(ports)));
  GraspControl control(session);
  control.setCalibration(std::move(calibration));
  if (!request.object.empty()) control.setTouches(knownTouches());
  control.run();
  lines.show("connecting");
  session.start();
  awaitHand(control, request, choices.waitS, interruption);
  // Nothing was requested yet: the motion reported is that of the hand when it was found.
  for (const Event& event : session.takeEvents())
    if (event.kind == "motion") showState(lines, "stopped", event.text);
  const bool feelsObject = !sequence && request.mode != GraspMode::kPlain;
  lines.show("ready", feelsObject ? describe(control.forecast(request), request) : std::string());
  if (sequence) return runSequence(*sequence, session, control, lines, interruption);
  control.grasp(request);
  const GraspReport report = follow(control, lines, interruption);
  remember(report);
  if (report.outcome == GraspOutcome::kPortGone) awaitPort(control, report, lines, interruption);
  return exitCodeOf(report);
}

}  // namespace palpate::commands
