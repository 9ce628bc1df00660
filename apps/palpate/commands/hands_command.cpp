// The command `palpate hands` lists the hands that are known, shows one, and checks the folder of a
// hand.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/result_table.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/stl_mesh.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/touch.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

struct ListedHand {
  std::string key;
  std::string source;  // "built in", or the folder
  HandDescription hand;
  std::string fault;  // why it can't be read; empty: it can
};

std::vector<ListedHand> listHands() {
  std::vector<ListedHand> list;
  for (const KnownHand& known : knownHands(handFolders(dataFolder()))) {
    ListedHand listed{known.key, known.folder.string(), {}, {}};
    if (known.folder.empty()) {
      listed.source = "built in";
      listed.hand = builtInHand(known.key);
    } else {
      try {
        listed.hand = readHandFolder(known.folder);
      } catch (const Error& error) {
        listed.fault = error.what();
      }
    }
    list.push_back(std::move(listed));
  }
  return list;
}

Json handJson(const ListedHand& listed) {
  Json json = Json::object();
  json.set("key", listed.key).set("source", listed.source);
  if (!listed.fault.empty()) return std::move(json).set("fault", listed.fault);
  const HandDescription& hand = listed.hand;
  return std::move(json)
      .set("name", hand.name)
      .set("maker", hand.maker)
      .set("unit", hand.unit)
      .set("taxels", hand.layout->numTaxels())
      .set("matrices",
           jsonList(hand.layout->matrices(),
                    [](const MatrixLayout& matrix) {
                      return Json::object()
                          .set("rows", matrix.rows)
                          .set("columns", matrix.columns)
                          .set("pitch_mm", pitchJson(matrix.pitchMm))
                          .set("taxels", matrix.numTaxels());
                    }))
      .set("axes", hand.axes.size())
      .set("temperature_sensors", hand.temperatureSensors.size())
      .set("geometry", hasGeometry(hand));
}

// Reads everything that the folder of a hand refers to. Throws what is wrong; returns what only
// changes the looks of the hand.
std::vector<std::string> checkHand(const HandDescription& hand) {
  if (!hasGeometry(hand)) return {};
  const HandGeometry geometry(describeGeometry(hand));
  std::vector<double> middle;
  for (const AxisDescription& axis : hand.axes)
    middle.push_back((axis.minimumDeg + axis.maximumDeg) / 2.0);
  geometry.pose(middle);
  return meshFaults(geometry.description());
}

// Those that can be read.
std::unique_ptr<ResultTable> handTable(const std::vector<ListedHand>& hands) {
  const auto text = [](const char* name, const char* meaning, auto of) {
    return columnOf<ListedHand>(name, "", meaning, of);
  };
  std::vector<ColumnOf<ListedHand>> columns{
      text("key", "name for --hand", &ListedHand::key),
      text("name", "", [](const ListedHand& each) { return each.hand.name; }),
      text("maker", "", [](const ListedHand& each) { return each.hand.maker; }),
      text("unit", "of its taxels", [](const ListedHand& each) { return each.hand.unit; }),
      text("matrices",
           "rows and columns of each",
           [](const ListedHand& each) { return sizesText(*each.hand.layout); }),
      text("taxels", "", [](const ListedHand& each) { return each.hand.layout->numTaxels(); }),
      text("axes", "", [](const ListedHand& each) { return each.hand.axes.size(); }),
      text("temperature_sensors",
           "",
           [](const ListedHand& each) { return each.hand.temperatureSensors.size(); }),
      text("geometry",
           "whether the places of its taxels in space are known",
           [](const ListedHand& each) { return hasGeometry(each.hand); }),
      text("source", "built in, or its folder", &ListedHand::source)};
  std::vector<ListedHand> rows;
  std::copy_if(hands.begin(), hands.end(), std::back_inserter(rows), [](const auto& each) {
    return each.fault.empty();
  });
  return std::make_unique<RowTable<ListedHand>>("hands", std::move(columns), std::move(rows));
}

// Returns kPartlyDone where a hand can't be read.
int showHands(const CommandLine& given, const std::vector<ListedHand>& hands) {
  int code = kDone;
  if (formOf(given) == TableForm::kJson) {
    printJson(given, Json::object().set("hands", jsonList(hands, handJson)));
  } else if (given.has("output")) {
    code = writeTable(given, *handTable(hands));
  } else {
    for (const ListedHand& each : hands)
      if (each.fault.empty())
        std::printf("%-18s %-46s %s (%s)\n",
                    escapedLine(each.key).c_str(),
                    escapedLine(each.hand.name).c_str(),
                    sizesText(*each.hand.layout).c_str(),
                    escapedLine(each.source).c_str());
  }
  for (const ListedHand& each : hands) {
    if (each.fault.empty()) continue;
    sayLine(each.fault);
    code = kPartlyDone;
  }
  return code;
}

int checkFolders(const std::vector<std::string>& folders) {
  std::size_t failed = 0;
  bool inPart = false;
  for (const std::string& folder : folders) {
    try {
      const HandDescription hand = readHandFolder(folder);
      for (const std::string& fault : checkHand(hand)) {
        sayLine(folder + ": " + fault);
        inPart = true;
      }
      const std::string readings = readingsText(*hand.layout);
      std::printf("%s: %s: %s, %zu taxels, %s%zu axes, %s\n",
                  escapedLine(folder).c_str(),
                  escapedLine(hand.name).c_str(),
                  sizesText(*hand.layout).c_str(),
                  hand.layout->numTaxels(),
                  readings.empty() ? "" : (readings + ", ").c_str(),
                  hand.axes.size(),
                  hasGeometry(hand) ? "with geometry" : "without geometry");
    } catch (const std::exception& error) {
      sayLine(error.what());
      ++failed;
    }
  }
  if (failed == folders.size()) return kFailed;
  return inPart || failed > 0 ? kPartlyDone : kDone;
}

}  // namespace

int handsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate hands [--json] [-o OUT.csv]\n       palpate hands check FOLDER..",
       .purpose =
           "Lists the known hands: the built-in ones, and those in "
           "~/.local/share/palpate/hands. With check: reads the hand.json, URDF and meshes "
           "of each FOLDER, and prints what does not fit together. A mesh that can't be read "
           "is replaced by a box: exit code 3.",
       .options = withOutputOptions(
           {{"json", "", "one object of JSON instead of lines; -o: by the ending"}}, "OUT.csv"),
       .example = "palpate hands check my_hand",
       .minArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  if (!given.words().empty()) {
    if (given.words().front() != "check")
      throw UsageError("hands takes no argument but: check FOLDER..");
    if (given.words().size() < 2) throw UsageError("hands check needs the folder of a hand");
    if (given.options().size() > std::size_t{given.quiet()})
      throw UsageError("hands check prints no list: leave out its options");
    return checkFolders({given.words().begin() + 1, given.words().end()});
  }
  return showHands(given, listHands());
}

}  // namespace palpate::commands
