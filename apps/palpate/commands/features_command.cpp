// The command `palpate features PATH...` prints the features of the grasps in recordings as CSV.

#include "palpate/batch/batch_task.h"
#include "palpate/core/interruption.h"
#include "palpate/recognition/feature_table.h"
#include "palpate/recording/result_file.h"

#include "commands/batch_options.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

FeatureTable gather(const CommandLine& given, const FeatureExtractionOptions& options) {
  Interruption interruption;
  ProgressLine line("features", given.quiet());
  const Progress show = line.callback();
  return extractFeatures(
      {given.words().begin(), given.words().end()}, options, [&](double fraction) {
        if (interruption.waitForSignal(0)) return false;
        return !show || show(fraction);
      });
}

}  // namespace

int featuresCommand(const Arguments& words) {
  FeatureExtractionOptions options;
  const CommandLine given(
      {.synopsis = "palpate features PATH... [--set study|best|session|statistics] [-o TEMPLATE]",
       .purpose =
           "Prints the features of every grasp as a row of CSV: class, file, first and last frame "
           "(both inclusive), the first and last frame that the features use, then the features. "
           "PATH is a folder with a folder per class (the class is its name, with _ for a blank), "
           "or a recording (no class). The sets:\n\n  best        features that stay valid in "
           "another session: contact geometry and force on the load plateau\n  study       the 54 "
           "features of the study, to compare with it\n  session     best, and the joint angles at "
           "rest: these depend on how the object was presented, and are of no use in another "
           "session\n  statistics  load, extent and position of the contact on every matrix, of "
           "any hand\n\nA grasp: the two pads of the hand that pinch (matrices 1 and 5 of an "
           "SDH-2) are both active for more than 20 frames in a row; with statistics two fingers "
           "are, or the only one. A grasp without features (no joint angles, or pads that don't "
           "face each other) and a recording without a grasp are reported on standard error; then "
           "the exit code is 3. With -o there is a table for each recording.",
       .options = withTableOptions(withFilterOptions(
           {boundChoice("set", "SET", "", options.set, kFeatureSetWords, kDefaultFeatureSetText)})),
       .example = "palpate features recordings --set best > features.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  options.filters = recipeOf(given);
  if (given.has("output"))
    return runBatchCommand(given,
                           tableTemplateOf(given),
                           featuresTask(options.set, options.filters, given.has("units-row")));
  refuseBatchOptions(given);
  FeatureTable table = gather(given, options);

  if (table.set == FeatureSet::kSession && !given.quiet())
    sayLine(std::string(sessionSetWarning()));
  for (const std::string& problem : table.problems) sayLine(problem);
  if (table.rows.empty()) {
    sayLine("no grasp with features in " + std::to_string(table.numFiles) +
            (table.numFiles == 1 ? " recording" : " recordings"));
    return kFailed;
  }
  const bool isWhole = table.problems.empty();
  const int code = writeTable(given, *featureTable(std::move(table)));
  return isWhole ? code : kPartlyDone;
}

}  // namespace palpate::commands
