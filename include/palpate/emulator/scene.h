// What is around the emulated hand: objects, how the hand stands, what happens when. JSON:
//   {"objects": [{"shape": "sphere", "size_mm": 60, "stiffness_n_per_mm3": 0.5, "friction": 0.6,
//                 "mass_kg": 0.2, "pose": {"position_mm": [0,0,150], "rotation_deg": [0,0,0]}}],
//    "hand": {"preshape": "centrical", "close": 0.0},
//    "script": [{"at_s": 1, "grasp": {"close": 1, "velocity_deg_per_s": 30}}, ..],
//    "description": "A soft ball in the middle"}
// Every key but "shape", "size_mm" and "at_s" may be absent. Positions in the hand's base frame;
// rotations about its fixed axes x, y, z, in that order. An object keeps its pose until fingers
// touch it; then it moves under the contact forces, its weight and the applied load.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/shape.h>

namespace palpate {

struct SceneObject {
  Shape shape;
  // of its surface, against indentation; 10: rigid beside the rubber
  double stiffnessNPerMm3 = 10.0;
  double friction = 0.6;  // coefficient against the rubber
  double massKg = 0.1;
  bool fixed = false;  // held in place: only a script moves it
  Eigen::Vector3d positionMm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

// What a script does; times in seconds since the hand was switched on.
struct MoveObject {  // as a hand would that holds it: against any friction
  std::size_t object = 0;
  Eigen::Vector3d byMm = Eigen::Vector3d::Zero();
  double durationS = 1.0;
};
struct TurnObject {
  std::size_t object = 0;
  Eigen::Vector3d byDeg = Eigen::Vector3d::Zero();  // rotation vector about the object's middle
  double durationS = 1.0;
};
struct GraspAction {
  std::optional<std::string> preshape;  // nothing: the present one
  double close = 1.0;
  double velocityDegPerS = 30.0;
};
struct ReleaseAction {  // opens the present preshape
  double velocityDegPerS = 30.0;
};
struct LoadObject {  // in addition to its weight, from now on
  std::size_t object = 0;
  Eigen::Vector3d forceN = Eigen::Vector3d::Zero();
  Eigen::Vector3d torqueNmm = Eigen::Vector3d::Zero();
  double durationS = 0.0;  // grows from the load of before within this time
};
struct SetTemperature {
  double ambientDegC = 34.0;  // what the sensors relax to
};
struct SetSceneThreshold {
  std::optional<std::size_t> matrix;
  int counts = 0;
};
struct SetSceneSensitivity {
  std::optional<std::size_t> matrix;
  double sensitivity = 0.5;
};
using SceneAction = std::variant<MoveObject,
                                 TurnObject,
                                 GraspAction,
                                 ReleaseAction,
                                 LoadObject,
                                 SetTemperature,
                                 SetSceneThreshold,
                                 SetSceneSensitivity>;

struct ScriptStep {
  double atS = 0.0;
  SceneAction action;
};

struct Scene {
  std::string name;
  std::string description;  // for a person, one line; may be empty
  std::vector<SceneObject> objects;
  std::string preshape = "centrical";
  double close = 0.0;
  std::vector<ScriptStep> script;  // in order of time
};

// Throws FormatError naming the file and the field that is wrong, missing or unknown.
Scene parseScene(std::string_view json, const std::filesystem::path& name);
// A name ("ball") is looked up in `folder`; what ends in .json or holds a slash is a file. Throws
// FileError (no such scene: names those that are there), FormatError.
Scene loadScene(const std::string& nameOrFile, const std::filesystem::path& folder);
std::vector<std::string> sceneNames(const std::filesystem::path& folder);

}  // namespace palpate
