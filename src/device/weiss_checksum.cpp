#include "palpate/device/weiss_checksum.h"

#include <array>

namespace palpate {
namespace {

using Table = std::array<std::uint16_t, 256>;

constexpr Table makeTable() {
  Table table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned remainder = i << 8;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 0x8000u) != 0 ? remainder << 1 ^ 0x1021u : remainder << 1;
    table[i] = static_cast<std::uint16_t>(remainder);
  }
  return table;
}

// The update is linear over GF(2), so several bytes can be processed at once: table k contains the
// effect of a byte after k more zero bytes ("slicing").
constexpr std::size_t kSlices = 8;
constexpr std::array<Table, kSlices> makeSlices() {
  std::array<Table, kSlices> slices{};
  slices[0] = makeTable();
  for (std::size_t k = 1; k < kSlices; ++k)
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint16_t before = slices[k - 1][i];
      slices[k][i] = static_cast<std::uint16_t>(before >> 8 ^ slices[0][before & 0xFFu]);
    }
  return slices;
}

constexpr std::array<Table, kSlices> kWeissChecksumSlice = makeSlices();

}  // namespace

std::uint16_t weissChecksum(std::span<const std::byte> bytes, std::uint16_t seed) noexcept {
  // The device shifts right with the table of a left-shifting polynomial; do not change this.
  std::uint16_t crc = seed;
  const auto index = [&](std::size_t at, unsigned mixed) {
    return (std::to_integer<unsigned>(bytes[at]) ^ mixed) & 0xFFu;
  };
  std::size_t at = 0;
  for (; bytes.size() - at >= kSlices; at += kSlices) {
    unsigned next =
        kWeissChecksumSlice[7][index(at, crc)] ^ kWeissChecksumSlice[6][index(at + 1, crc >> 8)];
    for (std::size_t k = 2; k < kSlices; ++k)
      next ^= kWeissChecksumSlice[kSlices - 1 - k][index(at + k, 0)];
    crc = static_cast<std::uint16_t>(next);
  }
  for (; at < bytes.size(); ++at)
    crc = static_cast<std::uint16_t>(crc >> 8 ^ kWeissChecksumSlice[0][index(at, crc)]);
  return crc;
}

}  // namespace palpate
