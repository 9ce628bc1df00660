#include "palpate/recording/bzip2_blocks.h"

#include <algorithm>
#include <array>

#include <bzlib.h>

namespace palpate {
namespace {

constexpr std::uint64_t kBlockMark = 0x314159265359;
constexpr std::uint64_t kEndMark = 0x177245385090;
constexpr std::uint64_t kMarkMask = 0xFFFFFFFFFFFF;
// A block holds at most 900 kB before coding, which coding makes hardly longer. What lies farther
// from its mark belongs to something else.
constexpr std::uint64_t kMaxBlockBits = 8u * (2u << 20);

// Which 16 bits can stand in the middle of a mark, whatever its place in a byte: 16 of 65536, so
// one look-up a byte rejects nearly all places.
std::vector<bool> middlesOfMarks() {
  std::vector<bool> middles(1u << 16);
  for (const std::uint64_t mark : {kBlockMark, kEndMark})
    for (int shift = 0; shift < 8; ++shift) middles[mark << shift >> 16 & 0xFFFFu] = true;
  return middles;
}

// Every block and end mark, at any bit.
std::vector<Bzip2Mark> findMarks(std::span<const std::byte> bytes) {
  std::vector<Bzip2Mark> marks;
  for (auto mark = nextBzip2Mark(bytes, 0); mark; mark = nextBzip2Mark(bytes, mark->bit + 1))
    marks.push_back(*mark);
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

constexpr std::array<std::uint32_t, 256> kChecksumTable = makeChecksumTable();

struct Decoder {
  Decoder() = default;
  ~Decoder() { BZ2_bzDecompressEnd(&z); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  bz_stream z{};
};

}  // namespace

std::optional<Bzip2Mark> nextBzip2Mark(std::span<const std::byte> bytes, std::uint64_t fromBit) {
  static const std::vector<bool> kMiddles = middlesOfMarks();
  std::uint64_t window = 0;  // the last 64 bits
  for (auto i = static_cast<std::size_t>(fromBit / 8); i < bytes.size(); ++i) {
    window = window << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    if (!kMiddles[window >> 16 & 0xFFFFu]) continue;
    const std::uint64_t bitsSoFar = 8 * (static_cast<std::uint64_t>(i) + 1);
    for (int shift = 7; shift >= 0; --shift) {  // earlier bits first
      const std::uint64_t candidate = window >> shift & kMarkMask;
      if (candidate != kBlockMark && candidate != kEndMark) continue;
      const std::uint64_t end = bitsSoFar - static_cast<std::uint64_t>(shift);
      if (end >= fromBit + kBzip2MarkBits)
        return Bzip2Mark{end - kBzip2MarkBits, candidate == kBlockMark};
    }
  }
  return std::nullopt;
}

std::uint64_t bzip2Bits(std::span<const std::byte> bytes, std::uint64_t bit, int count) {
  BitReader reader(bytes, bit);
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 1 | reader.next();
  return value;
}

std::vector<char> bzip2StreamOf(std::span<const std::byte> bytes,
                                const Bzip2Block& block,
                                char level,
                                bool endsStream) {
  std::vector<char> stream = {'B', 'Z', 'h', level};
  const std::uint64_t numBits = std::min(block.endBit - block.beginBit, kMaxBlockBits);
  stream.reserve(static_cast<std::size_t>(numBits / 8) + 16);
  BitReader reader(bytes, block.beginBit);
  for (std::uint64_t i = 0; i < numBits / 8; ++i) stream.push_back(reader.nextByte());
  BitWriter writer(stream);
  for (std::uint64_t i = 0; i < numBits % 8; ++i) writer.putBit(reader.next());
  writer.put(endsStream ? kEndMark : kBlockMark, kBzip2MarkBits);
  if (endsStream)
    writer.put(bzip2Bits(bytes, block.beginBit + kBzip2MarkBits, kBzip2ChecksumBits),
               kBzip2ChecksumBits);
  writer.pad();
  return stream;
}

void Bzip2Checksum::add(std::span<const char> bytes) noexcept {
  for (const char byte : bytes)
    sum_ = sum_ << 8 ^ kChecksumTable[(sum_ >> 24 ^ static_cast<unsigned char>(byte)) & 0xFFu];
}

std::vector<Bzip2Block> findBzip2Blocks(std::span<const std::byte> bytes) {
  const std::vector<Bzip2Mark> marks = findMarks(bytes);
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
  if (block.endBit - block.beginBit < kBzip2MarkBits + kBzip2ChecksumBits) return content;
  const auto stored = static_cast<std::uint32_t>(
      bzip2Bits(bytes, block.beginBit + kBzip2MarkBits, kBzip2ChecksumBits));

  std::vector<char> stream = bzip2StreamOf(bytes, block, '9', true);
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
  Bzip2Checksum checksum;
  checksum.add(content.bytes);
  content.intact = size > 0 && size <= maxBytes && checksum.value() == stored;
  content.endsAtMark = content.intact && result == BZ_STREAM_END;
  if (!content.intact) content.bytes.clear();
  return content;
}

}  // namespace palpate
