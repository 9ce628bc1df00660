// Fake hand for tests of the servers: every taxel has the value set by the test, joints move, and
// there is no contact.
#pragma once

#include <algorithm>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/hand_model.h"

namespace palpate::testing {

class StillHand final : public HandModel {
 public:
  explicit StillHand(std::vector<double> startDeg = std::vector<double>(7, 0.0))
      : values(sdh2().layout->numCells()), joints_(sdh2(), std::move(startDeg)) {
    for (std::size_t m = 0; m < sdh2().layout->numMatrices(); ++m) {
      MatrixSetting setting;
      setting.thresholdCounts = setting.factoryThresholdCounts = m % 2 == 0 ? 150 : 300;
      setting.dynamicMask.assign(sdh2().layout->matrix(m).numCells(), 1);
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
    ++scans;
    std::copy(values.begin(), values.end(), counts.begin());
    if (noisy)
      for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = static_cast<std::uint16_t>(40 + (i * 7 + scans) % 11);
  }
  std::vector<double> temperatures() override {
    return {40.5, 45.7, 37.1, 41.75, 34.0, 44.0, 36.75, 48.6, 48.25};
  }
  std::vector<MatrixTruth> truth() const override {
    std::vector<MatrixTruth> all(6);
    all[1] = {.contact = true, .forceN = 2.5, .xMm = 1.0, .yMm = 2.0, .zMm = 3.0};
    return all;
  }

  std::vector<std::uint16_t> values;  // all taxels, in protocol order
  bool noisy = false;                 // neighbours have different values
  std::uint64_t scans = 0;

 private:
  JointMotion joints_;
  std::vector<MatrixSetting> settings_;
  double timeS_ = 0.0;
};

}  // namespace palpate::testing
