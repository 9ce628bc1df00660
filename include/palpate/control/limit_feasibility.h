// Checks whether the matrices, with their present settings, can measure that a force limit is
// exceeded. A grasp under tactile control depends on this.
//
// Largest possible reading of a matrix: its saturation; the converter's range minus its threshold
// (the threshold is subtracted before sending, so a threshold above the limit hides light contacts
// but not the limit); the reading of the firmest grasp at its sensitivity; 0 if no taxel of it is
// scanned.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/preshape.h>

namespace palpate {

// Margin between the limit and the largest possible reading [counts].
constexpr int kLimitMarginCounts = 200;

struct UnmeasurableLimit {
  std::size_t matrix = 0;
  // Example: "finger 0 distal can't tell: its threshold of 4095 leaves no more than 0 counts".
  std::string why;
};

// Returns the matrices that can't measure the limit, in order. `settings` has one entry per matrix
// as reported by the controller; with any other size the settings count as unknown, and only
// saturation and masks are checked.
std::vector<UnmeasurableLimit> unmeasurableLimits(const HandDescription& hand,
                                                  const std::vector<MatrixSettings>& settings,
                                                  int limitCounts);

// True if the matrix is on a finger that this preshape moves when it closes.
bool movesWith(const Preshape& preshape, const MatrixDescription& matrix);

}  // namespace palpate
