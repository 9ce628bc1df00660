// The elements of a .dsa recording, level by level (docs/dsa_format.md section 2).
#include <array>

#include "recording/dsa_document.h"

namespace palpate {

std::span<const DsaDocument::Child> DsaDocument::childrenOf(Node node) {
  constexpr auto sensorLeaf = [](std::string_view name, SensorField field) {
    return Child{name, Node::kLeaf, Leaf::kSensorField, field};
  };
  static constexpr std::array kDocument = {Child{"root", Node::kRoot}};
  static constexpr std::array kRoot = {Child{"sensor", Node::kSensor},
                                       Child{"data", Node::kData},
                                       Child{"temperatures", Node::kTemperatures},
                                       Child{"joint_angles", Node::kAngleList}};
  static constexpr std::array kSensor = {Child{"matrix", Node::kMatrix},
                                         sensorLeaf("generated_by", SensorField::kFirmware),
                                         sensorLeaf("serial_nr", SensorField::kSerial),
                                         sensorLeaf("num_matrices", SensorField::kNumMatrices),
                                         Child{"hw_revision", Node::kIgnored},
                                         Child{"converter_resolution", Node::kIgnored}};
  static constexpr std::array kMatrix = {sensorLeaf("cells_x", SensorField::kColumns),
                                         sensorLeaf("cells_y", SensorField::kRows),
                                         sensorLeaf("texel_width", SensorField::kPitchX),
                                         sensorLeaf("texel_height", SensorField::kPitchY),
                                         sensorLeaf("static_mask", SensorField::kStaticMask),
                                         sensorLeaf("dynamic_mask", SensorField::kDynamicMask),
                                         Child{"matrix_center_x", Node::kIgnored},
                                         Child{"matrix_center_y", Node::kIgnored},
                                         Child{"matrix_center_z", Node::kIgnored},
                                         Child{"theta_x", Node::kIgnored},
                                         Child{"theta_y", Node::kIgnored},
                                         Child{"theta_z", Node::kIgnored},
                                         Child{"output_unit", Node::kIgnored},
                                         Child{"hw_revision", Node::kIgnored},
                                         sensorLeaf("one_wire_uid", SensorField::kUniqueId),
                                         Child{"fullscale", Node::kIgnored}};
  static constexpr std::array kData = {Child{"frame", Node::kFrame},
                                       Child{"frame_count", Node::kLeaf, Leaf::kFrameCount}};
  static constexpr std::array kFrame = {Child{"time_stamp", Node::kLeaf, Leaf::kTime},
                                        Child{"frame_data", Node::kLeaf, Leaf::kFrameData}};
  static constexpr std::array kTemperatures = {
      Child{"temp", Node::kTemperature}, Child{"temp_count", Node::kLeaf, Leaf::kTemperatureCount}};
  static constexpr std::array kTemperature = {
      Child{"time_stamp", Node::kLeaf, Leaf::kTime},
      Child{"temp_data", Node::kLeaf, Leaf::kTemperatureData}};
  static constexpr std::array kAngleList = {Child{"angle", Node::kAngle},
                                            Child{"angle_count", Node::kLeaf, Leaf::kAngleCount}};
  static constexpr std::array kAngle = {Child{"time_stamp", Node::kLeaf, Leaf::kTime},
                                        Child{"angle_data", Node::kLeaf, Leaf::kAngleData}};
  switch (node) {
    case Node::kDocument:
      return kDocument;
    case Node::kRoot:
      return kRoot;
    case Node::kSensor:
      return kSensor;
    case Node::kMatrix:
      return kMatrix;
    case Node::kData:
      return kData;
    case Node::kFrame:
      return kFrame;
    case Node::kTemperatures:
      return kTemperatures;
    case Node::kTemperature:
      return kTemperature;
    case Node::kAngleList:
      return kAngleList;
    case Node::kAngle:
      return kAngle;
    case Node::kLeaf:
    case Node::kIgnored:
    case Node::kUnknown:
      break;
  }
  return {};
}

}  // namespace palpate
