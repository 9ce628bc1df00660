#include "recording/mcap/mcap_messages.h"

#include <algorithm>
#include <bit>

namespace palpate {
namespace {

constexpr std::int64_t kMcapUsPerSecond = 1'000'000;
constexpr std::uint32_t kMcapEscapes = 0x10FF00;  // to 0x10FFFF

// -- UTF-8 --

// Length of the valid character at the begin of `text` (RFC 3629), 0 when there is none.
std::size_t mcapCharacterLength(std::string_view text) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = at(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((at(i) & 0xC0) != 0x80) return 0;
  const unsigned char second = at(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

// U+10FF00..U+10FFFF are F4 8F BC 80 to F4 8F BF BF.
bool isMcapEscape(std::string_view character) {
  return character.size() == 4 && character[0] == '\xF4' && character[1] == '\x8F' &&
         static_cast<unsigned char>(character[2]) >= 0xBC;
}

void appendMcapEscape(std::string& out, unsigned char byte) {
  out += "\xF4\x8F";
  out += static_cast<char>(0xBC + (byte >> 6));
  out += static_cast<char>(0x80 | (byte & 0x3F));
}

template <typename Replace>
std::string mcapReplaced(std::string_view text, Replace replace) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = mcapCharacterLength(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    if (length == 0 || character[0] == '\0' || isMcapEscape(character))
      for (const char byte : character) replace(out, static_cast<unsigned char>(byte));
    else
      out += character;
    text.remove_prefix(character.size());
  }
  return out;
}

// -- Protobuf (protobuf.dev, "Encoding") --

void putVarint(std::string& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
  out += static_cast<char>(value);
}
void putProtoInteger(std::string& out, unsigned field, std::int64_t value) {
  putVarint(out, field << 3);
  putVarint(out, static_cast<std::uint64_t>(value));
}
void putProtoFixed32(std::string& out, unsigned field, std::uint32_t value) {
  putVarint(out, field << 3 | 5);
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void putProtoBytes(std::string& out, unsigned field, std::string_view bytes) {
  putVarint(out, field << 3 | 2);
  putVarint(out, bytes.size());
  out += bytes;
}

// A field of a message as its FieldDescriptorProto (google/protobuf/descriptor.proto).
enum ProtoType {
  kProtoInt64 = 3,
  kProtoInt32 = 5,
  kProtoFixed32 = 7,
  kProtoString = 9,
  kProtoMessage = 11,
  kProtoBytes = 12
};
std::string protoField(const char* name,
                       int number,
                       ProtoType type,
                       const char* typeName = nullptr) {
  std::string field;
  putProtoBytes(field, 1, name);
  putProtoInteger(field, 3, number);
  putProtoInteger(field, 4, 1);  // LABEL_OPTIONAL
  putProtoInteger(field, 5, type);
  if (typeName) putProtoBytes(field, 6, typeName);
  return field;
}

struct ProtoReader {
  std::string_view bytes;
  bool ok = true;

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (bytes.empty()) break;
      const auto byte = static_cast<unsigned char>(bytes[0]);
      bytes.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
    ok = false;
    return 0;
  }
  std::string_view take(std::uint64_t count) {
    if (count > bytes.size()) {
      ok = false;
      return {};
    }
    const std::string_view taken = bytes.substr(0, static_cast<std::size_t>(count));
    bytes.remove_prefix(taken.size());
    return taken;
  }
  std::uint32_t fixed32() {
    std::uint32_t value = 0;
    const std::string_view taken = take(sizeof value);
    if (ok) std::memcpy(&value, taken.data(), sizeof value);
    return value;
  }
  void skip(unsigned wireType) {
    if (wireType == 0)
      varint();
    else if (wireType == 1)
      take(8);
    else if (wireType == 2)
      take(varint());
    else if (wireType == 5)
      take(4);
    else
      ok = false;
  }
};

std::int64_t readProtoTime(std::string_view message) {
  ProtoReader reader{message};
  std::int64_t seconds = 0;
  std::int64_t nanos = 0;
  while (reader.ok && !reader.bytes.empty()) {
    const std::uint64_t tag = reader.varint();
    if (tag == (1u << 3))
      seconds = static_cast<std::int64_t>(reader.varint());
    else if (tag == (2u << 3))
      nanos = static_cast<std::int64_t>(reader.varint());
    else
      reader.skip(tag & 7);
  }
  constexpr std::int64_t kMaximum = std::int64_t{1} << 40;
  return std::clamp(seconds, -kMaximum, kMaximum) * kMcapUsPerSecond +
         std::clamp<std::int64_t>(nanos, 0, 999'999'999) / 1000;
}

// -- Schemas --

constexpr const char* kRule =
    "================================================================================\n";
constexpr const char* kTimeMessage =
    "MSG: builtin_interfaces/Time\n"
    "int32 sec\n"
    "uint32 nanosec\n";
constexpr const char* kHeaderMessage =
    "MSG: std_msgs/Header\n"
    "builtin_interfaces/Time stamp\n"
    "string frame_id\n";

std::string withHeader(const char* text) {
  return std::string(text) + kRule + kHeaderMessage + kRule + kTimeMessage;
}

bool isWhole(const McapImage& image, std::size_t pixelBytes) {
  if (pixelBytes == 0) return true;  // of another encoding: its reader says so
  const std::uint64_t row = std::uint64_t{image.columns} * pixelBytes;
  return image.step >= row && std::uint64_t{image.step} * image.rows <= image.data.size();
}

}  // namespace

McapSchemaText mcapImageSchema() {
  return {"sensor_msgs/msg/Image",
          "ros2msg",
          withHeader("std_msgs/Header header\n"
                     "uint32 height\n"
                     "uint32 width\n"
                     "string encoding\n"
                     "uint8 is_bigendian\n"
                     "uint32 step\n"
                     "uint8[] data\n")};
}

McapSchemaText mcapJointStateSchema() {
  return {"sensor_msgs/msg/JointState",
          "ros2msg",
          withHeader("std_msgs/Header header\n"
                     "string[] name\n"
                     "float64[] position\n"
                     "float64[] velocity\n"
                     "float64[] effort\n")};
}

McapSchemaText mcapLogSchema() {
  return {"rcl_interfaces/msg/Log",
          "ros2msg",
          std::string("byte DEBUG=10\n"
                      "byte INFO=20\n"
                      "byte WARN=30\n"
                      "byte ERROR=40\n"
                      "byte FATAL=50\n"
                      "builtin_interfaces/Time stamp\n"
                      "uint8 level\n"
                      "string name\n"
                      "string msg\n"
                      "string file\n"
                      "string function\n"
                      "uint32 line\n") +
              kRule + kTimeMessage};
}

McapSchemaText mcapFrameSchema() {
  return {
      "palpate_msgs/msg/Frame",
      "ros2msg",
      "# Of one tactile frame, whose images follow.\n"
      "int64 time_us         # host time [us since 1970]\n"
      "int64 device_time_ms  # the controller's clock [ms]; -2^63: not known\n"
      "uint8 filtered        # 1: the values went through filters\n"
      "uint8[] active        # of a filtered frame: a bit per taxel of all matrices, the lowest\n"
      "                      # first: 1 where the taxel is touched\n"
      "uint8[] kept          # the same: 1 where the value counts, also where it is below 0\n"};
}

McapSchemaText mcapValuesSchema() {
  return {"palpate_msgs/msg/Values",
          "ros2msg",
          "# Numbers of one instant; names and units stand in the metadata of the channel.\n"
          "int64 time_us  # host time [us since 1970]\n"
          "float64[] values\n"};
}

McapSchemaText mcapSampleSchema() {
  return {"palpate_msgs/msg/Sample",
          "ros2msg",
          "# Numbers of one instant; names and units stand in the metadata of the channel.\n"
          "int64 time_us         # host time [us since 1970]\n"
          "int64 device_time_us  # the sender's clock [us]; -2^63: not known\n"
          "float64[] values      # NaN: not known\n"};
}

McapSchemaText mcapEventSchema() {
  return {"palpate_msgs/msg/Event",
          "ros2msg",
          "# Bytes of texts that are not UTF-8, and NUL, are the characters U+10FF00 + byte.\n"
          "int64 time_us  # host time [us since 1970]\n"
          "int64 end_us\n"
          "int32 matrix   # -2^31: of no single one\n"
          "string kind\n"
          "string text\n"
          "string json\n"};
}

McapSchemaText mcapRawImageSchema() {
  std::string time;
  putProtoBytes(time, 1, "Timestamp");
  putProtoBytes(time, 2, protoField("seconds", 1, kProtoInt64));
  putProtoBytes(time, 2, protoField("nanos", 2, kProtoInt32));
  std::string timeFile;
  putProtoBytes(timeFile, 1, "google/protobuf/timestamp.proto");
  putProtoBytes(timeFile, 2, "google.protobuf");
  putProtoBytes(timeFile, 4, time);
  putProtoBytes(timeFile, 12, "proto3");
  std::string image;
  putProtoBytes(image, 1, "RawImage");
  putProtoBytes(image, 2, protoField("timestamp", 1, kProtoMessage, ".google.protobuf.Timestamp"));
  putProtoBytes(image, 2, protoField("frame_id", 7, kProtoString));
  putProtoBytes(image, 2, protoField("width", 2, kProtoFixed32));
  putProtoBytes(image, 2, protoField("height", 3, kProtoFixed32));
  putProtoBytes(image, 2, protoField("encoding", 4, kProtoString));
  putProtoBytes(image, 2, protoField("step", 5, kProtoFixed32));
  putProtoBytes(image, 2, protoField("data", 6, kProtoBytes));
  std::string imageFile;
  putProtoBytes(imageFile, 1, "foxglove/RawImage.proto");
  putProtoBytes(imageFile, 2, "foxglove");
  putProtoBytes(imageFile, 3, "google/protobuf/timestamp.proto");
  putProtoBytes(imageFile, 4, image);
  putProtoBytes(imageFile, 12, "proto3");
  std::string set;
  putProtoBytes(set, 1, timeFile);
  putProtoBytes(set, 1, imageFile);
  return {"foxglove.RawImage", "protobuf", set};
}

std::string mcapSafeText(std::string_view text) { return mcapReplaced(text, appendMcapEscape); }

std::string mcapShownText(std::string_view text) {
  return mcapReplaced(text, [](std::string& out, unsigned char) { out += "\xEF\xBF\xBD"; });
}

std::string mcapRestoredText(std::string_view safe) {
  std::string out;
  for (std::size_t i = 0; i < safe.size(); ++i) {
    if (isMcapEscape(safe.substr(i, 4))) {
      out += static_cast<char>((safe[i + 2] & 3) << 6 | (safe[i + 3] & 0x3F));
      i += 3;
    } else {
      out += safe[i];
    }
  }
  return out;
}

void CdrWriter::time(std::int64_t timeUs) {
  std::int64_t seconds = timeUs / kMcapUsPerSecond;
  std::int64_t rest = timeUs % kMcapUsPerSecond;
  if (rest < 0) {
    rest += kMcapUsPerSecond;
    --seconds;
  }
  number(static_cast<std::int32_t>(std::clamp<std::int64_t>(seconds, INT32_MIN, INT32_MAX)));
  number(static_cast<std::uint32_t>(rest * 1000));
}

CdrReader::CdrReader(std::string_view message) {
  ok_ = message.size() >= 4 && message[0] == '\0' && (message[1] == '\0' || message[1] == '\1');
  if (!ok_) return;
  swapped_ = message[1] == '\0';  // big-endian
  bytes_ = message.substr(4);
}

std::string_view CdrReader::take(std::size_t count) {
  if (!ok_ || count > bytes_.size() - at_) {
    ok_ = false;
    return {};
  }
  const std::string_view taken = bytes_.substr(at_, count);
  at_ += count;
  return taken;
}

std::string_view CdrReader::text() {
  std::string_view text = bytes();
  if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  return text;
}

std::int64_t CdrReader::time() {
  const auto seconds = number<std::int32_t>();
  const auto nanos = number<std::uint32_t>();
  return seconds * kMcapUsPerSecond + nanos / 1000;
}

std::vector<double> CdrReader::doubles(std::size_t most) {
  const auto count = number<std::uint32_t>();
  if (count > most) ok_ = false;
  std::vector<double> values;
  for (std::uint32_t i = 0; ok_ && i < count; ++i) values.push_back(number<double>());
  return values;
}

std::vector<std::string> CdrReader::texts(std::size_t most) {
  const auto count = number<std::uint32_t>();
  if (count > most) ok_ = false;
  std::vector<std::string> texts;
  for (std::uint32_t i = 0; ok_ && i < count; ++i) texts.emplace_back(text());
  return texts;
}

std::size_t mcapPixelBytes(std::string_view encoding) noexcept {
  if (encoding == "mono8" || encoding == "8UC1") return 1;
  if (encoding == "mono16" || encoding == "16UC1") return 2;
  return encoding == "32FC1" ? 4 : 0;
}

std::optional<McapImage> readRosImage(std::string_view message) {
  CdrReader reader(message);
  McapImage image;
  image.timeUs = reader.time();
  image.frameId = reader.text();
  image.rows = reader.number<std::uint32_t>();
  image.columns = reader.number<std::uint32_t>();
  image.encoding = reader.text();
  image.bigEndian = reader.number<std::uint8_t>() != 0;
  image.step = reader.number<std::uint32_t>();
  image.data = reader.bytes();
  if (!reader.ok() || !isWhole(image, mcapPixelBytes(image.encoding))) return std::nullopt;
  return image;
}

std::optional<McapImage> readRawImage(std::string_view message) {
  ProtoReader reader{message};
  McapImage image;
  while (reader.ok && !reader.bytes.empty()) {
    const std::uint64_t tag = reader.varint();
    switch (tag) {
      case 1u << 3 | 2:
        image.timeUs = readProtoTime(reader.take(reader.varint()));
        break;
      case 2u << 3 | 5:
        image.columns = reader.fixed32();
        break;
      case 3u << 3 | 5:
        image.rows = reader.fixed32();
        break;
      case 4u << 3 | 2:
        image.encoding = reader.take(reader.varint());
        break;
      case 5u << 3 | 5:
        image.step = reader.fixed32();
        break;
      case 6u << 3 | 2:
        image.data = reader.take(reader.varint());
        break;
      case 7u << 3 | 2:
        image.frameId = reader.take(reader.varint());
        break;
      default:
        reader.skip(tag & 7);
    }
  }
  if (!reader.ok || !isWhole(image, mcapPixelBytes(image.encoding))) return std::nullopt;
  return image;
}

void mcapPixels(const McapImage& image, float* out) {
  const auto each = [&](std::size_t pixelBytes, const auto& valueOf) {
    for (std::uint32_t row = 0; row < image.rows; ++row) {
      const char* const from = image.data.data() + std::size_t{row} * image.step;
      for (std::size_t k = 0; k < image.columns; ++k) *out++ = valueOf(from + k * pixelBytes);
    }
  };
  const bool swapped = image.bigEndian;
  switch (mcapPixelBytes(image.encoding)) {
    case 1:
      return each(1, [](const char* from) {
        return static_cast<float>(static_cast<unsigned char>(*from));
      });
    case 2:
      return each(2, [swapped](const char* from) {
        std::uint16_t value = 0;
        std::memcpy(&value, from, sizeof value);
        return static_cast<float>(swapped ? __builtin_bswap16(value) : value);
      });
    default:
      return each(4, [swapped](const char* from) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, from, sizeof bits);
        return std::bit_cast<float>(swapped ? __builtin_bswap32(bits) : bits);
      });
  }
}

void appendRosImageHead(std::string& out, const McapImage& image, std::string_view frameId) {
  CdrWriter cdr(out);
  cdr.time(image.timeUs);
  cdr.text(frameId);
  cdr.number(image.rows);
  cdr.number(image.columns);
  cdr.text(image.encoding);
  cdr.number(std::uint8_t{0});
  cdr.number(image.step);
  cdr.number(image.step * image.rows);  // number of bytes, which follow
}

void appendRawImageHead(std::string& out, const McapImage& image, std::string_view frameId) {
  std::string time;
  putProtoInteger(time, 1, image.timeUs / kMcapUsPerSecond - (image.timeUs % kMcapUsPerSecond < 0));
  putProtoInteger(
      time, 2, (image.timeUs % kMcapUsPerSecond + kMcapUsPerSecond) % kMcapUsPerSecond * 1000);
  putProtoBytes(out, 1, time);
  putProtoBytes(out, 7, frameId);
  putProtoFixed32(out, 2, image.columns);
  putProtoFixed32(out, 3, image.rows);
  putProtoBytes(out, 4, image.encoding);
  putProtoFixed32(out, 5, image.step);
  putVarint(out, 6u << 3 | 2);
  putVarint(out, std::uint64_t{image.step} * image.rows);
}

}  // namespace palpate
