#include "palpate/emulator/simulated_recording.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"

namespace palpate {
namespace {

constexpr double kUsPerS = 1e6;
constexpr double kTemperatureIntervalS = 1.0;

}  // namespace

void SimulatedRecordingOptions::validate() const {
  for (const auto& [value, name] : {std::pair{durationS, "durationS"},
                                    std::pair{frameIntervalS, "frameIntervalS"},
                                    std::pair{angleIntervalS, "angleIntervalS"}})
    if (!(value > 0.0 && value <= 86'400.0))
      throw std::invalid_argument(std::string("SimulatedRecordingOptions: ") + name +
                                  " must be above 0, up to a day");
}

Profile simulateRecording(const Scene& scene,
                          const SimulatedRecordingOptions& options,
                          const Progress& progress) {
  options.validate();
  PhysicalHand hand(scene, options.hand);
  ProfileBuilder builder(hand.hand().layout);
  std::vector<std::uint16_t> counts(hand.hand().layout->numPlaces());
  std::vector<float> values(counts.size());
  double nextFrameS = 0.0, nextAngleS = 0.0, nextTemperatureS = 0.0;
  for (std::int64_t step = 0;; ++step) {
    const double nowS = std::min({nextFrameS, nextAngleS, nextTemperatureS});
    if (nowS > options.durationS) break;
    if (progress && step % 256 == 0 && !progress(nowS / options.durationS)) throw Cancelled();
    hand.advanceTo(nowS);
    const std::int64_t nowUs = options.startUs + std::llround(nowS * kUsPerS);
    if (nextAngleS <= nowS) {
      builder.addAngles(nowUs, hand.joints().angles());
      nextAngleS += options.angleIntervalS;
    }
    if (nextTemperatureS <= nowS) {
      builder.addTemperatures(nowUs, hand.temperatures());
      nextTemperatureS += kTemperatureIntervalS;
    }
    if (nextFrameS <= nowS) {
      hand.scan(counts);
      std::copy(counts.begin(), counts.end(), values.begin());
      builder.addFrame(nowUs, values);
      nextFrameS += options.frameIntervalS;
    }
  }
  ProfileInfo info;
  info.format = "synthetic";
  return builder.finish(info);
}

}  // namespace palpate
