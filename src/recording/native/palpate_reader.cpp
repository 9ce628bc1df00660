#include "palpate/recording/palpate_reader.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"
#include "recording/native/palpate_storage.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// A native recording, open.
class PalpateStorage final : public BlockStorage {
 public:
  // `readMore` reads what is wanted beside the blocks.
  PalpateStorage(const fs::path& path,
                 const Progress& progress,
                 const std::function<void(SqliteDatabase&)>& readMore = {})
      : BlockStorage(path, [this](std::int64_t id) { return load(id); }),
        path_(path),
        access_(path),
        layout_(readLayout(access_.database(), access_.meta())),
        seriesRows_(readSeries(access_.database())) {
    if (access_.beingWritten())
      indexGrowing(progress);
    else
      indexBlocks(progress);
    if (readMore) readMore(access_.database());
    access_.readBlocksOnly();
    readBlock_.emplace(access_.database().prepare(
        "SELECT stream, first, n, t0_us, t1_us, coding, crc32, data FROM block WHERE id=?"));
    setWidth(Stream::kTactile, layout_.numReadings());
    setGivesReadings(layout_.decidesTouch());
    std::size_t end = seriesRows_.end();
    for (std::size_t series = 0; series < kMaxSeries; ++series) {
      const Stream stream = streamOfSeries(series);
      const auto described = seriesRows_.sound.find(series);
      if (described != seriesRows_.sound.end()) setWidth(stream, described->second.columns.size());
      if (described != seriesRows_.sound.end() || places(stream).empty()) continue;
      setWidth(stream, widthOf(places(stream)));
      if (width(stream) > 0) {
        end = std::max(end, series + 1);
        continue;
      }
      // Costs its own samples, and nothing else.
      drop(stream);
      dropped_.push_back(stream);
    }
    series_ =
        seriesRows_.all(end, [&](std::size_t series) { return width(streamOfSeries(series)); });
  }

  const SensorLayout& layout() const { return layout_; }
  // Those beside the hand's.
  const std::vector<SeriesDescription>& series() const { return series_; }
  // Whether the file says what a series is; otherwise it has a name and columns made up for it.
  bool isDescribed(std::size_t series) const { return seriesRows_.sound.contains(series); }
  PalpateConnection& access() { return access_; }
  // Streams that are left out because no block of theirs can be read.
  const std::vector<Stream>& dropped() const { return dropped_; }

 private:
  [[noreturn]] void throwMissing() const {
    throw FormatError(path_, "blocks are missing or damaged; 'palpate recover' saves the others");
  }

  // The number of values per item, of the first block that is sound; 0 if none is.
  std::size_t widthOf(const std::vector<BlockEntry>& blocks) {
    for (const BlockEntry& each : blocks) {
      try {
        return sampleWidth(load(each.id));
      } catch (const FormatError&) {
        // Its samples are lost; the next block has the same width.
      }
    }
    return 0;
  }

  void addRow(const SqliteStatement& row) {
    const std::int64_t stream = row.integer(0);
    const BlockEntry place{
        row.integer(1), row.integer(2), row.integer(3), row.integer(4), row.integer(5)};
    if (stream < 0 || stream >= std::int64_t{kMaxStreams} ||
        !add(static_cast<Stream>(stream), place))
      throwMissing();
  }

  void indexBlocks(const Progress& progress) {
    constexpr std::size_t kRowsPerReport = 65536;
    // An unfinished recording has no index over its blocks, but they lie in order.
    SqliteStatement rows = access_.database().prepare(
        access_.unfinished()
            ? "SELECT stream, first, n, t0_us, t1_us, id FROM block NOT INDEXED ORDER BY id"
            : "SELECT stream, first, n, t0_us, t1_us, id FROM block ORDER BY stream, first");
    std::size_t numRows = 0;
    while (rows.next()) {
      if (progress && ++numRows % kRowsPerReport == 0 && !progress(0.5)) throw Cancelled();
      addRow(rows);
    }
  }

  // While it is being written: in short transactions, up to what is there now.
  void indexGrowing(const Progress& progress) {
    SqliteDatabase& database = access_.database();
    const std::int64_t lastId = database.integerOf("SELECT max(id) FROM block");
    SqliteStatement rows = database.prepare(
        "SELECT stream, first, n, t0_us, t1_us, id FROM block NOT INDEXED WHERE id>? AND id<=?"
        " ORDER BY id LIMIT 4096");
    for (std::int64_t id = 0; id < lastId;) {
      reportProgress(progress, static_cast<std::size_t>(id), static_cast<std::size_t>(lastId));
      const std::int64_t before = id;
      rows.bind(1, id).bind(2, lastId);
      while (rows.next()) {
        addRow(rows);
        id = rows.integer(5);
      }
      if (id <= before) break;
    }
  }

  // Reads a block and checks its CRC.
  Block load(std::int64_t id) {
    readBlock_->bind(1, id);
    if (!readBlock_->next()) throw FormatError(path_, "block " + std::to_string(id) + " is gone");
    const std::int64_t crc = readBlock_->integer(6);
    Block block = blockFrom(*readBlock_, 0, 7);
    readBlock_->reset();
    if (crc != static_cast<std::int64_t>(blockCrc(block)) || !plausible(block))
      throw FormatError(
          path_,
          "block " + std::to_string(id) +
              " is damaged (its checksum is wrong); 'palpate recover' saves the others");
    return block;
  }

  fs::path path_;
  PalpateConnection access_;
  SensorLayout layout_;
  SeriesRows seriesRows_;
  std::vector<SeriesDescription> series_;
  std::optional<SqliteStatement> readBlock_;
  std::vector<Stream> dropped_;
};

// A finished recording says it; of others every block must be looked at.
ValueType valueTypeOf(PalpateConnection& access) {
  std::string text = access.meta()["value_type"];
  if (text.empty())
    text = access.database().integerOf(
               "SELECT EXISTS(SELECT 1 FROM block WHERE stream=0 AND coding&7<>0)")
               ? "float"
               : "counts";
  return text == "float" ? ValueType::kFloat : ValueType::kCounts;
}

Profile profileOf(std::shared_ptr<PalpateStorage> storage) {
  PalpateConnection& access = storage->access();
  ProfileInfo info;
  info.format = "palpate";
  info.serial = access.meta()["serial"];
  info.firmware = access.meta()["firmware"];
  info.sensorRevision = access.meta()["sensor_revision"];
  info.valueType = valueTypeOf(access);
  access.database().unlimitWork();
  if (access.unfinished())
    info.warnings.emplace_back("unfinished: its writer stopped before the end");
  if (access.beingWritten())
    info.warnings.emplace_back("still being written: shown as far as it was when opened");
  for (const Stream stream : storage->dropped())
    info.warnings.emplace_back(
        "all " +
        (stream == Stream::kAngles ? std::string("joint angles")
         : stream == Stream::kTemperatures
             ? "temperatures"
             : "samples of series " + std::to_string(seriesOfStream(stream))) +
        " are damaged and left out");
  HandDescription hand = recordedHand(access.meta().values,
                                      storage->layout(),
                                      storage->width(Stream::kAngles),
                                      storage->width(Stream::kTemperatures));
  std::vector<SeriesDescription> series = storage->series();
  for (std::size_t i = 0; i < series.size(); ++i)
    if (!storage->isDescribed(kHandSeries + i))
      info.warnings.push_back("the description of a series is damaged: it is called " +
                              series[i].name + ", its columns 1, 2, ..");
  return {std::move(info), std::move(hand), std::move(storage), std::move(series)};
}

}  // namespace

Recording readPalpate(const fs::path& path, const Progress& progress) {
  EventsReport events;
  Damage damage;
  auto storage = std::make_shared<PalpateStorage>(path, progress, [&](SqliteDatabase& database) {
    try {
      events = readEventRows(database);
      damage.events = events.damaged;
    } catch (const Error&) {  // damaged, or can't be read
      damage.eventsError = std::current_exception();
    }
  });
  RecordingMeta meta = storage->access().meta().values;
  const bool overBaselines = storage->givesReadings();
  Profile profile = profileOf(std::move(storage));
  if (overBaselines)
    profile = profile.withBaselines(baselinesOf(events.events, profile.layout(), &damage.events));
  return {.profile = std::move(profile),
          .events = std::move(events.events),
          .meta = std::move(meta),
          .damage = std::move(damage)};
}

EventsReport readPalpateEvents(const fs::path& path) {
  PalpateConnection access(path);
  return readEventRows(access.database());
}

}  // namespace palpate
