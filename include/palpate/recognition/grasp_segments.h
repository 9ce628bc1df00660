// Finds the grasps in a recording: spans of frames in which fingers touch something from more than
// one side.
//
// Rule `general`: at least two different fingers with an active taxel (value > 0, of any of their
// matrices), for more than 20 frames and more than 0.6 s; up to 3 frames without are bridged. Rule
// `study` (its classifier's training script): matrices 1 and 5 both active, more than 20 frames,
// nothing bridged. In both a gap of the recording (longer than max(1 s, 5 median intervals)) ends a
// grasp: nobody knows what happened in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

enum class GraspRule { kGeneral, kStudy };

struct GraspSegmentOptions {
  GraspRule rule = GraspRule::kGeneral;
  std::size_t minFingers = 2;       // `general`; 1..8
  std::size_t moreThanFrames = 20;  // a grasp has more, from begin to end
  double moreThanS = 0.6;           // `general`: and lasts longer [s], >= 0
  std::size_t bridgedFrames = 3;    // `general`: at most so many without contact in a row
  std::vector<std::size_t> studyMatrices = {1, 5};  // `study`: all of these

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Frames begin..end, both inclusive; both are in contact.
struct GraspSegment {
  std::size_t begin = 0;
  std::size_t end = 0;
  // Those that touch in at least half of the frames, ascending; of `general` at least as many as
  // the rule asks for. A matrix without a finger (a pad) counts as a finger of its number.
  std::vector<int> fingers;
  // 0..1, the product of
  //   the part of its frames in contact (1: nothing was bridged),
  //   the part of its frames without a saturated taxel,
  //   1 - min(1, sd / mean) of the sum of all taxels over the middle half of its frames
  //     (1: held steadily),
  //   1, 1/2 or 1/4 if both, one or none of its ends lie inside the recording (not at its first or
  //     last frame, nor beside a gap).
  double quality = 0.0;
  bool operator==(const GraspSegment&) const = default;
};

// Throws Cancelled.
std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const GraspSegmentOptions& options = {},
                                     const Progress& progress = {});

// From what is known of every frame already, which reads none. `timing` is the profile's.
std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const SignalTable& table,
                                     const TimingReport& timing,
                                     const GraspSegmentOptions& options = {});

}  // namespace palpate
