// The command `palpate grasps PATH...` finds the grasps in recordings and prints them as CSV.
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/table_command.h"

namespace palpate::commands {

int graspsCommand(const Arguments& words) {
  GraspRowsOptions options;
  const CommandLine given(
      {.synopsis = "palpate grasps PATH... [--rule general|study] [-o TEMPLATE]",
       .purpose =
           "Finds the grasps in recordings and prints one per row as CSV: first and last frame "
           "(both inclusive), their host times [ms since 1970], the fingers, and a quality. PATH "
           "is a recording, or a folder: every recording below it. With several recordings a last "
           "column names the file.\n\nRule general: at least two different fingers (or the only "
           "one) have an active taxel (value > 0) for more than 20 frames and more than 0.6 s; "
           "interruptions of up to 3 frames are ignored. Rule study: the two pads that pinch "
           "(matrices 1 and 5 of an SDH-2) are both active for more than 20 frames without "
           "interruption. A gap of the recording (longer than max(1 s, 5 median intervals)) ends a "
           "grasp. fingers: those that touch in at least half of its frames, with blanks "
           "between.\n\nquality, 0 to 1, is the product of four numbers:\n  the fraction of its "
           "frames in contact by the rule (the others are ignored interruptions)\n  the fraction "
           "of its frames without a saturated taxel\n  1 - min(1, sd / mean) of the sum of all "
           "taxels over the middle half of its frames (1: held steadily)\n  1, 1/2 or 1/4 if both, "
           "one or none of its ends are inside the recording (not at its first or last frame, nor "
           "next to a gap)",
       .options = withTableOptions(withFilterOptions(
           {boundChoice("rule", "RULE", "", options.segments.rule, kGraspRuleWords),
            timeColumnOption()})),
       .example = "palpate grasps recordings --rule general > grasps.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  options.filters = recipeOf(given);
  return runTableCommand(given, graspsOf(options));
}

}  // namespace palpate::commands
