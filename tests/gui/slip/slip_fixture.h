// A recording of slip whose truth is known.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "palpate/device/sdh2.h"
#include <palpate/laboratory/synthetic_slip.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile_builder.h>

namespace palpate::gui {

inline constexpr std::size_t kMoving = 1, kStill = 3;  // matrices
inline constexpr std::size_t kRests = 40;              // frames, before and after it moves
inline constexpr std::size_t kMoves = 16;
inline constexpr double kStepTaxels = 0.25;  // downwards
inline constexpr double kBeginsAt = 4.0;     // row
inline constexpr double kEndsAt = kBeginsAt + kStepTaxels * kMoves;
inline constexpr std::int64_t kSlipIntervalUs = 32'000;

// A bar rests on one matrix, moves down by four taxels in half a second, and rests; another rests
// all the time.
inline Profile movingContact() {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  SyntheticSlip moving({.layout = hand.layout->matrix(kMoving)}, 7);
  SyntheticSlip still({.layout = hand.layout->matrix(kStill)}, 8);
  for (std::size_t i = 0; i < 2 * kRests + kMoves; ++i) {
    TactileFrame frame(hand.layout);
    const std::size_t steps = i < kRests ? 0 : std::min(i - kRests + 1, kMoves);
    moving.read({.shape = SlipShape::kBar,
                 .x = 2.5,
                 .y = kBeginsAt + kStepTaxels * static_cast<double>(steps)},
                frame.matrix(kMoving));
    still.read({.shape = SlipShape::kBar, .x = 2.5, .y = 6.0, .angleDeg = 30.0},
               frame.matrix(kStill));
    builder.addFrame(1'400'000'000'000'000 + static_cast<std::int64_t>(i) * kSlipIntervalUs,
                     frame.values);
  }
  return builder.finish({});
}

}  // namespace palpate::gui
