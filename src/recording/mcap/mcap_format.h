// The records of an MCAP file (mcap.dev/spec), which writer and reader agree on, and the topics of
// a recording in one (docs/notes/exchange_formats.md). Private to this module.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace palpate::mcap_format {

static_assert(std::endian::native == std::endian::little,
              "numbers are stored as they lie in memory");

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kRecordHead = 9;               // opcode u8, length u64
constexpr std::size_t kMessageHead = 2 + 4 + 8 + 8;  // channel, sequence, log and publish time

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr int kUnfilteredLayoutVersion = 1;
constexpr int kFilteredLayoutVersion = 2;

// Names of metadata records, attachments and topics of a recording.
constexpr const char* kAboutRecord = "palpate";      // layout version, provenance
constexpr const char* kMetaRecord = "palpate_meta";  // what was said of the recording
constexpr const char* kHandJson = "hand.json";
constexpr const char* kHandUrdf = "hand.urdf";
constexpr const char* kFrames = "/palpate/frames";
constexpr const char* kAngles = "/palpate/angles";
constexpr const char* kTemperatures = "/palpate/temperatures";
constexpr const char* kSeries = "/palpate/series/";  // then the name of a further series
constexpr const char* kEvents = "/palpate/events";
constexpr const char* kJointStates = "/joint_states";
constexpr const char* kLog = "/events";
inline std::string imageTopic(std::size_t matrix) { return "/tactile/m" + std::to_string(matrix); }

constexpr std::int64_t kNoDeviceTime = std::numeric_limits<std::int64_t>::min();
constexpr std::int32_t kNoMatrix = std::numeric_limits<std::int32_t>::min();

// Time of a record [ns since 1970]; at the ends of its range it stays there.
constexpr std::uint64_t timeNs(std::int64_t timeUs) {
  constexpr std::int64_t kMaxUs = std::numeric_limits<std::int64_t>::max() / 1000;
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(timeUs, 0, kMaxUs)) * 1000;
}

// zlib's CRC-32 of more bytes.
std::uint32_t addToCrc(std::uint32_t crc, std::string_view bytes) noexcept;

// Appends a number as it is in memory, little-endian.
template <typename Number>
void put(std::string& out, Number value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
inline void putString(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

}  // namespace palpate::mcap_format
