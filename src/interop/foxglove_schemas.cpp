#include "interop/foxglove_schemas.h"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "palpate/signals/characteristic_signals.h"

namespace palpate {
namespace {

using SchemaKeys = std::initializer_list<std::pair<const char*, Json>>;

Json schemaOf(const char* type, const std::string& description = {}) {
  Json schema = Json::object().set("type", type);
  if (!description.empty()) schema.set("description", description);
  return schema;
}
Json schemaNumber(const std::string& description = {}) { return schemaOf("number", description); }
Json schemaWhole(const std::string& description = {}) { return schemaOf("integer", description); }
Json schemaText(const std::string& description = {}) { return schemaOf("string", description); }

Json schemaObject(SchemaKeys keys) {
  Json properties = Json::object();
  for (const auto& [key, schema] : keys) properties.set(key, schema);
  return Json::object().set("type", "object").set("properties", std::move(properties));
}
Json schemaList(Json items) {
  return Json::object().set("type", "array").set("items", std::move(items));
}
Json schemaBytes(const std::string& description) {
  return schemaText(description).set("contentEncoding", "base64");
}
Json schemaTime() {
  return schemaObject({{"sec", schemaWhole("s since 1970")}, {"nsec", schemaWhole("ns")}});
}
// An object of numbers, a letter each.
Json schemaNumbers(std::string_view letters, const std::string& unit) {
  Json properties = Json::object();
  for (const char letter : letters) properties.set(std::string(1, letter), schemaNumber(unit));
  return Json::object().set("type", "object").set("properties", std::move(properties));
}
Json schemaVector(const std::string& unit) { return schemaNumbers("xyz", unit); }
Json schemaQuaternion() { return schemaNumbers("xyzw", {}); }
Json schemaPose() {
  return schemaObject({{"position", schemaVector("m")}, {"orientation", schemaQuaternion()}});
}
Json schemaColor() { return schemaNumbers("rgba", "0..1"); }
std::string titled(const char* title, Json schema) { return schema.set("title", title).text(-1); }

Json signalKeys() {
  Json keys = Json::object();
  keys.set("mean", schemaNumber("counts, of the active taxels"));
  keys.set("filtered_mean", schemaNumber("counts"));
  keys.set("min", schemaNumber("counts"));
  keys.set("max", schemaNumber("counts"));
  keys.set("sum", schemaNumber("counts"));
  keys.set("active", schemaWhole("number of active taxels"));
  keys.set("area_mm2", schemaNumber("mm^2"));
  return keys;
}

Json matrixKeys(const HandDescription& hand) {
  Json keys = signalKeys();
  if (hand.layout->decidesTouch())
    for (const SignalKind kind : signalKinds(true).subspan(kAllSignalKinds.size()))
      keys.set(std::string(signalName(kind)),
               schemaNumber(hand.unit + ", of the readings over the baseline"));
  keys.set("pressure_kpa", schemaNumber("kPa"));
  keys.set("force_n", schemaNumber("N"));
  keys.set("force_sd_n", schemaNumber("N, standard deviation"));
  keys.set("in_range", schemaWhole("1: the calibration covers it"));
  keys.set("slip",
           schemaObject({{"state", schemaText("state of the slip detection")},
                         {"slipping", schemaWhole("1: the alarm")},
                         {"confidence", schemaNumber("0..1")},
                         {"dx", schemaNumber("taxels, since the frame before")},
                         {"dy", schemaNumber("taxels, since the frame before")},
                         {"ref_dx", schemaNumber("taxels, since the reference")},
                         {"ref_dy", schemaNumber("taxels, since the reference")},
                         {"rotation_deg", schemaNumber("deg, since the frame before")},
                         {"ref_rotation_deg", schemaNumber("deg, since the reference")},
                         {"p_moved", schemaNumber("0..1")}}));
  return keys;
}

}  // namespace

std::string foxgloveImageSchema(const std::string& unit) {
  return titled("foxglove.RawImage",
                schemaObject({{"timestamp", schemaTime()},
                              {"frame_id", schemaText("frame of the matrix")},
                              {"width", schemaWhole("columns of taxels")},
                              {"height", schemaWhole("rows of taxels, the fingertip on top")},
                              {"encoding", schemaText("mono16, 32FC1 or rgb8")},
                              {"step", schemaWhole("bytes of a row")},
                              {"data", schemaBytes("values in " + unit)}}));
}

std::string foxglovePointCloudSchema(const std::string& unit) {
  return titled(
      "foxglove.PointCloud",
      schemaObject(
          {{"timestamp", schemaTime()},
           {"frame_id", schemaText()},
           {"pose", schemaPose()},
           {"point_stride", schemaWhole("bytes of a taxel")},
           {"fields",
            schemaList(schemaObject({{"name", schemaText()},
                                     {"offset", schemaWhole("bytes")},
                                     {"type", schemaWhole("1: u8, 7: float32")}}))},
           {"data", schemaBytes("a taxel after the other: x, y, z in m, value in " + unit)}}));
}

std::string foxgloveTransformsSchema() {
  return titled("foxglove.FrameTransforms",
                schemaObject({{"transforms",
                               schemaList(schemaObject({{"timestamp", schemaTime()},
                                                        {"parent_frame_id", schemaText()},
                                                        {"child_frame_id", schemaText()},
                                                        {"translation", schemaVector("m")},
                                                        {"rotation", schemaQuaternion()}}))}}));
}

std::string foxgloveSceneSchema() {
  const Json solid =
      schemaObject({{"pose", schemaPose()}, {"size", schemaVector("m")}, {"color", schemaColor()}});
  const Json cylinder = schemaObject({{"pose", schemaPose()},
                                      {"size", schemaVector("m")},
                                      {"bottom_scale", schemaNumber("0..1")},
                                      {"top_scale", schemaNumber("0..1")},
                                      {"color", schemaColor()}});
  const Json model = schemaObject({{"pose", schemaPose()},
                                   {"scale", schemaVector("")},
                                   {"color", schemaColor()},
                                   {"override_color", schemaOf("boolean")},
                                   {"url", schemaText()},
                                   {"media_type", schemaText()},
                                   {"data", schemaBytes("the file of the shape")}});
  const Json unused = schemaList(Json::object().set("type", "object"));
  const Json entity = schemaObject(
      {{"timestamp", schemaTime()},
       {"frame_id", schemaText("frame of the link")},
       {"id", schemaText()},
       {"lifetime", schemaObject({{"sec", schemaWhole()}, {"nsec", schemaWhole()}})},
       {"frame_locked", schemaOf("boolean")},
       {"metadata", schemaList(schemaObject({{"key", schemaText()}, {"value", schemaText()}}))},
       {"arrows", unused},
       {"cubes", schemaList(solid)},
       {"spheres", schemaList(solid)},
       {"cylinders", schemaList(cylinder)},
       {"lines", unused},
       {"triangles", unused},
       {"texts", unused},
       {"models", schemaList(model)}});
  return titled("foxglove.SceneUpdate",
                schemaObject({{"deletions", unused}, {"entities", schemaList(entity)}}));
}

std::string foxgloveJointsSchema() {
  return titled(
      "foxglove.JointStates",
      schemaObject({{"timestamp", schemaTime()},
                    {"joints",
                     schemaList(schemaObject(
                         {{"name", schemaText()},
                          {"position", schemaNumber("rad; m where the axis slides")}}))}}));
}

std::string foxgloveLogSchema() {
  return titled("foxglove.Log",
                schemaObject({{"timestamp", schemaTime()},
                              {"level", schemaWhole("2: information, 3: warning")},
                              {"message", schemaText()},
                              {"name", schemaText("kind of the event")},
                              {"file", schemaText()},
                              {"line", schemaWhole()}}));
}

std::string foxgloveSignalsSchema(const HandDescription& hand) {
  Json keys = Json::object();
  keys.set("t", schemaNumber("s since 1970, host time of the frame"));
  keys.set("sequence", schemaWhole("number of the frame since the stream was switched on"));
  keys.set("device_ms", schemaWhole("ms, the controller's clock"));
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    keys.set("m" + std::to_string(m),
             schemaOf("object", hand.matrixName(m)).set("properties", matrixKeys(hand)));
  keys.set("whole",
           schemaOf("object", "all matrices together")
               .set("properties", signalKeys().set("force_n", schemaNumber("N"))));
  keys.set("peak",
           schemaObject({{"matrix", schemaWhole()},
                         {"y", schemaWhole("row, 0 is the fingertip")},
                         {"x", schemaWhole("column")},
                         {"value", schemaNumber(hand.unit)},
                         {"counts", schemaNumber(hand.unit + ", the same as value")}}));
  keys.set("angles_deg", schemaList(schemaNumber("deg; mm where the axis slides")));
  keys.set("temperatures_degc", schemaList(schemaNumber("deg C")));
  keys.set("link",
           schemaObject({{"rate_hz", schemaNumber("Hz")},
                         {"age_ms", schemaNumber("ms")},
                         {"lost", schemaWhole("frames")},
                         {"bad_checksums", schemaWhole()},
                         {"saturated_frames", schemaWhole()},
                         {"queue", schemaWhole("frames")},
                         {"disk_h", schemaNumber("h")},
                         {"recording", schemaWhole("1: a recording is running")},
                         {"recorded_frames", schemaWhole()},
                         {"frames_on_disk", schemaWhole()},
                         {"alarms", schemaWhole()}}));
  return titled("palpate.Signals",
                Json::object().set("type", "object").set("properties", std::move(keys)));
}

}  // namespace palpate
