#include "palpate/device/sdh_protocol.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <stdexcept>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"
#include "palpate/core/number_text.h"
#include "palpate/device/weiss_checksum.h"

namespace palpate {
namespace {

constexpr std::uint8_t kFirstCommand = 0x80;
constexpr std::array<std::string_view, kSdhLastCommand - kFirstCommand + 1> kNames = {
    "v",
    "vel",
    "rvel",
    "pos",
    "state",
    "p",
    "a",
    "m",
    "stop",
    "vp",
    "con",
    "tpap",
    "tvav",
    "vlim",
    "alim",
    "pos_save",
    "ref",
    "temp",
    "id",
    "sn",
    "ver",
    "ver_date",
    "soc",
    "soc_date",
    "numaxis",
    "p_min",
    "p_max",
    "p_offset",
    "get_duration",
    "igrip",
    "ihold",
    "selgrip",
    "grip",
    "pid",
    "kv",
    "ilim",
    "power",
    "demo",
    "user_errors",
    "terminal",
    "debug",
    "use_fixed_length",
    "change_rs232",
    "change_channel"};

constexpr std::size_t kSdhProtocolHeaderBytes = 3;  // command, size, number of values
constexpr std::size_t kSdhProtocolChecksumBytes = 2;

void appendChecksum(std::vector<std::byte>& bytes) {
  appendLittleEndian(bytes, weissChecksum(bytes), 2);
}

bool isUpperName(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace

std::string_view sdhName(SdhCommand command) noexcept {
  const auto number = static_cast<std::uint8_t>(command);
  if (number < kFirstCommand || number > kSdhLastCommand) return {};
  return kNames[number - kFirstCommand];
}

bool sdhIsBinary(SdhCommand command) noexcept {
  switch (command) {
    case SdhCommand::kVelocityTarget:
    case SdhCommand::kVelocity:
    case SdhCommand::kVelocityReference:
    case SdhCommand::kAngle:
    case SdhCommand::kState:
    case SdhCommand::kAngleTarget:
    case SdhCommand::kAcceleration:
    case SdhCommand::kTargetGetAngle:
    case SdhCommand::kTargetGetVelocity:
    case SdhCommand::kCurrentLimit:
    case SdhCommand::kPower:
      return true;
    default:
      return false;
  }
}

std::vector<std::byte> sdhRecordRequest(SdhCommand command,
                                        std::span<const double> values,
                                        bool checksum) {
  if (!values.empty() && values.size() != kSdhAxes)
    throw std::invalid_argument("a record takes 7 values, not " + std::to_string(values.size()));
  std::vector<std::byte> bytes;
  const std::size_t size = 1 + 4 * values.size() + (checksum ? kSdhProtocolChecksumBytes : 0);
  bytes.push_back(static_cast<std::byte>(command));
  bytes.push_back(static_cast<std::byte>(size));
  bytes.push_back(static_cast<std::byte>(values.size()));
  for (const double value : values)
    appendLittleEndian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  if (checksum) appendChecksum(bytes);
  return bytes;
}

std::string sdhLineRequest(std::string_view name,
                           std::optional<int> axis,
                           std::span<const double> values) {
  std::string line(name);
  if (axis) line += "(" + std::to_string(*axis) + ")";
  char separator = '=';
  for (const double value : values) {
    line += separator + fixedText(value, 6);
    separator = ',';
  }
  return line;
}

bool sdhIsRecordStart(std::span<const std::byte> bytes, bool checksum) noexcept {
  const std::size_t size = sdhRecordBytes(checksum) - 2;
  const std::byte expected[] = {static_cast<std::byte>(size), static_cast<std::byte>(kSdhAxes)};
  if (bytes.empty()) return false;
  const auto command = std::to_integer<std::uint8_t>(bytes[0]);
  if (command < kFirstCommand || command > kSdhLastCommand) return false;
  for (std::size_t i = 1; i < kSdhProtocolHeaderBytes && i < bytes.size(); ++i)
    if (bytes[i] != expected[i - 1]) return false;
  return true;
}

std::optional<SdhRecord> decodeSdhRecord(std::span<const std::byte> bytes, bool checksum) {
  if (bytes.size() != sdhRecordBytes(checksum) || !sdhIsRecordStart(bytes, checksum))
    return std::nullopt;
  ByteReader reader(bytes);
  SdhRecord record;
  record.command = static_cast<SdhCommand>(reader.u8());
  reader.take(2);
  record.status = reader.u8();
  for (std::size_t axis = 0; axis < kSdhAxes; ++axis)
    record.values.push_back(static_cast<double>(reader.f32()));
  if (checksum &&
      weissChecksum(bytes.first(bytes.size() - kSdhProtocolChecksumBytes)) != reader.u16())
    return std::nullopt;
  return record;
}

SdhLine parseSdhLine(std::string_view line) {
  SdhLine result;
  result.text = line;
  if (line.starts_with('@')) {
    result.kind = SdhLine::Kind::kDebug;
    return result;
  }
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) {
    const auto code = line.size() > 1 && line.size() < 6 && line[0] == 'E' && line[1] != '-'
                          ? parseInteger(line.substr(1))
                          : std::nullopt;
    if (code.has_value()) {
      result.kind = SdhLine::Kind::kError;
      result.error = static_cast<int>(code.value());
    }
    return result;
  }
  std::string_view name = line.substr(0, equals);
  if (const std::size_t bracket = name.find('('); bracket != std::string_view::npos) {
    if (!name.ends_with(')')) return result;
    const auto axis = parseInteger(name.substr(bracket + 1, name.size() - bracket - 2));
    if (!axis.has_value() || axis.value() < 0 || axis.value() > 99) return result;
    result.axis = static_cast<int>(axis.value());
    name = name.substr(0, bracket);
  }
  if (!isUpperName(name)) {
    result.axis.reset();
    return result;
  }
  result.kind = SdhLine::Kind::kValue;
  result.name = name;
  result.text = line.substr(equals + 1);
  return result;
}

std::optional<std::vector<double>> parseSdhNumbers(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const auto number = parseDouble(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

std::string sdhErrorText(int code) {
  static constexpr std::array<const char*, 37> kTexts = {"ok",
                                                         "not available",
                                                         "not initialised",
                                                         "already running",
                                                         "feature not supported",
                                                         "inconsistent data",
                                                         "timeout",
                                                         "read error",
                                                         "write error",
                                                         "no resources",
                                                         "checksum error",
                                                         "not enough parameters",
                                                         "no parameters expected",
                                                         "unknown command",
                                                         "command format error",
                                                         "access denied",
                                                         "already open",
                                                         "command failed",
                                                         "command aborted",
                                                         "invalid handle",
                                                         "device not found",
                                                         "device not opened",
                                                         "input/output error",
                                                         "invalid parameter",
                                                         "range error",
                                                         "no data pipe",
                                                         "index out of bounds",
                                                         "homing error",
                                                         "axis disabled",
                                                         "over-temperature",
                                                         "too many commands",
                                                         "invalid password",
                                                         "command line too long",
                                                         "checksum error in a binary record",
                                                         "no command",
                                                         "internal error",
                                                         "unknown error"};
  if (code >= 0 && static_cast<std::size_t>(code) < kTexts.size())
    return kTexts[static_cast<std::size_t>(code)];
  return "unknown error " + std::to_string(code);
}

std::string sdhErrorAdvice(int code) {
  switch (code) {
    case 4:
    case 13:
      return "the hand's firmware is too old for this";
    case 10:
    case 33:
      return "check cable and adapter: bytes are lost on the way to the hand";
    case 24:
      return "the value is outside the hand's own limits";
    case 27:
      return "do a reference run, with the fingers free to move";
    case 28:
      return "power off, over-current or over-temperature; free the fingers, then switch the "
             "axes' power on again";
    case 29:
      return "switch the axes' power off and let the hand cool down";
    default:
      return {};
  }
}

SdhFirmware SdhFirmware::parse(std::string_view text) noexcept {
  SdhFirmware firmware;
  for (int& part : firmware.parts) {
    const auto result = std::from_chars(text.data(), text.data() + text.size(), part);
    if (result.ec != std::errc()) break;
    text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
    if (!text.starts_with('.')) break;
    text.remove_prefix(1);
  }
  return firmware;
}

bool SdhFirmware::atLeast(int a, int b, int c, int d) const noexcept {
  const int wanted[4] = {a, b, c, d};
  return !std::lexicographical_compare(
      std::begin(parts), std::end(parts), std::begin(wanted), std::end(wanted));
}

}  // namespace palpate
