// Checks a recording that was just made, a take, before the hand moves on to the next one: was
// anything touched, is it long enough, are frames missing, is it saturated? The plan of recordings
// in the window uses it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/signals/first_contact.h>

namespace palpate {

// From this quality on (GraspSegment::quality) a grasp is taken as an example without a question.
inline constexpr double kGoodGraspQuality = 0.5;

struct TakeCheckOptions {
  // Something was touched if there is such a contact.
  FirstContactOptions contact = {};
  double leastS = 1.0;          // shortest duration [s], 0..1e9
  std::int64_t mostLost = 0;    // frames that may be lost, 0 or more
  double mostSaturated = 0.02;  // fraction of the frames with a saturated taxel, 0..1
  // Least quality of its best grasp (GraspSegment::quality), 0..1; 0: a take needs no grasp.
  double leastQuality = 0.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
  bool operator==(const TakeCheckOptions& other) const noexcept;
};

struct TakeQuality {
  double durationS = 0.0;  // of all parts [s]
  std::size_t frames = 0;
  bool touched = false;
  std::size_t gaps = 0;  // longer than max(1 s, 5 median intervals)
  double gapsS = 0.0;    // their time [s]
  std::int64_t lost = 0;
  double saturated = 0.0;  // fraction of the frames with a saturated taxel
  // Best quality of its grasps (GraspSegment::quality); empty: there is no grasp.
  std::optional<double> graspQuality;
  // What is wrong with it, in the order in which the options stand; empty: it is good.
  std::vector<std::string> problems;

  bool good() const noexcept { return problems.empty(); }
  // The problems in one line: "nothing was touched; 1 gap of 2.3 s"; empty: none.
  std::string problem() const;
};

// Checks the parts of a take; `lost`: frames that were lost on the way from the hand or to the
// disk, as the recorder counted them. Throws std::invalid_argument (options), Error (a frame can't
// be read), Cancelled.
TakeQuality checkTake(std::span<const Profile> parts,
                      std::int64_t lost = 0,
                      const TakeCheckOptions& options = {},
                      const Progress& progress = {});

}  // namespace palpate
