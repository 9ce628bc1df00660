// Sensor model, from pressure to counts of the tactile controller: spreading, lag, creep and
// release of the rubber; gain as a function of sensitivity and temperature; noise; threshold;
// saturation; 12-bit quantisation; masks.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

class SensorModel {
 public:
  // Settings at power-up. Throws std::invalid_argument when the two don't describe the same
  // matrices.
  SensorModel(const HandDescription& hand,
              const SensorCharacteristics& characteristics,
              std::uint64_t seed = 1);

  SensorModel(const SensorModel&) = delete;
  SensorModel& operator=(const SensorModel&) = delete;

  std::vector<MatrixSetting>& settings() noexcept { return settings_; }
  const std::vector<MatrixSetting>& settings() const noexcept { return settings_; }
  // Lets the pressure [kPa] on each place act for a time. A place that is loaded answers a constant
  // pressure by the closed form, whatever the steps; one that is relieved follows within releaseS,
  // its creep too.
  void advance(std::span<const double> pressureKpa, double dtS);
  // What the rubber passes on now, lag and creep included [kPa], of one place.
  double responseKpa(std::size_t place) const { return lagged_[place] + creep_[place]; }
  // One scan. degC: temperature of the motor at each matrix, for the noise; handDegC: of the whole
  // hand, for the gain. Throws std::invalid_argument (sizes, a setting's mask too).
  void scan(std::span<const double> degC, double handDegC, std::span<std::uint16_t> counts);

 private:
  const SensorLayout layout_;
  const SensorCharacteristics characteristics_;
  std::vector<MatrixSetting> settings_;
  std::vector<double> first_, lagged_, creep_;  // per place [kPa]
  bool atRest_ = true;
  std::vector<const OffsetTaxel*> raised_;  // per place, into characteristics_; nullptr: ordinary
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

// Spreads pressure over neighbours: each taxel passes `share` of its pressure on to each of its
// four neighbours that exist. The sum over a matrix stays. Size: numCells().
void spreadPressure(const SensorLayout& layout, double share, std::span<double> pressureKpa);

// Bends a reading towards the saturation: linear up to 85 % of it, then approaching it
// exponentially.
double saturated(double counts, double saturationCounts);

}  // namespace palpate
