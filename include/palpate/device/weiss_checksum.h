// Checksum of the DSACON32-M's packets and of the SDH-2's binary records. It is NOT CRC-16/CCITT
// nor any other named one: the table is that of the left-shifting polynomial 0x1021, but the update
// shifts right. Seed 0xFFFF, no final xor, sent low byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace palpate {

// Continues the checksum from `seed`. Never fails.
std::uint16_t weissChecksum(std::span<const std::byte> bytes, std::uint16_t seed = 0xFFFF) noexcept;

}  // namespace palpate
