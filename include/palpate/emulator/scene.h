// Scene of an emulated hand: the objects, the posture of the hand, and a script of events. JSON:
//   {"objects": [{"shape": "sphere", "size_mm": 60, "stiffness_n_per_mm3": 0.5, "friction": 0.6,
//                 "mass_kg": 0.2, "pose": {"position_mm": [0,0,150], "rotation_deg": [0,0,0]}}],
//    "hand": {"preshape": "centrical", "close": 0.0},
//    "script": [{"at_s": 1, "grasp": {"close": 1, "velocity_deg_per_s": 30}}, ..],
//    "repeat_s": 15, "description": "A soft ball in the middle"}
// Every key except "shape", "size_mm" and "at_s" is optional. A scene is one of a certain hand: its
// preshapes, its matrices and its base frame. Positions are in the hand's base
// frame; rotations are about its fixed axes x, y, z, in that order. An object keeps its pose until
// fingers touch it; then it moves under the contact forces, its weight and the applied load.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/shape.h>
#include <palpate/model/hand_file.h>
#include <palpate/model/preshape.h>

namespace palpate {

struct SceneObject {
  Shape shape;
  // Stiffness of its surface against indentation; 10 is rigid compared with the rubber.
  double stiffnessNPerMm3 = 10.0;
  double friction = 0.6;  // coefficient against the rubber
  double massKg = 0.1;
  bool fixed = false;  // held in place: only the script moves it
  Eigen::Vector3d positionMm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

// What a script does; times in seconds since the hand was switched on.
// Moves an object as if a hand held it, against any friction.
struct MoveObject {
  std::size_t object = 0;
  Eigen::Vector3d byMm = Eigen::Vector3d::Zero();
  double durationS = 1.0;
};
struct TurnObject {
  std::size_t object = 0;
  // Rotation vector about the object's centre.
  Eigen::Vector3d byDeg = Eigen::Vector3d::Zero();
  double durationS = 1.0;
};
struct GraspAction {
  std::optional<std::string> preshape;  // empty: keeps the present preshape
  double close = 1.0;
  double velocityDegPerS = 30.0;
};
// Opens the hand in the present preshape.
struct ReleaseAction {
  double velocityDegPerS = 30.0;
};
// Applies a load in addition to the object's weight, from this step on.
struct LoadObject {
  std::size_t object = 0;
  Eigen::Vector3d forceN = Eigen::Vector3d::Zero();
  Eigen::Vector3d torqueNmm = Eigen::Vector3d::Zero();
  // Time in which the load changes linearly from its previous value.
  double durationS = 0.0;
};
struct SetTemperature {
  // Temperature that the sensors approach.
  double ambientDegC = 34.0;
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
  // One line for the user; may be empty.
  std::string description;
  std::vector<SceneObject> objects;
  std::string preshape;  // empty: startPreshape() of the hand
  double close = 0.0;
  std::vector<ScriptStep> script;  // in order of time
  // Time after which the script can begin again [s]; 0: it isn't meant to be repeated.
  double repeatS = 0.0;
};

// The preshape in which an emulated hand begins where a scene names none: the one with the name
// "centrical", otherwise the first one; empty for a hand without preshapes.
std::string startPreshape(const HandDescription& hand);
// Finds a preshape of a hand. Throws std::invalid_argument that lists all names.
const Preshape& scenePreshape(const HandDescription& hand, std::string_view name);

// Parses a scene for a hand. Throws FormatError naming the file and the wrong, missing or unknown
// field.
Scene parseScene(std::string_view json,
                 const std::filesystem::path& name,
                 const HandDescription& hand = defaultHand());
// Loads a scene. A name ("ball") is looked up in `folder`; a text that ends in .json or contains a
// slash is a file. Throws FileError (no such scene; the message lists the existing ones),
// FormatError.
Scene loadScene(const std::string& nameOrFile,
                const std::filesystem::path& folder,
                const HandDescription& hand = defaultHand());
std::vector<std::string> sceneNames(const std::filesystem::path& folder);

}  // namespace palpate
