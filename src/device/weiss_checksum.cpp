#include "palpate/device/weiss_checksum.h"

#include <array>

namespace palpate {
namespace {

constexpr std::array<std::uint16_t, 256> makeTable() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned remainder = i << 8;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 0x8000u) != 0 ? remainder << 1 ^ 0x1021u : remainder << 1;
    table[i] = static_cast<std::uint16_t>(remainder);
  }
  return table;
}

constexpr std::array<std::uint16_t, 256> kTable = makeTable();

}  // namespace

std::uint16_t weissChecksum(std::span<const std::byte> bytes, std::uint16_t seed) noexcept {
  std::uint16_t crc = seed;  // the device shifts right through a left-shifting table: keep it so
  for (const std::byte b : bytes)
    crc =
        static_cast<std::uint16_t>(crc >> 8 ^ kTable[(crc ^ std::to_integer<unsigned>(b)) & 0xFFu]);
  return crc;
}

}  // namespace palpate
