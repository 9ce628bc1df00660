// Protocol of the SDH-2's motion controller: encodes requests and decodes replies. ASCII lines and
// little-endian binary records share one connection. SdhReplyParser (sdh_reply_parser.h) finds the
// replies in the stream of bytes.
//
//   line:     text CR LF                            reply: NAME=values CR LF, or E<code> CR LF
//   request:  command u8 | n u8 | 0 u8 | crc u16                       n = bytes after n
//             command u8 | n u8 | 7 u8 | 7 x f32 | crc u16
//   record:   command u8 | n u8 | 7 u8 | status u8 | 7 x f32 | crc u16
// The checksum (weiss_checksum.h) is present on serial lines; on TCP it is absent and n is 2 less.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

constexpr std::size_t kSdhAxes = 7;
constexpr std::size_t kSdhTemperatures = 9;  // motors 0..6, FPGA, circuit board

// Command numbers of binary records. Only the first group is sent in binary form; the layout of the
// others is unknown, so they are sent as lines.
enum class SdhCommand : std::uint8_t {
  kVelocityTarget = 0x80,     // v
  kVelocity = 0x81,           // vel
  kVelocityReference = 0x82,  // rvel
  kAngle = 0x83,              // pos
  kState = 0x84,              // state
  kAngleTarget = 0x85,        // p
  kAcceleration = 0x86,       // a
  kTargetGetAngle = 0x8B,     // tpap
  kTargetGetVelocity = 0x8C,  // tvav
  kCurrentLimit = 0xA3,       // ilim
  kPower = 0xA4,              // power

  kMove = 0x87,
  kStop = 0x88,
  kProfile = 0x89,
  kController = 0x8A,
  kVelocityLimit = 0x8D,
  kAccelerationLimit = 0x8E,
  kSavePosition = 0x8F,
  kReference = 0x90,
  kTemperature = 0x91,
  kId = 0x92,
  kSerial = 0x93,
  kVersion = 0x94,
  kVersionDate = 0x95,
  kSoc = 0x96,
  kSocDate = 0x97,
  kNumAxes = 0x98,
  kMinimum = 0x99,
  kMaximum = 0x9A,
  kOffset = 0x9B,
  kDuration = 0x9C,
  kGripCurrent = 0x9D,
  kHoldCurrent = 0x9E,
  kSelectGrip = 0x9F,
  kGrip = 0xA0,
  kPid = 0xA1,
  kVelocityGain = 0xA2,
  kDemo = 0xA5,
  kUserErrors = 0xA6,
  kTerminal = 0xA7,
  kDebug = 0xA8,
  kUseFixedLength = 0xA9,
  kChangeRs232 = 0xAA,
  kChangeChannel = 0xAB,
};
constexpr std::uint8_t kSdhLastCommand = 0xAB;

// The command's name in lines, in lower case ("pos"); empty for a number that is no command.
std::string_view sdhName(SdhCommand command) noexcept;
// True for the first group above.
bool sdhIsBinary(SdhCommand command) noexcept;

// Encodes a binary request without values (read: 5 bytes, 3 without checksum) or with seven values
// (set: 33 bytes, 31 without checksum). Throws std::invalid_argument for another number of values.
std::vector<std::byte> sdhRecordRequest(SdhCommand command,
                                        std::span<const double> values,
                                        bool checksum);

// Encodes a line without its CR LF: "pos", "kv(2)", "p=0.000000,..". Values have six decimals, as
// in the vendor's library.
std::string sdhLineRequest(std::string_view name,
                           std::optional<int> axis = std::nullopt,
                           std::span<const double> values = {});

// A binary reply. Replies always contain seven values.
struct SdhRecord {
  SdhCommand command{};
  int status = 0;              // 0, or an error code
  std::vector<double> values;  // not checked: may contain NaN
};
// Size of a binary reply on the line [bytes].
constexpr std::size_t sdhRecordBytes(bool checksum) noexcept { return checksum ? 34 : 32; }
// True when `bytes` are the first three bytes of a reply; more bytes may follow them.
bool sdhIsRecordStart(std::span<const std::byte> bytes, bool checksum) noexcept;
// Decodes a whole reply with bytes.size() == sdhRecordBytes(); returns nothing when it isn't a
// reply or its checksum is wrong.
std::optional<SdhRecord> decodeSdhRecord(std::span<const std::byte> bytes, bool checksum);

// A reply line.
struct SdhLine {
  enum class Kind {
    kValue,  // NAME=text or NAME(axis)=text
    kError,  // E<code>
    kDebug,  // begins with @: progress report before the reply itself
    kOther,  // other text, such as the answer to stop
  };
  Kind kind = Kind::kOther;
  std::string name;  // in upper case
  std::optional<int> axis;
  std::string text;  // text after the =; the whole line where there is none
  int error = 0;
};
// `line` is passed without CR LF. Never fails: an unknown line is kOther.
SdhLine parseSdhLine(std::string_view line);
// Parses numbers separated by commas, blanks allowed; returns nothing when one of them isn't a
// finite number.
std::optional<std::vector<double>> parseSdhNumbers(std::string_view text);

// The meaning of an error code of the motion controller ("range error"), and advice on what to do
// (may be empty). The codes differ from those of the tactile controller.
std::string sdhErrorText(int code);
std::string sdhErrorAdvice(int code);

// A firmware release for comparisons: "0.0.3.3" -> {0, 0, 3, 3}; a part that is not a number counts
// as 0.
struct SdhFirmware {
  int parts[4] = {};
  static SdhFirmware parse(std::string_view text) noexcept;
  // True for release major.minor.release.build = a.b.c.d and every later one.
  bool atLeast(int a, int b, int c, int d) const noexcept;
};

// Axis states (command `state`): the axis moves in the first two, and something holds it in the
// others.
inline constexpr int kSdhAxisPositioning = 1;
inline constexpr int kSdhAxisSpeedMode = 2;
inline constexpr int kSdhAxisBlockedClockwise = 4;
inline constexpr int kSdhAxisBlockedCounterClockwise = 5;
constexpr bool sdhAxisMoves(int state) noexcept {
  return state == kSdhAxisPositioning || state == kSdhAxisSpeedMode;
}
constexpr bool sdhAxisBlocks(int state) noexcept {
  return state == kSdhAxisBlockedClockwise || state == kSdhAxisBlockedCounterClockwise;
}

}  // namespace palpate
