// From pressure to counts, as the tactile controller delivers them: lag and creep of the rubber, gain by
// sensitivity and temperature, noise at rest, threshold subtracted, saturation, 12 bit, masks.
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
  // Settings at power-up. Throws std::invalid_argument when the two don't describe the same matrices.
  SensorModel(const HandDescription& hand,
              const SensorCharacteristics& characteristics,
              std::uint64_t seed = 1);

  std::vector<MatrixSetting>& settings() noexcept { return settings_; }
  const std::vector<MatrixSetting>& settings() const noexcept { return settings_; }
  // Lets the pressure [kPa] on each place act for a time. Exact for a pressure that is constant.
  void advance(std::span<const double> pressureKpa, double dtS);
  // What the rubber passes on now, lag and creep included [kPa], of one place.
  double responseKpa(std::size_t place) const { return lagged_[place] + creep_[place]; }
  // One scan. degC: temperature of each matrix.
  void scan(std::span<const double> degC, std::span<std::uint16_t> counts);

 private:
  const SensorLayout layout_;
  const SensorCharacteristics characteristics_;
  std::vector<MatrixSetting> settings_;
  std::vector<double> first_, lagged_, creep_;  // per place [kPa]
  bool atRest_ = true;
  std::vector<double> warm_;  // per place: 1 where it rests higher
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

// Bends a reading towards the saturation: linear up to 85 % of it, then approaching it exponentially.
double saturated(double counts, double saturationCounts);

}  // namespace palpate
