#include "palpate/control/limit_feasibility.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/sensor_characteristics.h"

namespace palpate {
namespace {

// Largest pressure of a finger. At sensitivity 0.5 the largest readings of the recordings (3567
// counts, thresholds 150 and 300) correspond to about 160 kPa.
constexpr double kFirmestKpa = 200.0;
constexpr double kUsualDegC = 35.0;

// Reading for that pressure according to the sensor's characteristic [counts]; SDH-2 only.
std::optional<double> readingOfTheFirmest(const HandDescription& hand,
                                          std::size_t matrix,
                                          const MatrixSettings& settings) {
  const SensorCharacteristics& sensor = sdh2Sensor();
  if (hand.matrices.size() != sensor.matrices.size() || hand.matrices[matrix].segment.empty())
    return std::nullopt;
  return sensor.matrices[matrix].restCounts(kUsualDegC) +
         settings.sensitivity * sensor.countsAbove(kFirmestKpa, kUsualDegC) -
         settings.thresholdCounts;
}

// Reason why this matrix can't read `needed` counts; empty if it can.
std::string emptyReason(const HandDescription& hand,
                        std::size_t matrix,
                        const std::optional<MatrixSettings>& settings,
                        double needed) {
  if (hand.layout->matrix(matrix).numEnabled() == 0) return "no taxel of it is scanned";
  const auto saturation = static_cast<double>(hand.saturationOf(matrix));
  if (saturation < needed) return "it saturates at " + numberText(saturation) + " counts";
  if (!settings) return {};
  const double left = static_cast<double>(hand.maximumOf(matrix)) - settings->thresholdCounts;
  if (left < needed)
    return "its threshold of " + std::to_string(settings->thresholdCounts) +
           " leaves no more than " + numberText(std::max(left, 0.0)) + " counts";
  if (!(settings->sensitivity > 0.0)) return "its sensitivity is 0";
  const auto firmest = readingOfTheFirmest(hand, matrix, *settings);
  if (firmest && *firmest < needed)
    return "at sensitivity " + fixedText(settings->sensitivity, 3) + " and threshold " +
           std::to_string(settings->thresholdCounts) + " it reads no more than " +
           numberText(std::round(std::max(*firmest, 0.0))) + " counts";
  return {};
}

}  // namespace

std::vector<UnmeasurableLimit> unmeasurableLimits(const HandDescription& hand,
                                                  const std::vector<MatrixSettings>& settings,
                                                  int limitCounts) {
  const bool known = settings.size() == hand.layout->numMatrices();
  std::vector<UnmeasurableLimit> unfelt;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const std::string why = emptyReason(hand,
                                        m,
                                        known ? std::optional(settings[m]) : std::nullopt,
                                        static_cast<double>(limitCounts) + kLimitMarginCounts);
    if (!why.empty()) unfelt.push_back({m, hand.matrixName(m) + " can't measure it: " + why});
  }
  return unfelt;
}

// Axis 0 rotates fingers 0 and 2; each finger has two further axes (sdh2()).
bool movesWith(const Preshape& preshape, const MatrixDescription& matrix) {
  const auto first = static_cast<std::size_t>(1 + 2 * std::max(matrix.finger, 0));
  if (first + 1 >= preshape.joints.size()) return true;  // unknown finger: it may move
  return preshape.joints[first].slopeDeg != 0.0 || preshape.joints[first + 1].slopeDeg != 0.0;
}

}  // namespace palpate
