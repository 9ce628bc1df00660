// Whether the matrices of a hand can tell that a limit is exceeded, as they are set: a grasp under tactile control
// stands on that.
//
// What a matrix reads at most: its saturation; what its threshold leaves of the converter's range (readings are sent
// less the threshold, so that a threshold above the limit hides light touches, but not the limit itself); what its
// sensitivity makes of the firmest grasp; nothing, where no taxel of it is scanned.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/preshape.h>

namespace palpate {

// A limit ends so far below what a matrix reads at most: it must be able to say that it is over it [counts].
constexpr int kFeltMarginCounts = 200;

struct UnfeltLimit {
  std::size_t matrix = 0;
  std::string
      why;  // "finger 0 distal can't tell: its threshold of 4095 leaves no more than 0 counts"
};

// Those that can't tell; in the order of the matrices. `settings`: as the controller told them, one per matrix; of
// another number: not known, then only saturation and masks count.
std::vector<UnfeltLimit> unfeltLimits(const HandDescription& hand,
                                      const std::vector<MatrixSettings>& settings,
                                      int limitCounts);

// Whether a matrix sits on a finger that this preshape moves when it closes.
bool movesIn(const Preshape& preshape, const MatrixDescription& matrix);

}  // namespace palpate
