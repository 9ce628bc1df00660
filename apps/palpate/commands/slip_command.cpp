// The command `palpate slip FILE...` prints as CSV how contacts move on every matrix, and whether
// that is slip.
#include <stdexcept>
#include <string>

#include "palpate/slip/slip_rows.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

// What isn't bound to a field.
void takeWords(const CommandLine& given, SlipRowsOptions& options) {
  setSlipMethod(options, nameOf(options.pass.detector.method));
  try {
    setSlipReference(options, given.text("reference").value_or("first"));
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--reference is ") + error.what());
  }
  options.filters = recipeOf(given);
  options.times = timeChoiceOf(given);
  options.pass.threads = given.has("output") ? 1 : 0;  // of -o: recordings at the same time
}

}  // namespace

int slipCommand(const Arguments& words) {
  SlipRowsOptions options;
  SlipRuleOptions& rule = options.pass.detector.rule;
  const CommandLine given(
      {.synopsis =
           "palpate slip PATH... [--method METHOD] [--reference first|rest|FRAME] [-o TEMPLATE]",
       .purpose =
           "Prints for every frame and every matrix with an active taxel, as CSV, how the contact "
           "moved since the frame before (dx, dy) and since the reference [taxels, x right, y "
           "down], by which angle it turned, and whether that is slip; docs/manual/columns.md "
           "explains the "
           "columns. With --segments there is a row per slip instead. PATH is a recording, or a "
           "folder: every recording below it. With several recordings a last column names the "
           "file. With -o there is a table for each recording.",
       .options = withTableOptions(withFilterOptions(
           {boundChoice("method",
                        "METHOD",
                        "contest compares a motion with a load shift",
                        options.pass.detector.method,
                        wordsOf(slipMethods(), [](SlipMethod each) { return nameOf(each); })),
            bound("matrix", "M", "only this matrix", options.matrix, kMatrixOption),
            {"reference",
             "WHAT",
             "first: first frame with an active taxel (default); rest: each contact from when "
             "it is at rest; or a frame"},
            bound("step", "T", "threshold per frame", rule.stepTaxels, rule.kStepTaxels),
            bound("limit",
                  "T",
                  "threshold since the reference",
                  rule.referenceTaxels,
                  rule.kReferenceTaxels),
            bound("rotation",
                  "DEG",
                  "threshold of the rotation",
                  rule.rotationDeg,
                  rule.kRotationDeg),
            bound("segments",
                  "print a row per slip: frames, matrix, length of the path",
                  options.segments),
            timeOption(),
            timeColumnOption()})),
       .example = "palpate slip bottle.dsa --reference rest > slip.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  takeWords(given, options);
  return runTableCommand(given, slipOf(options));
}

}  // namespace palpate::commands
