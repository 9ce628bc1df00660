#include "palpate/device/stream_packets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include <zlib.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::byte kSync0{0xA5};
constexpr std::byte kSync1{0x5A};
constexpr std::byte kVersion{1};
constexpr std::size_t kCoveredFrom = 2;  // the checksum begins behind the sync bytes
constexpr std::size_t kLargestU16 = 65'535;

std::uint32_t checksumOf(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

StreamItemKind kindOf(StreamPacketType type) {
  if (type == StreamPacketType::kAngles) return StreamItemKind::kAngles;
  if (type == StreamPacketType::kTemperatures) return StreamItemKind::kTemperatures;
  if (type == StreamPacketType::kDescription) return StreamItemKind::kDescription;
  return StreamItemKind::kFrame;
}

std::size_t bytesPerValue(StreamPacketType type) {
  return type == StreamPacketType::kFrameU16 ? 2 : 4;
}

std::string nameOf(StreamPacketType type) {
  switch (type) {
    case StreamPacketType::kFrameU16:
      return "u16 values";
    case StreamPacketType::kFrameF32:
      return "f32 values";
    case StreamPacketType::kAngles:
      return "angles";
    case StreamPacketType::kTemperatures:
      return "temperatures";
    case StreamPacketType::kDescription:
      break;
  }
  return "description";
}

float f32At(std::span<const std::byte> payload, std::size_t index) {
  return std::bit_cast<float>(
      static_cast<std::uint32_t>(littleEndian(payload.subspan(4 * index, 4))));
}

}  // namespace

void appendStreamPacket(std::vector<std::byte>& out,
                        StreamPacketType type,
                        std::uint32_t sequence,
                        std::uint64_t deviceUs,
                        std::span<const std::byte> payload) {
  const std::size_t begin = out.size();
  out.insert(out.end(), {kSync0, kSync1, kVersion, static_cast<std::byte>(type)});
  appendLittleEndian(out, payload.size(), 4);
  appendLittleEndian(out, sequence, 4);
  appendLittleEndian(out, deviceUs, 8);
  out.insert(out.end(), payload.begin(), payload.end());
  appendLittleEndian(out, checksumOf(std::span(out).subspan(begin + kCoveredFrom)), 4);
}

void appendStreamFrame(std::vector<std::byte>& out,
                       std::uint32_t sequence,
                       std::uint64_t deviceUs,
                       std::span<const float> values) {
  const bool whole = std::all_of(values.begin(), values.end(), [](float value) {
    return value >= 0.0F && value <= static_cast<float>(kLargestU16) && value == std::trunc(value);
  });
  std::vector<std::byte> payload;
  payload.reserve(4 * values.size());
  for (const float value : values) {
    if (whole)
      appendLittleEndian(payload, static_cast<std::uint64_t>(value), 2);
    else
      appendLittleEndian(payload, std::bit_cast<std::uint32_t>(value), 4);
  }
  appendStreamPacket(out,
                     whole ? StreamPacketType::kFrameU16 : StreamPacketType::kFrameF32,
                     sequence,
                     deviceUs,
                     payload);
}

StreamPacketParser::StreamPacketParser(StreamShape shape)
    : shape_(std::move(shape)),
      values_(shape_.numPlaces()),
      numbers_(std::max(shape_.numAxes(), shape_.numTemperatures())) {}

void StreamPacketParser::push(std::span<const std::byte> bytes, const Sink& sink) {
  if (pending_.empty()) {
    const std::size_t taken = take(bytes, false, sink);
    pending_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(taken), bytes.end());
    return;
  }
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  const std::size_t taken = take(pending_, false, sink);
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(taken));
}

void StreamPacketParser::flush(const Sink& sink) {
  take(pending_, true, sink);
  pending_.clear();
}

std::string StreamPacketParser::place() const {
  return "packet " + std::to_string(stats_.packets + stats_.badChecksums + stats_.badLengths) +
         ": ";
}

void StreamPacketParser::fault(const std::string& why) { lastFault_ = place() + why; }

// Returns what is wrong with the length; empty when an item of the hand has it.
std::string StreamPacketParser::lengthFault(StreamPacketType type, std::size_t length) const {
  if (type == StreamPacketType::kDescription) {
    if (length <= kLongestStreamDescription) return {};
    return "a description of " + std::to_string(length) + " bytes, longer than " +
           std::to_string(kLongestStreamDescription);
  }
  const std::size_t each = bytesPerValue(type);
  if (length % each == 0 && shape_.fits(kindOf(type), length / each)) return {};
  return std::to_string(length) + " bytes of " + nameOf(type) + " (" +
         std::to_string(length / each) + ") instead of " + shape_.expected(kindOf(type));
}

// Returns the number of bytes that are done with: the rest is the beginning of a packet. At the end
// all are.
std::size_t StreamPacketParser::take(std::span<const std::byte> bytes,
                                     bool isEnd,
                                     const Sink& sink) {
  std::size_t at = 0;
  const auto skip = [&](std::size_t count) {
    at += count;
    stats_.skippedBytes += count;
  };
  bool isCutOff = false;
  const auto skipCutOff = [&] {
    if (!std::exchange(isCutOff, true)) {
      ++stats_.badLengths;
      fault("cut off: " + counted(bytes.size() - at, "byte") + " of it came");
    }
    skip(1);
  };
  while (at < bytes.size()) {
    const auto rest = bytes.subspan(at);
    if (rest[0] != kSync0) {
      const void* next = std::memchr(rest.data(), static_cast<int>(kSync0), rest.size());
      skip(next == nullptr
               ? rest.size()
               : static_cast<std::size_t>(static_cast<const std::byte*>(next) - rest.data()));
      continue;
    }
    // A beginning that is too short for its checks is kept, unless this is the end.
    const auto differs = [&](std::size_t index, std::byte value) {
      return rest.size() > index && rest[index] != value;
    };
    const auto type = rest.size() > 3 ? std::to_integer<unsigned>(rest[3]) : 1U;
    if (differs(1, kSync1) || differs(2, kVersion) || type < 1 || type > 5) {
      skip(1);
      continue;
    }
    if (rest.size() < kStreamHeaderBytes) {
      if (!isEnd) break;
      if (rest.size() > 1)
        skipCutOff();
      else
        skip(1);
      continue;
    }
    const auto length = static_cast<std::size_t>(littleEndian(rest.subspan(4, 4)));
    if (const std::string why = lengthFault(static_cast<StreamPacketType>(type), length);
        !why.empty()) {
      ++stats_.badLengths;
      fault(why);
      skip(1);
      continue;
    }
    const std::size_t total = kStreamPacketBytes + length;
    if (rest.size() < total) {
      if (!isEnd) break;
      skipCutOff();
      continue;
    }
    const auto covered = rest.subspan(kCoveredFrom, total - 4 - kCoveredFrom);
    if (checksumOf(covered) != littleEndian(rest.subspan(total - 4, 4))) {
      ++stats_.badChecksums;
      fault("wrong checksum");
      skip(1);
      continue;
    }
    ++stats_.packets;
    stats_.packetBytes += total;
    at += total;
    deliver(rest.first(total), sink);
  }
  return at;
}

void StreamPacketParser::deliver(std::span<const std::byte> packet, const Sink& sink) {
  const auto type = static_cast<StreamPacketType>(std::to_integer<std::uint8_t>(packet[3]));
  const auto payload = packet.subspan(kStreamHeaderBytes, packet.size() - kStreamPacketBytes);
  const std::size_t count = payload.size() / bytesPerValue(type);
  StreamItem item;
  item.kind = kindOf(type);
  item.sequence = static_cast<std::uint32_t>(littleEndian(packet.subspan(8, 4)));
  const std::uint64_t deviceUs = littleEndian(packet.subspan(12, 8));
  std::string why;
  if (deviceUs > static_cast<std::uint64_t>(INT64_MAX))
    why = "the device time " + std::to_string(deviceUs) + " us is out of range";
  item.deviceUs = static_cast<std::int64_t>(deviceUs);
  switch (type) {
    case StreamPacketType::kFrameU16:
      for (std::size_t i = 0; i < count; ++i)
        values_[i] = static_cast<float>(std::to_integer<unsigned>(payload[2 * i]) |
                                        std::to_integer<unsigned>(payload[2 * i + 1]) << 8U);
      break;
    case StreamPacketType::kFrameF32:
      for (std::size_t i = 0; i < count; ++i) values_[i] = f32At(payload, i);
      break;
    case StreamPacketType::kAngles:
    case StreamPacketType::kTemperatures:
      for (std::size_t i = 0; i < count; ++i) numbers_[i] = static_cast<double>(f32At(payload, i));
      item.numbers = std::span(numbers_).first(count);
      break;
    case StreamPacketType::kDescription:
      item.text = {reinterpret_cast<const char*>(payload.data()), payload.size()};
      break;
  }
  if (why.empty()) {
    if (item.kind == StreamItemKind::kFrame) {
      if (const std::string outside = shape_.arrange(values_, count); !outside.empty()) {
        ++stats_.outOfRange;
        lastOutOfRange_ = place() + outside;
      }
      item.values = values_;
    } else if (item.kind != StreamItemKind::kDescription) {
      why = shape_.check(item.numbers);
    }
  }
  if (!why.empty()) {
    ++stats_.refused;
    return fault(why);
  }
  ++stats_.items;
  sink(item);
}

}  // namespace palpate
