#include "recording/dsa/bzip2_block_reader.h"

#include <bit>
#include <cstring>
#include <optional>
#include <utility>

namespace palpate {
namespace {

constexpr std::size_t kReadBytes = 128u << 10;
// A block holds at most 900 kB before coding, which coding makes hardly longer. If no mark follows
// within this distance, something is wrong.
constexpr std::uint64_t kLargestBlockBytes = 2u << 20;
constexpr std::uint64_t kHeaderBits = 32;
constexpr std::uint64_t kMarkAndChecksumBits = kBzip2MarkBits + kBzip2ChecksumBits;

}  // namespace

Bzip2BlockReader::Bzip2BlockReader(ByteSource& source, std::vector<char> first)
    : source_(source), window_(std::move(first)) {}

std::span<const std::byte> Bzip2BlockReader::window() const noexcept {
  return std::as_bytes(std::span(window_));
}

// Reads more of the source. Returns false when there is nothing left.
bool Bzip2BlockReader::extend() {
  const std::size_t size = window_.size();
  window_.resize(size + kReadBytes);
  window_.resize(size + source_.read(std::span(window_).subspan(size)));
  return window_.size() > size;
}

// Returns whether `numBits` bits follow, and reads them if need be.
bool Bzip2BlockReader::has(std::uint64_t numBits) {
  while (8 * static_cast<std::uint64_t>(window_.size()) < bit_ + numBits)
    if (!extend()) return false;
  return true;
}

void Bzip2BlockReader::dropTakenBytes() {
  const auto size = static_cast<std::size_t>(bit_ / 8);
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(size));
  windowBegin_ += size;
  bit_ -= 8 * static_cast<std::uint64_t>(size);
}

// At the header of a stream. Returns false when it is none.
bool Bzip2BlockReader::beginStream() {
  if (!has(kHeaderBits)) return false;
  const char* const header = window_.data() + bit_ / 8;
  if (std::memcmp(header, "BZh", 3) != 0 || header[3] < '1' || header[3] > '9') return false;
  level_ = header[3];
  bit_ += kHeaderBits;
  checksum_ = 0;
  inStream_ = true;
  return true;
}

// Behind the mark of a stream's end. Returns false when the stream's checksum is wrong.
bool Bzip2BlockReader::endStream() {
  const std::uint64_t stored = bzip2Bits(window(), bit_ + kBzip2MarkBits, kBzip2ChecksumBits);
  bit_ = (bit_ + kMarkAndChecksumBits + 7) / 8 * 8;
  inStream_ = false;
  return stored == checksum_;
}

// Finds the mark behind the block that begins at bit_. Returns false when there is none.
bool Bzip2BlockReader::findEnd(Bzip2Mark& end) {
  std::uint64_t from = bit_ + kBzip2MarkBits;
  for (;;) {
    if (const std::optional<Bzip2Mark> mark = nextBzip2Mark(window(), from)) {
      end = *mark;
      return true;
    }
    // The next mark may begin within the last bits already.
    const std::uint64_t bits = 8 * static_cast<std::uint64_t>(window_.size());
    if (bits - bit_ > 8 * kLargestBlockBytes) return false;
    if (bits >= from + kBzip2MarkBits) from = bits - kBzip2MarkBits + 1;
    if (!extend()) return false;
  }
}

Bzip2BlockReader::Next Bzip2BlockReader::next(Block& block) {
  dropTakenBytes();
  for (;;) {
    if (!inStream_) {
      const bool begun = windowBegin_ + bit_ / 8 > 0;
      if (begun && !has(1)) {
        block.bytesTaken = windowBegin_ + bit_ / 8;
        return Next::kEnd;
      }
      if (!beginStream()) return Next::kIrregular;
    }
    if (!has(kMarkAndChecksumBits)) return Next::kIrregular;
    const std::optional<Bzip2Mark> mark = nextBzip2Mark(
        window().first(static_cast<std::size_t>((bit_ + kMarkAndChecksumBits + 7) / 8)), bit_);
    if (!mark || mark->bit != bit_) return Next::kIrregular;
    if (mark->block) break;
    if (!endStream()) return Next::kIrregular;
  }
  Bzip2Mark end;
  if (!findEnd(end)) return Next::kIrregular;
  if (end.bit < bit_ + kMarkAndChecksumBits) return Next::kIrregular;
  block.checksum =
      static_cast<std::uint32_t>(bzip2Bits(window(), bit_ + kBzip2MarkBits, kBzip2ChecksumBits));
  checksum_ = std::rotl(checksum_, 1) ^ block.checksum;
  block.endsStream = !end.block;
  block.stream = bzip2StreamOf(window(), {bit_, end.bit}, level_, block.endsStream);
  block.numBytes = static_cast<std::size_t>((kHeaderBits + end.bit - bit_ + 7) / 8);
  bit_ = end.bit;
  block.bytesTaken = windowBegin_ + bit_ / 8;
  return Next::kBlock;
}

}  // namespace palpate
