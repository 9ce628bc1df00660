// palpate grasp --sdh PORT [--dsa PORT] --preshape NAME ..: moves a hand, and says what it does.
#include <cstdio>
#include <memory>
#include <string>

#include "palpate/capture/capture_session.h"
#include "palpate/control/grasp_control.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/one_line.h"
#include "palpate/core/time.h"
#include "palpate/device/live_hand.h"
#include "palpate/model/preshape.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "gui/interruption.h"

namespace palpate::commands {
namespace {
using gui::Interruption;

constexpr int kLookMs = 20;

CommandSpec spec() {
  return {
      .synopsis = "palpate grasp --sdh PORT [--dsa PORT] --preshape NAME [--close R] ..",
      .purpose =
          "Moves a hand. 'plain' goes to the preshape at close ratio R (0 open .. 1 closed, "
          "default 0.5), whatever\nis felt. 'reactive' opens to the preshape, then closes to R "
          "(default 1) until the first taxel is over\nN counts. Ctrl-C stops the hand. A line "
          "per state: seconds, state, text. The hand stays powered and holds.\nNAME: parallel, "
          "cylindrical, centrical, spherical, pinch-parallel, pinch-tilted, pinch-empty, "
          "calibration.",
      .options = {{"sdh", "PORT", "motion controller"},
                  {"dsa", "PORT", "tactile controller; 'reactive' needs it"},
                  {"preshape", "NAME", "how the fingers stand"},
                  {"close", "R", "close ratio, 0..1"},
                  {"velocity", "V", "of the joints, 1..100 deg/s, default 10"},
                  {"mode", "plain|reactive", "default plain"},
                  {"limit", "N", "of 'reactive', 3..3600 counts, default 200"},
                  {"wait", "S", "give up when the hand doesn't answer for S seconds, default 15"}},
      .example =
          "palpate grasp --sdh /dev/ttyUSB1 --dsa /dev/ttyUSB0 --preshape centrical "
          "--mode reactive",
      .mostWords = 0};
}

GraspRequest requestOf(const CommandLine& given) {
  GraspRequest request;
  const bool reactive = given.choice("mode", {"plain", "reactive"}).value_or("plain") == "reactive";
  if (reactive) {
    request.mode = GraspMode::kReactive;
    request.startRatio = 0.0;
    request.closeRatio = 1.0;
  }
  const auto preshape = given.text("preshape");
  if (!preshape) throw UsageError("grasp needs --preshape NAME");
  try {
    request.preshape = sdh2Preshape(*preshape).name;
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  request.closeRatio = given.number("close", 0.0, 1.0).value_or(request.closeRatio);
  request.velocityDegPerS = given.number("velocity", kSlowestGraspDegPerS, kFastestGraspDegPerS)
                                .value_or(request.velocityDegPerS);
  const auto limit = given.integer("limit", kLeastGraspLimitCounts, kMostGraspLimitCounts);
  if (limit && !reactive) throw UsageError("--limit belongs to --mode reactive");
  request.limitCounts = static_cast<int>(limit.value_or(request.limitCounts));
  return request;
}

// "0.523 closing", at once, for whoever reads along.
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
                oneLine(text).c_str());
    std::fflush(stdout);
  }

 private:
  bool quiet_;
  std::int64_t startUs_;
};

// Until the hand can do what is asked for. Throws why it can't.
void awaitHand(const GraspControl& control,
               const GraspRequest& request,
               double limitS,
               Interruption& interruption) {
  const std::int64_t endUs = systemClock().monotonicUs() + static_cast<std::int64_t>(limitS * 1e6);
  while (true) {
    const GraspStatus status = control.status();
    const std::string& why =
        request.mode == GraspMode::kReactive ? status.cannotReact : status.cannotMove;
    if (why.empty()) return;
    if (systemClock().monotonicUs() > endUs) throw Error("the hand can't grasp: " + why);
    if (interruption.came(kLookMs)) throw Error("interrupted before anything was moved");
  }
}

GraspReport follow(GraspControl& control, const StateLines& lines, Interruption& interruption) {
  while (true) {
    if (interruption.came(kLookMs)) control.stop();
    for (const GraspChange& change : control.takeChanges()) {
      if (!change.report) {
        lines.show(nameOf(change.phase));
        continue;
      }
      lines.show(nameOf(change.report->outcome), change.text);
      return *change.report;
    }
  }
}

int exitCodeOf(const GraspReport& report) {
  switch (report.outcome) {
    case GraspOutcome::kFinished:
    case GraspOutcome::kLimitReached:
      return kDone;
    case GraspOutcome::kStopped:
      std::fputs("palpate: stopped before the grasp was done\n", stderr);
      return kPartlyDone;
    default:
      throw Error(report.text);
  }
}

}  // namespace

int graspCommand(const Words& words) {
  const CommandLine given(spec(), words);
  if (given.helpShown()) return kDone;
  const GraspRequest request = requestOf(given);
  LiveHandOptions ports;
  ports.sdhPort = given.text("sdh").value_or("");
  ports.dsaPort = given.text("dsa").value_or("");
  if (ports.sdhPort.empty()) throw UsageError("grasp needs --sdh PORT");
  if (ports.dsaPort.empty() && request.mode == GraspMode::kReactive)
    throw UsageError("--mode reactive needs --dsa PORT: it stops by what the fingers feel");
  const double waitS = given.number("wait", 0.1, 1e6).value_or(15.0);
  const StateLines lines(given.quiet());
  Interruption interruption;
  CaptureSession session(std::make_unique<LiveHand>(std::move(ports)));
  GraspControl control(session);
  control.run();
  lines.show("connecting");
  session.start();
  awaitHand(control, request, waitS, interruption);
  lines.show("ready");
  control.grasp(request);
  return exitCodeOf(follow(control, lines, interruption));
}

}  // namespace palpate::commands
