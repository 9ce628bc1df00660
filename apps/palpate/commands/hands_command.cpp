// The command `palpate hands` lists the hands that are known, shows one, and checks the folder of a
// hand.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/stl_mesh.h"
#include "palpate/model/hand_file.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"

namespace palpate::commands {
namespace {

namespace fs = std::filesystem;

struct ListedHand {
  std::string key;
  std::string source;  // "built in", or the folder
  HandDescription hand;
  std::string fault;  // why it can't be read; empty: it can
};

std::vector<ListedHand> listHands() {
  std::vector<ListedHand> list;
  std::set<std::string> keys;
  for (const fs::path& folder : handFolders()) {
    std::error_code failure;
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder, failure))
      if (fs::is_regular_file(entry.path() / "hand.json", failure)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    for (const fs::path& path : found) {
      const std::string key = path.filename().string();
      if (!keys.insert(key).second) continue;
      ListedHand listed{key, path.string(), {}, {}};
      try {
        listed.hand = readHandFolder(path);
      } catch (const Error& error) {
        listed.fault = error.what();
      }
      list.push_back(std::move(listed));
    }
  }
  for (const BuiltInHand& each : builtInHands())
    if (keys.insert(each.key).second) list.push_back({each.key, "built in", *each.hand, {}});
  std::sort(list.begin(), list.end(), [](const ListedHand& a, const ListedHand& b) {
    return a.key < b.key;
  });
  return list;
}

std::string sizesOfMatrices(const HandDescription& hand) {
  // Equal sizes are counted: "3 x 14x6, 3 x 13x6".
  std::vector<std::pair<std::string, int>> sizes;
  for (const MatrixLayout& matrix : hand.layout->matrices()) {
    const std::string size = std::to_string(matrix.rows) + "x" + std::to_string(matrix.columns);
    const auto known = std::find_if(
        sizes.begin(), sizes.end(), [&](const auto& each) { return each.first == size; });
    if (known == sizes.end())
      sizes.emplace_back(size, 1);
    else
      ++known->second;
  }
  std::string text;
  for (const auto& [size, count] : sizes)
    text += (text.empty() ? "" : ", ") +
            (count == 1 ? std::string() : std::to_string(count) + " x ") + size;
  return text;
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
                          .set("pitch_mm", matrix.pitchMm)
                          .set("taxels", matrix.numTaxels());
                    }))
      .set("axes", hand.axes.size())
      .set("temperature_sensors", hand.temperatureSensors.size())
      .set("geometry", hasGeometry(hand));
}

// Reads everything that the folder of a hand refers to. Throws what is wrong.
void checkHand(const HandDescription& hand) {
  if (!hasGeometry(hand)) return;
  const HandGeometry geometry(describeGeometry(hand));
  for (const LinkShape& shape : geometry.description().shapes)
    if (shape.kind == LinkShape::Kind::kMesh) readStl(shape.mesh);
  std::vector<double> middle;
  for (const AxisDescription& axis : hand.axes)
    middle.push_back((axis.minimumDeg + axis.maximumDeg) / 2.0);
  geometry.pose(middle);
}

int checkFolders(const std::vector<std::string>& folders) {
  int failed = 0;
  for (const std::string& folder : folders) {
    try {
      const HandDescription hand = readHandFolder(folder);
      checkHand(hand);
      std::printf("%s: %s: %s, %zu taxels, %zu axes, %s\n",
                  folder.c_str(),
                  hand.name.c_str(),
                  sizesOfMatrices(hand).c_str(),
                  hand.layout->numTaxels(),
                  hand.axes.size(),
                  hasGeometry(hand) ? "with geometry" : "without geometry");
    } catch (const std::exception& error) {
      std::fprintf(stderr, "palpate: %s\n", error.what());
      ++failed;
    }
  }
  return failed > 0 ? kFailed : kDone;
}

}  // namespace

int handsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate hands [--json]\npalpate hands check FOLDER..",
       .purpose = "Lists the hands that are known: the built-in ones, and those in "
                  "~/.local/share/palpate/hands.\nWith check: reads the hand.json, URDF and meshes "
                  "of each folder, and says what does not fit.",
       .options = {{"json", "", "as JSON, one object per hand"}},
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
  bool failed = false;
  for (const ListedHand& listed : listHands()) {
    if (given.has("json")) {
      std::printf("%s\n", handJson(listed).text(-1).c_str());
    } else if (listed.fault.empty()) {
      std::printf("%-18s %-46s %s (%s)\n",
                  listed.key.c_str(),
                  listed.hand.name.c_str(),
                  sizesOfMatrices(listed.hand).c_str(),
                  listed.source.c_str());
    }
    if (listed.fault.empty()) continue;
    std::fprintf(stderr, "palpate: %s\n", listed.fault.c_str());
    failed = true;
  }
  return failed ? kFailed : kDone;
}

}  // namespace palpate::commands
