#include "palpate/emulator/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate {
namespace {

constexpr double kLargestWireCounts = 65'535.0;  // of 16 bits
constexpr double kStreamSteps = 4096.0;          // of a converter of 12 bits
// Multiple of the RMSE above the noise line that an unloaded matrix does not reach.
constexpr double kNoiseMultiple = 3.0;
constexpr double kRestKpa = 1e-6;       // below this pressure the rubber is at rest
constexpr double kNoiseReach = 8.0;     // larger noise is not generated [standard deviations]
constexpr double kHeavyReach = 45.0;    // heavyTailed(kNoiseReach)
constexpr double kMaxRestShare = 0.02;  // offsets of readings at rest, of full scale
constexpr std::uint64_t kRestSeed = 0x7265737473;  // so that the noise is independent of them

// A random value of unit variance with the heavy tails of the noise of ordinary taxels: of their
// readings (sd 0.9) 1.8 % are 3 counts or more from the mean, 0.5 % 4 or more; for a normal
// distribution it would be 0.7 and 0.01 %.
double heavyTailed(double z) { return z * (0.756 + 0.0756 * z * z); }

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
      resolution_(hand.unit == "counts" ? 1.0
                                        : static_cast<double>(hand.maximumCounts) / kStreamSteps),
      first_(layout_.numCells()),
      lagged_(layout_.numCells()),
      creep_(layout_.numCells()),
      raised_(layout_.numCells()),
      random_(seed) {
  if (characteristics_.matrices.size() != layout_.numMatrices())
    throw std::invalid_argument("SensorModel: characteristics of " +
                                std::to_string(characteristics_.matrices.size()) +
                                " matrices for " + std::to_string(layout_.numMatrices()));
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
    fullScales_.push_back(static_cast<double>(hand.maximumOf(m)));
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    MatrixSetting setting;
    setting.sensitivity = setting.factorySensitivity = matrix.sensitivity;
    setting.thresholdCounts = setting.factoryThresholdCounts = matrix.thresholdCounts;
    setting.dynamicMask.assign(layout_.matrix(m).numCells(), 1);
    settings_.push_back(std::move(setting));
    for (const OffsetTaxel& taxel : matrix.raised) {
      if (taxel.place >= layout_.matrix(m).numCells())
        throw std::invalid_argument("SensorModel: matrix " + std::to_string(m) + " has no place " +
                                    std::to_string(taxel.place));
      raised_[layout_.offset(m) + taxel.place] = &taxel;
    }
  }
  std::mt19937_64 random(seed ^ kRestSeed);
  std::uniform_real_distribution<double> share(-kMaxRestShare, kMaxRestShare);
  for (std::size_t m = 0; m < layout_.numMatrices() && layout_.decidesTouch(); ++m) {
    const TouchRule& rule = layout_.matrix(m).touch;
    for (std::size_t i = 0; i < layout_.matrix(m).numReadings(); ++i)
      offsets_.push_back(fullScales_[m] * (share(random) + (rule.isSigned ? 0.0 : kMaxRestShare)));
  }
}

void SensorModel::advance(std::span<const double> pressureKpa, double dtS) {
  if (!(dtS > 0.0)) return;
  const bool loaded = std::any_of(
      pressureKpa.begin(), pressureKpa.end(), [](double kpa) { return kpa > kRestKpa; });
  if (!loaded && atRest_) return;
  // Exact solution of two lags in series for a constant input u: with a = e^(-t/T1), b = e^(-t/T2),
  //   x1 = u + (x1 - u) a
  //   x2 = u + (x2 - u) b + (x1 - u) T1 (a - b) / (T1 - T2)
  const double t1 = characteristics_.lag1S, t2 = characteristics_.lag2S;
  const double a = std::exp(-dtS / t1), b = std::exp(-dtS / t2);
  double mixed = 0.0;
  if (t1 != t2)
    mixed = t1 * (a - b) / (t1 - t2);
  else if (t1 > 0.0)
    mixed = dtS / t1 * a;  // the limit of equal time constants
  const double c = std::exp(-dtS / characteristics_.creepS);
  const double letsGo = std::exp(-dtS / characteristics_.releaseS);
  double most = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double u = pressureKpa[i];
    if (u <= kRestKpa && first_[i] == 0.0 && lagged_[i] == 0.0 && creep_[i] == 0.0) continue;
    const double gap1 = first_[i] - u, gap2 = lagged_[i] - u;
    if (gap2 > 0.0) {
      lagged_[i] = u + gap2 * letsGo;
      first_[i] = u + gap1 * letsGo;
    } else {
      lagged_[i] = u + gap2 * b + gap1 * mixed;
      first_[i] = u + gap1 * a;
    }
    const double share = characteristics_.creepFraction * lagged_[i];
    creep_[i] = std::min(share + (creep_[i] - share) * c, share);
    most = std::max({most, first_[i], lagged_[i], creep_[i]});
  }
  atRest_ = !loaded && most < kRestKpa;
  if (!atRest_) return;
  std::fill(first_.begin(), first_.end(), 0.0);
  std::fill(lagged_.begin(), lagged_.end(), 0.0);
  std::fill(creep_.begin(), creep_.end(), 0.0);
}

template <typename Threshold, typename Store>
void SensorModel::scanPlaces(std::span<const double> degC,
                             double handDegC,
                             std::size_t numPlaces,
                             const Threshold& thresholdOf,
                             const Store& store) {
  if (numPlaces != layout_.numCells() || degC.size() != layout_.numMatrices())
    throw std::invalid_argument("SensorModel: wrong number of places or temperatures");
  std::size_t place = 0;
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
    const MatrixLayout& layout = layout_.matrix(m);
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    const MatrixSetting& setting = settings_[m];
    if (setting.dynamicMask.size() != layout.numCells())
      throw std::invalid_argument("SensorModel: mask of matrix " + std::to_string(m));
    const double shared = matrix.sharedSd * normal_(random_);
    const double rest = matrix.restCounts(degC[m]);
    const double threshold = thresholdOf(m);
    const double largest = std::min(characteristics_.largestCounts, fullScales_[m]);
    for (std::size_t i = 0; i < layout.numCells(); ++i, ++place) {
      store(m, place, 0.0);
      if (layout.staticMask[i] == 0 || setting.dynamicMask[i] == 0) continue;
      const OffsetTaxel* const raised = raised_[place];
      const double sd = raised ? raised->sd : matrix.taxelSd;
      double raw = raised ? raised->intercept + raised->slope * degC[m] : rest;
      const double kpa = responseKpa(place);
      if (kpa > 0.0) raw += setting.sensitivity * characteristics_.countsAbove(kpa, handDegC);
      if (raw + (raised ? kNoiseReach : kHeavyReach) * sd < threshold)
        continue;  // noise can't raise it above the threshold
      const double drawn = normal_(random_);
      raw += shared + sd * (raised ? drawn : heavyTailed(drawn));
      store(m, place, saturated(raw - threshold, largest));
    }
  }
}

void SensorModel::scan(std::span<const double> degC,
                       double handDegC,
                       std::span<std::uint16_t> counts) {
  scanPlaces(
      degC,
      handDegC,
      counts.size(),
      [this](std::size_t m) { return static_cast<double>(settings_[m].thresholdCounts); },
      [&](std::size_t m, std::size_t place, double above) {
        const double most = std::min(std::floor(fullScales_[m]), kLargestWireCounts);
        counts[place] = static_cast<std::uint16_t>(std::clamp(std::round(above), 0.0, most));
      });
}

Baseline SensorModel::baseline(std::span<const double> degC) const {
  if (degC.size() != layout_.numMatrices())
    throw std::invalid_argument("SensorModel: wrong number of temperatures");
  Baseline rest{std::vector<float>(layout_.numReadings()),
                std::vector<float>(layout_.numReadings())};
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
    const MatrixLayout& layout = layout_.matrix(m);
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    for (std::size_t i = 0; i < layout.numReadings() && layout.touch.decides(); ++i) {
      const auto cell = i / static_cast<std::size_t>(layout.touch.components);
      if (layout.staticMask[cell] == 0) continue;
      const std::size_t at = layout_.readingOffset(m) + i;
      rest.rest[at] = static_cast<float>(offsets_[at] + matrix.restCounts(degC[m]));
      rest.noise[at] = static_cast<float>(matrix.taxelSd);
    }
  }
  return rest;
}

// A scan of a matrix that decides touch.
void SensorModel::measureReadings(std::size_t m,
                                  const Baseline& rest,
                                  double handDegC,
                                  std::span<float> values,
                                  std::span<const std::array<double, 2>> shear) {
  const MatrixLayout& layout = layout_.matrix(m);
  const auto components = static_cast<std::size_t>(layout.touch.components);
  const double mostSteps = std::floor(fullScales_[m] / resolution_);
  const double largest = std::min(characteristics_.largestCounts, fullScales_[m]);
  std::size_t at = layout_.readingOffset(m);
  for (std::size_t i = 0; i < layout.numCells(); ++i) {
    const double kpa = responseKpa(layout_.offset(m) + i);
    const double pressed =
        kpa > 0.0 ? settings_[m].sensitivity * characteristics_.countsAbove(kpa, handDegC) : 0.0;
    for (std::size_t k = 0; k < components; ++k, ++at) {
      values[at] = 0.0F;
      if (layout.staticMask[i] == 0 || settings_[m].dynamicMask[i] == 0) continue;
      const bool isNormal = k + 1 == components;
      const double share = isNormal ? 1.0 : shear.empty() ? 0.0 : shear[m][k];
      const double raw = static_cast<double>(rest.rest[at]) + pressed * share +
                         static_cast<double>(rest.noise[at]) * heavyTailed(normal_(random_));
      const double limited = std::copysign(saturated(std::abs(raw), largest), raw);
      const double steps = std::clamp(
          std::round(limited / resolution_), layout.touch.isSigned ? -mostSteps : 0.0, mostSteps);
      values[at] = static_cast<float>(steps * resolution_);
    }
  }
}

void SensorModel::measure(std::span<const double> degC,
                          double handDegC,
                          std::span<float> values,
                          std::span<const std::array<double, 2>> shear) {
  if (values.size() != layout_.numReadings() ||
      (!shear.empty() && shear.size() != layout_.numMatrices()))
    throw std::invalid_argument("SensorModel: wrong number of readings or shears");
  const auto thresholdOf = [&](std::size_t m) {
    if (settings_[m].thresholdCounts > 0) return static_cast<double>(settings_[m].thresholdCounts);
    const MatrixCharacteristics& matrix = characteristics_.matrices[m];
    return matrix.noiseIntercept + matrix.noiseSlope * degC[m] + kNoiseMultiple * matrix.noiseRmse;
  };
  scanPlaces(degC,
             handDegC,
             layout_.numCells(),
             thresholdOf,
             [&](std::size_t m, std::size_t place, double above) {
               if (layout_.matrix(m).touch.decides()) return;
               const double mostSteps = std::floor(fullScales_[m] / resolution_);
               const double steps = std::clamp(std::round(above / resolution_), 0.0, mostSteps);
               values[layout_.readingOffset(m) + place - layout_.offset(m)] =
                   static_cast<float>(steps * resolution_);
             });
  if (!layout_.decidesTouch()) return;
  const Baseline rest = baseline(degC);
  for (std::size_t m = 0; m < layout_.numMatrices(); ++m)
    if (layout_.matrix(m).touch.decides()) measureReadings(m, rest, handDegC, values, shear);
}

void spreadPressure(const SensorLayout& layout, double share, std::span<double> pressureKpa) {
  if (pressureKpa.size() != layout.numCells())
    throw std::invalid_argument("spreadPressure: wrong number of places");
  std::vector<double> spread;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    double* const of = &pressureKpa[layout.offset(m)];
    if (std::all_of(of, of + matrix.numCells(), [](double kpa) { return kpa == 0.0; })) continue;
    spread.assign(of, of + matrix.numCells());
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x) {
        const auto place = static_cast<std::size_t>(y * matrix.columns + x);
        if (of[place] == 0.0) continue;
        for (const auto& [dy, dx] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          if (!matrix.exists(y + dy, x + dx)) continue;
          const double given = of[place] * share;
          spread[place] -= given;
          spread[static_cast<std::size_t>((y + dy) * matrix.columns + x + dx)] += given;
        }
      }
    std::copy(spread.begin(), spread.end(), of);
  }
}

}  // namespace palpate
