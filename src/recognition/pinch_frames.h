// The frames of one grasp as the features need them: read once, checked once.
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

// Of one matrix: of its values > 0.
struct PadLoad {
  double sum = 0.0;             // [counts]
  double largest = 0.0;         // [counts]
  double xMm = 0.0, yMm = 0.0;  // centroid on the unrolled surface, from the centre of taxel (0, 0)
};

// Why a span is no grasp that features can be had of ("" when it is): too short, not finite values,
// no joint angles, pads that don't touch, another hand.
struct PinchFrames {
  std::string problem;
  std::size_t begin = 0;
  std::vector<std::vector<double>> anglesDeg;  // per frame
  std::vector<std::vector<PadLoad>> loads;     // per frame, per matrix
};

// Frames grasp.begin..grasp.end. Throws std::out_of_range. allMatrices: the others' loads, too.
PinchFrames readPinch(const Profile& profile,
                      const GraspSegment& grasp,
                      const PinchHand& hand,
                      bool allMatrices);

// The longest run of frames within a grasp in which both pads touch; nothing when it is shorter
// than kMinPinchFrames.
std::optional<GraspSegment> longestTouch(const Profile& profile,
                                         const GraspSegment& grasp,
                                         const std::array<std::size_t, 2>& pads);

// Of one matrix of a frame.
PadLoad padLoad(const ConstMatrixMap& values, double pitchMm);

constexpr std::size_t kMinPinchFrames = 21;

}  // namespace palpate
