#include "palpate/device/dsa_packet.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "palpate/core/byte_order.h"
#include "palpate/device/weiss_checksum.h"

namespace palpate {
namespace {

constexpr std::byte kPreamble{0xAA};
constexpr std::size_t kPreambleBytes = 3;
constexpr std::size_t kDsaPacketHeaderBytes = 6;
constexpr std::size_t kDsaPacketChecksumBytes = 2;
constexpr std::size_t kFrameHeaderBytes = 5;  // time stamp, flags
// Largest answer that is not a frame: a descriptor string, or the echo of a loop test [bytes].
constexpr std::size_t kLargestAnswer = 258;

std::size_t u16At(std::span<const std::byte> bytes, std::size_t at) {
  return littleEndian(bytes.subspan(at, 2));
}

}  // namespace

DsaPacketParser::DsaPacketParser(DsaPacketOptions options) { setNumPlaces(options.numCells); }

void DsaPacketParser::setNumPlaces(std::size_t numCells) {
  const std::size_t bytes = kFrameHeaderBytes + 2 * numCells;
  if (numCells == 0 || bytes > 0xFFFF)
    throw std::invalid_argument("DsaPacketParser: " + std::to_string(numCells) +
                                " places are not in 1..32765");
  largestFrame_ = bytes;
}

bool DsaPacketParser::plausible(std::uint8_t id, std::size_t size) const noexcept {
  switch (static_cast<DsaId>(id)) {
    case DsaId::kFrame:
      return size > kFrameHeaderBytes && size <= largestFrame_ && size % 2 == 1;
    case DsaId::kControllerConfiguration:
      return size == 18 || size == 2;
    case DsaId::kSensorConfiguration:
      return size == 12 || size == 2;
    case DsaId::kMatrixConfiguration:
      return size == 52 || size == 2;
    case DsaId::kGetSensitivity:
      return size == 11 || size == 2;
    case DsaId::kGetThreshold:
      return size == 4 || size == 2;
    case DsaId::kAcquisition:
    case DsaId::kSetSensitivity:
    case DsaId::kSetThreshold:
    case DsaId::kSetDynamicMask:
      return size == 2;
    // Masks, strings, echoes, and answers that newer firmware may add (no id is AA: a run of AA is
    // preamble).
    default:
      return id != 0xAA && size > 0 && size <= kLargestAnswer;
  }
}

std::size_t DsaPacketParser::consume(std::span<const std::byte> in, const Sink& sink) {
  std::size_t at = 0;
  while (true) {
    const auto next = std::find(in.begin() + static_cast<std::ptrdiff_t>(at), in.end(), kPreamble);
    const auto start = static_cast<std::size_t>(next - in.begin());
    stats_.skippedBytes += start - at;
    at = start;
    const auto rest = in.subspan(at);
    const std::size_t known = std::min(rest.size(), kPreambleBytes);
    if (std::any_of(rest.begin(),
                    rest.begin() + static_cast<std::ptrdiff_t>(known),
                    [](std::byte b) { return b != kPreamble; })) {
      ++at;
      ++stats_.skippedBytes;
      continue;
    }
    if (rest.size() < kDsaPacketHeaderBytes) return at;
    const auto id = std::to_integer<std::uint8_t>(rest[3]);
    const std::size_t size = u16At(rest, 4);
    if (!plausible(id, size)) {
      ++at;
      ++stats_.skippedBytes;
      ++stats_.implausible;
      continue;
    }
    const std::size_t total = kDsaPacketHeaderBytes + size + kDsaPacketChecksumBytes;
    if (rest.size() < total) return at;
    if (weissChecksum(
            rest.subspan(kPreambleBytes, kDsaPacketHeaderBytes - kPreambleBytes + size)) !=
        u16At(rest, kDsaPacketHeaderBytes + size)) {
      ++at;
      ++stats_.skippedBytes;
      ++stats_.badChecksums;
      continue;
    }
    ++stats_.packets;
    stats_.packetBytes += total;
    at += total;
    sink({static_cast<DsaId>(id), rest.subspan(kDsaPacketHeaderBytes, size)});
  }
}

void DsaPacketParser::push(std::span<const std::byte> bytes, const Sink& sink) {
  stats_.bytes += bytes.size();
  // The usual case: whole packets are parsed in place.
  if (pending_.empty()) {
    const std::size_t done = consume(bytes, sink);
    pending_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(done), bytes.end());
    return;
  }
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  const std::size_t done = consume(pending_, sink);
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(done));
}

void DsaPacketParser::flush(const Sink& sink) {
  while (!pending_.empty()) {
    ++stats_.skippedBytes;
    pending_.erase(pending_.begin());
    const std::size_t done = consume(pending_, sink);
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(done));
  }
}

std::vector<std::byte> dsaRequest(DsaId id, std::span<const std::byte> payload) {
  if (payload.size() > 0xFFFF)
    throw std::invalid_argument("dsaRequest: payload of " + std::to_string(payload.size()) +
                                " bytes is longer than 65535");
  std::vector<std::byte> bytes(kPreambleBytes, kPreamble);
  bytes.push_back(static_cast<std::byte>(id));
  appendLittleEndian(bytes, payload.size(), 2);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (payload.empty()) return bytes;
  appendLittleEndian(bytes, weissChecksum(std::span(bytes).subspan(kPreambleBytes)), 2);
  return bytes;
}

}  // namespace palpate
