// The command `palpate hands` lists the hands that are known, shows one, and checks the folder of a
// hand.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/stl_mesh.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/touch.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"

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

int checkFolders(const std::vector<std::string>& folders) {
  int failed = 0;
  bool inPart = false;
  for (const std::string& folder : folders) {
    try {
      const HandDescription hand = readHandFolder(folder);
      for (const std::string& fault : checkHand(hand)) {
        std::fprintf(stderr, "palpate: %s\n", escapedLine(folder + ": " + fault).c_str());
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
      std::fprintf(stderr, "palpate: %s\n", escapedLine(error.what()).c_str());
      ++failed;
    }
  }
  return failed > 0 ? kFailed : inPart ? kPartlyDone : kDone;
}

}  // namespace

int handsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate hands [--json]\npalpate hands check FOLDER..",
       .purpose =
           "Lists the known hands: the built-in ones, and those in "
           "~/.local/share/palpate/hands. With check: reads the hand.json, URDF and meshes "
           "of each FOLDER, and prints what does not fit together. A mesh that can't be read "
           "is replaced by a box: exit code 3.",
       .options = {{"json", "", "one object of JSON, with a list of the hands"}},
       .example = "palpate hands check my_hand",
       .minArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  if (!given.words().empty()) {
    if (given.words().front() != "check")
      throw UsageError("hands takes no argument but: check FOLDER..");
    if (given.words().size() < 2) throw UsageError("hands check needs the folder of a hand");
    if (given.has("json")) throw UsageError("--json can't be used with check");
    return checkFolders({given.words().begin() + 1, given.words().end()});
  }
  const std::vector<ListedHand> hands = listHands();
  if (given.has("json"))
    std::printf("%s\n", Json::object().set("hands", jsonList(hands, handJson)).text(-1).c_str());
  bool failed = false;
  for (const ListedHand& listed : hands) {
    if (!given.has("json") && listed.fault.empty()) {
      std::printf("%-18s %-46s %s (%s)\n",
                  escapedLine(listed.key).c_str(),
                  escapedLine(listed.hand.name).c_str(),
                  sizesText(*listed.hand.layout).c_str(),
                  escapedLine(listed.source).c_str());
    }
    if (listed.fault.empty()) continue;
    std::fprintf(stderr, "palpate: %s\n", escapedLine(listed.fault).c_str());
    failed = true;
  }
  return failed ? kFailed : kDone;
}

}  // namespace palpate::commands
