// The options of commands that place taxels in space: joint angles, and the radius of the
// fingertips.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/kinematics/geometry_description.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>

#include "commands/command_line.h"

namespace palpate::commands {

// Parses "10,-20,.." as `count` numbers (0: any number of them); throws UsageError that names the
// option and the invalid part.
std::vector<double> numbersOf(const std::string& text,
                              const std::string& option,
                              std::size_t count);

// The option --hand NAME|FOLDER, and the hand that it names (nothing without the option). Throws
// Error that lists the known hands, or names what is wrong in the hand's files.
OptionSpec handOption();
std::optional<HandDescription> handOf(const CommandLine& given);

// The option --angles A0,A1,..: numbers [deg; mm for an axis that slides]; throws UsageError.
OptionSpec anglesOption();
std::optional<std::vector<double>> anglesOf(const CommandLine& given);
// The same for a hand: one number per axis, within its range.
std::optional<std::vector<double>> anglesOf(const CommandLine& given, const HandDescription& hand);

// The option --fingertip study|effective.
OptionSpec fingertipOption(const std::string& defaultName = "study");
// Geometry of a hand. Throws Error that names the hand when its description contains none.
GeometryDescription geometryOf(const CommandLine& given,
                               const HandDescription& hand,
                               const std::string& defaultName = "study");
// The same for the hand of a recording; Error names the file.
GeometryDescription geometryOf(const CommandLine& given,
                               const std::filesystem::path& file,
                               const Profile& profile,
                               const std::string& defaultName = "study");

// Largest full scale that a hand may have, in its unit: bound of options that are values of taxels
// before the hand is known.
inline constexpr double kLargestFullScale = 1e9;
// Throws UsageError that names the option unless a value of a taxel is within the hand's full
// scale.
void requireWithinFullScale(const std::string& option, double value, const HandDescription& hand);

}  // namespace palpate::commands
