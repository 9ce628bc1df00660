#include "palpate/recording/bzip2_blocks.h"

#include <algorithm>
#include <array>

#include <bzlib.h>

namespace palpate {
namespace {

constexpr std::uint64_t kBlockMark = 0x314159265359;
constexpr std::uint64_t kEndMark = 0x177245385090;
constexpr std::uint64_t kMarkMask = 0xFFFFFFFFFFFF;
constexpr int kMarkBits = 48;
constexpr int kChecksumBits = 32;
// A block holds at most 900 kB before coding, which coding makes hardly longer. What lies farther
// from its mark belongs to something else.
constexpr std::uint64_t kMaxBlockBits = 8u * (2u << 20);

struct Mark {
  std::uint64_t bit = 0;
  bool block = false;
};

// Which 16 bits can stand in the middle of a mark, whatever its place in a byte: 16 of 65536, so
// one look-up a byte rejects nearly all places.
std::vector<bool> middlesOfMarks() {
  std::vector<bool> middles(1u << 16);
  for (const std::uint64_t mark : {kBlockMark, kEndMark})
    for (int shift = 0; shift < 8; ++shift) middles[mark << shift >> 16 & 0xFFFFu] = true;
  return middles;
}

// Every block and end mark, at any bit.
std::vector<Mark> findMarks(std::span<const std::byte> bytes) {
  const std::vector<bool> middles = middlesOfMarks();
  std::vector<Mark> marks;
  std::uint64_t window = 0;  // the last 64 bits
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    window = window << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    if (!middles[window >> 16 & 0xFFFFu]) continue;
    const std::uint64_t bitsSoFar = 8 * (static_cast<std::uint64_t>(i) + 1);
    for (int shift = 7; shift >= 0; --shift) {  // earlier bits first
      const std::uint64_t candidate = window >> shift & kMarkMask;
      if (candidate != kBlockMark && candidate != kEndMark) continue;
      const std::uint64_t end = bitsSoFar - static_cast<std::uint64_t>(shift);
      if (end >= kMarkBits) marks.push_back({end - kMarkBits, candidate == kBlockMark});
    }
  }
  return marks;
}

// Bits of a byte string, read from any place.
class BitReader {
 public:
  BitReader(std::span<const std::byte> bytes, std::uint64_t bit) : bytes_(bytes), bit_(bit) {}
  unsigned next() {
    const auto byte = std::to_integer<unsigned>(bytes_[static_cast<std::size_t>(bit_ / 8)]);
    return byte >> (7 - bit_++ % 8) & 1u;
  }
  // The next 8 bits; behind the end, zeros.
  char nextByte() {
    const auto index = static_cast<std::size_t>(bit_ / 8);
    const auto at = [&](std::size_t i) {
      return i < bytes_.size() ? std::to_integer<unsigned>(bytes_[i]) : 0u;
    };
    const unsigned pair = at(index) << 8 | at(index + 1);
    const unsigned shift = 8 - static_cast<unsigned>(bit_ % 8);
    bit_ += 8;
    return static_cast<char>(pair >> shift & 0xFFu);
  }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t bit_;
};

class BitWriter {
 public:
  explicit BitWriter(std::vector<char>& out) : out_(out) {}
  void put(std::uint64_t value, int bits) {
    for (int i = bits - 1; i >= 0; --i) putBit(static_cast<unsigned>(value >> i & 1u));
  }
  void putBit(unsigned bit) {
    byte_ = byte_ << 1 | bit;
    if (++numBits_ == 8) {
      out_.push_back(static_cast<char>(byte_ & 0xFFu));
      numBits_ = 0;
    }
  }
  void pad() {
    while (numBits_ != 0) putBit(0);
  }

 private:
  std::vector<char>& out_;
  unsigned byte_ = 0;
  int numBits_ = 0;
};

// CRC-32 of bzip2: polynomial 0x04C11DB7, highest bit first.
constexpr std::array<std::uint32_t, 256> makeChecksumTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i << 24;
    for (int bit = 0; bit < 8; ++bit)
      value = value & 0x80000000u ? value << 1 ^ 0x04C11DB7u : value << 1;
    table[i] = value;
  }
  return table;
}

std::uint32_t checksumOf(std::span<const char> bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = makeChecksumTable();
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const char byte : bytes)
    sum = sum << 8 ^ kTable[(sum >> 24 ^ static_cast<unsigned char>(byte)) & 0xFFu];
  return ~sum;
}

// A stream of its own around the block: header, the block's bits, end mark, checksum (that of the
// only block).
std::vector<char> streamAround(std::span<const std::byte> bytes,
                               const Bzip2Block& block,
                               std::uint32_t checksum) {
  std::vector<char> stream = {'B', 'Z', 'h', '9'};
  const std::uint64_t numBits = std::min(block.endBit - block.beginBit, kMaxBlockBits);
  stream.reserve(static_cast<std::size_t>(numBits / 8) + 16);
  BitReader reader(bytes, block.beginBit);
  for (std::uint64_t i = 0; i < numBits / 8; ++i) stream.push_back(reader.nextByte());
  BitWriter writer(stream);
  for (std::uint64_t i = 0; i < numBits % 8; ++i) writer.putBit(reader.next());
  writer.put(kEndMark, kMarkBits);
  writer.put(checksum, kChecksumBits);
  writer.pad();
  return stream;
}

struct Decoder {
  Decoder() = default;
  ~Decoder() { BZ2_bzDecompressEnd(&z); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  bz_stream z{};
};

}  // namespace

std::vector<Bzip2Block> findBzip2Blocks(std::span<const std::byte> bytes) {
  const std::vector<Mark> marks = findMarks(bytes);
  std::vector<Bzip2Block> blocks;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!marks[i].block) continue;
    const std::uint64_t end =
        i + 1 < marks.size() ? marks[i + 1].bit : 8 * static_cast<std::uint64_t>(bytes.size());
    blocks.push_back({marks[i].bit, end});
  }
  return blocks;
}

Bzip2BlockContent decodeBzip2Block(std::span<const std::byte> bytes,
                                   const Bzip2Block& block,
                                   std::size_t maxBytes) {
  Bzip2BlockContent content;
  if (block.endBit - block.beginBit < kMarkBits + kChecksumBits) return content;
  BitReader reader(bytes, block.beginBit + kMarkBits);
  std::uint32_t stored = 0;
  for (int i = 0; i < kChecksumBits; ++i) stored = stored << 1 | reader.next();

  std::vector<char> stream = streamAround(bytes, block, stored);
  Decoder decoder;
  if (BZ2_bzDecompressInit(&decoder.z, 0, 0) != BZ_OK) throw std::bad_alloc();
  decoder.z.next_in = stream.data();
  decoder.z.avail_in = static_cast<unsigned>(stream.size());
  int result = BZ_OK;
  std::size_t size = 0;
  constexpr std::size_t kStep = 256u << 10;
  while (result == BZ_OK && size <= maxBytes) {
    content.bytes.resize(size + kStep);
    decoder.z.next_out = content.bytes.data() + size;
    decoder.z.avail_out = kStep;
    result = BZ2_bzDecompress(&decoder.z);
    const std::size_t got = kStep - decoder.z.avail_out;
    size += got;
    if (got == 0 && decoder.z.avail_in == 0) break;  // the data ends within the block
  }
  content.bytes.resize(size);
  // Where the mark behind the block is damaged the decoder stumbles after the block's last byte, so
  // the block's own checksum decides, not the decoder's answer.
  content.intact = size > 0 && size <= maxBytes && checksumOf(content.bytes) == stored;
  content.endsAtMark = content.intact && result == BZ_STREAM_END;
  if (!content.intact) content.bytes.clear();
  return content;
}

}  // namespace palpate
