// The 54 features of the study, computed as its training script computes them (the study, sections
// 6.3 to 6.6): diameter, compressibility, and for each of the two pads the standard deviation and
// 25 moment invariants. They are the set `study` (grasp_features.h).
//
// Known deficiencies are kept, so that the results are comparable with the study (the set `best`
// gives better results):
//   the diameter is the smallest one over the grasp, not the most frequent one;
//   the end frame is one before the intended frame, and rounding selected one of its two candidates
//   (here it is always the earlier one);
//   the angle of a contact comes from atan, so that 180 and 90 degrees are ambiguous;
//   6 of the 54 are multiples of others (m_T01 = m_T10 = -1.61 m_T00, m_T11 = 2.6 m_T00).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recognition/pinch_hand.h>

namespace palpate {

// Returns "diameter" [mm], "compressibility" [mm], "std_1", "std_5" [full scale], "m1_T00",
// "m1_T01" .. "m5_T44"; the numbers are those of the pads.
std::vector<std::string> studyFeatureNames(const PinchHand& hand);

// Whether these are the names of the study's features, of whichever pads.
bool isStudySet(const std::vector<std::string>& names);

struct StudyFeatures {
  // Reason why there are no features: no joint angles, no contact, grasp too short, and so on;
  // otherwise empty.
  std::string problem;
  std::size_t initialFrame = 0;
  std::size_t endFrame = 0;
  // The second candidate for the end frame.
  std::size_t otherEndFrame = 0;
  // In the order of studyFeatureNames(); empty if there is a problem.
  std::vector<double> values;
};

// Computes the features of one grasp. If `endFrame` is given, the image and the end of the
// compression are taken from this frame. Throws std::out_of_range when the grasp has frames that
// the profile doesn't have; std::invalid_argument when `endFrame` is outside of the grasp. What the
// recording lacks is reported in `problem`.
StudyFeatures studyFeatures(const Profile& profile,
                            const GraspSegment& grasp,
                            const PinchHand& hand,
                            std::optional<std::size_t> endFrame = std::nullopt);

}  // namespace palpate
