// The messages of a recording in an MCAP file, and their schemas: ROS 2 messages in CDR (OMG
// DDS-RTPS 2.5, section 10: plain CDR, little-endian, behind four bytes of encapsulation) with
// schemas `ros2msg`, and foxglove.RawImage in protobuf. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// A schema of a channel.
struct McapSchemaText {
  const char* name;      // "sensor_msgs/msg/Image"
  const char* encoding;  // "ros2msg", "protobuf"
  std::string data;
};
McapSchemaText mcapImageSchema();
McapSchemaText mcapRawImageSchema();
McapSchemaText mcapJointStateSchema();
McapSchemaText mcapLogSchema();
McapSchemaText mcapFrameSchema();   // palpate_msgs/msg/Frame
McapSchemaText mcapValuesSchema();  // palpate_msgs/msg/Values
McapSchemaText mcapSampleSchema();  // palpate_msgs/msg/Sample
McapSchemaText mcapEventSchema();   // palpate_msgs/msg/Event

// UTF-8 that any text comes back from: each NUL and each byte that is part of no valid character
// becomes the character U+10FF00 + byte. Bytes of such characters in the text itself do so, too.
std::string mcapSafeText(std::string_view text);
std::string mcapRestoredText(std::string_view safe);
// For those who only read it: such bytes become U+FFFD.
std::string mcapShownText(std::string_view text);

// Appends a message in CDR.
class CdrWriter {
 public:
  explicit CdrWriter(std::string& out) : out_(out) {
    constexpr std::string_view kLittleEndianCdr("\0\1\0\0", 4);
    out_ += kLittleEndianCdr;
    begin_ = out_.size();
  }
  template <typename Number>
  void number(Number value) {
    align(sizeof value);
    out_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    out_ += text;
    out_ += '\0';
  }
  // builtin_interfaces/Time of host time [us since 1970]; at the ends of its range it stays there.
  void time(std::int64_t timeUs);
  template <typename Number>
  void sequence(std::span<const Number> values) {
    number(static_cast<std::uint32_t>(values.size()));
    if (values.empty()) return;
    align(sizeof(Number));
    out_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }

 private:
  void align(std::size_t size) { out_.append((size - (out_.size() - begin_) % size) % size, '\0'); }

  std::string& out_;
  std::size_t begin_ = 0;
};

// Reads a message in CDR of either byte order. Reading past the end sets a failure that remains and
// returns zeros.
class CdrReader {
 public:
  explicit CdrReader(std::string_view message);
  bool ok() const noexcept { return ok_; }
  template <typename Number>
  Number number() {
    align(sizeof(Number));
    Number value{};
    const std::string_view bytes = take(sizeof(Number));
    if (ok_) std::memcpy(&value, bytes.data(), sizeof value);
    if constexpr (sizeof(Number) > 1)
      if (swapped_) value = swap(value);
    return value;
  }
  std::string_view text();
  // [us since 1970], rounded down.
  std::int64_t time();
  std::string_view bytes() { return take(number<std::uint32_t>()); }
  std::vector<double> doubles(std::size_t most);
  std::vector<std::string> texts(std::size_t most);

 private:
  template <typename Number>
  static Number swap(Number value) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, &value, sizeof value);
    for (std::size_t i = 0; i < sizeof value / 2; ++i)
      std::swap(bytes[i], bytes[sizeof value - 1 - i]);
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  void align(std::size_t size) { take((size - at_ % size) % size); }
  std::string_view take(std::size_t count);

  std::string_view bytes_;
  std::size_t at_ = 0;  // from behind the encapsulation
  bool ok_ = true;
  bool swapped_ = false;
};

// An image as a message has it; views of the message.
struct McapImage {
  std::int64_t timeUs = 0;
  std::string_view frameId;
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  std::string_view encoding;
  bool bigEndian = false;
  std::uint32_t step = 0;  // bytes of a row
  std::string_view data;
};
// Empty: the message is damaged, or its size is not that of its rows.
std::optional<McapImage> readRosImage(std::string_view message);
std::optional<McapImage> readRawImage(std::string_view message);
// Bytes per pixel of an encoding that is read (mono8, mono16, 8UC1, 16UC1, 32FC1), 0 of others.
std::size_t mcapPixelBytes(std::string_view encoding) noexcept;
// Puts rows x columns values into `out`.
void mcapPixels(const McapImage& image, float* out);

// What stands in a message before its pixels; append these after it.
void appendRosImageHead(std::string& out, const McapImage& image, std::string_view frameId);
void appendRawImageHead(std::string& out, const McapImage& image, std::string_view frameId);

}  // namespace palpate
