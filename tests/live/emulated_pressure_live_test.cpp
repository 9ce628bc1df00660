// Applies a known pressure to the emulated hand and compares it with the pressure after ports and
// live processing: the result is within the stated uncertainty.
#include <cmath>

#include "palpate/device/sdh2.h"
#include "palpate/live/pressure_stage.h"
#include "palpate/live/processing_chain.h"
#include "palpate/live/signals_stage.h"

#include "calibration/stamped_sensor.h"
#include "control/emulated_bench.h"
#include "testing/testing.h"

namespace palpate::emulated_pressure_live_test {
namespace {
using namespace testing;

// A hand at rest for half a second after a client has changed its settings; then a stamp presses on
// it.
class StampedHand final : public HandModel {
 public:
  explicit StampedHand(double kpa) : loaded_(underTheStamp(kpa)) {}

  const HandDescription& hand() const override { return sdh2(); }
  void advanceTo(double timeS) override {
    if (timeS <= this->timeS()) return;
    const double dtS = timeS - this->timeS();
    still_.advanceTo(timeS);
    const bool set = sensor_.settings()[kMatrix].sensitivity == 1.0;
    restS_ += set ? dtS : 0.0;
    sensor_.advance(restS_ > 0.5 ? loaded_ : none_, dtS);
  }
  double timeS() const override { return still_.timeS(); }
  JointMotion& joints() override { return still_.joints(); }
  std::vector<MatrixSetting>& settings() override { return sensor_.settings(); }
  void scan(std::span<std::uint16_t> counts) override {
    sensor_.scan(std::vector<double>(6, kDegC), kDegC, counts);
  }
  std::vector<double> temperatures() override { return std::vector<double>(9, kDegC); }
  std::vector<MatrixTruth> truth() const override { return still_.truth(); }

  static constexpr double kDegC = 35.0;

 private:
  StillHand still_;
  SensorModel sensor_{sdh2(), sdh2Sensor(), 77};
  const std::vector<double> none_ = std::vector<double>(sdh2().layout->numCells(), 0.0);
  const std::vector<double> loaded_;
  double restS_ = 0.0;
};

TEST(EmulatedPressureLive, AKnownPressureIsShownWithinItsBand) {
  constexpr double kKpa = 48.0;
  EmulatedBench bench(std::make_unique<StampedHand>(kKpa));
  bench.connect();
  auto stage = std::make_unique<PressureStage>(bench.session->device().hand(), [&] {
    std::vector<SensorSettings> settings;
    for (const MatrixSettings& matrix : bench.session->device().info().matrices)
      settings.push_back({matrix.sensitivity, static_cast<double>(matrix.thresholdCounts), false});
    return settings;
  });
  PressureStage& pressure = *stage;
  pressure.setCalibration(calibrated());
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<SignalsStage>());
  stages.push_back(std::move(stage));
  ProcessingChain chain(std::move(stages));
  chain.connect(*bench.session);
  for (const DeviceCommand& command : {DeviceCommand(SetThreshold{std::nullopt, 100}),
                                       DeviceCommand(SetSensitivity{std::nullopt, 1.0})})
    bench.control->change(command).get();
  // When the lag is over, the creep is subtracted.
  std::shared_ptr<const PressureFrame> shown;
  int steady = 0;
  ASSERT_TRUE(eventuallyTrue([&] {
    chain.step();
    if (const auto results = chain.take(); results && results->pressure) {
      shown = results->pressure;
      steady += shown->matrices[kMatrix].compensated ? 1 : 0;
    }
    return steady > 30;
  })) << pressure.problem();
  const MatrixPressure& contact = shown->matrices[kMatrix];
  EXPECT_TRUE(contact.inRange);
  EXPECT_TRUE(contact.temperatureKnown);
  EXPECT_LT(contact.sdKpa, 5.0);
  EXPECT_LE(std::abs(contact.kpa - kKpa), 2.0 * contact.sdKpa) << contact.kpa;
  const double forceN = kKpa * kStampMm2 * 1e-3;
  EXPECT_LE(std::abs(shown->forceN - forceN), 2.0 * shown->sdForceN) << shown->forceN;
}

}  // namespace
}  // namespace palpate::emulated_pressure_live_test
