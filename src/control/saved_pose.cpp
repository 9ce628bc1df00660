#include "palpate/control/saved_pose.h"

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxNameBytes = 100;
constexpr std::size_t kMaxPoses = 10'000;
constexpr std::size_t kMaxAxes = 1000;
constexpr double kMaxAngleDeg = 1e6;
constexpr std::int64_t kPosesVersion = 1;

std::string nameFrom(const JsonField& field) {
  const std::string name = field.text();
  if (name.empty() || name.size() > kMaxNameBytes || name.find('\n') != std::string::npos)
    field.fail("must be one line of 1.." + std::to_string(kMaxNameBytes) + " bytes");
  return name;
}

}  // namespace

std::string problemOf(const SavedPose& pose, const HandDescription& hand) {
  const std::string subject = "the pose '" + shortened(pose.name) + "' ";
  if (pose.hand != hand.name) return subject + "is of another hand: " + pose.hand;
  if (pose.anglesDeg.size() != hand.axes.size())
    return subject + "has " + std::to_string(pose.anglesDeg.size()) + " angles, the hand has " +
           std::to_string(hand.axes.size()) + " axes";
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis) {
    const AxisDescription& is = hand.axes[axis];
    const double angle = pose.anglesDeg[axis];
    if (angle >= is.minimumDeg && angle <= is.maximumDeg) continue;  // NaN is in no range
    return subject + "is out of range: " + is.name + " at " + numberText(angle) + ", not in " +
           numberText(is.minimumDeg) + ".." + numberText(is.maximumDeg) + " " + is.unit();
  }
  return {};
}

GraspRequest motionTo(const SavedPose& pose, double velocityDegPerS) {
  GraspRequest request;
  request.targetDeg.assign(pose.anglesDeg.begin(), pose.anglesDeg.end());
  request.title = pose.name;
  request.velocityDegPerS = velocityDegPerS;
  return request;
}

Json jsonOf(const SavedPose& pose) {
  Json json = Json::object();
  json.set("name", pose.name).set("hand", pose.hand).set("angles_deg", jsonList(pose.anglesDeg));
  return json;
}

SavedPose savedPoseFrom(const JsonField& field) {
  SavedPose pose;
  pose.name = nameFrom(field.required("name"));
  pose.hand = field.required("hand").text();
  for (const JsonField& angle : field.required("angles_deg").items(kMaxAxes))
    pose.anglesDeg.push_back(angle.number(-kMaxAngleDeg, kMaxAngleDeg));
  return pose;
}

std::string posesText(const std::vector<SavedPose>& poses) {
  Json json = Json::object();
  json.set("format", "palpate-poses").set("version", kPosesVersion);
  Json list = Json::array();
  for (const SavedPose& pose : poses) list.push(jsonOf(pose));
  json.set("poses", std::move(list));
  return json.text() + "\n";
}

std::vector<SavedPose> parsePoses(std::string_view text, const std::filesystem::path& file) {
  const JsonField root = JsonField::parse(text, file, "the list of poses");
  if (!root.has("format") || root.at("format").text() != "palpate-poses")
    root.fail("is not a list of poses: 'format' must be \"palpate-poses\"");
  root.required("version").integer(1, kPosesVersion);
  std::vector<SavedPose> poses;
  for (const JsonField& each : root.required("poses").items(kMaxPoses))
    poses.push_back(savedPoseFrom(each));
  return poses;
}

}  // namespace palpate
