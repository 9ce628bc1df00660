// A pose of a hand that a user has saved under a name, as one JSON object:
// {"name": "rest", "hand": "SCHUNK SDH-2 with Weiss DSA", "angles_deg": [0, -30, ..]}
// A list of poses is {"format": "palpate-poses", "version": 1, "poses": [..]}.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/control/grasp_request.h>
#include <palpate/core/json_field.h>
#include <palpate/model/hand_description.h>

namespace palpate {

struct SavedPose {
  std::string name;  // one line, 1..100 bytes
  std::string hand;  // HandDescription::name
  std::vector<double> anglesDeg;
  bool operator==(const SavedPose&) const = default;
};

// Why this hand can't take the pose, one line: it is of another hand, has another number of axes,
// or an angle is out of range or not finite. Empty when it can.
std::string problemOf(const SavedPose& pose, const HandDescription& hand);
// The motion to the pose; to be checked by problemOf() before.
GraspRequest motionTo(const SavedPose& pose, double velocityDegPerS);

Json jsonOf(const SavedPose& pose);
// Throws FormatError that names what is missing or invalid. Whether the hand can take the pose is
// not checked.
SavedPose savedPoseFrom(const JsonField& field);
std::string posesText(const std::vector<SavedPose>& poses);
// Throws FormatError, also for a newer version. `file` names the text in errors.
std::vector<SavedPose> parsePoses(std::string_view text, const std::filesystem::path& file);

}  // namespace palpate
