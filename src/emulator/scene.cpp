#include "palpate/emulator/scene.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr std::size_t kMostObjects = 100;
constexpr std::size_t kMaxSteps = 10'000;
constexpr std::uintmax_t kMaxBytes = 1u << 20;

// One JSON object of the file, with its path for error messages.
class Field {
 public:
  Field(Json json, std::string place, const fs::path& file)
      : json_(std::move(json)), place_(std::move(place)), file_(file) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(file_, (place_.empty() ? "the scene" : place_) + " " + what);
  }
  void only(std::initializer_list<std::string_view> known) const {
    if (!json_.isObject()) fail("isn't a JSON object");
    for (const std::string& key : json_.keys())
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        std::string list;
        for (const std::string_view name : known)
          list += (list.empty() ? "" : ", ") + std::string(name);
        fail("has an unknown key '" + key + "' (known: " + list + ")");
      }
  }
  bool has(std::string_view key) const { return json_.contains(key); }
  Field at(std::string_view key) const {
    return Field(json_.at(key), place_ + (place_.empty() ? "" : ".") + std::string(key), file_);
  }
  std::vector<Field> items(std::size_t most) const {
    if (!json_.isArray()) fail("isn't a JSON array");
    if (json_.size() > most) fail("has more than " + std::to_string(most) + " items");
    std::vector<Field> all;
    for (std::size_t i = 0; i < json_.size(); ++i)
      all.emplace_back(json_.at(i), place_ + "[" + std::to_string(i) + "]", file_);
    return all;
  }
  double number(double least, double most) const {
    if (!json_.isNumber()) fail("isn't a number");
    const double value = json_.asDouble();
    if (!(value >= least && value <= most))
      fail("is " + numberText(value) + ", not in " + numberText(least) + ".." + numberText(most));
    return value;
  }
  double number(std::string_view key, double otherwise, double least, double most) const {
    return has(key) ? at(key).number(least, most) : otherwise;
  }
  Vector3d vector(double most) const {
    const auto parts = items(3);
    if (parts.size() != 3) fail("is not three numbers");
    return {
        parts[0].number(-most, most), parts[1].number(-most, most), parts[2].number(-most, most)};
  }
  Vector3d vector(std::string_view key, double most) const {
    return has(key) ? at(key).vector(most) : Vector3d(Vector3d::Zero());
  }
  std::string text() const {
    if (!json_.isString()) fail("isn't a text");
    return json_.asString();
  }
  bool flag() const {
    if (!json_.isBool()) fail("is neither true nor false");
    return json_.asBool();
  }
  std::size_t index(std::string_view key, std::size_t count) const {
    if (!has(key)) return 0;
    const double value = at(key).number(0.0, static_cast<double>(count) - 1.0);
    if (value != std::floor(value)) at(key).fail("isn't a whole number");
    return static_cast<std::size_t>(value);
  }
  std::optional<std::size_t> matrix() const {
    if (!has("matrix")) return std::nullopt;
    return index("matrix", sdh2().layout->numMatrices());
  }
  bool isNumber() const { return json_.isNumber(); }

 private:
  Json json_;
  std::string place_;
  const fs::path& file_;
};

Eigen::Matrix3d rotationOf(const Vector3d& deg) {
  const Vector3d rad = deg * std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(rad.z(), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rad.y(), Vector3d::UnitY()) *
          Eigen::AngleAxisd(rad.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

constexpr double kMostMm = 10'000.0;

Shape shapeOf(const Field& field) {
  if (!field.has("shape")) field.fail("has no \"shape\"");
  Shape shape;
  try {
    shape.kind = shapeKind(field.at("shape").text());
  } catch (const std::invalid_argument& wrong) {
    field.at("shape").fail(wrong.what());
  }
  if (!field.has("size_mm")) field.fail("has no \"size_mm\"");
  const Field size = field.at("size_mm");
  std::vector<double> sizes;
  if (size.isNumber())
    sizes = {size.number(1.0, kMostMm)};
  else
    for (const Field& item : size.items(3)) sizes.push_back(item.number(1.0, kMostMm));
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

SceneObject objectOf(const Field& field) {
  field.only({"shape", "size_mm", "stiffness_n_per_mm3", "friction", "mass_kg", "fixed", "pose"});
  SceneObject object;
  object.shape = shapeOf(field);
  object.stiffnessNPerMm3 = field.number("stiffness_n_per_mm3", object.stiffnessNPerMm3, 1e-4, 1e4);
  object.friction = field.number("friction", object.friction, 0.0, 10.0);
  object.massKg = field.number("mass_kg", object.massKg, 0.0, 100.0);
  if (field.has("fixed")) object.fixed = field.at("fixed").flag();
  if (!field.has("pose")) return object;
  const Field pose = field.at("pose");
  pose.only({"position_mm", "rotation_deg"});
  object.positionMm = pose.vector("position_mm", kMostMm);
  object.rotation = rotationOf(pose.vector("rotation_deg", 360.0));
  return object;
}

void requirePreshape(const Field& field) {
  try {
    sdh2Preshape(field.text());
  } catch (const std::invalid_argument& wrong) {
    field.fail(std::string("is wrong: ") + wrong.what());
  }
}

constexpr double kMostSeconds = 1e6;

SceneAction actionOf(const Field& step, std::size_t objects) {
  const auto speed = [](const Field& field) {
    return field.number("velocity_deg_per_s", 30.0, 0.1, 83.0);
  };
  const auto object = [&](const Field& field) {
    if (objects == 0) field.fail("needs an object");
    return field.index("object", objects);
  };
  if (step.has("move")) {
    const Field at = step.at("move");
    at.only({"object", "by_mm", "duration_s"});
    return MoveObject{
        object(at), at.vector("by_mm", kMostMm), at.number("duration_s", 1.0, 0.001, kMostSeconds)};
  }
  if (step.has("turn")) {
    const Field at = step.at("turn");
    at.only({"object", "by_deg", "duration_s"});
    return TurnObject{object(at),
                      at.vector("by_deg", 36'000.0),
                      at.number("duration_s", 1.0, 0.001, kMostSeconds)};
  }
  if (step.has("grasp")) {
    const Field at = step.at("grasp");
    at.only({"preshape", "close", "velocity_deg_per_s"});
    GraspAction grasp;
    if (at.has("preshape")) {
      requirePreshape(at.at("preshape"));
      grasp.preshape = at.at("preshape").text();
    }
    grasp.close = at.number("close", 1.0, 0.0, 1.0);
    grasp.velocityDegPerS = speed(at);
    return grasp;
  }
  if (step.has("release")) {
    const Field at = step.at("release");
    at.only({"velocity_deg_per_s"});
    return ReleaseAction{speed(at)};
  }
  if (step.has("load")) {
    const Field at = step.at("load");
    at.only({"object", "force_n", "torque_nmm", "duration_s"});
    return LoadObject{object(at),
                      at.vector("force_n", 1000.0),
                      at.vector("torque_nmm", 1e5),
                      at.number("duration_s", 0.0, 0.0, kMostSeconds)};
  }
  if (step.has("temperature")) {
    const Field at = step.at("temperature");
    at.only({"ambient_c"});
    return SetTemperature{at.number("ambient_c", 34.0, -20.0, 90.0)};
  }
  if (step.has("threshold")) {
    const Field at = step.at("threshold");
    at.only({"matrix", "counts"});
    return SetSceneThreshold{at.matrix(), static_cast<int>(at.number("counts", 0.0, 0.0, 4095.0))};
  }
  if (step.has("sensitivity")) {
    const Field at = step.at("sensitivity");
    at.only({"matrix", "value"});
    return SetSceneSensitivity{at.matrix(), at.number("value", 0.5, 0.0, 1.0)};
  }
  step.fail(
      "doesn't say what happens: give one of move, turn, grasp, release, load, temperature, "
      "threshold, "
      "sensitivity");
}

}  // namespace

Scene parseScene(std::string_view text, const fs::path& name) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Error& error) {
    throw FormatError(name, error.what());
  }
  const Field root(json, "", name);
  root.only({"objects", "hand", "script", "description"});
  Scene scene;
  scene.name = name.stem().string();
  if (root.has("description")) scene.description = root.at("description").text();
  if (root.has("objects"))
    for (const Field& object : root.at("objects").items(kMostObjects))
      scene.objects.push_back(objectOf(object));
  if (root.has("hand")) {
    const Field hand = root.at("hand");
    hand.only({"preshape", "close"});
    if (hand.has("preshape")) {
      requirePreshape(hand.at("preshape"));
      scene.preshape = hand.at("preshape").text();
    }
    scene.close = hand.number("close", 0.0, 0.0, 1.0);
  }
  if (root.has("script"))
    for (const Field& step : root.at("script").items(kMaxSteps)) {
      step.only({"at_s",
                 "move",
                 "turn",
                 "grasp",
                 "release",
                 "load",
                 "temperature",
                 "threshold",
                 "sensitivity"});
      if (!step.has("at_s")) step.fail("has no \"at_s\"");
      scene.script.push_back(
          {step.at("at_s").number(0.0, kMostSeconds), actionOf(step, scene.objects.size())});
    }
  std::stable_sort(scene.script.begin(),
                   scene.script.end(),
                   [](const ScriptStep& a, const ScriptStep& b) { return a.atS < b.atS; });
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

Scene loadScene(const std::string& nameOrFile, const fs::path& folder) {
  const bool isFile = nameOrFile.find('/') != std::string::npos || nameOrFile.ends_with(".json");
  const fs::path path = isFile ? fs::path(nameOrFile) : folder / (nameOrFile + ".json");
  std::error_code failure;
  if (!isFile && !fs::exists(path, failure)) {
    std::string known;
    for (const std::string& name : sceneNames(folder)) known += (known.empty() ? "" : ", ") + name;
    throw FileError(path, "no scene '" + nameOrFile + "'; there are: " + known);
  }
  if (!fs::is_regular_file(path, failure)) throw FileError(path, "no such file");
  return parseScene(readTextFile(path, kMaxBytes), path);
}

}  // namespace palpate
