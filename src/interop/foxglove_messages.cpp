#include "palpate/interop/foxglove_messages.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/file_name.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"

#include "interop/foxglove_schemas.h"

namespace palpate {
namespace {

constexpr const char* kHandFrame = "hand";  // of a hand without a URDF
constexpr double kMPerMm = 1e-3;
constexpr std::int64_t kFoxgloveUsPerS = 1'000'000;
constexpr std::int64_t kFoxgloveNsPerUs = 1000;
constexpr std::size_t kMaxMeshBytes = 8U << 20;
constexpr std::size_t kPointBytes = 20;
constexpr double kLinkGrey = 0.72;
constexpr int kLogInfo = 2;
constexpr int kLogWarning = 3;

// A time before 1970 has no form in these messages.
std::pair<std::int64_t, std::int64_t> foxgloveTime(std::int64_t timeUs) {
  const std::int64_t us = std::max<std::int64_t>(timeUs, 0);
  return {us / kFoxgloveUsPerS, us % kFoxgloveUsPerS * kFoxgloveNsPerUs};
}

void appendTime(std::string& out, std::int64_t timeUs) {
  const auto [seconds, nanoseconds] = foxgloveTime(timeUs);
  out += "{\"sec\":";
  appendNumber(out, seconds);
  out += ",\"nsec\":";
  appendNumber(out, nanoseconds);
  out += '}';
}

Json timeJson(std::int64_t timeUs) {
  const auto [seconds, nanoseconds] = foxgloveTime(timeUs);
  return Json::object().set("sec", seconds).set("nsec", nanoseconds);
}

// The parts of a vector, or of a quaternion.
template <typename Parts>
void appendParts(std::string& out, const Parts& parts) {
  for (int i = 0; i < parts.size(); ++i) {
    out += i == 0 ? '{' : ',';
    out += '"';
    out += "xyzw"[i];
    out += "\":";
    appendNumber(out, parts[i]);
  }
  out += '}';
}

Json vectorJson(const Eigen::Vector3d& vector) {
  return Json::object().set("x", vector.x()).set("y", vector.y()).set("z", vector.z());
}

Json poseJson(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.rotation());
  return Json::object()
      .set("position", vectorJson(pose.translation() * kMPerMm))
      .set("orientation",
           Json::object()
               .set("x", turn.x())
               .set("y", turn.y())
               .set("z", turn.z())
               .set("w", turn.w()));
}

// A name as part of a topic: small letters, digits and '_', as ROS has them; a name that is taken
// gets a number.
std::string topicName(std::string_view name, std::set<std::string>& taken) {
  std::string plain;
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x80 && std::isalnum(code) != 0)
      plain += static_cast<char>(std::tolower(code));
    else if (!plain.empty() && plain.back() != '_')
      plain += '_';
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain.front())) != 0)
    plain.insert(0, "n");
  std::string unique = plain;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = plain + "_" + std::to_string(i);
  return unique;
}

void putFloat(std::string& bytes, double value) {
  static_assert(std::endian::native == std::endian::little);
  const auto number = static_cast<float>(value);
  std::array<char, sizeof number> raw{};
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

std::unique_ptr<const HandGeometry> foxgloveGeometry(const HandDescription& hand,
                                                     std::string& problem) {
  if (!hasGeometry(hand)) return nullptr;
  try {
    return std::make_unique<const HandGeometry>(describeGeometry(hand));
  } catch (const std::exception& error) {
    problem = error.what();
    return nullptr;
  }
}

bool isWarning(const std::string& kind) {
  constexpr std::array<std::string_view, 4> kWarnings = {"gap", "fault", "alarm", "error"};
  return std::find(kWarnings.begin(), kWarnings.end(), kind) != kWarnings.end();
}

// Empty: the file can't be read, or is too large for a message.
std::string meshBytes(const std::filesystem::path& path) {
  try {
    return readTextFile(path, kMaxMeshBytes);
  } catch (const Error&) {
    return {};
  }
}

void addShape(Json& entity, const LinkShape& shape) {
  const Json grey =
      Json::object().set("r", kLinkGrey).set("g", kLinkGrey).set("b", kLinkGrey).set("a", 1.0);
  Json body = Json::object().set("pose", poseJson(shape.linkFromShape));
  if (shape.kind != LinkShape::Kind::kMesh) body.set("size", vectorJson(shape.sizeMm * kMPerMm));
  switch (shape.kind) {
    case LinkShape::Kind::kBox:
      entity.set("cubes", Json::array().push(body.set("color", grey)));
      return;
    case LinkShape::Kind::kSphere:
      entity.set("spheres", Json::array().push(body.set("color", grey)));
      return;
    case LinkShape::Kind::kCylinder:
      entity.set("cylinders",
                 Json::array().push(
                     body.set("bottom_scale", 1.0).set("top_scale", 1.0).set("color", grey)));
      return;
    case LinkShape::Kind::kMesh:
      break;
  }
  const std::string bytes = meshBytes(shape.mesh);
  if (bytes.empty()) return;
  std::string text;
  appendBase64(text, bytes.data(), bytes.size());
  entity.set(
      "models",
      Json::array().push(
          body.set("scale", vectorJson(shape.sizeMm * kMPerMm))
              .set("color", grey)
              .set("override_color", true)
              .set("url", "")
              .set("media_type",
                   lowerEndingOf(shape.mesh) == ".dae" ? "model/vnd.collada+xml" : "model/stl")
              .set("data", text)));
}

}  // namespace

FoxgloveColor foxgloveColor(double value) noexcept {
  // Viridis at 0, 1/4, 1/2, 3/4 and 1.
  constexpr std::array<std::array<double, 3>, 5> kViridis = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = (value > 0.0 ? std::min(value, 1.0) : 0.0) * (kViridis.size() - 1);
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(at), kViridis.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto mixed = [&](std::size_t i) {
    return static_cast<std::uint8_t>(
        std::lround(kViridis[low][i] * (1.0 - part) + kViridis[low + 1][i] * part));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

void appendBase64(std::string& out, const void* data, std::size_t size) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const unsigned char*>(data);
  out.reserve(out.size() + (size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t given = std::min<std::size_t>(3, size - i);
    const unsigned group = static_cast<unsigned>(bytes[i]) << 16 |
                           (given > 1 ? static_cast<unsigned>(bytes[i + 1]) << 8 : 0U) |
                           (given > 2 ? static_cast<unsigned>(bytes[i + 2]) : 0U);
    out += kDigits[group >> 18 & 63];
    out += kDigits[group >> 12 & 63];
    out += given > 1 ? kDigits[group >> 6 & 63] : '=';
    out += given > 2 ? kDigits[group & 63] : '=';
  }
}

FoxgloveMessages::FoxgloveMessages(HandDescription hand, FoxgloveImage image)
    : hand_(std::move(hand)), image_(image), countsOnly_(hand_.unit == "counts") {
  if (!hand_.layout) throw std::invalid_argument("FoxgloveMessages: the hand has no layout");
  geometry_ = foxgloveGeometry(hand_, geometryProblem_);
  std::set<std::string> taken;
  for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m) {
    const std::string name = topicName(hand_.matrixName(m), taken);
    frameIds_.push_back(Json("tactile/" + name).text(-1));
    addChannel(
        {"/tactile/" + name + "/image", "foxglove.RawImage", foxgloveImageSchema(hand_.unit)});
  }
  signals_ = addChannel({"/signals", "palpate.Signals", foxgloveSignalsSchema(hand_)});
  events_ = addChannel({"/events", "foxglove.Log", foxgloveLogSchema()});
  handJoints_ = shownJoints(hand_);
  for (const HandJoint& joint : handJoints_) jointNames_.push_back(Json(joint.name).text(-1));
  if (!hand_.axes.empty())
    joints_ = addChannel({"/joint_states", "foxglove.JointStates", foxgloveJointsSchema()});
  if (!geometry_) return;
  makeFrames();
  transforms_ = addChannel({"/tf", "foxglove.FrameTransforms", foxgloveTransformsSchema()});
  taxels_ =
      addChannel({"/hand/taxels", "foxglove.PointCloud", foxglovePointCloudSchema(hand_.unit)});
  if (!geometry_->description().shapes.empty())
    shapes_ = addChannel({"/hand/shapes", "foxglove.SceneUpdate", foxgloveSceneSchema(), true});
}

std::size_t FoxgloveMessages::addChannel(FoxgloveChannel channel) {
  channels_.push_back(std::move(channel));
  return channels_.size() - 1;
}

void FoxgloveMessages::makeFrames() {
  const GeometryDescription& hand = geometry_->description();
  for (const NamedLink& link : hand.links)
    frames_.push_back(
        {link.name, Json(link.name).text(-1), link.parent, link.place, link.placeFromLink});
  if (!frames_.empty()) return;
  frames_.push_back({kHandFrame, Json(kHandFrame).text(-1), std::nullopt, {}});
  for (std::size_t f = 0; f < hand.fingers.size(); ++f)
    for (std::size_t l = 0; l < hand.fingers[f].links.size(); ++l) {
      const std::string name = "finger_" + std::to_string(f) + "/link_" + std::to_string(l);
      frames_.push_back({name, Json(name).text(-1), 0, {f, l}});
    }
}

const FoxgloveMessages::Frame& FoxgloveMessages::frameAt(const LinkPlace& place) const {
  const auto found = std::find_if(
      frames_.begin(), frames_.end(), [&](const Frame& frame) { return frame.place == place; });
  return found == frames_.end() ? frames_.front() : *found;
}

FoxgloveColor FoxgloveMessages::colorOf(float value) const noexcept {
  return foxgloveColor(static_cast<double>(value) / static_cast<double>(hand_.maximumCounts));
}

std::string FoxgloveMessages::image(const TactileFrame& frame, std::size_t matrix) const {
  const MatrixLayout& layout = hand_.layout->matrix(matrix);
  const auto values = frame.allValues(matrix);
  std::string bytes;
  const char* encoding = image_ == FoxgloveImage::kColored ? "rgb8"
                         : countsOnly_                     ? "mono16"
                                                           : "32FC1";
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const float value = values(y, x);
      if (image_ == FoxgloveImage::kColored) {
        const FoxgloveColor color = layout.exists(y, x) ? colorOf(value) : FoxgloveColor{};
        for (const std::uint8_t part : {color.red, color.green, color.blue})
          bytes += static_cast<char>(part);
      } else if (countsOnly_) {
        const auto counts = static_cast<std::uint16_t>(
            value > 0.0F ? std::min(std::lround(value), static_cast<long>(UINT16_MAX)) : 0);
        bytes += static_cast<char>(counts & 0xFF);
        bytes += static_cast<char>(counts >> 8);
      } else {
        putFloat(bytes, static_cast<double>(value));
      }
    }
  std::string out = "{\"timestamp\":";
  appendTime(out, frame.hostUs);
  out += ",\"frame_id\":" + frameIds_[matrix] + ",\"width\":" + std::to_string(layout.columns) +
         ",\"height\":" + std::to_string(layout.rows) + ",\"encoding\":\"" + encoding +
         "\",\"step\":" + std::to_string(bytes.size() / static_cast<std::size_t>(layout.rows)) +
         ",\"data\":\"";
  appendBase64(out, bytes.data(), bytes.size());
  out += "\"}";
  return out;
}

std::string FoxgloveMessages::joints(const Sample& angles) const {
  std::string out = "{\"timestamp\":";
  appendTime(out, angles.hostUs);
  out += ",\"joints\":[";
  bool first = true;
  for (std::size_t i = 0; i < handJoints_.size(); ++i) {
    const HandJoint& joint = handJoints_[i];
    if (joint.axis && *joint.axis >= angles.values.size()) continue;
    const double position = joint.valueSi(angles.values);
    if (!std::isfinite(position)) continue;
    if (!std::exchange(first, false)) out += ',';
    out += "{\"name\":" + jointNames_[i] + ",\"position\":";
    appendNumber(out, position);
    out += '}';
  }
  out += "]}";
  return out;
}

std::string FoxgloveMessages::event(const Event& event) const {
  std::string text = event.text;
  if (event.matrix && *event.matrix >= 0)
    text = hand_.matrixName(static_cast<std::size_t>(*event.matrix)) + (text.empty() ? "" : ": ") +
           text;
  return Json::object()
      .set("timestamp", timeJson(event.tUs))
      .set("level", isWarning(event.kind) ? kLogWarning : kLogInfo)
      .set("message", text)
      .set("name", event.kind)
      .set("file", "")
      .set("line", 0)
      .text(-1);
}

bool FoxgloveMessages::setPose(const LiveResults& results) {
  pose_ = {};
  if (!geometry_) return false;
  const std::size_t numAxes = geometry_->description().numAxes;
  static const std::vector<double> kNoAngles;
  if (numAxes > 0 && !results.angles) return false;
  const std::vector<double>& angles = numAxes > 0 ? results.angles->values : kNoAngles;
  if (angles.size() != numAxes ||
      !std::all_of(angles.begin(), angles.end(), [](double deg) { return std::isfinite(deg); }))
    return false;
  geometry_->pose(angles, pose_);
  return true;
}

std::string FoxgloveMessages::transforms(std::int64_t timeUs) const {
  std::string stamp = "{\"timestamp\":";
  appendTime(stamp, timeUs);
  std::string out = "{\"transforms\":[";
  bool first = true;
  // The names are JSON texts.
  const auto add = [&](const std::string& parent,
                       const std::string& child,
                       const Eigen::Isometry3d& parentFromChild) {
    if (!std::exchange(first, false)) out += ',';
    out += stamp + ",\"parent_frame_id\":" + parent + ",\"child_frame_id\":" + child +
           ",\"translation\":";
    appendParts(out, Eigen::Vector3d(parentFromChild.translation() * kMPerMm));
    out += ",\"rotation\":";
    appendParts(out, Eigen::Quaterniond(parentFromChild.rotation()).coeffs());
    out += '}';
  };
  std::vector<Eigen::Isometry3d> baseFrom;
  for (const Frame& frame : frames_) {
    baseFrom.push_back(pose_.baseFrom(frame.place) * frame.placeFromFrame);
    if (frame.parent)
      add(frames_[*frame.parent].text,
          frame.text,
          baseFrom[*frame.parent].inverse(Eigen::Isometry) * baseFrom.back());
  }
  for (std::size_t m = 0; m < frameIds_.size(); ++m)
    add(frames_.front().text, frameIds_[m], pose_.baseFromMatrix(m));
  out += "]}";
  return out;
}

std::string FoxgloveMessages::taxels(const TactileFrame& frame) const {
  std::string bytes;
  const SensorLayout& layout = *hand_.layout;
  const std::vector<float>& values = frame.allValues();
  bytes.reserve(layout.numTaxels() * kPointBytes);
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    for (int y = 0; y < layout.matrix(m).rows; ++y)
      for (int x = 0; x < layout.matrix(m).columns; ++x) {
        if (!layout.matrix(m).exists(y, x)) continue;
        const std::size_t place =
            layout.offset(m) + static_cast<std::size_t>(y * layout.matrix(m).columns + x);
        const Eigen::Vector3d at = pose_.positionsMm()[place] * kMPerMm;
        for (int i = 0; i < 3; ++i) putFloat(bytes, at[i]);
        putFloat(bytes, static_cast<double>(values[place]));
        const FoxgloveColor color = colorOf(values[place]);
        for (const std::uint8_t part : {color.red, color.green, color.blue, std::uint8_t{255}})
          bytes += static_cast<char>(part);
      }
  std::string out = "{\"timestamp\":";
  appendTime(out, frame.hostUs);
  out +=
      ",\"frame_id\":" + frames_.front().text +
      ",\"pose\":{\"position\":{\"x\":0,\"y\":0,\"z\":0},"
      "\"orientation\":{\"x\":0,\"y\":0,\"z\":0,\"w\":1}},\"point_stride\":" +
      std::to_string(kPointBytes) +
      ",\"fields\":[{\"name\":\"x\",\"offset\":0,\"type\":7},"
      "{\"name\":\"y\",\"offset\":4,\"type\":7},{\"name\":\"z\",\"offset\":8,\"type\":7},"
      "{\"name\":\"value\",\"offset\":12,\"type\":7},"
      "{\"name\":\"red\",\"offset\":16,\"type\":1},{\"name\":\"green\",\"offset\":17,\"type\":1},"
      "{\"name\":\"blue\",\"offset\":18,\"type\":1},"
      "{\"name\":\"alpha\",\"offset\":19,\"type\":1}],\"data\":\"";
  appendBase64(out, bytes.data(), bytes.size());
  out += "\"}";
  return out;
}

std::string FoxgloveMessages::shapes(std::int64_t timeUs) const {
  Json entities = Json::array();
  if (geometry_) {
    const std::vector<LinkShape>& shapes = geometry_->description().shapes;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Frame& frame = frameAt(shapes[i].place);
      Json entity = Json::object()
                        .set("timestamp", timeJson(timeUs))
                        .set("frame_id", frame.name)
                        .set("id", "shape_" + std::to_string(i))
                        .set("lifetime", Json::object().set("sec", 0).set("nsec", 0))
                        .set("frame_locked", true);
      for (const char* empty : {"metadata",
                                "arrows",
                                "cubes",
                                "spheres",
                                "cylinders",
                                "lines",
                                "triangles",
                                "texts",
                                "models"})
        entity.set(empty, Json::array());
      LinkShape shape = shapes[i];
      shape.linkFromShape = frame.placeFromFrame.inverse(Eigen::Isometry) * shape.linkFromShape;
      addShape(entity, shape);
      entities.push(std::move(entity));
    }
  }
  return Json::object()
      .set("deletions", Json::array())
      .set("entities", std::move(entities))
      .text(-1);
}

}  // namespace palpate
