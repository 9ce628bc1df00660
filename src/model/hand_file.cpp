#include "palpate/model/hand_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json_field.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"

#include "model/built_in_hands.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMatrices = 64;
constexpr std::int64_t kMaxMatrixSide = 256;
constexpr std::size_t kMaxAxes = 256;
constexpr std::size_t kMaxTemperatureSensors = 256;
constexpr std::size_t kMaxPreshapes = 256;
constexpr std::size_t kMaxJoints = 256;
constexpr double kFarMm = 1e5;           // no part of a hand is farther away
constexpr double kMaxHandCounts = 1e9;   // of a value of a taxel, in its unit
constexpr double kPerpendicular = 1e-6;  // largest error of unit vectors

// The name at a key, which must be one line that is not empty.
std::string nameAt(const JsonField& field, std::string_view key) {
  const JsonField at = field.required(key);
  std::string name = at.text();
  if (name.empty()) at.fail("is empty");
  if (name.size() > 200) at.fail("is longer than 200 bytes");
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
    at.fail("contains a control character");
  return name;
}

std::string textAt(const JsonField& field, std::string_view key, std::string otherwise = {}) {
  return field.has(key) ? field.at(key).text() : otherwise;
}

// Rows of "#" (a taxel) and "." (none), from row 0 on.
Mask maskOf(const JsonField& field, int rows, int columns) {
  const std::vector<JsonField> lines = field.items(static_cast<std::size_t>(kMaxMatrixSide));
  if (lines.size() != static_cast<std::size_t>(rows))
    field.fail("has " + counted(lines.size(), "row") + " instead of " + std::to_string(rows));
  Mask mask;
  for (const JsonField& line : lines) {
    const std::string row = line.text();
    if (row.size() != static_cast<std::size_t>(columns))
      line.fail("has " + std::to_string(row.size()) + " characters instead of " +
                std::to_string(columns));
    for (const char c : row) {
      if (c != '#' && c != '.')
        line.fail("contains something else than '#' (taxel) and '.' (none)");
      mask.push_back(c == '#' ? 1 : 0);
    }
  }
  if (std::count(mask.begin(), mask.end(), 1) == 0) field.fail("leaves no taxel");
  return mask;
}

// One number, or [along a row, along a column].
TaxelPitch pitchOf(const JsonField& field) {
  constexpr double kMinMm = 0.01, kMaxMm = 1000.0;
  if (!field.json().isArray()) return field.number(kMinMm, kMaxMm);
  const std::vector<double> both = field.numbers(2, kMinMm, kMaxMm);
  return {both[0], both[1]};
}

MatrixLayout layoutOf(const JsonField& field) {
  const auto rows = static_cast<int>(field.required("rows").integer(1, kMaxMatrixSide));
  const auto columns = static_cast<int>(field.required("columns").integer(1, kMaxMatrixSide));
  MatrixLayout layout = MatrixLayout::full(rows, columns, pitchOf(field.required("pitch_mm")));
  if (field.has("mask")) layout.staticMask = maskOf(field.at("mask"), layout.rows, layout.columns);
  return layout;
}

std::array<double, 3> vectorOf(const JsonField& field, double most) {
  const std::vector<double> parts = field.numbers(3, -most, most);
  return {parts[0], parts[1], parts[2]};
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<double, 3> unitVectorOf(const JsonField& field) {
  std::array<double, 3> vector = vectorOf(field, 1.0 + kPerpendicular);
  if (std::abs(dot(vector, vector) - 1.0) > kPerpendicular) field.fail("isn't of length 1");
  return vector;
}

MatrixSurface surfaceOf(const JsonField& field, const MatrixLayout& layout) {
  field.only({"link", "origin_mm", "x_axis", "y_axis", "bend", "taxels"});
  MatrixSurface surface;
  if (field.has("link")) surface.link = nameAt(field, "link");
  if (field.has("taxels")) {
    if (field.has("origin_mm") || field.has("x_axis") || field.has("y_axis") || field.has("bend"))
      field.fail(
          "has both \"taxels\" and \"origin_mm\", \"x_axis\", \"y_axis\" or \"bend\"; give one");
    const JsonField list = field.at("taxels");
    const std::vector<JsonField> taxels = list.items(layout.numCells());
    if (taxels.size() != layout.numCells())
      list.fail("has " + counted(taxels.size(), "item") + " instead of " +
                std::to_string(layout.numCells()) + " (one per place, row by row)");
    for (const JsonField& taxel : taxels) {
      taxel.only({"position_mm", "normal"});
      surface.taxels.push_back({vectorOf(taxel.required("position_mm"), kFarMm),
                                unitVectorOf(taxel.required("normal"))});
    }
    return surface;
  }
  surface.originMm = vectorOf(field.required("origin_mm"), kFarMm);
  surface.xAxis = unitVectorOf(field.required("x_axis"));
  surface.yAxis = unitVectorOf(field.required("y_axis"));
  if (std::abs(dot(surface.xAxis, surface.yAxis)) > kPerpendicular)
    field.at("y_axis").fail("isn't perpendicular to x_axis");
  if (!field.has("bend")) return surface;
  const JsonField bend = field.at("bend");
  bend.only({"row", "radius_mm", "effective_radius_mm"});
  surface.bendRow = bend.required("row").number(-1000.0, 1000.0);
  surface.bendRadiusMm = bend.required("radius_mm").number(0.1, kFarMm);
  surface.effectiveBendRadiusMm =
      bend.number("effective_radius_mm", surface.bendRadiusMm, 0.1, kFarMm);
  return surface;
}

// Keys that a matrix doesn't have are those of the hand.
TouchRule touchRuleOf(const JsonField& root, const JsonField& matrix) {
  const auto of = [&](const char* key) -> const JsonField& {
    return matrix.has(key) ? matrix : root;
  };
  const auto flag = [&](const char* key, bool otherwise) {
    return of(key).has(key) ? of(key).at(key).flag() : otherwise;
  };
  TouchRule rule;
  rule.components = static_cast<int>(of("components").integer("components", 1, 1, 3));
  if (rule.components == 2) of("components").at("components").fail("is neither 1 nor 3");
  rule.isSigned = flag("signed", rule.components == 3);
  rule.threshold =
      static_cast<float>(of("touch_threshold").number("touch_threshold", 0.0, 0.0, kMaxHandCounts));
  rule.sigmas = static_cast<float>(of("touch_sigma").number("touch_sigma", 0.0, 0.0, 1000.0));
  return rule;
}

// The full scale of a matrix is at most that of the hand, its saturation at most its full scale.
void readScale(const JsonField& item, const HandDescription& hand, MatrixDescription& matrix) {
  const auto most = static_cast<double>(hand.maximumCounts);
  if (item.has("full_scale"))
    matrix.maximumCounts = static_cast<float>(item.at("full_scale").number(1e-6, most));
  const auto full = static_cast<double>(matrix.maximumCounts.value_or(hand.maximumCounts));
  if (item.has("saturation"))
    matrix.saturationCounts = static_cast<float>(item.at("saturation").number(1e-6, full));
  else if (matrix.maximumCounts)
    matrix.saturationCounts = std::min(*matrix.maximumCounts, hand.saturationCounts);
}

void readMatrices(const JsonField& root, HandDescription& hand, HandFile& file) {
  const JsonField list = root.required("matrices");
  const std::vector<JsonField> items = list.items(kMaxMatrices);
  if (items.empty()) list.fail("is empty");
  std::vector<MatrixLayout> layouts;
  std::set<std::string> names;
  for (std::size_t m = 0; m < items.size(); ++m) {
    const JsonField& item = items[m];
    item.only({"name",
               "short_name",
               "finger",
               "segment",
               "rows",
               "columns",
               "pitch_mm",
               "mask",
               "full_scale",
               "saturation",
               "components",
               "signed",
               "touch_threshold",
               "touch_sigma",
               "picture",
               "temperature_sensor",
               "surface"});
    MatrixDescription matrix;
    matrix.name = nameAt(item, "name");
    if (!names.insert(matrix.name).second) item.at("name").fail("is used twice");
    matrix.shortName = item.has("short_name") ? nameAt(item, "short_name") : matrix.name;
    matrix.finger =
        static_cast<int>(item.integer("finger", static_cast<std::int64_t>(m), 0, kMaxMatrices - 1));
    matrix.segment = textAt(item, "segment");
    layouts.push_back(layoutOf(item));
    readScale(item, hand, matrix);
    layouts.back().touch = touchRuleOf(root, item);
    if (item.has("picture")) {
      const JsonField picture = item.at("picture");
      picture.only({"column", "row"});
      matrix.pictureColumn = static_cast<int>(picture.required("column").integer(0, 63));
      matrix.pictureRow = static_cast<int>(picture.required("row").integer(0, 63));
      for (const MatrixDescription& other : hand.matrices)
        if (other.pictureColumn == matrix.pictureColumn && other.pictureRow == matrix.pictureRow)
          picture.fail("is the place of " + other.name + ", too");
    } else {
      matrix.pictureColumn = static_cast<int>(m);
    }
    if (item.has("temperature_sensor"))
      matrix.temperatureSensor =
          item.at("temperature_sensor").index(hand.temperatureSensors.size());
    if (item.has("surface")) file.surfaces.push_back(surfaceOf(item.at("surface"), layouts.back()));
    hand.matrices.push_back(std::move(matrix));
  }
  if (!file.surfaces.empty() && file.surfaces.size() != items.size())
    list.fail("have a \"surface\" in " + std::to_string(file.surfaces.size()) + " of " +
              std::to_string(items.size()) + " matrices; give all or none");
  hand.layout = std::make_shared<SensorLayout>(std::move(layouts));
}

void readAxes(const JsonField& root, HandDescription& hand, HandFile& file) {
  if (!root.has("axes")) return;
  std::set<std::string> names, joints;
  for (const JsonField& item : root.at("axes").items(kMaxAxes)) {
    item.only({"name",
               "unit",
               "minimum",
               "maximum",
               "velocity",
               "acceleration",
               "maximum_torque_nmm",
               "maximum_force_n",
               "joints"});
    AxisDescription axis;
    axis.name = nameAt(item, "name");
    if (!names.insert(axis.name).second) item.at("name").fail("is used twice");
    const std::string unit = textAt(item, "unit", "deg");
    if (unit != "deg" && unit != "mm") item.at("unit").fail("is neither \"deg\" nor \"mm\"");
    axis.isSliding = unit == "mm";
    axis.minimumDeg = item.required("minimum").number(-kFarMm, kFarMm);
    axis.maximumDeg = item.required("maximum").number(-kFarMm, kFarMm);
    if (!(axis.maximumDeg > axis.minimumDeg)) item.at("maximum").fail("isn't above minimum");
    axis.maximumVelocityDegPerS = item.number("velocity", 0.0, 0.0, 1e6);
    axis.maximumAccelerationDegPerS2 = item.number("acceleration", 0.0, 0.0, 1e9);
    const char* load = axis.isSliding ? "maximum_force_n" : "maximum_torque_nmm";
    axis.maximumTorqueNmm = item.number(load, 0.0, 0.0, 1e9);
    file.axisJoints.emplace_back();
    if (item.has("joints"))
      for (const JsonField& joint : item.at("joints").items(kMaxJoints)) {
        if (!joints.insert(joint.text()).second) joint.fail("is moved by two axes");
        file.axisJoints.back().push_back(joint.text());
      }
    hand.axes.push_back(std::move(axis));
  }
}

void readPreshapes(const JsonField& root, const HandDescription& hand, HandFile& file) {
  if (!root.has("preshapes")) return;
  std::set<std::string> names;
  for (const JsonField& item : root.at("preshapes").items(kMaxPreshapes)) {
    item.only({"name", "title", "joints"});
    Preshape preshape;
    preshape.name = nameAt(item, "name");
    if (!names.insert(preshape.name).second) item.at("name").fail("is used twice");
    preshape.title = item.has("title") ? nameAt(item, "title") : preshape.name;
    const JsonField list = item.required("joints");
    const std::vector<JsonField> joints = list.items(kMaxAxes);
    if (joints.size() != hand.axes.size())
      list.fail("has " + counted(joints.size(), "item") + " for " +
                std::to_string(hand.axes.size()) + " axes");
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::vector<double> line = joints[i].numbers(2, -kFarMm, kFarMm);
      const AxisDescription& axis = hand.axes[i];
      for (const double end : {line[0], line[0] + line[1]})
        if (end < axis.minimumDeg || end > axis.maximumDeg)
          joints[i].fail("leaves the range of axis '" + shortened(axis.name) + "'");
      preshape.joints.push_back({line[0], line[1]});
    }
    file.preshapes.push_back(std::move(preshape));
  }
}

MatrixCharacteristics matrixCharacteristicsOf(const JsonField& item, const MatrixLayout& layout) {
  item.only(
      {"noise", "rest", "taxel_sd", "shared_sd", "sensitivity", "threshold_counts", "raised"});
  MatrixCharacteristics matrix;
  const auto line = [](const JsonField& field, const char* key) {
    return field.required(key).number(-kMaxHandCounts, kMaxHandCounts);
  };
  const JsonField noise = item.required("noise");
  noise.only({"slope", "intercept", "rmse"});
  matrix.noiseSlope = line(noise, "slope");
  matrix.noiseIntercept = line(noise, "intercept");
  matrix.noiseRmse = noise.required("rmse").number(0.0, kMaxHandCounts);
  const JsonField rest = item.required("rest");
  rest.only({"slope", "intercept"});
  matrix.restSlope = line(rest, "slope");
  matrix.restIntercept = line(rest, "intercept");
  matrix.taxelSd = item.required("taxel_sd").number(0.0, kMaxHandCounts);
  matrix.sharedSd = item.number("shared_sd", 0.0, 0.0, kMaxHandCounts);
  matrix.sensitivity = item.number("sensitivity", 0.5, 0.0, 1.0);
  matrix.thresholdCounts = static_cast<int>(item.integer("threshold_counts", 0, 0, 65535));
  if (!item.has("raised")) return matrix;
  for (const JsonField& raised : item.at("raised").items(layout.numCells())) {
    raised.only({"row", "column", "intercept", "slope", "sd"});
    const std::size_t row = raised.required("row").index(static_cast<std::size_t>(layout.rows));
    const std::size_t column =
        raised.required("column").index(static_cast<std::size_t>(layout.columns));
    matrix.raised.push_back({row * static_cast<std::size_t>(layout.columns) + column,
                             line(raised, "intercept"),
                             line(raised, "slope"),
                             raised.required("sd").number(0.0, kMaxHandCounts)});
  }
  return matrix;
}

SensorCharacteristics characteristicsOf(const JsonField& field, const SensorLayout& layout) {
  field.only({"matrices",
              "pressure_plane",
              "counts_per_mean",
              "threshold_kpa",
              "largest_counts",
              "neighbour_fraction",
              "lag_s",
              "creep_fraction",
              "creep_s",
              "release_s"});
  SensorCharacteristics sensor;
  const JsonField list = field.required("matrices");
  const std::vector<JsonField> items = list.items(kMaxMatrices);
  if (items.size() != layout.numMatrices())
    list.fail("has " + counted(items.size(), "item") + " for " +
              std::to_string(layout.numMatrices()) + " matrices");
  for (std::size_t m = 0; m < items.size(); ++m)
    sensor.matrices.push_back(matrixCharacteristicsOf(items[m], layout.matrix(m)));
  const std::vector<double> plane =
      field.required("pressure_plane").numbers(4, -kMaxHandCounts, kMaxHandCounts);
  std::copy(plane.begin(), plane.end(), sensor.pressure);
  sensor.countsPerMean = field.number("counts_per_mean", 1.0, 1e-6, 1e6);
  sensor.thresholdKpa = field.number("threshold_kpa", 0.0, 0.0, 1e6);
  sensor.largestCounts = field.required("largest_counts").number(1.0, kMaxHandCounts);
  sensor.neighbourFraction = field.number("neighbour_fraction", 0.0, 0.0, 0.25);
  if (field.has("lag_s")) {
    const std::vector<double> lag = field.at("lag_s").numbers(2, 0.0, 3600.0);
    sensor.lag1S = lag[0];
    sensor.lag2S = lag[1];
  }
  sensor.creepFraction = field.number("creep_fraction", 0.0, 0.0, 10.0);
  sensor.creepS = field.number("creep_s", 1.0, 1e-3, 1e6);
  sensor.releaseS = field.number("release_s", 0.0, 0.0, 3600.0);
  return sensor;
}

PinchDescription pinchOf(const JsonField& field, const HandDescription& hand) {
  field.only({"pads",
              "other_pads",
              "second_pad_gain",
              "full_scale",
              "image_size",
              "largest_counts",
              "grip_axes"});
  const auto pair = [&](const JsonField& at) -> std::array<std::size_t, 2> {
    const std::vector<JsonField> both = at.items(2);
    if (both.size() != 2) at.fail("are not two matrices");
    const std::size_t first = both[0].index(hand.matrices.size());
    const std::size_t second = both[1].index(hand.matrices.size());
    if (first == second) at.fail("names one matrix twice");
    return {first, second};
  };
  PinchDescription pinch;
  pinch.pads = pair(field.required("pads"));
  if (field.has("other_pads"))
    for (const JsonField& other : field.at("other_pads").items(kMaxMatrices))
      pinch.otherPads.push_back(pair(other));
  pinch.secondPadGain = field.number("second_pad_gain", 1.0, 1e-3, 1e3);
  pinch.fullScaleCounts = field.number(
      "full_scale", static_cast<double>(hand.maximumCounts) + 1.0, 1e-6, kMaxHandCounts);
  int side = 1;
  for (const std::size_t pad : pinch.pads)
    side = std::max({side, hand.layout->matrix(pad).rows, hand.layout->matrix(pad).columns});
  pinch.imageSize = static_cast<int>(field.integer("image_size", side, side, 1024));
  const double full = static_cast<double>(hand.maximumCounts);
  pinch.largestCounts = {full, full};
  if (field.has("largest_counts")) {
    const std::vector<double> largest = field.at("largest_counts").numbers(2, 1e-6, kMaxHandCounts);
    pinch.largestCounts = {largest[0], largest[1]};
  }
  if (field.has("grip_axes"))
    for (const JsonField& axis : field.at("grip_axes").items(kMaxAxes))
      pinch.gripAxes.push_back(axis.index(hand.axes.size()));
  return pinch;
}

}  // namespace

HandDescription parseHand(const std::string& json,
                          const std::string& urdf,
                          const fs::path& source) {
  const JsonField root = JsonField::parse(json, source, "the hand");
  root.only({"format",
             "version",
             "name",
             "maker",
             "sources",
             "unit",
             "full_scale",
             "saturation",
             "components",
             "signed",
             "touch_threshold",
             "touch_sigma",
             "matrices",
             "axes",
             "temperature_sensors",
             "preshapes",
             "characteristics",
             "pinch",
             "urdf",
             "controller"});
  if (root.required("format").text() != "palpate-hand")
    root.at("format").fail("is not \"palpate-hand\"");
  if (const std::int64_t version = root.required("version").integer(1, 1'000'000); version != 1)
    root.at("version").fail("is " + std::to_string(version) +
                            "; this program reads version 1. A newer Palpate wrote this file.");
  HandDescription hand;
  auto file = std::make_shared<HandFile>();
  file->json = json;
  hand.name = nameAt(root, "name");
  hand.maker = textAt(root, "maker");
  if (root.has("sources"))
    for (const JsonField& line : root.at("sources").items(1000)) line.text();
  file->controller = textAt(root, "controller");
  if (root.has("unit")) hand.unit = nameAt(root, "unit");
  hand.maximumCounts = static_cast<float>(root.required("full_scale").number(1e-6, kMaxHandCounts));
  hand.saturationCounts = static_cast<float>(root.number("saturation",
                                                         static_cast<double>(hand.maximumCounts),
                                                         1e-6,
                                                         static_cast<double>(hand.maximumCounts)));
  if (root.has("temperature_sensors"))
    for (const JsonField& sensor : root.at("temperature_sensors").items(kMaxTemperatureSensors)) {
      sensor.only({"name"});
      hand.temperatureSensors.push_back({nameAt(sensor, "name")});
    }
  readMatrices(root, hand, *file);
  readAxes(root, hand, *file);
  readPreshapes(root, hand, *file);
  if (root.has("characteristics"))
    file->characteristics = characteristicsOf(root.at("characteristics"), *hand.layout);
  if (root.has("pinch")) file->pinch = pinchOf(root.at("pinch"), hand);
  if (root.has("urdf")) {
    if (urdf.empty()) root.at("urdf").fail("names a file that is empty or missing");
    file->urdf = urdf;
  } else {
    for (const MatrixSurface& surface : file->surfaces)
      if (!surface.link.empty())
        root.fail("mounts a matrix on link '" + shortened(surface.link) +
                  "' but names no \"urdf\"");
    for (std::size_t i = 0; i < hand.axes.size(); ++i)
      if (!file->axisJoints[i].empty())
        root.at("axes").fail("name joints, but the hand names no \"urdf\"");
  }
  hand.file = std::move(file);
  return hand;
}

HandDescription readHandFolder(const fs::path& folder) {
  std::error_code failure;
  const bool named = folder.extension() == ".json" && !fs::is_directory(folder, failure);
  const fs::path path = named ? folder : folder / "hand.json";
  const std::string json = readTextFile(path, kHandFileByteLimit);
  const JsonField root = JsonField::parse(json, path, "the hand");
  std::string urdf;
  if (root.has("urdf")) {
    const JsonField name = root.at("urdf");
    const fs::path file = name.text();
    constexpr std::size_t kLongestName = 255;  // of a file
    if (file.empty() || file.native().size() > kLongestName || file.has_root_path() ||
        file.has_parent_path())
      name.fail("isn't the name of a file in the folder of the hand");
    urdf = readTextFile(path.parent_path() / file, kHandFileByteLimit);
  }
  HandDescription hand = parseHand(json, urdf, path);
  auto file = std::make_shared<HandFile>(*hand.file);
  file->folder = path.parent_path();
  hand.file = std::move(file);
  return hand;
}

std::map<std::string, std::string> handMeta(const HandDescription& hand) {
  std::map<std::string, std::string> meta{{"hand", hand.name}};
  if (!hand.file) return meta;
  meta["hand_json"] = hand.file->json;
  if (!hand.file->urdf.empty()) meta["hand_urdf"] = hand.file->urdf;
  return meta;
}

HandDescription recordedHand(const std::map<std::string, std::string>& meta,
                             const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors) {
  const auto json = meta.find("hand_json");
  if (json != meta.end()) {
    try {
      const auto urdf = meta.find("hand_urdf");
      HandDescription hand = parseHand(
          json->second, urdf != meta.end() ? urdf->second : std::string(), "the recording's hand");
      const auto fits = [](std::size_t recorded, std::size_t described) {
        return recorded == 0 || recorded == described;
      };
      if (sameSizes(layout, *hand.layout) && fits(numAxes, hand.axes.size()) &&
          fits(numTemperatureSensors, hand.temperatureSensors.size())) {
        hand.layout = std::make_shared<SensorLayout>(layout);
        return hand;
      }
    } catch (const Error&) {  // of a newer version, or damaged: the data are readable without it
    }
  }
  return describeHand(layout, numAxes, numTemperatureSensors);
}

const std::vector<BuiltInHand>& builtInHands() {
  static const std::vector<BuiltInHand> hands = [] {
    std::vector<BuiltInHand> all;
    for (const BuiltInHandText& text : builtInHandTexts())
      all.push_back({text.key,
                     std::make_shared<const HandDescription>(parseHand(
                         text.json, text.urdf, fs::path("hands") / text.key / "hand.json"))});
    return all;
  }();
  return hands;
}

const HandDescription& builtInHand(std::string_view key) {
  std::string known;
  for (const BuiltInHand& each : builtInHands()) {
    if (each.key == key) return *each.hand;
    known += (known.empty() ? "" : ", ") + each.key;
  }
  throw std::invalid_argument("no hand '" + shortened(key) + "'; there are: " + known);
}

const HandDescription& defaultHand() {
  for (const BuiltInHand& each : builtInHands())
    if (!each.hand->file->controller.empty()) return *each.hand;
  throw std::logic_error("no built-in hand has a tactile controller");
}

fs::path userDataFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  if (data && *data) return fs::path(data) / "palpate";
  return home && *home ? fs::path(home) / ".local/share/palpate" : fs::path();
}

std::vector<fs::path> handFolders(const fs::path& dataFolder) {
  std::vector<fs::path> folders;
  if (const fs::path own = userDataFolder(); !own.empty()) folders.push_back(own / "hands");
  folders.push_back(dataFolder / "hands");
  return folders;
}

std::vector<KnownHand> knownHands(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> known;
  for (const fs::path& folder : folders) {
    std::error_code failure;
    fs::directory_iterator entry(folder, failure);
    for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
      std::error_code ignored;
      if (fs::is_regular_file(entry->path() / "hand.json", ignored))
        known.emplace(entry->path().filename().string(), entry->path());
    }
  }
  for (const BuiltInHand& each : builtInHands()) known.emplace(each.key, fs::path());
  std::vector<KnownHand> list;
  for (const auto& [key, folder] : known) list.push_back({key, folder});
  return list;
}

HandDescription findHand(const std::string& name, const std::vector<fs::path>& folders) {
  std::error_code failure;
  const bool isPath = name.find('/') != std::string::npos || name.ends_with(".json");
  if (isPath || fs::is_regular_file(fs::path(name) / "hand.json", failure))
    return readHandFolder(name);
  std::string list;
  for (const KnownHand& each : knownHands(folders)) {
    if (each.key == name)
      return each.folder.empty() ? builtInHand(name) : readHandFolder(each.folder);
    list += (list.empty() ? "" : ", ") + each.key;
  }
  throw Error("no hand '" + shortened(name) + "'; there are: " + list +
              ". A folder with a hand.json is named by its path.");
}

}  // namespace palpate
