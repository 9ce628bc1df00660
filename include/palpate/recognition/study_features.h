// The 54 features by which the study tells objects apart, number for number as its training script
// makes them (the study, sections 6.3 to 6.6): diameter, compressibility, standard deviation of
// each of the two pads, 25 moment invariants of each.
//
// What is odd about them stays, under the study's name (the set `best` is the better one):
//   the diameter is the smallest one over the grasp, not the most frequent one;
//   the end frame lies one before the frame meant, and of its two candidates rounding chose (here:
//   always the earlier one);
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

// "diameter" [mm], "compressibility" [mm], "std_1", "std_5" [full scale], "m1_T00", "m1_T01" ..
// "m5_T44": the numbers are the hand's pads.
std::vector<std::string> studyFeatureNames(const PinchHand& hand = sdh2PinchHand());

struct StudyFeatures {
  // why there are none: no joint angles, no contact, too short, .. ; else empty
  std::string problem;
  std::size_t initialFrame = 0;
  std::size_t endFrame = 0;
  std::size_t otherEndFrame = 0;  // the tied candidate
  std::vector<double> values;     // as studyFeatureNames(); empty with trouble
};

// Of one grasp. endFrame: takes the picture, and the end of the compression, from this frame
// instead. Throws std::out_of_range: frames that aren't there; std::invalid_argument: an end frame
// outside of the grasp. What the recording lacks is said by `trouble`.
StudyFeatures studyFeatures(const Profile& profile,
                            const GraspSegment& grasp,
                            const PinchHand& hand = sdh2PinchHand(),
                            std::optional<std::size_t> endFrame = std::nullopt);

}  // namespace palpate
