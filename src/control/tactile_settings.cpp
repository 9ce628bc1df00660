#include "palpate/control/tactile_settings.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kDefaultSensitivity = 0.5;
constexpr int kDefaultThreshold = 150;        // [counts]
constexpr int kDefaultDistalThreshold = 300;  // [counts]
constexpr int kMaxCounts = 4095;

// Returns what is wrong with the settings; empty if they are valid.
std::string problemOf(const TactileSettings& settings) {
  for (const MatrixSettings& matrix : settings) {
    if (!(matrix.sensitivity >= 0.0 && matrix.sensitivity <= 1.0))
      return "sensitivity " + numberText(matrix.sensitivity) + " is not in 0..1";
    if (matrix.thresholdCounts < 0 || matrix.thresholdCounts > kMaxCounts)
      return "threshold " + std::to_string(matrix.thresholdCounts) + " is not in 0..4095 counts";
  }
  return {};
}

// Adds the commands that change `get` of all matrices to its value in `to`; `command` creates one,
// for a matrix or for all.
template <typename Get, typename MakeCommand>
void appendCommands(const TactileSettings& from,
                    const TactileSettings& to,
                    std::vector<DeviceCommand>& commands,
                    Get get,
                    MakeCommand command) {
  std::vector<std::size_t> different;
  for (std::size_t m = 0; m < to.size(); ++m)
    if (get(from[m]) != get(to[m])) different.push_back(m);
  const bool alike = std::all_of(
      to.begin(), to.end(), [&](const MatrixSettings& each) { return get(each) == get(to[0]); });
  if (different.size() > 1 && alike) {
    commands.push_back(command(std::optional<int>(), get(to[0])));
    return;
  }
  for (const std::size_t m : different)
    commands.push_back(command(std::optional<int>(static_cast<int>(m)), get(to[m])));
}

}  // namespace

TactileSettings defaultTactileSettings(const HandDescription& hand) {
  TactileSettings settings;
  for (const MatrixDescription& matrix : hand.matrices)
    settings.push_back({kDefaultSensitivity,
                        matrix.segment == "distal" ? kDefaultDistalThreshold : kDefaultThreshold});
  return settings;
}

std::vector<DeviceCommand> commandsBetween(const TactileSettings& from, const TactileSettings& to) {
  if (from.size() != to.size())
    throw std::invalid_argument("settings of " + std::to_string(to.size()) +
                                " matrices for a hand with " + std::to_string(from.size()));
  if (const std::string problem = problemOf(to); !problem.empty())
    throw std::invalid_argument("settings: " + problem);
  std::vector<DeviceCommand> commands;
  appendCommands(
      from,
      to,
      commands,
      // Compared in single precision, as the controller stores it: 0.3 is read back as not quite
      // 0.3.
      [](const MatrixSettings& matrix) { return static_cast<float>(matrix.sensitivity); },
      [](std::optional<int> matrix, float value) -> DeviceCommand {
        return SetSensitivity{matrix, static_cast<double>(value)};
      });
  appendCommands(
      from,
      to,
      commands,
      [](const MatrixSettings& matrix) { return matrix.thresholdCounts; },
      [](std::optional<int> matrix, int counts) -> DeviceCommand {
        return SetThreshold{matrix, counts};
      });
  return commands;
}

std::string toJson(const TactileSettings& settings) {
  Json matrices = Json::array();
  for (const MatrixSettings& matrix : settings)
    matrices.push(Json::object()
                      .set("sensitivity", matrix.sensitivity)
                      .set("threshold_counts", matrix.thresholdCounts));
  return Json::object().set("matrices", std::move(matrices)).text(-1);
}

TactileSettings parseTactileSettings(std::string_view json) {
  const Json matrices = Json::parse(json).at("matrices");
  if (!matrices.isArray()) throw Error("settings: 'matrices' is missing");
  TactileSettings settings;
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    MatrixSettings matrix;
    matrix.sensitivity = matrices.at(m).at("sensitivity").asDouble();
    const std::int64_t counts = matrices.at(m).at("threshold_counts").asInteger();
    matrix.thresholdCounts = static_cast<int>(std::clamp<std::int64_t>(counts, -1, kMaxCounts + 1));
    settings.push_back(matrix);
  }
  if (const std::string problem = problemOf(settings); !problem.empty())
    throw Error("settings: " + problem);
  return settings;
}

}  // namespace palpate
