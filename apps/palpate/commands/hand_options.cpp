#include "commands/hand_options.h"

#include <cstdlib>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/kinematics/joint_range.h"
#include "palpate/model/hand_file.h"

#include "commands/commands.h"

namespace palpate::commands {

std::vector<double> numbersOf(const std::string& text,
                              const std::string& option,
                              std::size_t count) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (true) {
    const std::size_t comma = text.find(',', at);
    const std::string piece = text.substr(at, comma == std::string::npos ? comma : comma - at);
    const auto number = parseDouble(piece);
    if (!number) throw UsageError("--" + option + ": '" + piece + "' is not a number");
    numbers.push_back(*number);
    if (comma == std::string::npos) break;
    at = comma + 1;
  }
  if (numbers.size() != count)
    throw UsageError("--" + option + " takes " + std::to_string(count) + " numbers, not " +
                     std::to_string(numbers.size()));
  return numbers;
}

std::vector<std::filesystem::path> handFolders() {
  std::vector<std::filesystem::path> folders;
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  if (data && *data)
    folders.push_back(std::filesystem::path(data) / "palpate/hands");
  else if (home && *home)
    folders.push_back(std::filesystem::path(home) / ".local/share/palpate/hands");
  folders.push_back(dataFolder() / "hands");
  return folders;
}

OptionSpec handOption() {
  return {"hand", "NAME|FOLDER", "the hand: a name that `palpate hands` lists, or its folder"};
}

std::optional<HandDescription> handOf(const CommandLine& given) {
  const auto name = given.text("hand");
  if (!name) return std::nullopt;
  return findHand(*name, handFolders());
}

OptionSpec anglesOption() { return {"angles", "A0,..,A6", "joint angles [deg]"}; }

std::optional<std::vector<double>> anglesOf(const CommandLine& given) {
  const auto text = given.text("angles");
  if (!text) return std::nullopt;
  const auto& axes = sdh2().axes;
  std::vector<double> angles = numbersOf(*text, "angles", axes.size());
  const AnglesCheck check = checkAngles(angles, axes);
  if (check.state != AngleValidity::kValid) throw UsageError("--angles: " + check.problem);
  return angles;
}

OptionSpec fingertipOption(const std::string& defaultName) {
  return {"fingertip",
          "study|effective",
          "radius of the bent fingertips: 58 mm or 48.4 mm; default " + defaultName};
}

GeometryDescription geometryOf(const CommandLine& given, const std::string& defaultName) {
  const std::string name = given.choice("fingertip", {"study", "effective"}).value_or(defaultName);
  return sdh2Geometry(name == "effective" ? kEffectiveFingertipRadiusMm : kStudyFingertipRadiusMm);
}

void requireHand(const std::filesystem::path& file,
                 const Profile& profile,
                 const GeometryDescription& hand) {
  const SensorLayout& known = hand.layout;
  bool same = profile.layout().numMatrices() == known.numMatrices();
  for (std::size_t m = 0; same && m < known.numMatrices(); ++m)
    same = profile.layout().matrix(m).rows == known.matrix(m).rows &&
           profile.layout().matrix(m).columns == known.matrix(m).columns;
  if (!same)
    throw Error(file.string() +
                ": its sensor is not the SDH-2's, the only hand whose geometry is known");
}

}  // namespace palpate::commands
