// The command `palpate calibrate step FILE --matrix M` fits the response to each loading step and
// prints it as JSON.
#include "palpate/calibration/step_report.h"
#include "palpate/core/hash.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/recording_list.h"

namespace palpate::commands {

int calibrateStep(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate calibrate step FILE --matrix M [--loss squares|huber|cauchy] [-o OUT.json]",
       .purpose = "Finds the loading steps of a matrix (something is put onto it and stays) and "
                  "fits a second order lag with linear drift to each: a(t) = K phi(t; T1, T2) + m "
                  "t. Prints JSON: per step the frames, K [counts], m [counts/s], T1, T2 [s], "
                  "covariance (in the order K, m, T1, T2), properties of the curve (dead time, "
                  "inflection, t_k), temperatures, and in `notes` the reasons to doubt the fit.",
       .options = {{"matrix", "M", "the matrix that was loaded"},
                   {"signal",
                    "NAME",
                    "filtered_mean (default), mean, max, min, sum, active, area_mm2"},
                   {"loss", "NAME", "squares (default), or robust: huber, cauchy"},
                   {"damping", "NAME", "over (default: d >= 1) or any (oscillating ones as well)"},
                   {"above", "N", "loaded: the signal is above N, default 0"},
                   {"least", "S", "shorter contacts are no steps [s], default 1"},
                   {"output,o", "OUT.json", "write the result to this file"},
                   {"force", "", "replace OUT.json"}},
       .example = "palpate calibrate step A1.dsa --matrix 1",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::filesystem::path file = given.words().front();
  const std::size_t matrix = matrixGiven(given);
  StepReportOptions options;
  options.steps.signal = signalGiven(given);
  options.steps.aboveCounts = given.number("above", 0.0, 1e6).value_or(0.0);
  options.steps.minDurationS =
      given.number("least", 0.0, 86'400.0).value_or(options.steps.minDurationS);
  options.fit.loss = lossGiven(given);
  if (given.choice("damping", {"over", "any"}) == "any") options.fit.damping = StepDamping::kAny;
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
