// Gathers items of one stream into blocks of a native recording, and takes blocks apart again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <palpate/recording/palpate_schema.h>

namespace palpate {

// Packs items until a block is full (kMaxBlockBytes; an item that is longer alone gets a longer
// one), its coding changes, or flush() is called. Not thread-safe.
class BlockPacker {
 public:
  using Sink = std::function<void(const Block&)>;
  BlockPacker(Stream stream, Sink sink);

  // Values of a frame. Time [us since 1970] must not go back.
  void addFrame(std::int64_t hostUs,
                std::optional<std::int64_t> deviceMs,
                std::span<const float> values);
  // Values of angles or temperatures.
  void addSample(std::int64_t hostUs, std::span<const double> values);
  // A frame with what filters gave beside its values.
  void addFrame(const TactileFrame& frame);
  // Hands over what is gathered.
  void flush();
  std::int64_t numItems() const noexcept { return numItems_; }
  bool empty() const noexcept { return block_.n == 0; }

 private:
  void add(std::int64_t hostUs, std::optional<std::int64_t> deviceMs, BlockCoding coding);

  Stream stream_;
  Sink sink_;
  Block block_;
  std::vector<std::byte> item_;  // the values of the item being added
  std::int64_t numItems_ = 0;
};

// Whether a block's fields make sense (before its data is looked at).
bool plausible(const Block& block) noexcept;

// Values per sample of a block of angles or temperatures; 0 where its size makes no sense.
std::size_t sampleWidth(const Block& block) noexcept;

// The stamps of a block's items [us since 1970], and where each item begins in its data.
// `numValues`: values per item (places of the layout, axes, temperature sensors). False: the data
// is not what the fields say. Never throws on damaged data.
struct BlockIndex {
  std::vector<std::int64_t> hostUs;
  std::vector<std::optional<std::int64_t>> deviceMs;
  std::vector<std::uint32_t> begin;  // of the values [bytes]
};
bool indexBlock(const Block& block, std::size_t numValues, BlockIndex& index);

// Values of the item that begins at `begin`; of a frame whose `values` has the right size already.
void readFrameValues(const Block& block, std::uint32_t begin, TactileFrame& out);
void readSampleValues(const Block& block, std::uint32_t begin, std::span<double> values);

}  // namespace palpate
