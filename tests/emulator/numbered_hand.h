// Fake hand whose frames encode their number, in counts that a damaged frame can't have by chance.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/hand_model.h"

namespace palpate::testing {

class NumberedHand : public HandModel {
 public:
  // loaded: number of taxels (0..300) with values besides the number, which make frames longer.
  explicit NumberedHand(std::size_t loaded = 20)
      : loaded_(loaded), joints_(sdh2(), std::vector<double>(7, 0.0)) {
    for (const MatrixLayout& matrix : sdh2().layout->matrices()) {
      MatrixSetting setting;
      setting.dynamicMask = matrix.dynamicMask;
      settings_.push_back(setting);
    }
  }

  const HandDescription& hand() const override { return sdh2(); }
  void advanceTo(double timeS) override {
    if (timeS <= timeS_) return;
    joints_.advance(timeS - timeS_);
    timeS_ = timeS;
  }
  double timeS() const override { return timeS_; }
  JointMotion& joints() override { return joints_; }
  std::vector<MatrixSetting>& settings() override { return settings_; }
  void scan(std::span<std::uint16_t> counts) override {
    const std::uint64_t number = next_++;
    std::fill(counts.begin(), counts.end(), std::uint16_t{0});
    for (std::size_t digit = 0; digit < 4; ++digit)
      counts[digit] = static_cast<std::uint16_t>(number >> 12 * digit & 0xFFFu);
    for (std::size_t i = 0; i < loaded_; ++i) counts[placeOf(i)] = valueOf(number, i);
  }
  std::vector<double> temperatures() override { return std::vector<double>(9, 37.25); }
  std::vector<MatrixTruth> truth() const override { return {}; }

  // The number of the frame with these values; nothing for values that were never sent.
  static std::optional<std::uint64_t> numberOf(std::span<const float> values,
                                               std::size_t loaded = 20) {
    std::uint64_t number = 0;
    for (std::size_t digit = 4; digit > 0; --digit)
      number = number << 12 | static_cast<std::uint64_t>(values[digit - 1]);
    std::vector<float> expected(values.size(), 0.0F);
    for (std::size_t digit = 0; digit < 4; ++digit)
      expected[digit] = static_cast<float>(number >> 12 * digit & 0xFFFu);
    for (std::size_t i = 0; i < loaded; ++i)
      expected[placeOf(i)] = static_cast<float>(valueOf(number, i));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] != expected[i]) return std::nullopt;
    return number;
  }

 private:
  // Place of the i-th loaded taxel, after the number; in matrices 0 and 2, which have no masked
  // corners.
  static std::size_t placeOf(std::size_t i) { return i < 76 ? 6 + i : 162 + (i - 76) % 84; }
  static std::uint16_t valueOf(std::uint64_t number, std::size_t i) {
    const std::uint64_t mixed = (number * 2654435761ull + i * 40503ull) * 11400714819323198485ull;
    return static_cast<std::uint16_t>(1 + (mixed >> 40) % 4000);
  }

  std::size_t loaded_;
  JointMotion joints_;
  std::vector<MatrixSetting> settings_;
  std::uint64_t next_ = 0;
  double timeS_ = 0.0;
};

}  // namespace palpate::testing
