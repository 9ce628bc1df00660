// `palpate help columns` and `palpate help commands` print pages of the manual: every column of
// every result table (docs/manual/tables.md), the help of every command (docs/manual/options.md).
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/calibration/pressure_rows.h"
#include "palpate/kinematics/contact_rows.h"
#include "palpate/kinematics/taxel_rows.h"
#include "palpate/laboratory/ghost_rows.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recognition/answer_rows.h"
#include "palpate/recognition/feature_table.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/recognition/size_rows.h"
#include "palpate/recording/label_table.h"
#include "palpate/signals/centre_rows.h"
#include "palpate/signals/curve_rows.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/signals/spectrum_rows.h"
#include "palpate/slip/slip_rows.h"

#include "commands/calibrate_commands.h"
#include "commands/command_line.h"
#include "commands/window_commands.h"

namespace palpate::commands {
namespace {

struct ShownTable {
  std::string command;
  std::unique_ptr<ResultTable> table;
};

// The table of each command, of a recording without frames.
std::vector<ShownTable> shownTables() {
  const HandDescription& hand = defaultHand();
  const Profile profile = ProfileBuilder(hand).finish({});
  const TimedProfile timed{profile};
  const std::string& unit = hand.unit;
  std::vector<ShownTable> tables;
  const auto add = [&](const std::string& command, std::unique_ptr<ResultTable> table) {
    tables.push_back({command, std::move(table)});
  };
  add("signals", signalTable(profile));
  add("signals --centre", centreTable(profile));
  add("slip", slipTable(profile, {}));
  add("slip --segments", slipTable(profile, {.segments = true}));
  add("contact", contactTable(profile, describeGeometry(hand)));
  add("contact --matrices", contactTable(profile, describeGeometry(hand), {.matrices = true}));
  add("contact --size", sizeTable({}));
  add("grasps", graspTable(profile));
  add("labels", labelRows({}, profile));
  for (const FeatureSet set :
       {FeatureSet::kBest, FeatureSet::kSession, FeatureSet::kStatistics, FeatureSet::kStudy}) {
    FeatureTable features;
    features.set = set;
    features.names = featureNames(set, hand);
    add("features --set " + std::string(featureSetName(set)), featureTable(std::move(features)));
  }
  add("derive", curveTable({{"FORMULA"}}, 1, 0));
  add("compare", comparisonTable(timed, timed, 0.0));
  add("compare --average", averageTable({}, {}, {}, {}));
  add("spectrum",
      spectraTable(
          std::make_unique<SpectrumRun>(std::span<const double>(), std::span<const double>()),
          unit));
  add("spectrum --welch", meanSpectrumTable({}, unit));
  add("spectrum --peaks", peakTable({}, unit));
  add("spectrum --coherence", coherenceTable({}, unit, unit));
  add("kinematics", taxelTable({}));
  add("ghosts", ghostTable(true, {}));
  add("ghosts PATH", ghostTable(false, {}));
  add("calibrate apply",
      std::make_unique<RowTable<MatrixRow<TouchedPressure>>>(
          "pressures", pressureColumns(), std::vector<MatrixRow<TouchedPressure>>()));
  add("classify -o OUT.csv", answerTable({}, {}, {}));
  add("evaluate --model M.json -o OUT.csv", verdictTable(ModelEvaluation({}), {}, {}));
  add("evaluate -o OUT.csv", classTable(ConfusionMatrix({})));
  return tables;
}

void printHelpOf(const Command& command, Arguments words = {}) {
  std::cout << "\n## " << command.name;
  for (const std::string& word : words) std::cout << ' ' << word;
  std::cout << "\n\n```\n" << std::flush;
  words.emplace_back("--help");
  if (command.run)
    command.run(words);
  else
    runWindowCommand(command.name, words);
  std::cout << "```\n" << std::flush;
}

void printOptions() {
  std::cout << "# Options\n\n"
               "Every option of every command with its range and default, as `palpate help "
               "commands` prints it.\n";
  for (const Command& command : allCommands()) {
    printHelpOf(command);
    if (std::string_view(command.name) == "calibrate")
      for (const std::string& kind : calibrationKinds()) printHelpOf(command, {kind});
  }
}

}  // namespace

int columnsCommand(const Arguments& words) {
  if (words == Arguments{"commands"}) {
    printOptions();
    return kDone;
  }
  StandardOutput out;
  out.write(
      "# Columns\n\n"
      "Every column of every table that a command prints, as `palpate help columns` prints it; "
      "units are those of an SDH-2. `--units-row` adds the units to a CSV. With several recordings "
      "a last column `file` names the recording. `--time-column s` adds `time_s`, seconds from the "
      "first frame, behind `time_ms` (`begin_s` behind `begin_ms`, `end_s` behind `end_ms`), "
      "`--time-column utc` adds `time_utc`, date and time of day. Flags are 0 and 1 in CSV, false "
      "and true in JSON. What isn't known is an empty cell, in JSON null.\n");
  for (const auto& [command, table] : shownTables()) {
    out.write("\n## " + table->name() + ": palpate " + command +
              "\n\n| column | unit | kind | meaning |\n|---|---|---|---|\n");
    for (const ResultColumn& each : table->columns())
      out.write("| `" + each.name + "` | " + each.unit + " | " + nameOf(each.kind) + " | " +
                each.meaning + " |\n");
  }
  out.finish();
  return kDone;
}

}  // namespace palpate::commands
