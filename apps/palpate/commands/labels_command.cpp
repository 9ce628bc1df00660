// The command `palpate labels PATH...` prints the labels of recordings as CSV, and adds those of
// such a table to a recording.
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/label_table.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

int importLabels(const CommandLine& given, const std::string& file, const std::string& from) {
  const std::string csv = readTextFile(from, kMaxLabelTableBytes);
  ProgressLine line("reading " + file, given.quiet());
  const Recording recording = openReported(file, line, given.quiet());
  recording.requireEvents();
  const EventsReport present{recording.events, recording.damage.events};
  const LabelTable table = [&] {
    try {
      return readLabelTable(csv, recording.profile, file);
    } catch (const Error& error) {
      throw FormatError(from, error.what());
    }
  }();
  const std::vector<Event> added = newLabels(table, present.events);
  if (!added.empty()) {
    std::vector<Event> all = present.events;
    all.insert(all.end(), added.begin(), added.end());
    saveEvents(file, present, all);
  }
  const std::size_t known = table.events.size() - added.size();
  if (!given.quiet())
    std::printf("%s\n",
                (file + ": " + counted(added.size(), "label") + " added" +
                 (known > 0 ? ", " + std::to_string(known) + " were there already" : "") +
                 (table.numOthers > 0
                      ? "; " + counted(table.numOthers, "row") + " of other recordings not taken"
                      : ""))
                    .c_str());
  for (const std::string& problem : table.problems) sayLine(from + ": " + problem);
  if (table.more) sayLine(from + ": has more wrong rows; the rest was not read");
  if (table.problems.empty()) return kDone;
  return table.events.empty() ? kFailed : kPartlyDone;
}

}  // namespace

int labelsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate labels PATH... | FILE --import LABELS.csv",
       .purpose =
           "Prints what a person has noted in recordings (labels, notes, marks, corrected grasps) "
           "as CSV: begin_s, end_s [s from the first frame], kind (label, note, mark, segment), "
           "text, matrix. PATH is a recording, or a folder: every recording below it. With several "
           "recordings a last column names the file.\n\nWith --import the labels of such a table "
           "are added to FILE, which keeps its own; a label that FILE already has isn't added "
           "again. Columns may be in any order. begin_s and text are required; a row without "
           "end_s is a moment, a row without kind is a label. Where a column names the file, only "
           "the rows of FILE are added. Wrong rows are left out and named by "
           "their line number; then the exit code is 3, or 1 if all rows are wrong.",
       .options =
           withTableOptions({{"import", "LABELS.csv", "add the labels of this table to FILE"}}),
       .example = "palpate labels recordings > labels.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (const auto from = given.text("import")) {
    if (given.words().size() != 1) throw UsageError("--import takes one FILE");
    if (given.options().size() > 1U + given.quiet())
      throw UsageError("--import doesn't print a table: leave out its options");
    return importLabels(given, given.words()[0], *from);
  }
  return runTableCommand(
      given,
      {.options = "labels",
       .of = [](const std::filesystem::path&,
                const Recording& recording,
                const Progress&) { return labelRows(recording.events, recording.profile); },
       .rowNoun = "label",
       .readable = true});
}

}  // namespace palpate::commands
