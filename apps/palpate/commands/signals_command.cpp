// The command `palpate signals PATH... [--matrix M] [--filter SPEC..]` prints characteristic
// signals as CSV.
#include <cstdint>
#include <filesystem>

#include "palpate/batch/batch_task.h"
#include "palpate/core/text_table.h"
#include "palpate/signals/signal_filter.h"
#include "palpate/signals/signal_rows.h"

#include "commands/batch_options.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

// The filters over time that are applied to the signals themselves (--smooth).
Recipe smoothOf(const CommandLine& given) {
  try {
    const Recipe recipe = parseRecipe(given.texts("smooth"));
    SignalFilter(recipe, 1, [](std::int64_t, std::span<const SignalValues>) {});
    return recipe;
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--smooth ") + error.what());
  }
}

}  // namespace

int signalsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate signals PATH... [--matrix M] [--filter SPEC..] [--smooth SPEC..] [-o TEMPLATE]",
       .purpose =
           "Prints the characteristic signals of every matrix in every frame as CSV: mean, "
           "minimum, maximum, sum and number of the active taxels (value > 0), their area, "
           "and the mean of the 3x3 Gaussian-filtered matrix over its active taxels. A "
           "matrix without active taxels has zeros. A sensor that sends readings with a sign or "
           "three components also has x, y, z, their sums over the baseline, and norm, "
           "the length of the three; with --filter it doesn't. PATH is a recording, or a folder: "
           "every "
           "recording below it. With several recordings a last column names the file; one "
           "that can't be read is reported, and the rows of the others are printed: exit "
           "code 3. With -o there is a table for each recording.",
       .options = withBatchOptions(withFilterOptions(
           {{"matrix", "M", "only this matrix (0, 1, ..)"},
            unitsRowOption(),
            {"smooth", "SPEC", "then filter the signals themselves over time, as kalman:q=0.05"}})),
       .example = "palpate signals foam_ball.dsa --matrix 1 > curve.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto matrix = given.integer("matrix", 0, INT64_MAX);
  const Recipe recipe = recipeOf(given);
  const Recipe smooth = smoothOf(given);
  const bool unitsRow = given.has("units-row");
  if (given.has("output"))
    return runBatchCommand(
        given,
        batchTemplateOf(given, {".csv"}),
        signalsTask({.matrix = matrix, .filters = recipe, .smooth = smooth, .unitsRow = unitsRow}));
  refuseBatchOptions(given);
  const RecordingList recordings = recordingsIn(given.words());
  const char* const noUnit = recordings.several ? ",\n" : "\n";
  const TextFrame frame{.head = [&](const Profile& profile) {
    // A filter leaves no readings.
    const bool components = profile.givesReadings() && recipe.empty();
    return signalColumns(components) + (recordings.several ? ",file\n" : "\n") +
           (unitsRow ? signalUnits(profile.hand(), components) + noUnit : "");
  }};
  return writeOpenedTexts(recordings,
                          given.quiet(),
                          frame,
                          [&](const std::filesystem::path& file,
                              const Recording& unfiltered,
                              const TextSink& write,
                              const Progress& progress) {
                            const Profile profile = filteredBy(recipe, unfiltered, file);
                            requireBelowHalfRate(smooth, profile, file);
                            requireMatrix(file, profile.layout(), matrix);
                            const std::string lineEnd =
                                recordings.several ? "," + csvLine({file.string()}) : "\n";
                            writeSignalRows(profile, matrix, smooth, lineEnd, write, progress);
                          });
}

}  // namespace palpate::commands
