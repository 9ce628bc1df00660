#include "palpate/recording/palpate_reader.h"

#include <algorithm>
#include <array>
#include <list>
#include <mutex>
#include <unordered_map>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/palpate_access.h"
#include "recording/palpate_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kCachedBlocks = 256;  // per recording; at most about 1 MB

// Where a block lies; all of a recording's are kept in memory.
struct BlockPlace {
  std::int64_t first = 0;
  std::int64_t n = 0;
  std::int64_t t0Us = 0;
  std::int64_t t1Us = 0;
  std::int64_t id = 0;
};

// A block, checked and ready for random access to its items.
struct OpenBlock {
  Block block;
  BlockIndex index;
};

// The blocks of one stream in order.
struct StreamIndex {
  std::vector<BlockPlace> places;
  std::size_t numItems = 0;
  std::size_t numValues = 0;  // per item

  const BlockPlace& placeOf(std::size_t item) const {
    const auto after = std::upper_bound(places.begin(),
                                        places.end(),
                                        static_cast<std::int64_t>(item),
                                        [](std::int64_t i, const auto& p) { return i < p.first; });
    return *std::prev(after);
  }
};

class PalpateStorage final : public ProfileStorage {
 public:
  PalpateStorage(const fs::path& path, const Progress& progress)
      : path_(path), access_(path), layout_(readLayout(access_.database())) {
    indexBlocks(progress);
    readBlock_.emplace(access_.database().prepare(
        "SELECT stream, first, n, t0_us, t1_us, coding, crc32, data FROM block WHERE id=?"));
    streams_[0].numValues = layout_.numPlaces();
    for (Stream stream : {Stream::kAngles, Stream::kTemperatures}) findWidth(stream);
  }

  const SensorLayout& layout() const { return layout_; }
  PalpateAccess& access() { return access_; }
  std::size_t width(Stream stream) const { return streamOf(stream).numValues; }

  std::size_t numFrames() const override { return streams_[0].numItems; }
  std::int64_t frameTimeUs(std::size_t i) const override { return timeUs(Stream::kTactile, i); }
  void readFrame(std::size_t i, TactileFrame& out) const override {
    const auto [block, item] = open(Stream::kTactile, i);
    out.deviceMs = block->index.deviceMs[item];
    readFrameValues(block->block, block->index.begin[item], out.values);
  }
  std::size_t numAngles() const override { return streams_[1].numItems; }
  std::int64_t angleTimeUs(std::size_t i) const override { return timeUs(Stream::kAngles, i); }
  JointAngles angles(std::size_t i) const override {
    auto [hostUs, values] = sample(Stream::kAngles, i);
    return {hostUs, std::move(values)};
  }
  std::size_t numTemperatures() const override { return streams_[2].numItems; }
  std::int64_t temperatureTimeUs(std::size_t i) const override {
    return timeUs(Stream::kTemperatures, i);
  }
  Temperatures temperatures(std::size_t i) const override {
    auto [hostUs, values] = sample(Stream::kTemperatures, i);
    return {hostUs, std::move(values)};
  }

 private:
  const StreamIndex& streamOf(Stream stream) const {
    return streams_[static_cast<std::size_t>(stream)];
  }

  void indexBlocks(const Progress& progress) {
    constexpr std::size_t kRowsPerReport = 65536;
    SqliteDatabase& database = access_.database();
    SqliteStatement rows = database.prepare(
        "SELECT stream, first, n, t0_us, t1_us, id FROM block ORDER BY stream, first");
    std::size_t numRows = 0;
    while (rows.next()) {
      if (progress && ++numRows % kRowsPerReport == 0 && !progress(0.5)) throw Cancelled();
      const std::int64_t stream = rows.integer(0);
      const BlockPlace place{
          rows.integer(1), rows.integer(2), rows.integer(3), rows.integer(4), rows.integer(5)};
      if (stream < 0 || stream > 2 || place.n < 1 ||
          place.first !=
              static_cast<std::int64_t>(streams_[static_cast<std::size_t>(stream)].numItems))
        throw FormatError(path_,
                          "blocks are missing or damaged; 'palpate recover' saves the others");
      StreamIndex& index = streams_[static_cast<std::size_t>(stream)];
      index.places.push_back(place);
      index.numItems += static_cast<std::size_t>(place.n);
    }
  }

  // Values per sample: from the size of the first block.
  void findWidth(Stream stream) {
    StreamIndex& index = streams_[static_cast<std::size_t>(stream)];
    if (index.places.empty()) return;
    const Block block = load(index.places.front().id);
    const std::size_t perItem = block.data.size() / static_cast<std::size_t>(block.n);
    index.numValues = (perItem - 12) / (block.coding == BlockCoding::kPlainF64 ? 8 : 4);
  }

  // Reads a block and checks its CRC.
  Block load(std::int64_t id) const {
    SqliteStatement& query = *readBlock_;
    query.bind(1, id);
    if (!query.next()) throw FormatError(path_, "block " + std::to_string(id) + " is gone");
    Block block;
    block.stream = static_cast<Stream>(std::clamp<std::int64_t>(query.integer(0), 0, 255));
    block.first = query.integer(1);
    block.n = query.integer(2);
    block.t0Us = query.integer(3);
    block.t1Us = query.integer(4);
    block.coding = static_cast<BlockCoding>(std::clamp<std::int64_t>(query.integer(5), 0, 255));
    const std::int64_t crc = query.integer(6);
    const auto data = query.blob(7);
    block.data.assign(data.begin(), data.end());
    query.reset();
    if (crc != static_cast<std::int64_t>(blockCrc(block)) || !plausible(block))
      throw FormatError(
          path_,
          "block " + std::to_string(id) +
              " is damaged (its checksum is wrong); 'palpate recover' saves the others");
    return block;
  }

  struct OpenItem {
    std::shared_ptr<const OpenBlock> block;
    std::size_t item;
  };

  OpenItem open(Stream stream, std::size_t item) const {
    std::lock_guard lock(mutex_);
    // Mostly the block that was read last: samples are read one after the other.
    std::shared_ptr<const OpenBlock>& last = last_[static_cast<std::size_t>(stream)];
    if (last) {
      const std::size_t from = static_cast<std::size_t>(last->block.first);
      if (item >= from && item < from + static_cast<std::size_t>(last->block.n))
        return {last, item - from};
    }
    const BlockPlace& place = streamOf(stream).placeOf(item);
    const std::size_t within = item - static_cast<std::size_t>(place.first);
    const auto cached = cache_.find(place.id);
    if (cached != cache_.end()) {
      last = cached->second;
      return {last, within};
    }
    auto opened = std::make_shared<OpenBlock>();
    opened->block = load(place.id);
    if (opened->block.n != place.n || opened->block.stream != stream ||
        !indexBlock(opened->block, streamOf(stream).numValues, opened->index))
      throw FormatError(path_, "block " + std::to_string(place.id) + " makes no sense");
    if (order_.size() >= kCachedBlocks) {
      cache_.erase(order_.front());
      order_.pop_front();
    }
    order_.push_back(place.id);
    cache_.emplace(place.id, opened);
    last = opened;
    return {std::move(opened), within};
  }

  std::int64_t timeUs(Stream stream, std::size_t item) const {
    const BlockPlace& place = streamOf(stream).placeOf(item);
    // First and last stamps stand in the index: searching by time opens one block, not twenty.
    if (static_cast<std::int64_t>(item) == place.first) return place.t0Us;
    if (static_cast<std::int64_t>(item) == place.first + place.n - 1) return place.t1Us;
    const auto [block, within] = open(stream, item);
    return block->index.hostUs[within];
  }

  std::pair<std::int64_t, std::vector<double>> sample(Stream stream, std::size_t item) const {
    const auto [block, within] = open(stream, item);
    std::vector<double> values(streamOf(stream).numValues);
    readSampleValues(block->block, block->index.begin[within], values);
    return {block->index.hostUs[within], std::move(values)};
  }

  fs::path path_;
  mutable PalpateAccess access_;
  SensorLayout layout_;
  std::array<StreamIndex, 3> streams_;
  mutable std::mutex mutex_;  // over the connection and the cache
  mutable std::optional<SqliteStatement> readBlock_;
  mutable std::unordered_map<std::int64_t, std::shared_ptr<const OpenBlock>> cache_;
  mutable std::list<std::int64_t> order_;                         // of entering the cache
  mutable std::array<std::shared_ptr<const OpenBlock>, 3> last_;  // read last, per stream
};

// A finished recording says it; of others every block must be looked at.
ValueType valueTypeOf(SqliteDatabase& database) {
  std::string text = readMeta(database, "value_type");
  if (text.empty())
    text = database.integerOf("SELECT EXISTS(SELECT 1 FROM block WHERE stream=0 AND coding<>0)")
               ? "float"
               : "counts";
  return text == "float" ? ValueType::kFloat : ValueType::kCounts;
}

}  // namespace

Profile readPalpate(const fs::path& path, const Progress& progress) {
  auto storage = std::make_shared<PalpateStorage>(path, progress);
  SqliteDatabase& database = storage->access().database();
  ProfileInfo info;
  info.format = "palpate";
  info.serial = readMeta(database, "serial");
  info.firmware = readMeta(database, "firmware");
  info.valueType = valueTypeOf(database);
  if (storage->access().unfinished())
    info.warnings.emplace_back("unfinished: its writer stopped before the end");
  if (storage->access().beingWritten())
    info.warnings.emplace_back("still being written: shown as far as it was when opened");
  HandDescription hand = describeHand(
      storage->layout(), storage->width(Stream::kAngles), storage->width(Stream::kTemperatures));
  return {std::move(info), std::move(hand), std::move(storage)};
}

EventsReport readPalpateEvents(const fs::path& path) {
  PalpateAccess access(path);
  EventsReport report;
  SqliteStatement rows = access.database().prepare(
      "SELECT id, t_us, t1_us, kind, matrix, text, json, crc32 FROM event ORDER BY t_us, id");
  while (rows.next()) {
    RecordingEvent event{
        rows.integer(1), rows.integer(2), rows.text(3), {}, rows.text(5), rows.text(6)};
    if (!rows.isNull(4)) event.matrix = static_cast<int>(rows.integer(4));
    if (rows.integer(7) == static_cast<std::int64_t>(eventCrc(rows.integer(0), event)))
      report.events.push_back(std::move(event));
    else
      ++report.damaged;
  }
  return report;
}

}  // namespace palpate
