// The command `palpate signals PATH... [--matrix M] [--filter SPEC..]` prints characteristic
// signals as a table.
#include <cstdint>

#include "palpate/signals/signal_filter.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/table_command.h"

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
  SignalRowsOptions options;
  const CommandLine given(
      {.synopsis =
           "palpate signals PATH... [--matrix M] [--filter SPEC..] [--smooth SPEC..] [-o TEMPLATE]",
       .purpose =
           "Prints the characteristic signals of every matrix in every frame as CSV: mean, "
           "minimum, maximum, sum and number of the active taxels (value > 0), their area, "
           "and the mean of the 3x3 Gaussian-filtered matrix over its active taxels. A "
           "matrix without active taxels has zeros. A sensor that sends readings with a "
           "sign or three components also has x, y, z, their sums over the baseline, and "
           "norm, the length of the three; with --filter it doesn't. PATH is a recording, "
           "or a folder: every recording below it. With several recordings a last column names the "
           "file; one "
           "that can't be read is reported, and the rows of the others are printed: exit "
           "code 3. With -o there is a table for each recording. With --centre a row is the centre "
           "of force of a matrix that is touched: sum,x,y [taxels],x_mm,y_mm.",
       .options = withTableOptions(withFilterOptions(
           {bound("matrix", "M", "only this matrix", options.matrix, kMatrixOption),
            timeOption(),
            timeColumnOption(),
            bound("centre",
                  "print the centre of force of each touched matrix instead",
                  options.centres),
            {"smooth", "SPEC", "then filter the signals themselves over time, as kalman:q=0.05"}})),
       .example = "palpate signals foam_ball.dsa --matrix 1 > curve.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  options.filters = recipeOf(given);
  options.smooth = smoothOf(given);
  options.times = timeChoiceOf(given);
  if (options.centres && !options.smooth.empty())
    throw UsageError("--smooth filters the signals: leave out --centre, or use --filter");
  return runTableCommand(given, signalsOf(options));
}

}  // namespace palpate::commands
