#include "palpate/emulator/scene.h"

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json_field.h"
#include "palpate/core/text_file.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr std::size_t kMaxObjects = 100;
constexpr std::size_t kMaxSteps = 10'000;
constexpr std::uintmax_t kMaxBytes = 1u << 20;
constexpr std::string_view kUsualPreshape = "centrical";

Vector3d vectorAt(const JsonField& field, std::string_view key, double most) {
  if (!field.has(key)) return Vector3d::Zero();
  const std::vector<double> parts = field.at(key).numbers(3, -most, most);
  return {parts[0], parts[1], parts[2]};
}

std::optional<std::size_t> matrixOf(const JsonField& field, const HandDescription& hand) {
  if (!field.has("matrix")) return std::nullopt;
  return field.at("matrix").index(hand.layout->numMatrices());
}

Eigen::Matrix3d rotationOf(const Vector3d& deg) {
  const Vector3d rad = deg * std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(rad.z(), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rad.y(), Vector3d::UnitY()) *
          Eigen::AngleAxisd(rad.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

constexpr double kMaxMm = 10'000.0;

Shape shapeOf(const JsonField& field) {
  Shape shape;
  try {
    shape.kind = shapeKind(field.required("shape").text());
  } catch (const std::invalid_argument& wrong) {
    field.at("shape").fail(wrong.what());
  }
  const JsonField size = field.required("size_mm");
  std::vector<double> sizes;
  if (size.isNumber())
    sizes = {size.number(1.0, kMaxMm)};
  else
    for (const JsonField& item : size.items(3)) sizes.push_back(item.number(1.0, kMaxMm));
  const auto want = [&](std::size_t count, const char* what) {
    if (sizes.size() != count) size.fail(std::string("takes ") + what);
  };
  switch (shape.kind) {
    case ShapeKind::kSphere:
      want(1, "the diameter");
      shape.sizeMm = Vector3d::Constant(sizes[0]);
      break;
    case ShapeKind::kCylinder:
    case ShapeKind::kCone:
      want(2, "diameter and height");
      shape.sizeMm = {sizes[0], sizes[0], sizes[1]};
      break;
    case ShapeKind::kBox:
    case ShapeKind::kEllipsoid:
      want(3, "three lengths");
      shape.sizeMm = {sizes[0], sizes[1], sizes[2]};
      break;
  }
  return shape;
}

SceneObject objectOf(const JsonField& field) {
  field.only({"shape", "size_mm", "stiffness_n_per_mm3", "friction", "mass_kg", "fixed", "pose"});
  SceneObject object;
  object.shape = shapeOf(field);
  object.stiffnessNPerMm3 = field.number("stiffness_n_per_mm3", object.stiffnessNPerMm3, 1e-4, 1e4);
  object.friction = field.number("friction", object.friction, 0.0, 10.0);
  object.massKg = field.number("mass_kg", object.massKg, 0.0, 100.0);
  if (field.has("fixed")) object.fixed = field.at("fixed").flag();
  if (!field.has("pose")) return object;
  const JsonField pose = field.at("pose");
  pose.only({"position_mm", "rotation_deg"});
  object.positionMm = vectorAt(pose, "position_mm", kMaxMm);
  object.rotation = rotationOf(vectorAt(pose, "rotation_deg", 360.0));
  return object;
}

void requirePreshape(const JsonField& field, const HandDescription& hand) {
  try {
    scenePreshape(hand, field.text());
  } catch (const std::invalid_argument& wrong) {
    field.fail(std::string("is wrong: ") + wrong.what());
  }
}

constexpr double kMaxSceneSeconds = 1e6;
constexpr double kMinRepeatS = 1.0;

constexpr double kSceneMaxVelocity = 1000.0;  // [deg/s, mm/s]
constexpr double kSceneUsualVelocity = 30.0;

// Velocity that every axis reaches.
double largestVelocity(const HandDescription& hand) {
  double most = kSceneMaxVelocity;
  for (const AxisDescription& axis : hand.axes)
    if (axis.maximumVelocityDegPerS > 0.0) most = std::min(most, axis.maximumVelocityDegPerS);
  return most;
}

SceneAction actionOf(const JsonField& step, std::size_t objects, const HandDescription& hand) {
  const auto speed = [&](const JsonField& field) {
    const double most = largestVelocity(hand);
    return field.number(
        "velocity_deg_per_s", std::min(kSceneUsualVelocity, most), std::min(0.1, most), most);
  };
  const auto object = [&](const JsonField& field) {
    if (objects == 0) field.fail("needs an object");
    return field.has("object") ? field.at("object").index(objects) : 0;
  };
  if (step.has("move")) {
    const JsonField at = step.at("move");
    at.only({"object", "by_mm", "duration_s"});
    return MoveObject{object(at),
                      vectorAt(at, "by_mm", kMaxMm),
                      at.number("duration_s", 1.0, 0.001, kMaxSceneSeconds)};
  }
  if (step.has("turn")) {
    const JsonField at = step.at("turn");
    at.only({"object", "by_deg", "duration_s"});
    return TurnObject{object(at),
                      vectorAt(at, "by_deg", 36'000.0),
                      at.number("duration_s", 1.0, 0.001, kMaxSceneSeconds)};
  }
  if (step.has("grasp")) {
    const JsonField at = step.at("grasp");
    at.only({"preshape", "close", "velocity_deg_per_s"});
    if (startPreshape(hand).empty())
      at.fail("needs preshapes, and the hand '" + shortened(hand.name) + "' has none");
    GraspAction grasp;
    if (at.has("preshape")) {
      requirePreshape(at.at("preshape"), hand);
      grasp.preshape = at.at("preshape").text();
    }
    grasp.close = at.number("close", 1.0, 0.0, 1.0);
    grasp.velocityDegPerS = speed(at);
    return grasp;
  }
  if (step.has("release")) {
    const JsonField at = step.at("release");
    at.only({"velocity_deg_per_s"});
    return ReleaseAction{speed(at)};
  }
  if (step.has("load")) {
    const JsonField at = step.at("load");
    at.only({"object", "force_n", "torque_nmm", "duration_s"});
    return LoadObject{object(at),
                      vectorAt(at, "force_n", 1000.0),
                      vectorAt(at, "torque_nmm", 1e5),
                      at.number("duration_s", 0.0, 0.0, kMaxSceneSeconds)};
  }
  if (step.has("temperature")) {
    const JsonField at = step.at("temperature");
    at.only({"ambient_c"});
    return SetTemperature{at.number("ambient_c", 34.0, -20.0, 90.0)};
  }
  if (step.has("threshold")) {
    const JsonField at = step.at("threshold");
    at.only({"matrix", "counts"});
    return SetSceneThreshold{
        matrixOf(at, hand),
        static_cast<int>(at.number("counts", 0.0, 0.0, static_cast<double>(hand.maximumCounts)))};
  }
  if (step.has("sensitivity")) {
    const JsonField at = step.at("sensitivity");
    at.only({"matrix", "value"});
    return SetSceneSensitivity{matrixOf(at, hand), at.number("value", 0.5, 0.0, 1.0)};
  }
  step.fail(
      "doesn't say what happens: give one of move, turn, grasp, release, load, temperature, "
      "threshold, "
      "sensitivity");
}

}  // namespace

std::string startPreshape(const HandDescription& hand) {
  if (!hand.file || hand.file->preshapes.empty()) return {};
  for (const Preshape& preshape : hand.file->preshapes)
    if (preshape.name == kUsualPreshape) return preshape.name;
  return hand.file->preshapes.front().name;
}

const Preshape& scenePreshape(const HandDescription& hand, std::string_view name) {
  std::string known;
  if (hand.file)
    for (const Preshape& preshape : hand.file->preshapes) {
      if (preshape.name == name) return preshape;
      known += (known.empty() ? "" : ", ") + preshape.name;
    }
  throw std::invalid_argument(known.empty()
                                  ? "the hand '" + shortened(hand.name) + "' has no preshapes"
                                  : "no preshape '" + shortened(name) + "'; there are: " + known);
}

Scene parseScene(std::string_view text, const fs::path& name, const HandDescription& hand) {
  const JsonField root = JsonField::parse(text, name, "the scene");
  root.only({"objects", "hand", "script", "repeat_s", "description"});
  Scene scene;
  scene.name = name.stem().string();
  if (root.has("description")) scene.description = root.at("description").text();
  if (root.has("objects"))
    for (const JsonField& object : root.at("objects").items(kMaxObjects))
      scene.objects.push_back(objectOf(object));
  scene.preshape = startPreshape(hand);
  if (root.has("hand")) {
    const JsonField posture = root.at("hand");
    posture.only({"preshape", "close"});
    if (posture.has("preshape")) {
      requirePreshape(posture.at("preshape"), hand);
      scene.preshape = posture.at("preshape").text();
    }
    scene.close = posture.number("close", 0.0, 0.0, 1.0);
  }
  if (root.has("script"))
    for (const JsonField& step : root.at("script").items(kMaxSteps)) {
      step.only({"at_s",
                 "move",
                 "turn",
                 "grasp",
                 "release",
                 "load",
                 "temperature",
                 "threshold",
                 "sensitivity"});
      scene.script.push_back({step.required("at_s").number(0.0, kMaxSceneSeconds),
                              actionOf(step, scene.objects.size(), hand)});
    }
  std::stable_sort(scene.script.begin(),
                   scene.script.end(),
                   [](const ScriptStep& a, const ScriptStep& b) { return a.atS < b.atS; });
  if (root.has("repeat_s")) {
    const double least = scene.script.empty() ? 0.0 : scene.script.back().atS;
    scene.repeatS =
        root.required("repeat_s").number(std::max(least, kMinRepeatS), kMaxSceneSeconds);
  }
  return scene;
}

std::vector<std::string> sceneNames(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Scene loadScene(const std::string& nameOrFile,
                const fs::path& folder,
                const HandDescription& hand) {
  const bool isFile = nameOrFile.find('/') != std::string::npos || nameOrFile.ends_with(".json");
  const fs::path path = isFile ? fs::path(nameOrFile) : folder / (nameOrFile + ".json");
  std::error_code failure;
  if (!isFile && !fs::exists(path, failure)) {
    std::string known;
    for (const std::string& name : sceneNames(folder)) known += (known.empty() ? "" : ", ") + name;
    throw FileError(path, "no scene '" + shortened(nameOrFile) + "'; there are: " + known);
  }
  if (!fs::is_regular_file(path, failure)) throw FileError(path, "no such file");
  return parseScene(readTextFile(path, kMaxBytes), path, hand);
}

}  // namespace palpate
