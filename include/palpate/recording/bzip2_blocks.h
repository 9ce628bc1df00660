// The blocks of damaged bzip2 data: each is found by its 48-bit mark, at any bit, and decoded by
// itself, so that what lies behind the damage can still be had (as bzip2recover does).
//
// A block: mark 0x314159265359, checksum 32 bit of its decoded bytes, data. A stream ends with the
// mark 0x177245385090 and a checksum over the blocks' checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpate {

struct Bzip2Block {
  std::uint64_t beginBit = 0;  // of the mark, from the first byte's highest bit
  std::uint64_t endBit = 0;    // of the next mark (of a block or a stream's end), or of the data
};

// All places that look like a block, in order.
std::vector<Bzip2Block> findBzip2Blocks(std::span<const std::byte> bytes);

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
