// Encodes DSACON32-M packets for the tests from the protocol document, without the driver's code: a
// bitwise checksum, frames run by run.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "device/scripted_channel.h"

namespace palpate::testing {

inline std::uint16_t bitwiseChecksum(const Bytes& bytes, std::size_t from, std::size_t count) {
  unsigned crc = 0xFFFF;
  for (std::size_t i = from; i < from + count; ++i) {
    unsigned entry = ((crc ^ std::to_integer<unsigned>(bytes[i])) & 0xFFu) << 8;
    for (int bit = 0; bit < 8; ++bit)
      entry = (entry & 0x8000u) != 0 ? (entry << 1 ^ 0x1021u) & 0xFFFFu : entry << 1 & 0xFFFFu;
    crc = crc >> 8 ^ entry;
  }
  return static_cast<std::uint16_t>(crc);
}

inline Bytes wirePacket(unsigned id, const Bytes& payload) {
  Bytes bytes;
  bytes.reserve(payload.size() + 8);
  for (int i = 0; i < 3; ++i) bytes.push_back(std::byte{0xAA});
  bytes.push_back(static_cast<std::byte>(id));
  bytes.push_back(static_cast<std::byte>(payload.size() & 0xFFu));
  bytes.push_back(static_cast<std::byte>(payload.size() >> 8));
  for (const std::byte b : payload) bytes.push_back(b);
  if (payload.empty()) return bytes;
  const unsigned crc = bitwiseChecksum(bytes, 3, bytes.size() - 3);
  bytes.push_back(static_cast<std::byte>(crc & 0xFFu));
  bytes.push_back(static_cast<std::byte>(crc >> 8));
  return bytes;
}

inline Bytes framePayload(std::uint32_t stampMs, const std::vector<unsigned>& counts, bool runs) {
  Bytes payload;
  for (int i = 0; i < 4; ++i) payload.push_back(static_cast<std::byte>(stampMs >> 8 * i & 0xFFu));
  payload.push_back(static_cast<std::byte>(runs ? 1 : 0));
  const auto unit = [&](unsigned value) {
    payload.push_back(static_cast<std::byte>(value & 0xFFu));
    payload.push_back(static_cast<std::byte>(value >> 8));
  };
  for (std::size_t i = 0; i < counts.size();) {
    std::size_t run = 1;
    while (runs && run < 15 && i + run < counts.size() && counts[i + run] == counts[i]) ++run;
    unit(runs ? static_cast<unsigned>(run << 12) | counts[i] : counts[i]);
    i += run;
  }
  return payload;
}

// Counts similar to a grasp: a few dozen taxels with values, the rest zero; zero where no taxel is.
inline std::vector<unsigned> graspCounts(std::mt19937& random) {
  std::vector<unsigned> counts(486, 0);
  for (const std::size_t first : {120u, 282u, 444u})
    for (std::size_t i = 0; i < 18; ++i)
      if (random() % 4 != 0) counts[first + i] = 1 + random() % 2000;
  return counts;
}

}  // namespace palpate::testing
