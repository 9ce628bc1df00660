// Finds the grasps in a recording: spans of frames in which fingers touch something from more than
// one side. The features of grasps, `palpate grasps` and the marks of the window use it.
//
// Rule `general`: at least two different fingers have an active taxel (value > 0, on any of their
// matrices) for more than 20 frames and more than 0.6 s; up to 3 frames without are bridged. On a
// hand with only one finger or pad this one suffices. Rule `study` (of the study's training
// script): the two pads that pinch (matrices 1 and 5 of an SDH-2) are both active for more than 20
// frames; nothing is bridged. With both rules a gap in the recording (longer than max(1 s, 5 median
// intervals)) ends a grasp, because the contact during the gap is not known.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

enum class GraspRule { kGeneral, kStudy };
inline constexpr std::array<OptionWord<GraspRule>, 2> kGraspRuleWords{
    {{"general", GraspRule::kGeneral}, {"study", GraspRule::kStudy}}};

struct GraspSegmentOptions {
  GraspRule rule = GraspRule::kGeneral;
  // `general`: number of fingers, 1..8; at most as many as the hand has are required.
  std::size_t minFingers = 2;
  // A grasp has more frames than this, from begin to end,
  std::size_t moreThanFrames = 20;
  // and with `general` it lasts longer than this [s], >= 0.
  double moreThanS = 0.6;
  // `general`: largest number of successive frames without contact inside a grasp.
  std::size_t bridgedFrames = 3;
  // `study`: matrices that must all touch; empty: the pads that pinch (PinchDescription::pads).
  std::vector<std::size_t> studyMatrices = {};

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// One grasp: frames begin..end, both inclusive and both in contact.
struct GraspSegment {
  std::size_t begin = 0;
  std::size_t end = 0;
  // Fingers that touch in at least half of the frames, ascending; with `general` at least
  // `minFingers`. A matrix that belongs to no finger (a pad) counts as a finger with the number of
  // the matrix.
  std::vector<int> fingers;
  // 0..1, the product of
  //   the fraction of its frames in contact (1: nothing was bridged),
  //   the fraction of its frames without a saturated taxel,
  //   1 - min(1, sd / mean) of the sum of all taxels over the middle half of its frames
  //     (1: held steadily),
  //   1, 1/2 or 1/4 if both, one or none of its ends lie inside the recording (not at its first or
  //     last frame, nor beside a gap).
  double quality = 0.0;
  bool operator==(const GraspSegment&) const = default;
};

// Throws Cancelled; Error when the rule `study` names no matrices and the hand has no pads that
// pinch.
std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const GraspSegmentOptions& options = {},
                                     const Progress& progress = {});

// The same from signals that were computed before; reads no frame. `timing` is that of the profile.
std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const SignalTable& table,
                                     const TimingReport& timing,
                                     const GraspSegmentOptions& options = {});

// The grasps as a result table: first and last frame, their host times, the fingers, the quality.
std::unique_ptr<ResultTable> graspTable(const Profile& profile,
                                        const GraspSegmentOptions& options = {},
                                        const Progress& progress = {});

}  // namespace palpate
