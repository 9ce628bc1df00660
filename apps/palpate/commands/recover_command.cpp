// The command `palpate recover IN OUT` saves what is readable in a damaged or unfinished recording.
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {

int recoverCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate recover IN OUT [--topic TOPIC]..",
       .purpose = "Saves what is readable in a damaged or unfinished recording; IN is never "
                  "changed. The ending of OUT chooses the format, as in `palpate convert` "
                  "(.palpate, .dsa, .csv, .npz, ..). Exit code: 0 nothing was lost, 3 something "
                  "was lost, 1 nothing could be saved (then there is no OUT).",
       .options = {{"force", "", "replace OUT"}, topicOption()},
       .example = "palpate recover broken.dsa saved.palpate",
       .minArguments = 2,
       .maxArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  const std::string& in = given.words()[0];
  const RecoverReport report = [&] {
    ProgressLine progress("recovering " + in, given.quiet());
    return recoverRecording(in,
                            given.words()[1],
                            given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse,
                            progress.callback(),
                            {.topics = given.texts("topic")});
  }();
  if (report.state == RecoverReport::State::kNothing) throw Error(in + ": " + report.message);
  if (!given.quiet()) std::printf("%s\n", escapedLine(in + ": " + report.message).c_str());
  return report.state == RecoverReport::State::kWhole ? kDone : kPartlyDone;
}

}  // namespace palpate::commands
