// What the emulator knows of the pen that `palpate demo` lets slip, beside what the slip detector
// says of the recording: when it began to move, how far it went, and whether and when that was
// seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/json.h"
#include "palpate/emulator/hand_model.h"
#include "palpate/slip/slip_series.h"

namespace palpate::commands {

// The truth of one scan.
struct DemoTruthFrame {
  std::int64_t hostUs = 0;  // [us since 1970]
  double handS = 0.0;       // since the hand was switched on [s]
  std::vector<MatrixTruth> matrices;
};

// The way of an object over the matrix on which it moved furthest, by the emulator's own mechanics.
struct DemoMotion {
  std::size_t matrix = 0;
  // Host times [us since 1970] of the first scan in which it had moved by kDemoMovedTaxels, and of
  // the first one in which it had made all of its way but so much.
  std::int64_t beganUs = 0;
  std::int64_t endedUs = 0;
  double movedTaxels = 0.0;  // at the end
};
inline constexpr double kDemoMovedTaxels = 0.1;

// Between two times of the hand [s]. Nothing: it moved by less than a taxel, or was not held by two
// matrices at `fromS`.
std::optional<DemoMotion> demoMotion(const std::vector<DemoTruthFrame>& truth,
                                     double fromS,
                                     double untilS);

// The alarm that belongs to the motion.
struct DemoAlarm {
  std::size_t matrix = 0;
  std::size_t frame = 0;       // in which it was raised
  std::size_t lastFrame = 0;   // in which it stood
  double atS = 0.0;            // since the first frame of the recording [s]
  double afterS = 0.0;         // behind the begin of the motion [s]; below 0: ahead of it
  double movedTaxels = 0.0;    // so far the object had gone then, by the emulator's mechanics
  double imprintTaxels = 0.0;  // how far the imprint was from its reference while it stood, at most
  std::size_t furthestFrame = 0;             // in which that was
  SlipIndicator lamp = SlipIndicator::kOff;  // in `frame`
  SlipState state = SlipState::kInvalid;
};

struct DemoSlip {
  DemoMotion motion;
  std::optional<DemoAlarm> alarm;     // the first one; nothing: it was not seen
  std::vector<std::size_t> matrices;  // that raised one while it moved, ascending
  // Alarms while it was held and did not move yet: false ones.
  std::size_t early = 0;
};

// `truth` and `fromS` as the motion is of: from then on it was held and at rest. An alarm belongs
// to the motion when it stands between its begin and its end.
DemoSlip demoSlip(const SlipSeries& series,
                  const std::vector<DemoTruthFrame>& truth,
                  double fromS,
                  const DemoMotion& motion);

// One line for a person. `pitchMm` of a taxel.
std::string demoSlipText(const DemoSlip& slip, double pitchMm);
Json demoSlipJson(const DemoSlip& slip, double pitchMm);

}  // namespace palpate::commands
