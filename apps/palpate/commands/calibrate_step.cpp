// The command `palpate calibrate step FILE --matrix M` fits the response to each loading step and
// prints it as JSON.
#include "palpate/calibration/step_report.h"
#include "palpate/core/hash.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {

int calibrateStep(const Arguments& words) {
  StepReportOptions options;
  const CommandLine given(
      {.synopsis =
           "palpate calibrate step FILE --matrix M [--loss squares|huber|cauchy] [-o OUT.json]",
       .purpose = "Finds the loading steps of a matrix (something is put onto it and stays) and "
                  "fits a second order lag with linear drift to each: a(t) = K phi(t; T1, T2) + m "
                  "t. Prints JSON: per step the frames, K [counts], m [counts/s], T1, T2 [s], "
                  "covariance (in the order K, m, T1, T2), properties of the curve (dead time, "
                  "inflection, t_k), temperatures, and in `notes` the reasons to doubt the fit.",
       .options = withOutputOptions(
           {matrixSpec(),
            boundChoice("signal", "NAME", "", options.steps.signal, signalWords()),
            boundChoice(
                "loss", "NAME", "huber and cauchy are robust", options.fit.loss, kStepLossWords),
            boundChoice("damping",
                        "NAME",
                        "over: d >= 1; any: oscillating steps as well",
                        options.fit.damping,
                        kStepDampingWords),
            bound("above",
                  "N",
                  "count the hand as loaded while the signal is above N",
                  options.steps.aboveCounts,
                  options.steps.kAboveCounts),
            bound("least",
                  "S",
                  "ignore shorter contacts",
                  options.steps.minDurationS,
                  options.steps.kMinDurationS)}),
       .example = "palpate calibrate step A1.dsa --matrix 1",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::filesystem::path file = given.words().front();
  const std::size_t matrix = matrixGiven(given);
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Profile profile = openReported(file, progress, given.quiet()).profile;
  requireMatrix(file, profile.layout(), matrix);
  const StepReport report = reportSteps(profile, matrix, options, progress.callback());
  progress.wipe();
  Json json = provenance("step");
  json.set("file", file.string()).set("sha256", sha256OfFile(file));
  const Json found = jsonOf(report);
  for (const std::string& key : found.keys()) json.set(key, found.at(key));
  printJson(given, json);
  return report.steps.empty() ? kPartlyDone : kDone;
}

}  // namespace palpate::commands
