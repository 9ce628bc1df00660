// Run-length coding of a frame's values, for memory and disk. Three codings:
//   counts: u16 units, little-endian, run << 12 | value, run 1..15, value 0..4095 (as on the
//           DSACON32-M's wire)
//   floats: pairs (u8 run 1..255, f32 value little-endian)
//   filtered: a bit per value, the least significant first, 1: the value counts
//             (TactileFrame::values), 0: it is only in TactileFrame::filtered, where nothing was
//             active as recorded; unused bits 0; then all values as floats
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class FrameCoding : std::uint8_t { kCounts = 0, kFloats = 1, kFiltered = 2 };

// Counts where every value is a whole number 0..4095, else floats.
FrameCoding codingFor(std::span<const float> values) noexcept;
// Of a frame: kFiltered where it has more than `values`.
FrameCoding codingFor(const TactileFrame& frame) noexcept;
// Appends the coded values to `out`. Throws std::invalid_argument when kCounts can't hold a value,
// and for kFiltered.
void encodeFrame(std::span<const float> values, FrameCoding coding, std::vector<std::byte>& out);
void encodeFrame(const TactileFrame& frame, FrameCoding coding, std::vector<std::byte>& out);
// Decodes exactly values.size() values from the start of `bytes`. Returns the number of bytes used;
// 0 when the bytes are not a frame of that size (then `values` is unspecified). Never throws.
std::size_t decodeFrame(std::span<const std::byte> bytes,
                        FrameCoding coding,
                        std::span<float> values) noexcept;

// Into `values` and `filtered` of a frame whose `values` has the right size already.
std::size_t decodeFrame(std::span<const std::byte> bytes, FrameCoding coding, TactileFrame& out);

// Bytes of the bits before the values of a kFiltered frame.
constexpr std::size_t activeBytes(std::size_t numValues) noexcept { return (numValues + 7) / 8; }

// As decodeFrame(), without the values: how many bytes `numValues` values take; 0 when the bytes
// are not a frame of that size.
std::size_t codedFrameBytes(std::span<const std::byte> bytes,
                            FrameCoding coding,
                            std::size_t numValues) noexcept;

}  // namespace palpate
