#include "commands/hand_options.h"

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
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
  if (count > 0 && numbers.size() != count)
    throw UsageError("--" + option + " takes " + std::to_string(count) + " numbers, not " +
                     std::to_string(numbers.size()));
  return numbers;
}

OptionSpec handOption() {
  return {"hand", "NAME|FOLDER", "the hand: a name that `palpate hands` lists, or its folder"};
}

std::optional<HandDescription> handOf(const CommandLine& given) {
  const auto name = given.text("hand");
  if (!name) return std::nullopt;
  return findHand(*name, handFolders(dataFolder()));
}

OptionSpec anglesOption() {
  return {"angles", "A0,A1,..", "joint angles [deg; mm for an axis that slides], one per axis"};
}

std::optional<std::vector<double>> anglesOf(const CommandLine& given) {
  const auto text = given.text("angles");
  if (!text) return std::nullopt;
  return numbersOf(*text, "angles", 0);
}

std::optional<std::vector<double>> anglesOf(const CommandLine& given, const HandDescription& hand) {
  const auto text = given.text("angles");
  if (!text) return std::nullopt;
  if (hand.axes.empty()) throw UsageError("--angles: '" + hand.name + "' has no joints");
  std::vector<double> angles = numbersOf(*text, "angles", hand.axes.size());
  const AnglesCheck check = checkAngles(angles, hand.axes);
  if (check.state != AngleValidity::kValid) throw UsageError("--angles: " + check.problem);
  return angles;
}

OptionSpec fingertipOption(const std::string& defaultName) {
  return worded("fingertip",
                "NAME",
                "radius of bent fingertips: nominal, or the one that measures every object alike "
                "(SDH-2: 58 mm, 48.4 mm)",
                kBendRadiusWords,
                defaultName);
}

GeometryDescription geometryOf(const CommandLine& given,
                               const HandDescription& hand,
                               const std::string& defaultName) {
  const BendRadius usual =
      defaultName == "effective" ? BendRadius::kEffective : BendRadius::kNominal;
  return describeGeometry(hand, given.chosen("fingertip", kBendRadiusWords).value_or(usual));
}

GeometryDescription geometryOf(const CommandLine& given,
                               const std::filesystem::path& file,
                               const Profile& profile,
                               const std::string& defaultName) {
  try {
    return geometryOf(given, profile.hand(), defaultName);
  } catch (const Error& error) {
    throw FileError(file, error.what());
  }
}

void requireWithinFullScale(const std::string& option, double value, const HandDescription& hand) {
  const auto fullScale = static_cast<double>(hand.maximumCounts);
  if (value > fullScale)
    throw UsageError("--" + option + " " + numberText(value) + " is above the full scale of " +
                     shortened(hand.name) + ", " + numberText(fullScale) + " " + hand.unit);
}

}  // namespace palpate::commands
