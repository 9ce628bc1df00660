// Compares, for the pen that slips in `palpate demo`, the emulator's true motion with the result of
// the slip detector: when it began to move, how far it moved, and whether and when that was
// detected.
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

// The true values of one scan.
struct DemoTruthFrame {
  std::int64_t hostUs = 0;  // [us since 1970]
  double handS = 0.0;       // [s] since the hand was switched on
  std::vector<MatrixTruth> matrices;
};

// The motion of an object on the matrix where it moved furthest, as the emulator's mechanics
// computed it.
struct DemoMotion {
  std::size_t matrix = 0;
  // Host times [us since 1970]: the first scan after a motion of kDemoMovedTaxels, and the first
  // scan with less than kDemoMovedTaxels left to move.
  std::int64_t beganUs = 0;
  std::int64_t endedUs = 0;
  // Length of the motion at its end.
  double movedTaxels = 0.0;
};
inline constexpr double kDemoMovedTaxels = 0.1;

// The motion between two times of the hand [s]. Nothing when it was less than a taxel, or when
// fewer than two matrices held the object at `fromS`.
std::optional<DemoMotion> demoMotion(const std::vector<DemoTruthFrame>& truth,
                                     double fromS,
                                     double untilS);

// The alarm that detected the motion.
struct DemoAlarm {
  std::size_t matrix = 0;
  // The frame that raised the alarm.
  std::size_t frame = 0;
  // The last frame of the alarm.
  std::size_t lastFrame = 0;
  double atS = 0.0;     // [s] since the first frame of the recording
  double afterS = 0.0;  // [s] after the begin of the motion; negative: before it
  // True motion of the object up to the alarm.
  double movedTaxels = 0.0;
  // Largest distance of the contact from its reference during the alarm [taxels].
  double imprintTaxels = 0.0;
  // The frame with that distance.
  std::size_t furthestFrame = 0;
  // The status symbol in `frame`.
  SlipIndicator indicator = SlipIndicator::kOff;
  SlipState state = SlipState::kInvalid;
};

// The true motion compared with the alarms of the slip detector.
struct DemoSlip {
  DemoMotion motion;
  // The first alarm; nothing when the motion was not detected.
  std::optional<DemoAlarm> alarm;
  // The matrices that raised an alarm during the motion, ascending.
  std::vector<std::size_t> matrices;
  // Number of false alarms: while the object was held and did not move yet.
  std::size_t early = 0;
};

// Evaluates the alarms from `fromS` on, when the object was held and at rest; `truth` and `fromS`
// are those of demoMotion(). An alarm belongs to the motion when it overlaps the time between its
// begin and its end.
DemoSlip demoSlip(const SlipSeries& series,
                  const std::vector<DemoTruthFrame>& truth,
                  double fromS,
                  const DemoMotion& motion);

// One line of text; `pitchMm` is the pitch of the taxels.
std::string demoSlipText(const DemoSlip& slip, double pitchMm);
Json demoSlipJson(const DemoSlip& slip, double pitchMm);

}  // namespace palpate::commands
