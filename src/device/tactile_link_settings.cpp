// The settings of the tactile controller: changed, told, and brought back to a controller that forgot them.
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "device/dsa_records.h"
#include "device/tactile_link.h"

namespace palpate {

void TactileLink::applySetting(std::size_t matrix, const Wanted& wanted) {
  if (wanted.sensitivity) controller_->setSensitivity(matrix, *wanted.sensitivity);
  if (wanted.thresholdCounts) controller_->setThreshold(matrix, *wanted.thresholdCounts);
  if (wanted.dynamicMask) controller_->setDynamicMask(matrix, *wanted.dynamicMask);
}

void TactileLink::restoreSettings() {
  bool restored = false;
  for (const auto& [matrix, wanted] : wanted_) {
    if (matrix >= controller_->facts().matrices.size()) continue;
    const DsaMatrixFacts& is = controller_->facts().matrices[matrix];
    const bool same = (!wanted.sensitivity || static_cast<float>(*wanted.sensitivity) ==
                                                  static_cast<float>(is.sensitivity)) &&
                      (!wanted.thresholdCounts || wanted.thresholdCounts == is.thresholdCounts) &&
                      (!wanted.dynamicMask || wanted.dynamicMask == is.layout.dynamicMask);
    if (same) continue;
    applySetting(matrix, wanted);
    restored = true;
  }
  if (!restored) return;
  learn();
  const std::int64_t nowUs = time_.nowUs();
  event("settings",
        "the settings of before were restored",
        nowUs,
        nowUs,
        std::nullopt,
        settingsJson());
}

// What holds from now on: a recording can be read without knowing what went before.
std::string TactileLink::settingsJson() const {
  Json matrices = Json::array();
  for (const DsaMatrixFacts& matrix : controller_->facts().matrices)
    matrices.push(Json::object()
                      .set("sensitivity", matrix.sensitivity)
                      .set("threshold_counts", matrix.thresholdCounts.value_or(0))
                      .set("dynamic_mask", hexDigits(packMask(matrix.layout.dynamicMask))));
  return Json::object().set("matrices", matrices).text(-1);
}

void TactileLink::change(const Wanted& wanted, std::optional<int> matrix, const std::string& text) {
  const std::size_t matrices = controller_->facts().matrices.size();
  if (matrix && (*matrix < 0 || static_cast<std::size_t>(*matrix) >= matrices))
    throw std::invalid_argument("there is no matrix " + std::to_string(*matrix));
  const std::int64_t fromUs = time_.nowUs();
  controller_->whilePaused([&] {
    for (std::size_t m = 0; m < matrices; ++m) {
      if (matrix && static_cast<std::size_t>(*matrix) != m) continue;
      applySetting(m, wanted);
      Wanted& kept = wanted_[m];
      if (wanted.sensitivity) kept.sensitivity = wanted.sensitivity;
      if (wanted.thresholdCounts) kept.thresholdCounts = wanted.thresholdCounts;
      if (wanted.dynamicMask) kept.dynamicMask = wanted.dynamicMask;
    }
  });
  learn();
  rateMayChange();
  event("settings",
        text + (matrix ? " (" + hand_.matrixName(static_cast<std::size_t>(*matrix)) + ")"
                       : " (all matrices)"),
        fromUs,
        time_.nowUs(),
        matrix,
        settingsJson());
}

CommandAnswer TactileLink::execute(const DeviceCommand& command) {
  if (const auto* threshold = std::get_if<SetThreshold>(&command)) {
    Wanted wanted;
    wanted.thresholdCounts = threshold->counts;
    change(wanted, threshold->matrix, "threshold " + std::to_string(threshold->counts) + " counts");
  } else if (const auto* sensitivity = std::get_if<SetSensitivity>(&command)) {
    Wanted wanted;
    wanted.sensitivity = sensitivity->sensitivity;
    change(wanted, sensitivity->matrix, "sensitivity " + numberText(sensitivity->sensitivity));
  } else if (const auto* mask = std::get_if<SetDynamicMask>(&command)) {
    Wanted wanted;
    wanted.dynamicMask = mask->mask;
    const auto on = std::count_if(
        mask->mask.begin(), mask->mask.end(), [](std::uint8_t flag) { return flag != 0; });
    change(wanted, mask->matrix, "dynamic mask: " + std::to_string(on) + " taxels scanned");
  }
  return {};
}

}  // namespace palpate
