// The samples of a profile that lie in blocks of a native recording, wherever the blocks are: their
// index lies in memory, the blocks themselves are read on demand. Private to this module.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/model/profile.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/block_cache.h"

namespace palpate {

// One block in the index; the entries of all blocks of a recording are kept in memory.
struct BlockEntry {
  std::int64_t first = 0;  // index of its first item in the profile
  std::int64_t n = 0;      // number of items
  std::int64_t t0Us = 0;   // host time of the first item [us since 1970]
  std::int64_t t1Us = 0;   // host time of the last item [us since 1970]
  std::int64_t id = 0;     // what the loader knows the block by
};

// Reading is safe from several threads once the index is complete.
class BlockStorage : public ProfileStorage {
 public:
  // Gives the block of an id after checking its checksum; throws FormatError. It is called by one
  // thread at a time.
  using Loader = std::function<Block(std::int64_t id)>;

  BlockStorage(std::filesystem::path path, Loader loader);

  // Appends an entry to a stream. Returns false and appends nothing when the entry doesn't follow
  // the ones before it in index and time, or makes no sense.
  bool add(Stream stream, const BlockEntry& place);
  // Takes all entries of a stream out again.
  void drop(Stream stream) { streams_[static_cast<std::size_t>(stream)] = {}; }
  // The number of values per item; it must be set before items are read.
  void setWidth(Stream stream, std::size_t numValues);
  std::size_t width(Stream stream) const { return of(stream).numValues; }
  const std::vector<BlockEntry>& places(Stream stream) const { return of(stream).places; }

  // Whether frames are the readings of a sensor; it must be set before frames are read.
  void setGivesReadings(bool gives) { givesReadings_ = gives; }
  bool givesReadings() const override { return givesReadings_; }

  std::size_t numFrames() const override { return of(Stream::kTactile).numItems; }
  std::int64_t frameTimeUs(std::size_t frame) const override;
  void readFrame(std::size_t frame, TactileFrame& out) const override;
  std::size_t numSamples(std::size_t series) const override {
    return of(streamOfSeries(series)).numItems;
  }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override;
  Sample sample(std::size_t series, std::size_t sample) const override;
  // Search over the times of the blocks, and read at most the block that holds the sample.
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const override;
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const override;

 private:
  struct Entries {
    std::vector<BlockEntry> places;
    std::size_t numItems = 0;
    std::size_t numValues = 0;  // per item
  };
  struct OpenBlock {
    Block block;
    BlockIndex index;
    std::size_t first = 0;  // in the profile
  };
  struct OpenItem {
    std::shared_ptr<const OpenBlock> block;
    std::size_t item;
  };

  static constexpr std::size_t kCachedBytes = 2u << 20;  // of blocks, per profile

  const Entries& of(Stream stream) const { return streams_[static_cast<std::size_t>(stream)]; }
  const BlockEntry& placeOf(Stream stream, std::size_t item) const;
  std::int64_t timeUs(Stream stream, std::size_t item) const;
  std::optional<std::size_t> itemAt(Stream stream, std::int64_t timeUs) const;
  // The lock is held in these four.
  OpenItem open(Stream stream, std::size_t item) const;
  std::shared_ptr<const OpenBlock> loaded(Stream stream, const BlockEntry& place) const;
  // As open(); null where the block can't be read.
  std::shared_ptr<const OpenBlock> readable(Stream stream, std::size_t item) const;
  const OpenBlock* lastWith(Stream stream, std::size_t item) const;

  std::filesystem::path path_;
  Loader loader_;
  bool givesReadings_ = false;
  std::array<Entries, kMaxStreams> streams_;
  mutable std::mutex mutex_;  // over loader and cache
  mutable BlockCache<std::shared_ptr<const OpenBlock>> cache_{kCachedBytes};  // by id
  mutable std::unordered_map<std::int64_t, FormatError> damaged_;           // by id: not read again
  mutable std::array<std::shared_ptr<const OpenBlock>, kMaxStreams> last_;  // read last, per stream
};

}  // namespace palpate
