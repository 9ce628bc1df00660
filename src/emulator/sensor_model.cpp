#include "palpate/emulator/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

constexpr double kMaxCounts = 4095.0;
constexpr double kRestKpa = 1e-6;    // below: the rubber is at rest
constexpr double kNoiseReach = 7.0;  // standard deviations that matter

}  // namespace

double saturated(double counts, double saturationCounts) {
  const double knee = 0.85 * saturationCounts;
  if (counts <= knee) return counts;
  const double room = saturationCounts - knee;
  return knee + room * (1.0 - std::exp(-(counts - knee) / room));
}

SensorModel::SensorModel(const HandDescription& hand,
                         const SensorCharacteristics& characteristics,
                         std::uint64_t seed)
    : layout_(*hand.layout),
      characteristics_(characteristics),
      first_(layout_.numPlaces()),
      lagged_(layout_.numPlaces()),
      creep_(layout_.numPlaces()),
      warm_(layout_.numPlaces()),
      random_(seed) {
  if (characteristics_.matrices.size() != layout_.numMatrices())
    throw std::invalid_argument("SensorModel: characteristics of " +
                                std::to_string(characteristics_.matrices.size()) +
                                " matrices for " + std::to_string(layout_.numMatrices()));
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    MatrixSetting setting;
    setting.sensitivity = setting.factorySensitivity = matrix.sensitivity;
    setting.thresholdCounts = setting.factoryThresholdCounts = matrix.thresholdCounts;
    setting.dynamicMask.assign(layout_.matrix(m).numPlaces(), 1);
    settings_.push_back(std::move(setting));
    for (const std::size_t place : matrix.warmPlaces) warm_.at(layout_.offset(m) + place) = 1.0;
  }
}

void SensorModel::advance(std::span<const double> pressureKpa, double dtS) {
  if (!(dtS > 0.0)) return;
  const bool loaded = std::any_of(
      pressureKpa.begin(), pressureKpa.end(), [](double kpa) { return kpa > kRestKpa; });
  if (!loaded && atRest_) return;
  // Two lags in a row under a constant input u, exactly: with a = e^(-t/T1), b = e^(-t/T2),
  // x1 = u + (x1 - u) a, x2 = u + (x2 - u) b + (x1 - u) T1 (a - b) / (T1 - T2).
  const double t1 = characteristics_.lag1S, t2 = characteristics_.lag2S;
  const double a = std::exp(-dtS / t1), b = std::exp(-dtS / t2);
  const double mixed = t1 * (a - b) / (t1 - t2);
  const double c = std::exp(-dtS / characteristics_.creepS);
  double most = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double u = pressureKpa[i];
    if (u <= kRestKpa && first_[i] == 0.0 && lagged_[i] == 0.0 && creep_[i] == 0.0) continue;
    const double gap1 = first_[i] - u, gap2 = lagged_[i] - u;
    lagged_[i] = u + gap2 * b + gap1 * mixed;
    first_[i] = u + gap1 * a;
    const double share = characteristics_.creepShare * lagged_[i];
    creep_[i] = share + (creep_[i] - share) * c;
    most = std::max({most, first_[i], lagged_[i], creep_[i]});
  }
  atRest_ = !loaded && most < kRestKpa;
  if (!atRest_) return;
  std::fill(first_.begin(), first_.end(), 0.0);
  std::fill(lagged_.begin(), lagged_.end(), 0.0);
  std::fill(creep_.begin(), creep_.end(), 0.0);
}

void SensorModel::scan(std::span<const double> degC, std::span<std::uint16_t> counts) {
  if (counts.size() != layout_.numPlaces() || degC.size() != layout_.numMatrices())
    throw std::invalid_argument("SensorModel: wrong number of places or temperatures");
  std::size_t place = 0;
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
    const MatrixLayout& layout = layout_.matrix(m);
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    const MatrixSetting& setting = settings_[m];
    const double rest = matrix.meanAtRest(degC[m]);
    const double warm = matrix.warmAtRest(degC[m]);
    const double gain = characteristics_.gainCountsPerKpa(degC[m]) * setting.sensitivity;
    const double threshold = setting.thresholdCounts;
    for (std::size_t i = 0; i < layout.numPlaces(); ++i, ++place) {
      counts[place] = 0;
      if (layout.staticMask[i] == 0 || setting.dynamicMask[i] == 0) continue;
      double raw = rest + warm_[place] * warm + gain * responseKpa(place);
      if (raw + kNoiseReach * matrix.taxelSd < threshold) continue;  // noise doesn't lift it
      raw += matrix.taxelSd * normal_(random_);
      const double above =
          std::round(saturated(raw - threshold, characteristics_.saturationCounts));
      counts[place] = static_cast<std::uint16_t>(std::clamp(above, 0.0, kMaxCounts));
    }
  }
}

}  // namespace palpate
