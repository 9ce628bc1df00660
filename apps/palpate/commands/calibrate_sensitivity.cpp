// The command `palpate calibrate sensitivity FILE --matrix M` determines the gain as a function of
// sensitivity.
#include <algorithm>

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/sensitivity_curve.h"
#include "palpate/calibration/step_report.h"
#include "palpate/core/error.h"
#include "palpate/core/hash.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr std::size_t kMaxSteps = 1000;

std::vector<double> sensitivitiesGiven(const CommandLine& given, std::size_t steps) {
  const auto text = given.text("sensitivities");
  if (!text) return {};
  const auto count = static_cast<std::size_t>(std::count(text->begin(), text->end(), ',')) + 1;
  const std::vector<double> values = numbersOf(*text, "sensitivities", std::min(count, kMaxSteps));
  for (const double value : values)
    if (!(value > 0.0 && value <= 1.0))
      throw UsageError("--sensitivities must be above 0, at most 1");
  if (values.size() != steps)
    throw Error("--sensitivities names " + std::to_string(values.size()) +
                " values, but the recording has " + std::to_string(steps) + " steps");
  return values;
}

}  // namespace

int calibrateSensitivity(const Arguments& words) {
  StepReportOptions options;
  double threshold = SensorSettings{}.thresholdCounts;
  const CommandLine given(
      {.synopsis = "palpate calibrate sensitivity FILE --matrix M [--sensitivities S1,S2,..]",
       .purpose =
           "Measures gain K against sensitivity: the same load, put on again at several "
           "sensitivities in one recording. Prints JSON: the points, slope, offset and r2 of K = "
           "slope s + offset, and how the threshold explains the offset. Without --sensitivities "
           "the N steps are taken as 1/N, 2/N, .., 1 (a .dsa stores no sensitivity).",
       .options = withOutputOptions(
           {matrixSpec(),
            {"sensitivities", "S1,S2,..", "sensitivities of the steps, in order"},
            bound("threshold",
                  "N",
                  "threshold while it was recorded, for the explanation",
                  threshold,
                  SensorSettings::kThresholdCounts),
            boundChoice("signal", "NAME", "", options.steps.signal, signalWords()),
            boundChoice("loss", "NAME", "of the step fits", options.fit.loss, kStepLossWords)}),
       .example = "palpate calibrate sensitivity sensitivity_0.1-1.0.dsa --matrix 1",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::filesystem::path file = given.words().front();
  const std::size_t matrix = matrixGiven(given);
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Profile profile = openReported(file, progress, given.quiet()).profile;
  requireMatrix(file, profile.layout(), matrix);
  requireWithinFullScale("threshold", threshold, profile.hand());
  const StepReport report = reportSteps(profile, matrix, options, progress.callback());
  progress.wipe();
  const std::size_t n = report.steps.size();
  const std::vector<double> named = sensitivitiesGiven(given, n);
  std::vector<SensitivityPoint> points;
  for (std::size_t i = 0; i < n; ++i) {
    const FittedStep& step = report.steps[i];
    SensitivityPoint point;
    point.sensitivity =
        named.empty() ? static_cast<double>(i + 1) / static_cast<double>(n) : named[i];
    point.staticResponseCounts = step.fit.parameters.staticResponseCounts;
    point.used = step.fit.usable();
    for (const auto* notes : {&step.notes, &step.fit.notes})
      if (point.note.empty() && !notes->empty()) point.note = notes->front();
    points.push_back(std::move(point));
  }
  SensitivityCurve curve = fitSensitivityCurve(points, threshold);
  for (const std::string& note : report.notes) curve.notes.push_back(note);
  if (named.empty() && n > 0)
    curve.notes.push_back("the sensitivities aren't in the recording: " + std::to_string(n) +
                          " even steps up to 1 assumed");
  Json json = provenance("sensitivity");
  json.set("file", file.string()).set("sha256", sha256OfFile(file)).set("matrix", matrix);
  json.set("options",
           Json::object()
               .set("threshold_counts", threshold)
               .set("assumed_sensitivities", named.empty()));
  const Json found = jsonOf(curve);
  for (const std::string& key : found.keys()) json.set(key, found.at(key));
  printJson(given, json);
  return curve.valid ? kDone : kPartlyDone;
}

}  // namespace palpate::commands
