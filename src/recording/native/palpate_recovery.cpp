#include "palpate/recording/palpate_recovery.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_file.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording_lock.h"
#include "palpate/recording/recording_losses.h"
#include "palpate/recording/second_summary.h"

#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"
#include "recording/native/palpate_storage.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// SQLite's record format (sqlite.org/fileformat2.html section 2.1): a header of varints (its own
// size, then a serial type per column), then the columns. A block row has nine: id (NULL, the
// rowid), six integers, crc32, data.
constexpr std::size_t kColumns = 9;
constexpr std::size_t kSmallestHeader = 1 + kColumns;
constexpr std::size_t kLargestHeader = kSmallestHeader + 2;  // the blob's type takes up to 3 bytes

class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  std::size_t at() const { return at_; }
  std::optional<std::uint64_t> varint() {
    std::uint64_t value = 0;
    for (int i = 0; i < 9; ++i) {
      if (at_ >= bytes_.size()) return std::nullopt;
      const auto byte = std::to_integer<std::uint64_t>(bytes_[at_++]);
      if (i == 8) return value << 8 | byte;
      value = value << 7 | (byte & 0x7F);
      if (byte < 0x80) return value;
    }
    return std::nullopt;
  }
  // A big-endian two's complement integer of a serial type 1..6, 8, 9.
  std::optional<std::int64_t> integer(std::uint64_t type) {
    constexpr std::array<std::size_t, 7> kSizes{0, 1, 2, 3, 4, 6, 8};
    if (type == 8 || type == 9) return static_cast<std::int64_t>(type - 8);
    if (type < 1 || type > 6) return std::nullopt;
    const std::size_t size = kSizes[type];
    if (size > bytes_.size() - at_) return std::nullopt;
    const std::size_t unusedBits =
        64 - 8 * size;  // the shift to the right repeats the sign in them
    const std::uint64_t shifted = bigEndian(bytes_.subspan(at_, size)) << unusedBits;
    at_ += size;
    return static_cast<std::int64_t>(shifted) >> unusedBits;
  }
  std::span<const std::byte> take(std::size_t count) {
    if (count > bytes_.size() - at_) return {};
    const auto taken = bytes_.subspan(at_, count);
    at_ += count;
    return taken;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_;
};

std::optional<Block> blockAt(std::span<const std::byte> page, std::size_t at) {
  const auto headerSize = std::to_integer<std::size_t>(page[at]);
  if (headerSize < kSmallestHeader || headerSize > kLargestHeader ||
      headerSize > page.size() - at || page[at + 1] != std::byte{0})
    return std::nullopt;
  Cursor types(page, at + 2);
  std::array<std::uint64_t, kColumns> type{};
  for (std::size_t column = 1; column < kColumns; ++column) {
    const auto value = types.varint();
    if (!value) return std::nullopt;
    type[column] = *value;
  }
  const std::uint64_t blobType = type[kColumns - 1];
  if (types.at() != at + headerSize || blobType < 12 || blobType % 2 != 0) return std::nullopt;
  Cursor body(page, at + headerSize);
  std::array<std::int64_t, kColumns> value{};
  for (std::size_t column = 1; column + 1 < kColumns; ++column) {
    const auto integer = body.integer(type[column]);
    if (!integer) return std::nullopt;
    value[column] = *integer;
  }
  const std::size_t size = (blobType - 12) / 2;
  const auto data = body.take(size);
  if (data.size() != size || value[1] < 0 || value[1] >= static_cast<int>(kMaxStreams) ||
      value[6] < 0 || value[6] > static_cast<int>(withDeviceUs(BlockCoding::kFilteredRuns)))
    return std::nullopt;
  Block block{static_cast<Stream>(value[1]),
              value[2],
              value[3],
              value[4],
              value[5],
              static_cast<BlockCoding>(value[6]),
              {data.begin(), data.end()}};
  if (!plausible(block) || value[7] != static_cast<std::int64_t>(blockCrc(block)))
    return std::nullopt;
  return block;
}

// A row of `kTexts` texts and their checksum, on a page. `hasId`: a rowid, which isn't in the row,
// stands before them.
template <std::size_t kTexts>
struct TextRow {
  std::array<std::string, kTexts> texts;
  std::int64_t crc = 0;
};
template <std::size_t kTexts>
std::optional<TextRow<kTexts>> textRowAt(std::span<const std::byte> page,
                                         std::size_t at,
                                         bool hasId,
                                         const std::array<std::size_t, kTexts>& longest) {
  const std::size_t begin = 1 + (hasId ? 1 : 0);          // its size, and the type of the rowid
  const std::size_t leastHeader = begin + kTexts + 1;     // a type per column
  const std::size_t mostHeader = begin + 2 * kTexts + 2;  // of two bytes
  constexpr std::size_t kFirstTextType = 13;              // of an empty text; odd
  const auto headerSize = std::to_integer<std::size_t>(page[at]);
  if (headerSize < leastHeader || headerSize > mostHeader || headerSize > page.size() - at ||
      (hasId && page[at + 1] != std::byte{0}))
    return std::nullopt;
  Cursor types(page, at + begin);
  std::array<std::size_t, kTexts> sizes{};
  for (std::size_t i = 0; i < kTexts; ++i) {
    const auto type = types.varint();
    // Without limits, damaged bytes would cost long copies.
    if (!type || *type % 2 == 0 || *type < kFirstTextType ||
        (*type - kFirstTextType) / 2 > longest[i])
      return std::nullopt;
    sizes[i] = (*type - kFirstTextType) / 2;
  }
  const auto crcType = types.varint();
  if (!crcType || types.at() != at + headerSize) return std::nullopt;
  Cursor body(page, at + headerSize);
  TextRow<kTexts> row;
  for (std::size_t i = 0; i < kTexts; ++i) {
    const auto bytes = body.take(sizes[i]);
    row.texts[i].assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  const auto crc = body.integer(*crcType);
  if (!crc) return std::nullopt;
  row.crc = *crc;
  return row;
}

// A row of the table of meta data: key, value and their checksum.
std::optional<std::pair<std::string, std::string>> metaRowAt(std::span<const std::byte> page,
                                                             std::size_t at) {
  constexpr std::size_t kMaxKey = 256, kMaxValue = 8192;  // [bytes]
  auto row = textRowAt<2>(page, at, false, {kMaxKey, kMaxValue});
  if (!row || row->texts[0].empty() ||
      row->crc != static_cast<std::int64_t>(metaCrc(row->texts[0], row->texts[1])))
    return std::nullopt;
  return std::pair(std::move(row->texts[0]), std::move(row->texts[1]));
}

// Adds what a row of the table of series describes, if it is one that isn't there yet: true then.
// Which series it is of, only its checksum tells.
bool addSeriesRowAt(std::span<const std::byte> page, std::size_t at, SeriesRows& series) {
  constexpr std::size_t kMaximum = 4096;  // longer ones don't fit into a page
  const auto row = textRowAt<4>(page, at, true, {kMaxSeriesName, kMaximum, kMaximum, kMaximum});
  if (!row || row->texts[0].empty()) return false;
  const auto found = seriesFrom(row->texts[0], row->texts[1], row->texts[2], row->texts[3]);
  if (!found) return false;
  for (std::size_t index = kHandSeries; index < kMaxSeries; ++index)
    if (row->crc == static_cast<std::int64_t>(
                        seriesCrc(static_cast<std::int64_t>(streamOfSeries(index)), *found)))
      return series.add(index, *found);
  return false;
}

// Finds rows of the block table in the raw bytes of an SQLite file, without SQLite: on pages that
// its b-trees no longer reach, too. Calls `found` for every record in `page` that looks like a
// block row and whose checksum is right (a wrong find is a matter of 2^-32). Records on overflow
// pages are not found: blocks are made to fit.
void scanPage(std::span<const std::byte> page, const std::function<void(Block)>& found) {
  for (std::size_t at = 0; at + kSmallestHeader < page.size(); ++at)
    if (auto block = blockAt(page, at)) found(std::move(*block));
}

// The most bytes of found blocks that are kept in memory; what comes after lies in a file.
constexpr std::int64_t kMemoryBytes = 32 << 20;

// Intact blocks that were found: their index lies in memory, their data in memory up to
// kMemoryBytes and then in a nameless temporary file.
class BlockStore {
 public:
  struct StoredBlock {
    std::int64_t n = 0;
    std::int64_t t0Us = 0;
    std::int64_t t1Us = 0;
    std::int64_t id = 0;
  };

  // False: one like it is there already (of two with the same first item the longer one counts).
  // Throws Error where there is no room for a temporary file.
  bool add(const Block& block);
  // By the first item.
  const std::map<std::int64_t, StoredBlock>& stream(Stream stream) const {
    return streams_[static_cast<std::size_t>(stream)];
  }
  Block load(std::int64_t id) const;

 private:
  struct Data {  // of a block
    Stream stream;
    BlockCoding coding;
    std::uint32_t size;
    std::int64_t first;
    std::int64_t begin;  // in memory_, or behind kMemoryBytes: in the file
  };

  std::array<std::map<std::int64_t, StoredBlock>, kMaxStreams> streams_;
  std::vector<Data> data_;  // by id
  std::vector<std::byte> memory_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::int64_t fileBytes_ = 0;
};

bool BlockStore::add(const Block& block) {
  auto& stream = streams_[static_cast<std::size_t>(block.stream)];
  const auto known = stream.find(block.first);
  const bool isNew = known == stream.end();
  if (!isNew && known->second.n >= block.n) return false;
  const auto size = static_cast<std::int64_t>(block.data.size());
  std::int64_t begin = static_cast<std::int64_t>(memory_.size());
  if (begin + size <= kMemoryBytes && !file_) {
    memory_.insert(memory_.end(), block.data.begin(), block.data.end());
  } else {
    if (!file_) file_.reset(std::tmpfile());
    if (!file_ ||
        ::pwrite(fileno(file_.get()), block.data.data(), block.data.size(), fileBytes_) != size)
      throw Error("no space for temporary files");
    begin = kMemoryBytes + fileBytes_;
    fileBytes_ += size;
  }
  const auto id = static_cast<std::int64_t>(data_.size());
  data_.push_back({block.stream,
                   block.coding,
                   static_cast<std::uint32_t>(block.data.size()),
                   block.first,
                   begin});
  stream.insert_or_assign(block.first, StoredBlock{block.n, block.t0Us, block.t1Us, id});
  return isNew;
}

Block BlockStore::load(std::int64_t id) const {
  const Data& data = data_.at(static_cast<std::size_t>(id));
  const StoredBlock& place = stream(data.stream).at(data.first);
  Block block{data.stream, data.first, place.n, place.t0Us, place.t1Us, data.coding, {}};
  block.data.resize(data.size);
  if (data.begin < kMemoryBytes)
    std::copy_n(memory_.begin() + data.begin, data.size, block.data.begin());
  else if (::pread(fileno(file_.get()), block.data.data(), data.size, data.begin - kMemoryBytes) !=
           static_cast<ssize_t>(data.size))
    throw Error("a temporary file can't be read");
  return block;
}

// All that was found, before it is put together.
struct Findings {
  std::shared_ptr<BlockStore> blocks = std::make_shared<BlockStore>();
  std::shared_ptr<const SensorLayout> layout;
  MetaRows meta;
  SeriesRows series;
  std::vector<SecondSummary> seconds;
  std::optional<std::vector<SecondSummary>> overview;
  bool hasOverview = false;
  std::size_t damagedSeconds = 0;

  // Behind the last series of which there is a description, a block or a number of samples.
  std::size_t seriesEnd() const {
    std::size_t end = series.end();
    for (std::size_t i = end; i < kMaxSeries; ++i)
      if (!blocks->stream(streamOfSeries(i)).empty() ||
          meta.integer(samplesKey(streamOfSeries(i))).value_or(0) > 0)
        end = i + 1;
    return end;
  }
};

// Runs a piece of reading; what SQLite refuses is remembered, not thrown.
template <typename Work>
void attemptRecovery(PalpateRecovery& recovery, Work work) {
  try {
    work();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    if (recovery.sqliteError.empty()) recovery.sqliteError = error.what();
  }
}

void readBlocks(SqliteDatabase& database,
                Findings& found,
                PalpateRecovery& recovery,
                const Progress& progress) {
  constexpr std::size_t kRowsPerReport = 4096;
  std::size_t numRows = 0;
  SqliteStatement rows = database.prepare(
      "SELECT id, stream, first, n, t0_us, t1_us, coding, crc32, data FROM block NOT INDEXED");
  while (rows.next()) {
    if (progress && ++numRows % kRowsPerReport == 0 && !progress(0.3)) throw Cancelled();
    const Block block = blockFrom(rows, 1, 8);
    if (!plausible(block) || rows.integer(7) != static_cast<std::int64_t>(blockCrc(block)) ||
        !found.blocks->add(block))
      ++recovery.damagedBlocks;
  }
}

// SQLite's own check of its trees; flipped values it doesn't see.
void checkIntegrity(SqliteDatabase& database) {
  constexpr std::int64_t kMaxPages = std::int64_t{1} << 28;  // the check needs a bit for each
  if (database.integerOf("PRAGMA page_count") > kMaxPages)
    throw FormatError(database.path(), "has too many pages");
  SqliteStatement check = database.prepare("PRAGMA integrity_check(1)");
  if (check.next() && check.text(0) != "ok") {
    std::string said = check.text(0);
    std::replace(said.begin(), said.end(), '\n', ' ');
    throw FormatError(database.path(), "is damaged: " + said);
  }
}

void readBySql(const fs::path& path,
               Findings& found,
               PalpateRecovery& recovery,
               const Progress& progress) {
  PalpateConnection access(path);
  SqliteDatabase& database = access.database();
  recovery.unfinished = access.unfinished();
  recovery.beingWritten = access.beingWritten();
  found.meta = access.meta();
  recovery.damagedRows += found.meta.damaged;
  attemptRecovery(recovery, [&] { readBlocks(database, found, recovery, progress); });
  attemptRecovery(recovery, [&] {
    found.layout = std::make_shared<SensorLayout>(readLayout(database, found.meta, true));
  });
  attemptRecovery(recovery, [&] {
    found.series = readSeries(database);
    recovery.damagedRows += found.series.damaged;
  });
  attemptRecovery(recovery, [&] {
    EventsReport events = readEventRows(database);
    recovery.events = std::move(events.events);
    recovery.damagedRows += events.damaged;
  });
  attemptRecovery(recovery,
                  [&] { found.seconds = readSecondRows(database, found.damagedSeconds); });
  attemptRecovery(recovery, [&] {
    const auto numSeconds = found.meta.integer("seconds");
    found.hasOverview = numSeconds && *numSeconds > 0;
    if (found.hasOverview && found.layout)
      found.overview = readOverview(database, found.layout->numMatrices(), *numSeconds);
  });
  attemptRecovery(recovery, [&] { checkIntegrity(database); });
}

void scanFile(const fs::path& path,
              Findings& found,
              PalpateRecovery& recovery,
              const Progress& progress) {
  // Windows overlap by more than the longest row, so that rows are found wherever they lie.
  constexpr std::size_t kOverlap = 8192;
  constexpr std::size_t kWindow = 1u << 20;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, "can't be opened for reading");
  std::error_code ignored;
  const double size = static_cast<double>(fs::file_size(path, ignored));
  // SQLite refuses a file that was cut off, though its first pages tell how long it was.
  const bool needsMeta = found.meta.values.empty();
  std::vector<std::byte> window(kWindow);
  std::size_t kept = 0;
  double read = 0.0;
  while (in) {
    in.read(reinterpret_cast<char*>(window.data() + kept),
            static_cast<std::streamsize>(window.size() - kept));
    const auto got = static_cast<std::size_t>(in.gcount());
    read += static_cast<double>(got);
    if (progress && !progress(std::min(1.0, read / std::max(size, 1.0)))) throw Cancelled();
    const std::size_t filled = kept + got;
    scanPage(std::span(window).first(filled), [&](const Block& block) {
      if (found.blocks->add(block)) ++recovery.blocksFromPages;
    });
    const auto page = std::span<const std::byte>(window).first(filled);
    for (std::size_t at = 0; at < filled; ++at) {
      if (needsMeta)
        if (auto row = metaRowAt(page, at)) found.meta.values.insert(std::move(*row));
      // SQLite didn't give it.
      if (addSeriesRowAt(page, at, found.series)) ++recovery.damagedRows;
    }
    kept = std::min(kOverlap, filled);
    std::copy(window.begin() + static_cast<std::ptrdiff_t>(filled - kept),
              window.begin() + static_cast<std::ptrdiff_t>(filled),
              window.begin());
  }
}

// Whether blocks are missing before or between those that are there.
bool hasHoles(const std::map<std::int64_t, BlockStore::StoredBlock>& stream) {
  std::int64_t next = 0;
  for (const auto& [first, place] : stream) {
    if (first != next) return true;
    next = first + place.n;
  }
  return false;
}

// Values per item of a stream of samples: what most of its first blocks have. 0: none fits.
std::size_t widthOf(const BlockStore& blocks, Stream stream) {
  for (const auto& [first, place] : blocks.stream(stream))
    if (const std::size_t width = sampleWidth(blocks.load(place.id)); width > 0) return width;
  return 0;
}

bool everyFrameHas(const BlockStore& blocks, std::size_t numValues) {
  BlockIndex index;
  const auto& stream = blocks.stream(Stream::kTactile);
  return std::all_of(stream.begin(), stream.end(), [&](const auto& entry) {
    return indexBlock(blocks.load(entry.second.id), numValues, index);
  });
}

// Items that the recording once had, as far as it tells.
std::int64_t expectedItems(const Findings& found, Stream stream) {
  constexpr std::int64_t kMaximum = std::int64_t{1} << 40;
  std::int64_t expected = found.meta.integer(samplesKey(stream)).value_or(0);
  if (stream == Stream::kTactile) {
    std::int64_t inSeconds = 0;
    for (const SecondSummary& row : found.seconds)
      if (row.matrix == 0 && row.frames > 0 && row.frames < kMaximum && inSeconds < kMaximum)
        inSeconds += row.frames;
    expected = std::max(expected, inSeconds);
  }
  const auto& blocks = found.blocks->stream(stream);
  if (!blocks.empty())
    expected = std::max(expected, blocks.rbegin()->first + blocks.rbegin()->second.n);
  return std::clamp<std::int64_t>(expected, 0, kMaximum);
}

// An event for items that are missing between two times: without it, a reader of the saved
// recording could not tell a loss shorter than a gap.
Event lossEvent(const std::string& stream,
                std::int64_t count,
                std::int64_t fromUs,
                std::int64_t toUs) {
  Event event;
  event.tUs = fromUs;
  event.t1Us = toUs;
  event.kind = "gap";
  event.text =
      counted(static_cast<std::size_t>(count), itemOf(stream)) + " lost: the file was damaged";
  event.json = Json::object()
                   .set("stream", stream)
                   .set("lost", count)
                   .set("reason", "the file was damaged")
                   .text(-1);
  return event;
}

// Puts the blocks of a stream together, numbered without holes; what makes no sense is left out.
// Returns the number of items that are missing.
std::size_t assemble(const Findings& found,
                     Stream stream,
                     const std::string& name,
                     BlockStorage& storage,
                     PalpateRecovery& recovery) {
  BlockIndex index;
  std::int64_t items = 0;
  std::int64_t next = 0;
  std::optional<std::int64_t> lastUs;
  for (const auto& [first, place] : found.blocks->stream(stream)) {
    const bool fits = first >= next &&
                      indexBlock(found.blocks->load(place.id), storage.width(stream), index) &&
                      storage.add(stream, {items, place.n, place.t0Us, place.t1Us, place.id});
    if (!fits) {
      ++recovery.damagedBlocks;
      continue;
    }
    if (first > next)
      recovery.events.push_back(
          lossEvent(name, first - next, lastUs.value_or(place.t0Us), place.t0Us));
    items += place.n;
    next = first + place.n;
    lastUs = place.t1Us;
  }
  const std::int64_t expected = expectedItems(found, stream);
  if (lastUs && expected > next)
    recovery.events.push_back(lossEvent(name, expected - next, *lastUs, *lastUs));
  return static_cast<std::size_t>(std::max<std::int64_t>(0, expected - items));
}

std::size_t numDifferent(const std::vector<SecondSummary>& a, const std::vector<SecondSummary>& b) {
  std::size_t same = 0;
  const auto key = [](const SecondSummary& row) { return std::pair(row.tS, row.matrix); };
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    if (key(a[i]) == key(b[k]))
      same += a[i++] == b[k++] ? 1 : 0;
    else
      key(a[i]) < key(b[k]) ? ++i : ++k;
  }
  return std::max(a.size(), b.size()) - same;
}

// Rows of the summary that are not what the frames say.
std::size_t damagedSeconds(const Findings& found,
                           const Profile& profile,
                           bool unfinished,
                           const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 1024;
  std::vector<SecondSummary> expected;
  SecondSummarizer summarizer([&](const SecondSummary& row) { expected.push_back(row); });
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    if (progress && i % kFramesPerReport == 0 && !progress(0.9)) throw Cancelled();
    profile.readFrame(i, frame);
    summarizer.add(frame);
  }
  const std::vector<SecondSummary> complete = expected;  // without the second it ended in
  summarizer.flush();
  std::size_t different = numDifferent(found.seconds, expected);
  if (unfinished) different = std::min(different, numDifferent(found.seconds, complete));
  const bool overviewWrong = found.hasOverview && found.overview != expected;
  return std::max(different, found.damagedSeconds) + (overviewWrong ? 1 : 0);
}

void findLayout(Findings& found, PalpateRecovery& recovery) {
  if (found.layout || found.blocks->stream(Stream::kTactile).empty()) return;
  if (everyFrameHas(*found.blocks, defaultHand().layout->numCells()))
    recovery.layoutAssumed = true;
  else
    recovery.layoutLost = true;
}

void buildProfile(const fs::path& path,
                  const Findings& found,
                  PalpateRecovery& recovery,
                  const Progress& progress) {
  auto storage = std::make_shared<BlockStorage>(
      path, [blocks = found.blocks](std::int64_t id) { return blocks->load(id); });
  const std::shared_ptr<const SensorLayout> layout =
      found.layout ? found.layout : defaultHand().layout;
  storage->setWidth(Stream::kTactile, layout->numReadings());
  storage->setGivesReadings(layout->decidesTouch());
  const std::size_t numSeries = found.seriesEnd();
  for (std::size_t i = 0; i < numSeries; ++i) {
    const auto described = found.series.sound.find(i);
    const Stream stream = streamOfSeries(i);
    storage->setWidth(stream,
                      described != found.series.sound.end() ? described->second.columns.size()
                                                            : widthOf(*found.blocks, stream));
  }
  std::vector<SeriesDescription> further = found.series.all(
      numSeries, [&](std::size_t series) { return storage->width(streamOfSeries(series)); });
  recovery.lostFrames = recovery.layoutLost
                            ? static_cast<std::size_t>(expectedItems(found, Stream::kTactile))
                            : assemble(found, Stream::kTactile, "tactile", *storage, recovery);
  recovery.lostAngles = assemble(found, Stream::kAngles, "angles", *storage, recovery);
  recovery.lostTemperatures =
      assemble(found, Stream::kTemperatures, "temperatures", *storage, recovery);
  for (std::size_t i = kHandSeries; i < numSeries; ++i) {
    const std::string& name = further[i - kHandSeries].name;
    const std::size_t lost = assemble(found, streamOfSeries(i), name, *storage, recovery);
    recovery.further.push_back(
        {name, storage->numSamples(i), lost, !found.series.sound.contains(i)});
  }
  std::stable_sort(recovery.events.begin(),
                   recovery.events.end(),
                   [](const Event& a, const Event& b) { return a.tUs < b.tUs; });
  recovery.frames = storage->numFrames();
  recovery.angles = storage->numSamples(kAngleSeries);
  recovery.temperatures = storage->numSamples(kTemperatureSeries);
  // A recording may have no sample yet, whatever is damaged beside.
  const bool lostAny = recovery.lostItems() + recovery.damagedBlocks > 0;
  if (recovery.savedItems() == 0 && (!found.layout || lostAny)) return;
  ProfileInfo info;
  info.format = "palpate";
  info.serial = found.meta["serial"];
  info.firmware = found.meta["firmware"];
  info.sensorRevision = found.meta["sensor_revision"];
  for (const BlockEntry& place : storage->places(Stream::kTactile))
    if (valueCoding(found.blocks->load(place.id).coding) != BlockCoding::kCountsRuns)
      info.valueType = ValueType::kFloat;
  HandDescription hand = recordedHand(found.meta.values,
                                      *layout,
                                      storage->width(Stream::kAngles),
                                      storage->width(Stream::kTemperatures));
  recovery.profile.emplace(
      std::move(info), std::move(hand), std::move(storage), std::move(further));
  if (recovery.profile->givesReadings())
    recovery.profile =
        recovery.profile->withBaselines(baselinesOf(recovery.events, recovery.profile->layout()));
  if (recovery.whole() && !recovery.beingWritten)
    recovery.damagedRows += damagedSeconds(found,
                                           recovery.profile->withBaselines(recordedBaselinesOf(
                                               recovery.events, recovery.profile->layout())),
                                           recovery.unfinished,
                                           progress);
  else
    recovery.damagedRows += found.damagedSeconds;
}

// Something else than a file under the name of a side file could keep whoever opens it waiting.
bool sideFilesAreFiles(const fs::path& recording) {
  std::error_code ignored;
  for (const fs::path& side : {lockPathOf(recording), journalPathOf(recording)})
    if (const auto status = fs::symlink_status(side, ignored);
        fs::exists(status) && !fs::is_regular_file(status))
      return false;
  return true;
}

std::uint64_t numberAt(std::string_view bytes, std::size_t at) {
  return bigEndian(std::as_bytes(std::span(bytes.substr(at, 4))));
}

// A journal that has to be played back: its writer died inside a commit (the database file format
// of SQLite, section 3). Of an empty database it would leave nothing.
bool diedInCommit(const fs::path& recording) {
  constexpr std::string_view kMagic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  constexpr std::size_t kPagesAt = 16;  // pages of the database before
  const std::string journal = beginningOfFile(journalPathOf(recording), kPagesAt + 4);
  return journal.size() == kPagesAt + 4 && journal.starts_with(kMagic) &&
         numberAt(journal, kPagesAt) > 0;
}

// By its header alone, which is the same at any moment of its life (section 1.3).
bool looksLikeRecording(const fs::path& path) {
  constexpr std::size_t kApplicationIdAt = 68;
  const std::string header = beginningOfFile(path, kApplicationIdAt + 4);
  return header.size() == kApplicationIdAt + 4 && header.starts_with("SQLite format 3") &&
         numberAt(header, kApplicationIdAt) == std::uint64_t{kPalpateApplicationId};
}

}  // namespace

PalpateRecovery recoverPalpateProfile(const fs::path& path, const Progress& progress) {
  PalpateRecovery recovery;
  Findings found;
  attemptRecovery(recovery, [&] { readBySql(path, found, recovery, progress); });
  bool doubtful = !recovery.sqliteError.empty() || recovery.damagedBlocks > 0 ||
                  found.meta.damaged > 0 || found.series.damaged > 0;
  const std::size_t numStreams = 1 + found.seriesEnd();
  for (std::size_t i = 0; i < numStreams; ++i) {
    const auto stream = static_cast<Stream>(i);
    const auto& blocks = found.blocks->stream(stream);
    const std::int64_t end =
        blocks.empty() ? 0 : blocks.rbegin()->first + blocks.rbegin()->second.n;
    doubtful = doubtful || hasHoles(blocks) || end < expectedItems(found, stream) ||
               (i > kHandSeries && !found.series.sound.contains(seriesOfStream(stream)));
  }
  // Never while it is being written: a rollback journal is at work, and closing a file that this
  // process also writes would drop SQLite's locks on it.
  if (doubtful && !recovery.beingWritten) scanFile(path, found, recovery, progress);
  findLayout(found, recovery);
  buildProfile(path, found, recovery, progress);
  recovery.meta = std::move(found.meta.values);
  return recovery;
}

// The lock comes first: a recording whose lock is free is never written again, so that nothing here
// gets into the way of a writer, be it in this very process (where closing a file that SQLite has
// open would drop SQLite's own locks on it).
bool isUnfinishedRecording(const fs::path& path) {
  if (!sideFilesAreFiles(path) || RecordingLock::isHeld(path)) return false;
  // A copy, as the reader makes one, would take long for a long recording.
  if (diedInCommit(path)) return looksLikeRecording(path);
  try {
    PalpateConnection access(path);
    return access.unfinished() &&
           access.database().integerOf(
               "SELECT EXISTS(SELECT 1 FROM block) OR EXISTS(SELECT 1 FROM event)") != 0;
  } catch (const Error&) {
    return false;  // no recording, damaged, no permission
  }
}

}  // namespace palpate
