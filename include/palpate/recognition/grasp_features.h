// Features of a grasp: the named numbers from which recognition predicts its class. There are four
// sets:
//
//   study       the 54 features of the study (study_features.h), for comparison with it
//   best        the features that are stable between sessions (plateau_features.h): contact
//   geometry
//               and force on the load plateau
//   session     the features of `best`, the joint angles at rest and simple statistics of both
//   pads.
//               The most accurate set within one session; not to be used in another one, because it
//               contains the pose in which an object was presented (sessionSetWarning())
//   statistics  load, extent and position of the contact of every matrix (contact_statistics.h)
//
// The first three need a hand with two pads that pinch (pinchHandOf()); `statistics` are computed
// for every hand.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recognition/pinch_hand.h>

namespace palpate {

enum class FeatureSet { kStudy, kBest, kSession, kStatistics };
inline constexpr std::array<OptionWord<FeatureSet>, 4> kFeatureSetWords{
    {{"study", FeatureSet::kStudy},
     {"best", FeatureSet::kBest},
     {"session", FeatureSet::kSession},
     {"statistics", FeatureSet::kStatistics}}};

// Names of the sets: "study", "best", "session", "statistics"; featureSetNamed() returns nothing
// for another name.
std::string_view featureSetName(FeatureSet set) noexcept;
std::optional<FeatureSet> featureSetNamed(std::string_view name) noexcept;
// The set for a hand: `best` where two pads pinch, otherwise `statistics`.
FeatureSet defaultFeatureSet(const HandDescription& hand);
inline constexpr const char* kDefaultFeatureSetText = "best where two pads pinch, else statistics";
// Throws Error when the hand has no pads that pinch and the set needs them.
std::vector<std::string> featureNames(FeatureSet set, const HandDescription& hand);
// Unit of a feature of a set: "mm", "deg", "taxels", "full scale"; empty for a number without unit,
// such as a logarithm or a share, and for a name that the set doesn't have.
std::string_view featureUnit(FeatureSet set, std::string_view name) noexcept;
// What it is, in a few words; empty for a name that the set doesn't have.
std::string featureMeaning(FeatureSet set, std::string_view name);
// Warning, one line, to be shown wherever the set `session` is chosen.
std::string_view sessionSetWarning() noexcept;

// Features of one grasp.
struct GraspFeatures {
  // First and last frame of the grasp, both inclusive.
  std::size_t begin = 0, end = 0;
  // Frames that the features are computed from. `study`: its initial and end frame. `best` and
  // `session`: the first frame with a quarter of the largest load and the last frame of the
  // plateau.
  std::size_t initialFrame = 0, endFrame = 0;
  // GraspSegment::quality.
  double quality = 0.0;
  // Finite values in the order of featureNames(); empty if there is a problem.
  std::vector<double> values;
  // Reason why there are no values, one line; otherwise empty.
  std::string problem;
  bool operator==(const GraspFeatures&) const = default;
};

// Computes the features of one grasp of the profile's hand. Throws std::out_of_range when the grasp
// has frames that the profile doesn't have. What the recording or the hand lacks is reported in
// `problem`.
GraspFeatures graspFeatures(const Profile& profile, const GraspSegment& grasp, FeatureSet set);

// Finds the grasps of a recording that recognition uses with a set. With two pads that pinch: both
// touch for more than 20 frames (rule `study`). With the set `statistics`: by the rule `general`.
// Empty when the hand has no pads that pinch and the set needs them. Throws Cancelled.
std::vector<GraspSegment> findPinches(const Profile& profile,
                                      FeatureSet set,
                                      const Progress& progress = {});
// Why findPinches() finds nothing, one line.
std::string noPinchText(const HandDescription& hand, FeatureSet set);

// Features of all grasps of a recording, in order of time. `problem` is set if its hand has no pads
// that pinch and the set needs them, if its joint angles are those of another hand, or if it has no
// grasp; otherwise it is empty.
struct RecordingFeatures {
  std::vector<GraspFeatures> grasps;
  std::string problem;
};
RecordingFeatures recordingFeatures(const Profile& profile,
                                    FeatureSet set,
                                    const Progress& progress = {});

}  // namespace palpate
