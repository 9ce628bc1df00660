// Statistics of the contact during a grasp, for hands of any kind: load, extent and position on
// every matrix. They are the set `statistics` (grasp_features.h). Unlike those of the set `best`
// they need no joint angles and no pads that pinch; they contain the pose in which an object was
// held.
//
//   ln_sum           ln(s + .001): s is the sum of all taxels [full scale of a taxel]
//   ln_peak          ln(p + .001): p is the largest taxel [full scale]
//   ln_active        ln(active taxels + 1)
//   touched          number of matrices with an active taxel
// and of every matrix M, all 0 when none of its taxels is active:
//   mM_share         its part of the sum, 0..1
//   mM_active        active taxels / its taxels, 0..1
//   mM_column        centroid, from -1 at the first to 1 at the last column
//   mM_row           centroid, from -1 at the first to 1 at the last row
//   mM_major         ln((l1 + .15) / .15), l1 >= l2: principal second moments of the load [taxel^2]
//   mM_minor         ln((l2 + .15) / .15)
//
// All are computed of the mean of at most 25 frames, evenly selected among those with at least 90 %
// of the largest sum in the grasp. A taxel is active above 3 % of the largest value of its matrix
// in this mean.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_segments.h>

namespace palpate {

// Names of the statistics of a hand, as above.
std::vector<std::string> contactStatisticsNames(const HandDescription& hand);

struct ContactStatistics {
  // Reason why there are none (no load, values that are not finite); otherwise empty.
  std::string problem;
  // First frame with a quarter of the largest sum.
  std::size_t startFrame = 0;
  // Last frame that the mean contains.
  std::size_t plateauEndFrame = 0;
  // In the order of contactStatisticsNames(); empty if there is a problem.
  std::vector<double> values;
};

// Computes the statistics of one grasp of the profile's hand. Throws std::out_of_range when the
// grasp has frames that the profile doesn't have.
ContactStatistics contactStatistics(const Profile& profile, const GraspSegment& grasp);

}  // namespace palpate
