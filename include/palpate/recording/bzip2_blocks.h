// The blocks of damaged bzip2 data: each is found by its 48-bit mark, at any bit, and decoded by
// itself, so that what lies behind the damage can still be had (as bzip2recover does).
//
// A block: mark 0x314159265359, checksum 32 bit of its decoded bytes, data. A stream ends with the
// mark 0x177245385090 and a checksum over the blocks' checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palpate {

inline constexpr int kBzip2MarkBits = 48;
inline constexpr int kBzip2ChecksumBits = 32;

// A mark, or bits that look like one.
struct Bzip2Mark {
  std::uint64_t bit = 0;  // of its begin, from the first byte's highest bit
  bool block = false;     // begins a block; otherwise ends a stream
};

// The first mark that begins at `fromBit` or behind it.
std::optional<Bzip2Mark> nextBzip2Mark(std::span<const std::byte> bytes, std::uint64_t fromBit);

// `count` bits from any place, at most 64. They must lie within the bytes.
std::uint64_t bzip2Bits(std::span<const std::byte> bytes, std::uint64_t bit, int count);

struct Bzip2Block {
  std::uint64_t beginBit = 0;  // of the mark, from the first byte's highest bit
  std::uint64_t endBit = 0;    // of the next mark (of a block or a stream's end), or of the data
};

// All places that look like a block, in order.
std::vector<Bzip2Block> findBzip2Blocks(std::span<const std::byte> bytes);

// A stream of its own with the one block: header of block size `level` ('1' to '9'), the block's
// bits, and the mark that `endsStream` tells: of the end, with the checksum over this block only,
// or of a further block, which is missing.
std::vector<char> bzip2StreamOf(std::span<const std::byte> bytes,
                                const Bzip2Block& block,
                                char level,
                                bool endsStream);

// CRC-32 of bzip2: polynomial 0x04C11DB7, highest bit first.
class Bzip2Checksum {
 public:
  void add(std::span<const char> bytes) noexcept;
  std::uint32_t value() const noexcept { return ~sum_; }

 private:
  std::uint32_t sum_ = 0xFFFFFFFFu;
};

struct Bzip2BlockContent {
  std::vector<char> bytes;  // decoded; empty when not intact
  bool intact = false;      // the block's own checksum is right
  // The block ends exactly where endBit says. Otherwise something damaged follows it.
  bool endsAtMark = false;
};

// Decodes one block and checks it. `maxBytes` bounds what it may expand to (a larger one counts as
// not intact).
Bzip2BlockContent decodeBzip2Block(std::span<const std::byte> bytes,
                                   const Bzip2Block& block,
                                   std::size_t maxBytes);

}  // namespace palpate
