// Monitors whether a held object slips: compares every frame of all loaded matrices with reference
// frames that are taken when the grasp is at rest.
//
// A matrix is evaluated if it has at least three active taxels, 400 counts in sum, and a confidence
// of at least 0.3. It slips if the contact moves by more than 0.20 taxel per frame in two
// consecutive frames, or by more than 0.3 taxel or 5 deg from the reference. These limits are lower
// than the 1.0 taxel of an alarm, because the imprint of an object that is pulled out moves only
// about a quarter as far as the object (docs/slip.md), and because a false detection only increases
// the force.
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
  int minTaxels = 3;             // a matrix with fewer says nothing, 2..
  double minCounts = 400.0;      // nor one with less in sum, >= 0
  double minConfidence = 0.3;    // nor a reading below, 0..1

  void validate() const;  // throws std::invalid_argument naming the field
};

struct GripSlip {
  std::size_t matrix = 0;  // that slips most, by its thresholds
  SlipMotion motion;
  std::string why;  // "finger 0 distal: 1.12 taxels since the reference"
};

class GripMonitor {
 public:
  // Throws std::invalid_argument.
  explicit GripMonitor(const HandDescription& hand, const GripMonitorOptions& options = {});

  void onFrame(const TactileFrame& frame);
  // The newest frame is how things should stay.
  void setReference();
  void reset();

  // By the newest frame, against the reference; nothing: no reference, or nothing slips.
  std::optional<GripSlip> slip() const;
  double sumCounts() const noexcept { return sum_; }  // of all taxels of the newest frame
  bool touches() const noexcept { return sum_ > 0.0; }

 private:
  HandDescription hand_;
  GripMonitorOptions options_;
  SensorSlipTracker tracker_;
  std::vector<int> fast_;  // frames in a row with too large a step, per matrix
  bool referenced_ = false;
  double sum_ = 0.0;
};

}  // namespace palpate
