// Adaptive sensitivity (study, 3.4): finds the highest sensitivity without saturation from the
// largest readings. A reading is sensitivity x gain - threshold, so one unsaturated measurement
// predicts where saturation begins; a saturated one only gives an upper bound, and the interval is
// bisected. This class only proposes settings: the owner of the device applies them (each pauses
// the stream for some hundred ms) and passes the following frames to observe().
#pragma once

#include <cstddef>
#include <optional>

#include <palpate/model/hand_description.h>

namespace palpate {

struct SensitivitySearchOptions {
  double least = 0.1;  // sensitivities tried, 0..1
  double most = 1.0;
  double resolution = 0.03;  // ends where less is to be won; > 0
  // a taxel at or above is saturated [counts]
  double saturationCounts = static_cast<double>(kSdh2SaturationCounts);
  double headroom = 0.1;            // aim so far below saturation; 0..0.9
  std::size_t framesPerTrial = 10;  // with contact, at one sensitivity; >= 1
  // After this time with a low maximum [s], >= 0, the upper bound is dropped and tested again.
  double resetUpperBoundAfterS = 5.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

class SensitivitySearch {
 public:
  // Begins at a sensitivity that is set already, between least and most.
  SensitivitySearch(double sensitivity,
                    double thresholdCounts,
                    const SensitivitySearchOptions& options = {});

  // One frame, taken at the sensitivity that was proposed last: its largest reading (0: no
  // contact). The next sensitivity to set; nothing: stay. Frames that aren't numbers are ignored.
  std::optional<double> observe(double timeS, double maximumCounts);

  double sensitivity() const noexcept { return sensitivity_; }  // present
  bool settled() const noexcept { return settled_; }            // nothing higher is left to try
  bool saturated() const noexcept { return saturated_; }        // also at `least`: nothing helps

 private:
  std::optional<double> propose(double sensitivity);

  SensitivitySearchOptions options_;
  double thresholdCounts_;
  double sensitivity_;
  double highestUnsaturated_ = 0.0;  // highest that didn't saturate; 0: none yet
  double lowestSaturated_ = 2.0;     // lowest that did; 2: none yet
  double largest_ = 0.0;             // in this look [counts]
  std::size_t frames_ = 0;           // of this look
  bool settled_ = false;
  bool saturated_ = false;
  std::optional<double> lowSinceS_;
};

}  // namespace palpate
