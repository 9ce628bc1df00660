// A recording of the emulated hand without ports and without waiting: scene in, profile out, the
// same for the same seed. For data to learn from, and tests.
#pragma once

#include <cstdint>

#include <palpate/core/progress.h>
#include <palpate/emulator/physical_hand.h>
#include <palpate/emulator/scene.h>
#include <palpate/model/profile.h>

namespace palpate {

struct SimulatedRecordingOptions {
  double durationS = 12.0;                       // > 0
  double frameIntervalS = 0.0315;                // of a whole scan on a real line, > 0
  double angleIntervalS = 0.0063;                // > 0
  std::int64_t startUs = 1'400'000'000'000'000;  // host time of its begin [us since 1970]
  PhysicalHandOptions hand = {};

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Throws std::invalid_argument (options, scene), Cancelled.
Profile simulateRecording(const Scene& scene,
                          const SimulatedRecordingOptions& options = {},
                          const Progress& progress = {});

// How differently the same thing is presented from grasp to grasp: standard deviations, all >= 0.
struct GraspVariation {
  double positionMm = 2.0;           // of each object, along each axis of the base frame
  double turnDeg = 3.0;              // of each object, about each axis
  double velocitySdFraction = 0.1;   // of the fingers' velocity
  double stiffnessSdFraction = 0.1;  // of the objects' surfaces

  void validate() const;
};
// The scene as it might be the next time; the same for the same seed.
Scene variedScene(const Scene& scene, const GraspVariation& variation, std::uint64_t seed);

// A recording of `count` runs of a scene, each varied anew, one after the other. Runs last
// options.durationS.
Profile simulateGrasps(const Scene& scene,
                       int count,
                       const GraspVariation& variation = {},
                       const SimulatedRecordingOptions& options = {},
                       const Progress& progress = {});

}  // namespace palpate
