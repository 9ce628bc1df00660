// Makes a recording of the emulated hand without ports and without waiting: scene in, profile out,
// the same for the same seed. Used as training data and in tests.
#pragma once

#include <cstdint>

#include <palpate/core/progress.h>
#include <palpate/emulator/physical_hand.h>
#include <palpate/emulator/scene.h>
#include <palpate/model/profile.h>

namespace palpate {

struct SimulatedRecordingOptions {
  double durationS = 12.0;  // > 0
  // Interval of frames, as of a whole scan on a real line, > 0.
  double frameIntervalS = 0.0315;
  double angleIntervalS = 0.0063;  // > 0
  // Host time of the first frame [us since 1970].
  std::int64_t startUs = 1'400'000'000'000'000;
  PhysicalHandOptions hand = {};

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Throws std::invalid_argument (options, scene), Cancelled.
Profile simulateRecording(const Scene& scene,
                          const SimulatedRecordingOptions& options = {},
                          const Progress& progress = {});

// Variation between repeated grasps of the same object: standard deviations, all >= 0.
struct GraspVariation {
  double positionMm = 2.0;           // of each object, along each axis of the base frame
  double turnDeg = 3.0;              // of each object, about each axis
  double velocitySdFraction = 0.1;   // of the fingers' velocity
  double stiffnessSdFraction = 0.1;  // of the objects' surfaces

  void validate() const;
};
// Returns a randomly varied copy of the scene; the same for the same seed.
Scene variedScene(const Scene& scene, const GraspVariation& variation, std::uint64_t seed);

// Makes a recording of `count` consecutive runs of a scene, each varied anew. Every run lasts
// options.durationS.
Profile simulateGrasps(const Scene& scene,
                       int count,
                       const GraspVariation& variation = {},
                       const SimulatedRecordingOptions& options = {},
                       const Progress& progress = {});

}  // namespace palpate
