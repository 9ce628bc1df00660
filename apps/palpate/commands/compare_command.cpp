// The command `palpate compare A B [--align HOW]` prints two recordings side by side, frame by
// frame, as CSV; with --average the average of a signal over grasps or recordings.
#include <array>
#include <filesystem>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "palpate/batch/grasp_files.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/average_curve.h"
#include "palpate/signals/curve_comparison.h"
#include "palpate/signals/curve_rows.h"
#include "palpate/signals/formula.h"

#include "commands/calibrated_frames.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"
#include "commands/signal_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

constexpr double kFurthestS = 1e9;
constexpr OptionRange kOffsetS{-kFurthestS, kFurthestS, "s"};
constexpr int kMicroseconds = 6;  // decimals: the resolution of time stamps

struct TimedRecording {
  Recording recording;
  TimedProfile timed;
};

TimedRecording opened(const std::string& file, bool quiet) {
  ProgressLine progress("reading " + file, quiet);
  Recording recording = openReported(file, progress, quiet);
  TimedProfile timed = timedProfile(recording.profile, {}, progress.callback());
  return {std::move(recording), std::move(timed)};
}

// The grasps of a recording: as a person has corrected them, else those that are found.
std::vector<GraspFrames> graspsOf(const std::string& file, const Recording& recording, bool quiet) {
  recording.requireEvents();
  ProgressLine progress("finding grasps in " + file, quiet);
  std::vector<GraspFrames> grasps =
      graspFrames(recording.profile, recording.events, progress.callback());
  if (grasps.empty()) throw Error(file + ": has no grasp");
  return grasps;
}

// --grasp I:J, numbers from 1. Says where both grasps last: the rows are those of the whole
// recordings.
double offsetOfGrasps(const CommandLine& given, const TimedRecording& a, const TimedRecording& b) {
  const std::string text = *given.text("grasp");
  const auto colon = text.find(':');
  const auto numberOf = [&](const std::string& part) {
    const auto number = parseInteger(part);
    if (!number || *number < 1)
      throw UsageError("--grasp needs two numbers I:J from 1, as 1:3; is \"" + text + "\"");
    return static_cast<std::size_t>(*number);
  };
  const std::size_t i = numberOf(text.substr(0, colon));
  const std::size_t j = colon == std::string::npos ? i : numberOf(text.substr(colon + 1));
  TimedProfile timedA = a.timed, timedB = b.timed;
  std::vector<FrameRange> ranges;
  for (const auto& [side, recording, number, file] :
       {std::tuple(&timedA, &a.recording, i, given.words()[0]),
        std::tuple(&timedB, &b.recording, j, given.words()[1])}) {
    const auto grasps = graspsOf(file, *recording, given.quiet());
    if (number > grasps.size())
      throw Error(file + ": has no grasp " + std::to_string(number) + ", only 1.." +
                  std::to_string(grasps.size()));
    side->grasp = grasps[number - 1].begin;
    ranges.push_back({grasps[number - 1].begin, grasps[number - 1].end});
  }
  const double offsetS = *offsetBetween(timedA, timedB, Alignment::kGrasp);
  const auto both = graspsInCommon(timedA, ranges[0], timedB, ranges[1], offsetS);
  if (both && !given.quiet())
    sayLine("both grasps last from time_s " + fixedText(both->fromS, kMicroseconds) + " to " +
            fixedText(both->toS, kMicroseconds) +
            "; the rows are of all frames that both recordings have");
  return offsetS;
}

auto alignmentWords() {
  return wordsOf(std::array{Alignment::kContact, Alignment::kStart, Alignment::kClock},
                 [](Alignment each) { return nameOf(each); });
}

double offsetFor(const CommandLine& given, const TimedRecording& a, const TimedRecording& b) {
  if (given.has("grasp")) {
    for (const char* other : {"align", "offset"})
      if (given.has(other))
        throw UsageError(std::string("give --grasp or --") + other + ", not both");
    return offsetOfGrasps(given, a, b);
  }
  if (const auto offsetS = given.number("offset", kOffsetS)) {
    if (given.has("align")) throw UsageError("give --align or --offset, not both");
    return *offsetS;
  }
  const Alignment how = given.chosen("align", alignmentWords()).value_or(Alignment::kContact);
  if (const auto offsetS = offsetBetween(a.timed, b.timed, how)) return *offsetS;
  for (std::size_t i = 0; i < 2; ++i) {
    const TimedProfile& side = (i == 0 ? a : b).timed;
    if (side.profile.numFrames() == 0) throw Error(given.words()[i] + ": has no frames");
    if (!side.contact)
      throw Error(given.words()[i] +
                  ": no lasting contact (3 taxels in 3 frames in a row); use --align start");
  }
  throw Error("these two recordings can't be aligned; try --align start");
}

// What --average depends on.
struct AverageChoices {
  AverageOptions average = {};
  bool ofGrasps = true;
  double marginS = 0.5;
};

constexpr std::array<OptionWord<bool>, 2> kOfGraspsWords{{{"grasps", true}, {"recordings", false}}};

void takePercentiles(const CommandLine& given, AverageOptions& options) {
  if (const auto text = given.text("percentiles")) {
    const std::vector<std::string> parts = splitAtCommas(*text);
    const auto low = parseDouble(parts.front()), high = parseDouble(parts.back());
    if (parts.size() != 2 || !low || !high || !(*low >= 0.0 && *low < *high && *high <= 100.0))
      throw UsageError("--percentiles needs two numbers LOW,HIGH from 0 to 100, as 10,90; is \"" +
                       *text + "\"");
    if (given.has("band") && options.band != AverageBand::kPercentiles)
      throw UsageError("give --band sd or --percentiles, not both");
    options.band = AverageBand::kPercentiles;
    options.lowPercent = *low;
    options.highPercent = *high;
  }
}

// Curves with their names.
struct NamedCurves {
  std::vector<AlignedCurve> curves;
  std::vector<std::string> files;   // one per curve
  std::vector<std::string> grasps;  // " grasp 1", or empty
};

// Names of the columns: of files with different names these, else their paths.
std::vector<std::string> shownNames(const std::vector<std::string>& files, const NamedCurves& all) {
  std::set<std::string> names;
  for (const std::string& file : files)
    names.insert(std::filesystem::path(file).filename().string());
  const bool differ = names.size() == std::set<std::string>(files.begin(), files.end()).size();
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < all.files.size(); ++i)
    shown.push_back(
        (differ ? std::filesystem::path(all.files[i]).filename().string() : all.files[i]) +
        all.grasps[i]);
  return shown;
}

void addCurvesOf(const CommandLine& given,
                 const AverageChoices& choices,
                 const std::optional<CalibrationChoice>& calibration,
                 const std::string& file,
                 NamedCurves& all) {
  const TimedRecording whole = opened(file, given.quiet());
  const TimedProfile& timed = whole.timed;
  if (timed.profile.numFrames() == 0) throw Error(file + ": has no frames");
  const NamedSignals named = namedSignals(calibration, file, whole.recording, timed.profile);
  const TypedSignal signal = typedSignal(*given.text("average"), named.profile, file, "--average");
  reportAssumptions(named, namesOf(signal, named.profile.layout()), given.quiet());
  ProgressLine progress("reading " + file, given.quiet());
  const auto series = std::make_shared<const Series>(
      typedSeries(named.profile, signal, -kFurthestS, kFurthestS, file, progress.callback()));
  const double longestS = gapFromS(timed.timing);
  if (!choices.ofGrasps) {
    const Alignment how = given.chosen("align", alignmentWords()).value_or(Alignment::kContact);
    if (how == Alignment::kClock)
      throw UsageError("--align of --average must be one of contact, start, not 'clock'");
    if (how == Alignment::kContact && !timed.contact)
      throw Error(file + ": no lasting contact (3 taxels in 3 frames in a row); use --align start");
    all.curves.push_back({.series = series,
                          .zeroS = how == Alignment::kContact ? timed.timeS(*timed.contact) : 0.0,
                          .longestS = longestS});
    all.files.push_back(file);
    all.grasps.emplace_back();
    return;
  }
  std::vector<TimeSpan> spans;
  for (const GraspFrames& grasp : graspsOf(file, whole.recording, given.quiet())) {
    spans.push_back({timed.timeS(grasp.begin), timed.timeS(grasp.end)});
    all.files.push_back(file);
    all.grasps.push_back(" grasp " + std::to_string(spans.size()));
  }
  for (AlignedCurve& curve : alignedStretches(series, spans, choices.marginS, longestS))
    all.curves.push_back(std::move(curve));
}

// --average NAME
int writeAverage(const CommandLine& given, AverageChoices choices) {
  for (const char* other : {"grasp", "offset"})
    if (given.has(other))
      throw UsageError(std::string("--average aligns all at their contacts: leave out --") + other);
  if (choices.ofGrasps && given.has("align"))
    throw UsageError("--align needs --of recordings; grasps are aligned where they begin");
  AverageOptions& options = choices.average;
  takePercentiles(given, options);
  NamedCurves all;
  const auto calibration = calibrationGiven(given);
  for (const std::string& file : given.words()) addCurvesOf(given, choices, calibration, file, all);
  const AverageCurve average = averageCurve(all.curves, options);
  return writeTable(given,
                    *averageTable(average, options, all.curves, shownNames(given.words(), all)));
}

}  // namespace

int compareCommand(const Arguments& words) {
  AverageChoices choices;
  const CommandLine given(
      {.synopsis =
           "palpate compare A B [--align contact|start|clock | --grasp I:J | --offset S]\n"
           "       palpate compare FILE.. --average SIGNAL [--of grasps|recordings] [--band "
           "sd|percentiles] [--calibration C.json]",
       .purpose =
           "Aligns two recordings in time. For every frame of A it takes the frame of B at "
           "the same time (or the last one before it) and prints of each matrix: the mean "
           "of the active taxels in A and in B, and mean and root mean square of A - B over "
           "the taxels that are active in either. The first contact is the first of three "
           "frames in a row in which at least 3 taxels are active. Matrices whose number of "
           "rows or columns differs in B are left out.\n"
           "With --average, the grasps of all files are aligned where they begin. For every "
           "moment it prints the mean of a signal with mean -+ standard deviation (n - 1), or "
           "the median with percentiles, then the value of every grasp: "
           "time_s,curves,mean,low,high,.. The column curves is the number of grasps with a value.",
       .options = withOneTableOptions(withCalibration(
           {worded("align",
                   "HOW",
                   "by first contacts, first frames, or host time",
                   alignmentWords(),
                   "contact"),
            {"grasp",
             "I:J",
             "align where grasp I of A and grasp J of B begin, numbers from 1; print on standard "
             "error where both last"},
            ranged("offset", "S", "begin B at this time after A's first frame", kOffsetS),
            {"average",
             "SIGNAL",
             "average a signal: m1_mean, hand_sum, m5_x2_y9, angle3, m1_force_n, or a formula as "
             "for derive"},
            boundChoice("of",
                        "WHAT",
                        "all grasps of each FILE, or each as a whole",
                        choices.ofGrasps,
                        kOfGraspsWords),
            boundChoice("band",
                        "HOW",
                        "sd: mean and standard deviation",
                        choices.average.band,
                        kAverageBandWords),
            {"percentiles", "LOW,HIGH", "default 10,90"},
            bound("margin",
                  "S",
                  "time to include before and after each grasp",
                  choices.marginS,
                  {0.0, kFurthestS, "s"}),
            bound("step",
                  "S",
                  "interval of the time base",
                  choices.average.stepS,
                  AverageOptions::kStepS,
                  "the longest median interval"),
            bound("least",
                  "N",
                  "minimum number of values for a mean",
                  choices.average.least,
                  AverageOptions::kMinimum)})),
       .example = "palpate compare run_1.dsa run_2.dsa > differences.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("average")) return writeAverage(given, choices);
  for (const char* only : {"of", "band", "percentiles", "margin", "step", "least", "calibration"})
    if (given.has(only)) throw UsageError(std::string("--") + only + " needs --average");
  calibrationGiven(given);
  if (given.words().size() != 2) throw UsageError("compare needs two recordings, or --average");
  const TimedRecording a = opened(given.words()[0], given.quiet());
  const TimedRecording b = opened(given.words()[1], given.quiet());
  const double offsetS = offsetFor(given, a, b);
  ProgressLine progress("comparing", given.quiet());
  return writeTable(given, *comparisonTable(a.timed, b.timed, offsetS, progress.callback()));
}

}  // namespace palpate::commands
