// Gathers the items of one stream into blocks of a native recording (palpate_schema.h), and takes
// blocks apart again. Taking apart never trusts the data: a checksum protects against accidents,
// not against a hostile file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <palpate/recording/palpate_schema.h>

namespace palpate {

// Packs items into a block until it is full (kMaxBlockBytes; an item that alone is longer gets a
// longer block), until the coding changes, or until flush() is called. Not thread-safe.
class BlockPacker {
 public:
  // Takes a block that is complete; the block is valid only inside the call.
  using Sink = std::function<void(const Block&)>;
  BlockPacker(Stream stream, Sink sink);

  // Adds the values of a frame. The host time [us since 1970] must not go back. Device times [us]
  // are stored in milliseconds until one of them isn't a whole number of these.
  void addFrame(std::int64_t hostUs,
                std::optional<std::int64_t> deviceUs,
                std::span<const float> values);
  // Adds a sample of a series.
  void addSample(std::int64_t hostUs,
                 std::span<const double> values,
                 std::optional<std::int64_t> deviceUs = {});
  // Adds a frame together with what filters gave beside its values (TactileFrame::filtered).
  void addFrame(const TactileFrame& frame);
  // Hands over what is gathered; does nothing when there is nothing.
  void flush();
  std::int64_t numItems() const noexcept { return numItems_; }
  bool empty() const noexcept { return block_.n == 0; }

 private:
  void add(std::int64_t hostUs, std::optional<std::int64_t> deviceUs, BlockCoding coding);

  Stream stream_;
  Sink sink_;
  Block block_;
  std::vector<std::byte> item_;  // the values of the item being added
  std::int64_t numItems_ = 0;
  bool deviceUs_ = false;  // device times are stored in microseconds
};

// Whether the fields of a block make sense. It is asked before the data is looked at.
bool plausible(const Block& block) noexcept;

// The number of values per sample of a block of a series; 0 where the size of the block makes no
// sense.
std::size_t sampleWidth(const Block& block) noexcept;

// The stamps of the items of a block [us since 1970], and where the values of each begin in its
// data. `numValues` is the number of values per item: places of the layout, or columns of
// the series. indexBlock() returns false when the data is not what the fields say; it never throws
// on damaged data.
struct BlockIndex {
  std::vector<std::int64_t> hostUs;
  std::vector<std::optional<std::int64_t>> deviceUs;
  std::vector<std::uint32_t> begin;  // of the values [bytes]
};
bool indexBlock(const Block& block, std::size_t numValues, BlockIndex& index);

// Read the values of the item that begins at `begin` (BlockIndex::begin), into a frame or span that
// has the right size already. The block must have passed indexBlock().
void readFrameValues(const Block& block, std::uint32_t begin, TactileFrame& out);
void readSampleValues(const Block& block, std::uint32_t begin, std::span<double> values);

}  // namespace palpate
