// Monitors whether a held object slips: compares every frame of all loaded matrices with reference
// frames that are taken when the grasp is at rest.
//
// A matrix is evaluated if it has at least three active taxels, 400 counts in sum, and a confidence
// of at least 0.3. It slips if the contact moves by more than 0.20 taxel per frame in two
// consecutive frames, or by more than 0.3 taxel or 5 deg from the reference. These limits are lower
// than the 1.0 taxel of an alarm, because the imprint of an object that is pulled out moves only
// about a quarter as far as the object (docs/notes/slip.md), and because a false detection only
// increases the force.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/slip/slip_tracker.h>

namespace palpate {

struct GripMonitorOptions {
  SlipMethod method = SlipMethod::kRegister;
  double stepTaxels = 0.20;      // per frame, > 0
  double referenceTaxels = 0.3;  // since the reference, > 0
  double turnDeg = 5.0;          // since the reference [deg], > 0
  // A matrix with fewer active taxels is not evaluated, 2.. .
  int minTaxels = 3;
  // A matrix with a smaller sum is not evaluated, >= 0.
  double minCounts = 400.0;
  // A motion with a lower confidence is not evaluated, 0..1.
  double minConfidence = 0.3;

  void validate() const;  // throws std::invalid_argument naming the field
};

struct GripSlip {
  // Matrix with the largest slip relative to its limits.
  std::size_t matrix = 0;
  SlipMotion motion;
  std::string why;  // "finger 0 distal: 1.12 taxels since the reference"
};

class GripMonitor {
 public:
  // Throws std::invalid_argument.
  explicit GripMonitor(const HandDescription& hand, const GripMonitorOptions& options = {});

  void onFrame(const TactileFrame& frame);
  // Makes the newest frame the reference.
  void setReference();
  void reset();

  // Result for the newest frame compared with the reference; empty when there is no reference or no
  // slip.
  std::optional<GripSlip> slip() const;
  double sumCounts() const noexcept { return sum_; }  // of all taxels in the newest frame
  bool touches() const noexcept { return sum_ > 0.0; }

 private:
  HandDescription hand_;
  GripMonitorOptions options_;
  SensorSlipTracker tracker_;
  // Per matrix: number of consecutive frames with too large a step.
  std::vector<int> fast_;
  bool referenced_ = false;
  double sum_ = 0.0;
};

}  // namespace palpate
