// Model of the tactile sensor, from pressure to counts of the tactile controller: spreading, lag,
// creep and release of the rubber; gain as a function of sensitivity and temperature; noise;
// threshold; saturation; 12-bit quantisation; masks. PhysicalHand uses it.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/sensor_characteristics.h>
#include <palpate/model/touch.h>

namespace palpate {

class SensorModel {
 public:
  // Starts with the settings at power-up. Throws std::invalid_argument when `hand` and
  // `characteristics` don't describe the same matrices.
  SensorModel(const HandDescription& hand,
              const SensorCharacteristics& characteristics,
              std::uint64_t seed = 1);

  SensorModel(const SensorModel&) = delete;
  SensorModel& operator=(const SensorModel&) = delete;

  std::vector<MatrixSetting>& settings() noexcept { return settings_; }
  const std::vector<MatrixSetting>& settings() const noexcept { return settings_; }
  // Applies the pressure [kPa] on each place for a time. The response of a loaded place to a
  // constant pressure follows the closed form, independent of the time steps; a relieved place
  // follows within releaseS, including its creep.
  void advance(std::span<const double> pressureKpa, double dtS);
  // Pressure that the rubber passes on at one place now, lag and creep included [kPa].
  double responseKpa(std::size_t place) const { return lagged_[place] + creep_[place]; }
  // Makes one scan. degC: temperature of the motor at each matrix, for the noise; handDegC:
  // temperature of the whole hand, for the gain. Throws std::invalid_argument (sizes, also that of
  // a mask in the settings).
  void scan(std::span<const double> degC, double handDegC, std::span<std::uint16_t> counts);
  // Makes one scan for a stream: values in the hand's unit, 0..full scale, in steps of one count,
  // or of 1/4096 of the full scale in another unit. Where a matrix has no threshold, the largest
  // value of the unloaded matrix (noise line plus three times its RMSE) is subtracted, as a sender
  // of a stream does. Throws as scan().
  //
  // A matrix that decides touch (TouchRule::decides) sends its readings instead, with nothing
  // subtracted: baseline() and noise, and the pressure on z. x and y of a taxel with three
  // components are `shear` of its matrix times its z. Readings with a sign go down to minus full
  // scale. Size of `values`: numReadings().
  // shear: per matrix, the tangential force along columns and rows as parts of the normal force;
  // empty: none.
  void measure(std::span<const double> degC,
               double handDegC,
               std::span<float> values,
               std::span<const std::array<double, 2>> shear = {});
  // The readings at rest of matrices that decide touch, without noise, and its standard deviation;
  // 0 of others. Each reading has an offset of its own, by the seed: up to 2 % of full scale in
  // either direction, or 0 to 4 % without a sign, above the rest line of the characteristics.
  Baseline baseline(std::span<const double> degC) const;

 private:
  // Calls `store` with each place and its value above the threshold, before it is rounded; 0 where
  // nothing is above it.
  template <typename Threshold, typename Store>
  void scanPlaces(std::span<const double> degC,
                  double handDegC,
                  std::size_t numPlaces,
                  const Threshold& thresholdOf,
                  const Store& store);

  void measureReadings(std::size_t m,
                       const Baseline& rest,
                       double handDegC,
                       std::span<float> values,
                       std::span<const std::array<double, 2>> shear);

  const SensorLayout layout_;
  const SensorCharacteristics characteristics_;
  std::vector<double> fullScales_;  // per matrix [unit of the hand]
  const double resolution_;         // of measure() [unit of the hand]
  std::vector<MatrixSetting> settings_;
  std::vector<double> first_, lagged_, creep_;  // per place [kPa]
  bool atRest_ = true;
  std::vector<double> offsets_;  // per reading, at rest
  // Per place, a pointer into characteristics_; nullptr for an ordinary taxel.
  std::vector<const OffsetTaxel*> raised_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

// Spreads pressure over neighbours: each taxel passes the fraction `share` of its pressure on to
// each of its four neighbours that exist. The sum over a matrix is unchanged. Size: numCells().
void spreadPressure(const SensorLayout& layout, double share, std::span<double> pressureKpa);

// Limits a reading to the saturation: linear up to 85 % of it, then approaching it exponentially.
double saturated(double counts, double saturationCounts);

}  // namespace palpate
