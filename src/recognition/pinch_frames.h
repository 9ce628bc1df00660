// Reads and checks the frames of one grasp for the computation of features (plateau_features.cpp,
// study_features.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "palpate/model/profile.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/recognition/pinch_hand.h"

namespace palpate {

// Load of one matrix, from its values > 0.
struct PadLoad {
  double sum = 0.0;      // [counts]
  double largest = 0.0;  // [counts]
  // Centroid on the unrolled surface, measured from the centre of taxel (0, 0) [mm].
  double xMm = 0.0, yMm = 0.0;
};

// Frames of a grasp. `problem` is the reason why no features can be computed (too short, values
// that are not finite, no joint angles, pads that do not touch, another hand); otherwise it is
// empty.
struct PinchFrames {
  std::string problem;
  std::size_t begin = 0;
  std::vector<std::vector<double>> anglesDeg;  // per frame
  std::vector<std::vector<PadLoad>> loads;     // per frame, per matrix
};

// Reads frames grasp.begin..grasp.end. If `allMatrices` is set, the loads of all matrices are
// computed, otherwise those of the two pads. Throws std::out_of_range.
PinchFrames readPinch(const Profile& profile,
                      const GraspSegment& grasp,
                      const PinchHand& hand,
                      bool allMatrices);

// Returns the longest run of frames within a grasp in which both pads touch; nothing when it is
// shorter than kMinPinchFrames.
std::optional<GraspSegment> longestTouch(const Profile& profile,
                                         const GraspSegment& grasp,
                                         const std::array<std::size_t, 2>& pads);

// Load of one matrix of a frame.
PadLoad padLoad(const ConstMatrixMap& values, const TaxelPitch& pitchMm);

constexpr std::size_t kMinPinchFrames = 21;

}  // namespace palpate
