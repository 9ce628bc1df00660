#include "palpate/emulator/simulated_recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/model/profile_builder.h"

namespace palpate {
namespace {

constexpr double kTemperatureIntervalS = 1.0;
constexpr std::int64_t kStepsPerReport = 256;

// Appends a run that begins at `startUs`. Returns the time of its end [us].
std::int64_t append(ProfileBuilder& builder,
                    const Scene& scene,
                    const SimulatedRecordingOptions& options,
                    std::int64_t startUs,
                    Baselines& baselines,
                    const Progress& progress) {
  PhysicalHand hand(scene, options.hand);
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  std::vector<float> values(hand.hand().layout->numReadings());
  const bool givesReadings = hand.hand().layout->decidesTouch();
  if (givesReadings)
    baselines.emplace_back(startUs, std::make_shared<const Baseline>(hand.baseline()));
  // A hand without a tactile controller sends a stream.
  const bool isStreamed = !hand.hand().file || hand.hand().file->controller.empty();
  double nextFrameS = 0.0, nextAngleS = 0.0, nextTemperatureS = 0.0;
  for (std::int64_t step = 0;; ++step) {
    const double nowS = std::min({nextFrameS, nextAngleS, nextTemperatureS});
    if (nowS > options.durationS) break;
    if (progress && step % kStepsPerReport == 0 && !progress(nowS / options.durationS))
      throw Cancelled();
    hand.advanceTo(nowS);
    const std::int64_t nowUs = startUs + std::llround(nowS * kUsPerS);
    if (nextAngleS <= nowS) {
      if (!hand.hand().axes.empty()) builder.addAngles(nowUs, hand.joints().angles());
      nextAngleS += options.angleIntervalS;
    }
    if (nextTemperatureS <= nowS) {
      if (!hand.hand().temperatureSensors.empty())
        builder.addTemperatures(nowUs, hand.temperatures());
      nextTemperatureS += kTemperatureIntervalS;
    }
    if (nextFrameS <= nowS) {
      if (isStreamed || givesReadings) {
        hand.measure(values);
      } else {
        hand.scan(counts);
        std::copy(counts.begin(), counts.end(), values.begin());
      }
      if (givesReadings)
        builder.addReadings(nowUs, values);
      else
        builder.addFrame(nowUs, values);
      nextFrameS += options.frameIntervalS;
    }
  }
  return startUs + std::llround((options.durationS + options.frameIntervalS) * kUsPerS);
}

Profile finished(ProfileBuilder& builder, Baselines baselines) {
  builder.setBaselines(std::move(baselines));
  ProfileInfo info;
  info.format = "synthetic";
  return builder.finish(info);
}

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
  ProfileBuilder builder(options.hand.hand);
  Baselines baselines;
  append(builder, scene, options, options.startUs, baselines, progress);
  return finished(builder, std::move(baselines));
}

void GraspVariation::validate() const {
  for (const auto& [value, name] : {std::pair{positionMm, "positionMm"},
                                    std::pair{turnDeg, "turnDeg"},
                                    std::pair{velocitySdFraction, "velocitySdFraction"},
                                    std::pair{stiffnessSdFraction, "stiffnessSdFraction"}})
    if (!(value >= 0.0 && std::isfinite(value)))
      throw std::invalid_argument(std::string("GraspVariation: ") + name + " must be >= 0");
}

Scene variedScene(const Scene& scene, const GraspVariation& variation, std::uint64_t seed) {
  variation.validate();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Scene out = scene;
  for (SceneObject& object : out.objects) {
    for (double& mm : object.positionMm) mm += variation.positionMm * normal(random);
    for (int axis = 0; axis < 3; ++axis)
      object.rotation =
          Eigen::AngleAxisd(variation.turnDeg * normal(random) * std::numbers::pi / 180.0,
                            Eigen::Vector3d::Unit(axis)) *
          object.rotation;
    object.stiffnessNPerMm3 *= std::exp(variation.stiffnessSdFraction * normal(random));
  }
  const double faster = std::exp(variation.velocitySdFraction * normal(random));
  for (ScriptStep& step : out.script)
    if (auto* grasp = std::get_if<GraspAction>(&step.action)) grasp->velocityDegPerS *= faster;
  return out;
}

Profile simulateGrasps(const Scene& scene,
                       int count,
                       const GraspVariation& variation,
                       const SimulatedRecordingOptions& options,
                       const Progress& progress) {
  options.validate();
  if (count < 1) throw std::invalid_argument("simulateGrasps: count must be 1 or more");
  ProfileBuilder builder(options.hand.hand);
  Baselines baselines;
  std::int64_t startUs = options.startUs;
  for (int i = 0; i < count; ++i) {
    SimulatedRecordingOptions run = options;
    run.hand.seed = options.hand.seed + static_cast<std::uint64_t>(i);
    const Progress part = [&](double fraction) {
      return !progress || progress((i + fraction) / count);
    };
    startUs = append(
        builder, variedScene(scene, variation, run.hand.seed), run, startUs, baselines, part);
  }
  return finished(builder, std::move(baselines));
}

}  // namespace palpate
