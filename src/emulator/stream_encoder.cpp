#include "emulator/stream_encoder.h"

#include <span>
#include <string_view>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/stream_packets.h"

#include "emulator/wire_writer.h"

namespace palpate {
namespace {

constexpr std::int64_t kUsPerSecond = 1'000'000;

void appendText(std::vector<std::byte>& out, std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

// Seconds with a decimal point, so that the receiver takes them for seconds.
std::string secondsText(std::int64_t us) {
  return fixedText(static_cast<double>(us) / static_cast<double>(kUsPerSecond), 6);
}

template <typename Values>
std::string withNumbers(const Values& values, std::string begin) {
  for (const auto value : values) {
    if (!begin.empty() && begin.back() != '[') begin += ',';
    appendNumber(begin, value);
  }
  return begin;
}

std::vector<std::byte> floatsOf(const std::vector<double>& values) {
  WireWriter writer;
  for (const double value : values) writer.f32(value);
  return std::move(writer.data());
}

}  // namespace

StreamEncoder::StreamEncoder(const HandDescription& hand, EmulatedStreamFormat format)
    : hand_(hand), format_(format) {}

std::string StreamEncoder::description() const {
  Json matrices = Json::array();
  for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m) {
    Json matrix = Json::object();
    matrix.set("rows", std::int64_t{hand_.layout->matrix(m).rows});
    matrix.set("columns", std::int64_t{hand_.layout->matrix(m).columns});
    const int components = hand_.layout->matrix(m).touch.components;
    if (components != 1) matrix.set("components", std::int64_t{components});
    matrices.push(std::move(matrix));
  }
  Json about = Json::object();
  about.set("name", hand_.name);
  about.set("firmware", "emulated");
  about.set("matrices", std::move(matrices));
  return about.text(-1);
}

std::vector<std::byte> StreamEncoder::beginning() const {
  std::vector<std::byte> out;
  if (format_ == EmulatedStreamFormat::kBinary) {
    if (const std::string about = description(); about.size() <= kLongestStreamDescription)
      appendStreamPacket(
          out, StreamPacketType::kDescription, 0, 0, std::as_bytes(std::span(about)));
    return out;
  }
  appendText(out, "# emulated hand\n");
  if (format_ == EmulatedStreamFormat::kJson)
    appendText(out, "{\"description\":" + description() + "}\n");
  return out;
}

std::string StreamEncoder::frameJson(std::uint64_t number,
                                     std::int64_t deviceUs,
                                     std::span<const float> values) const {
  std::string line = "{\"header\":{\"seq\":" + std::to_string(static_cast<std::uint32_t>(number)) +
                     ",\"stamp\":{\"secs\":" + std::to_string(deviceUs / kUsPerSecond) +
                     ",\"nsecs\":" + std::to_string(deviceUs % kUsPerSecond * 1000) +
                     "},\"frame_id\":\"emulated\"},\"tactile_matrix\":[";
  for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m) {
    const MatrixLayout& matrix = hand_.layout->matrix(m);
    line += (m == 0 ? "" : ",");
    line += "{\"matrix_id\":" + std::to_string(m) +
            ",\"cells_x\":" + std::to_string(matrix.columns) +
            ",\"cells_y\":" + std::to_string(matrix.rows) + ",\"tactile_array\":[";
    line = withNumbers(values.subspan(hand_.layout->readingOffset(m), matrix.numReadings()),
                       std::move(line));
    line += "]}";
  }
  return line + "]}\n";
}

void StreamEncoder::appendFrame(std::vector<std::byte>& out,
                                std::uint64_t number,
                                std::int64_t deviceUs,
                                std::span<const float> values) const {
  const auto sequence = static_cast<std::uint32_t>(number);
  switch (format_) {
    case EmulatedStreamFormat::kBinary:
      return appendStreamFrame(out, sequence, static_cast<std::uint64_t>(deviceUs), values);
    case EmulatedStreamFormat::kLines:
      return appendText(
          out,
          withNumbers(values, "frame#" + std::to_string(sequence) + "," + secondsText(deviceUs)) +
              "\n");
    case EmulatedStreamFormat::kJson:
      return appendText(out, frameJson(number, deviceUs, values));
  }
}

void StreamEncoder::appendAngles(std::vector<std::byte>& out,
                                 std::int64_t deviceUs,
                                 const std::vector<double>& values) const {
  switch (format_) {
    case EmulatedStreamFormat::kBinary:
      return appendStreamPacket(out,
                                StreamPacketType::kAngles,
                                0,
                                static_cast<std::uint64_t>(deviceUs),
                                floatsOf(values));
    case EmulatedStreamFormat::kLines:
      return appendText(out, withNumbers(values, "angles," + secondsText(deviceUs)) + "\n");
    case EmulatedStreamFormat::kJson:
      return appendText(out, withNumbers(values, "{\"angles_deg\":[") + "]}\n");
  }
}

void StreamEncoder::appendTemperatures(std::vector<std::byte>& out,
                                       std::int64_t deviceUs,
                                       const std::vector<double>& degC) const {
  switch (format_) {
    case EmulatedStreamFormat::kBinary:
      return appendStreamPacket(out,
                                StreamPacketType::kTemperatures,
                                0,
                                static_cast<std::uint64_t>(deviceUs),
                                floatsOf(degC));
    case EmulatedStreamFormat::kLines:
      return appendText(out, withNumbers(degC, "temperatures," + secondsText(deviceUs)) + "\n");
    case EmulatedStreamFormat::kJson:
      return appendText(out, withNumbers(degC, "{\"temperatures_degc\":[") + "]}\n");
  }
}

}  // namespace palpate
