#include "palpate/model/frame_coding.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "palpate/core/byte_reader.h"

namespace palpate {
namespace {

constexpr std::size_t kLongestCountsRun = 15;
constexpr std::size_t kLongestFloatsRun = 255;
constexpr float kMaxCounts = 4095.0F;

// Returns a value other than zero when `value` is not a number of counts. Uses integers only, so
// that the compiler can vectorise a loop over it: the bits of floats from 0 to 4095 are ordered
// like the numbers, and the bits of negative floats (also -0) are a negative integer.
std::int32_t differsFromCounts(float value) noexcept {
  constexpr auto kMaxBits = std::bit_cast<std::int32_t>(kMaxCounts);
  const auto bits = std::bit_cast<std::int32_t>(value);
  const std::int32_t inRange = -static_cast<std::int32_t>((bits >= 0) & (bits <= kMaxBits));
  const auto whole = static_cast<std::int32_t>(std::bit_cast<float>(bits & inRange));
  return bits ^ std::bit_cast<std::int32_t>(static_cast<float>(whole));
}

// Writes `bytes` bytes of `value` to `at`, little-endian, and returns the position behind them.
std::byte* putLittle(std::byte* at, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) *at++ = static_cast<std::byte>(value >> 8 * i & 0xFF);
  return at;
}

// Compares bits, so that a NaN equals itself and -0 differs from 0.
bool same(float a, float b) noexcept {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// Returns how many values at the start are the same, at least 1. Runs of zeros are long: so four
// values are compared between two decisions.
std::size_t runLength(std::span<const float> values) noexcept {
  constexpr std::size_t kStep = 4;
  const auto first = std::bit_cast<std::uint32_t>(values[0]);
  std::size_t run = 1;
  while (run + kStep <= values.size()) {
    std::uint32_t differs = 0;
    for (std::size_t i = 0; i < kStep; ++i)
      differs |= std::bit_cast<std::uint32_t>(values[run + i]) ^ first;
    if (differs != 0) break;
    run += kStep;
  }
  while (run < values.size() && same(values[run], values[0])) ++run;
  return run;
}

}  // namespace

FrameCoding codingFor(std::span<const float> values) noexcept {
  std::int32_t differs = 0;
  for (float value : values)
    differs |= differsFromCounts(value);  // no early exit, so that the loop is vectorised
  return differs == 0 ? FrameCoding::kCounts : FrameCoding::kFloats;
}

void encodeFrame(std::span<const float> values, FrameCoding coding, std::vector<std::byte>& out) {
  if (coding == FrameCoding::kFiltered)
    throw std::invalid_argument("encodeFrame: values alone don't say which of them count");
  const bool counts = coding == FrameCoding::kCounts;
  const std::size_t longest = counts ? kLongestCountsRun : kLongestFloatsRun;
  // Make room for the worst case first, so that the loop never reallocates.
  const std::size_t start = out.size();
  out.resize(start + values.size() * (counts ? 2 : 5));
  std::byte* at = out.data() + start;
  for (std::size_t i = 0; i < values.size();) {
    const float value = values[i];
    if (counts && differsFromCounts(value) != 0) {
      out.resize(start);
      throw std::invalid_argument("encodeFrame: a value is not a number of counts 0..4095");
    }
    std::size_t left = runLength(values.subspan(i));
    i += left;
    while (left > 0) {
      const std::size_t run = std::min(left, longest);
      left -= run;
      if (counts) {
        const auto unit = static_cast<std::uint32_t>(run << 12) | static_cast<std::uint32_t>(value);
        at = putLittle(at, unit, 2);
      } else {
        at = putLittle(at, static_cast<std::uint32_t>(run), 1);
        at = putLittle(at, std::bit_cast<std::uint32_t>(value), 4);
      }
    }
  }
  out.resize(static_cast<std::size_t>(at - out.data()));
}

FrameCoding codingFor(const TactileFrame& frame) noexcept {
  return frame.filtered.empty() ? codingFor(std::span(frame.values)) : FrameCoding::kFiltered;
}

void encodeFrame(const TactileFrame& frame, FrameCoding coding, std::vector<std::byte>& out) {
  if (coding != FrameCoding::kFiltered) return encodeFrame(std::span(frame.values), coding, out);
  const std::vector<float>& all = frame.allValues();
  const std::size_t bits = out.size();
  out.resize(bits + activeBytes(all.size()), std::byte{0});
  for (std::size_t i = 0; i < all.size(); ++i)
    if (same(frame.values[i], all[i])) out[bits + i / 8] |= static_cast<std::byte>(1U << i % 8);
  encodeFrame(std::span(all), FrameCoding::kFloats, out);
}

namespace {

// Calls fill(filled, run, value) for every run until there are `numValues` values. Returns the
// number of bytes used; 0 when the bytes are no such frame.
template <typename Fill>
std::size_t eachRun(std::span<const std::byte> bytes,
                    FrameCoding coding,
                    std::size_t numValues,
                    Fill fill) noexcept {
  ByteReader in(bytes);
  if (coding == FrameCoding::kFiltered) {
    std::uint8_t bits = 0;
    for (std::size_t i = 0; i < activeBytes(numValues); ++i) bits = in.u8();
    if (numValues % 8 != 0 && bits >> numValues % 8 != 0) return 0;
  }
  std::size_t filled = 0;
  while (filled < numValues) {
    std::size_t run = 0;
    float value = 0.0F;
    if (coding == FrameCoding::kCounts) {
      const unsigned unit = in.u16();
      run = unit >> 12;
      value = static_cast<float>(unit & 0xFFF);
    } else {
      run = in.u8();
      value = in.f32();
    }
    if (!in.ok() || run == 0 || run > numValues - filled) return 0;
    fill(filled, run, value);
    filled += run;
  }
  return in.position();
}

}  // namespace

std::size_t decodeFrame(std::span<const std::byte> bytes,
                        FrameCoding coding,
                        std::span<float> values) noexcept {
  return eachRun(
      bytes, coding, values.size(), [&](std::size_t filled, std::size_t run, float value) {
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(filled), run, value);
      });
}

std::size_t decodeFrame(std::span<const std::byte> bytes, FrameCoding coding, TactileFrame& out) {
  out.filtered.clear();
  const std::size_t used = decodeFrame(bytes, coding, std::span(out.values));
  if (coding != FrameCoding::kFiltered || used == 0) return used;
  out.filtered = out.values;
  for (std::size_t i = 0; i < out.values.size(); ++i)
    if ((bytes[i / 8] & static_cast<std::byte>(1U << i % 8)) == std::byte{0}) out.values[i] = 0.0F;
  return used;
}

std::size_t codedFrameBytes(std::span<const std::byte> bytes,
                            FrameCoding coding,
                            std::size_t numValues) noexcept {
  return eachRun(bytes, coding, numValues, [](std::size_t, std::size_t, float) {});
}

}  // namespace palpate
