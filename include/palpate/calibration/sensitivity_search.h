// Adapts the sensitivity to the load (study, 3.4): finds the highest sensitivity without saturation
// from the largest readings. A reading is sensitivity x gain - threshold, so one unsaturated
// measurement predicts where saturation begins; a saturated one only gives an upper bound, and the
// interval is bisected. This class only proposes settings: the owner of the device applies them
// (each pauses the stream for some hundred ms) and passes the following frames to observe().
#pragma once

#include <cstddef>
#include <optional>

#include <palpate/model/hand_description.h>

namespace palpate {

struct SensitivitySearchOptions {
  // Lowest and highest sensitivity that is tried, 0..1.
  double least = 0.1;
  double most = 1.0;
  // The search ends when the sensitivity can rise by less than this; > 0.
  double resolution = 0.03;
  // A taxel at or above this value is saturated [counts].
  double saturationCounts = 4095.0;
  double headroom = 0.1;  // target below saturation, as a share of it; 0..0.9
  // Number of frames with contact at one sensitivity; >= 1.
  std::size_t framesPerTrial = 10;
  // After this time with a low maximum [s], >= 0, the upper bound is dropped and tested again.
  double resetUpperBoundAfterS = 5.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Searches the sensitivity, frame by frame.
class SensitivitySearch {
 public:
  // Starts at the current sensitivity, which must be between least and most.
  SensitivitySearch(double sensitivity,
                    double thresholdCounts,
                    const SensitivitySearchOptions& options = {});

  // Takes one frame that was recorded at the last proposed sensitivity: its largest reading (0: no
  // contact). Returns the next sensitivity to set; empty: keep the current one. Ignores readings
  // that are not finite.
  std::optional<double> observe(double timeS, double maximumCounts);

  double sensitivity() const noexcept { return sensitivity_; }  // the current one
  bool settled() const noexcept { return settled_; }      // no higher sensitivity is left to try
  bool saturated() const noexcept { return saturated_; }  // saturated even at `least`

 private:
  std::optional<double> propose(double sensitivity);

  SensitivitySearchOptions options_;
  double thresholdCounts_;
  double sensitivity_;
  double highestUnsaturated_ = 0.0;  // highest without saturation; 0: none yet
  double lowestSaturated_ = 2.0;     // lowest with saturation; 2: none yet
  double largest_ = 0.0;             // in this trial [counts]
  std::size_t frames_ = 0;           // number of frames in this trial
  bool settled_ = false;
  bool saturated_ = false;
  std::optional<double> lowSinceS_;
};

}  // namespace palpate
