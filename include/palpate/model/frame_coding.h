// Run-length coding of a frame's values. Profiles in memory and .palpate recordings use it. There
// are three codings:
//   counts: u16 units, little-endian, run << 12 | value, run 1..15, value 0..4095 (as the
//           DSACON32-M sends them)
//   floats: pairs (u8 run 1..255, f32 value little-endian)
//   filtered: first one bit per value, the least significant first: 1 means that the value also
//             belongs to TactileFrame::values, 0 that only TactileFrame::filtered holds it,
//             because the taxel was not active in the recording; unused bits are 0. Then all
//             values, coded as floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

// The three codings above.
enum class FrameCoding : std::uint8_t { kCounts = 0, kFloats = 1, kFiltered = 2 };

// Returns kCounts when every value is a whole number 0..4095, kFloats otherwise.
FrameCoding codingFor(std::span<const float> values) noexcept;
// Returns the coding for a frame: kFiltered when the frame has `filtered` values, otherwise the
// coding for its `values`.
FrameCoding codingFor(const TactileFrame& frame) noexcept;
// Appends the coded values to `out`. Throws std::invalid_argument when a value does not fit
// kCounts, and always for kFiltered, which needs a whole frame.
void encodeFrame(std::span<const float> values, FrameCoding coding, std::vector<std::byte>& out);
void encodeFrame(const TactileFrame& frame, FrameCoding coding, std::vector<std::byte>& out);
// Decodes exactly values.size() values from the start of `bytes`. Returns the number of bytes used;
// 0 when the bytes are not a frame of that size (then `values` is unspecified). Never throws.
std::size_t decodeFrame(std::span<const std::byte> bytes,
                        FrameCoding coding,
                        std::span<float> values) noexcept;

// Decodes into `values` and `filtered` of a frame; `values` must already have the right size.
// Returns as the function above.
std::size_t decodeFrame(std::span<const std::byte> bytes, FrameCoding coding, TactileFrame& out);

// Number of bytes that the bits before the values of a kFiltered frame take.
constexpr std::size_t activeBytes(std::size_t numValues) noexcept { return (numValues + 7) / 8; }

// Returns how many bytes `numValues` coded values take, without decoding them; 0 when the bytes are
// not a frame of that size.
std::size_t codedFrameBytes(std::span<const std::byte> bytes,
                            FrameCoding coding,
                            std::size_t numValues) noexcept;

}  // namespace palpate
