// Features of grasps: what recognition knows of one grasp, as a row of numbers with names.
//
//   study    the 54 features of the study (study_features.h), for comparison with it
//   best     the features that are stable between sessions (plateau_features.h): contact geometry
//   and
//            force on the load plateau
//   session  the features of `best`, the joint angles at rest and simple statistics of both pads.
//            The most accurate set within one session; not to be used in another one, because it
//            contains the pose in which an object was presented (sessionSetWarning()).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recognition/pinch_hand.h>

namespace palpate {

enum class FeatureSet { kStudy, kBest, kSession };

// "study", "best", "session"; nothing for another word.
std::string_view featureSetName(FeatureSet set) noexcept;
std::optional<FeatureSet> featureSetNamed(std::string_view name) noexcept;
std::vector<std::string> featureNames(FeatureSet set, const PinchHand& hand = sdh2PinchHand());
// What has to be said wherever the set `session` is chosen: one line.
std::string_view sessionSetWarning() noexcept;

// Of one grasp.
struct GraspFeatures {
  std::size_t begin = 0, end = 0;  // frames, both inclusive
  // Where it begins and ends for the features: `study` its own two; `best`, `session`: the first
  // frame with a quarter of the load, and the last one of the plateau.
  std::size_t initialFrame = 0, endFrame = 0;
  std::vector<double> values;  // finite, as featureNames(); empty with trouble
  std::string problem;         // why there are none, one line; else empty
  bool operator==(const GraspFeatures&) const = default;
};

// Throws std::out_of_range: frames that aren't there. What the recording lacks is said by
// `trouble`.
GraspFeatures graspFeatures(const Profile& profile,
                            const GraspSegment& grasp,
                            FeatureSet set,
                            const PinchHand& hand = sdh2PinchHand());

// Grasps of a recording as recognition counts them: both pads touch for more than 20 frames (rule
// `study` with the hand's pads). Throws Cancelled.
std::vector<GraspSegment> findPinches(const Profile& profile,
                                      const PinchHand& hand = sdh2PinchHand(),
                                      const Progress& progress = {});

// All of a recording, in order of time; a recording of another hand gives none and says so in
// `trouble`.
struct RecordingFeatures {
  std::vector<GraspFeatures> grasps;
  std::string problem;  // another hand; no grasp; else empty
};
RecordingFeatures recordingFeatures(const Profile& profile,
                                    FeatureSet set,
                                    const PinchHand& hand = sdh2PinchHand(),
                                    const Progress& progress = {});

}  // namespace palpate
