#include "palpate/recording/palpate_recovery.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/second_summary.h"

#include "recording/native/block_store.h"
#include "recording/native/page_scan.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"
#include "recording/native/palpate_storage.h"
#include "recording/palpate_overview.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::array kStreams{Stream::kTactile, Stream::kAngles, Stream::kTemperatures};

// All that was found, before it is put together.
struct Findings {
  std::shared_ptr<BlockStore> blocks = std::make_shared<BlockStore>();
  std::shared_ptr<const SensorLayout> layout;
  MetaRows meta;
  std::vector<SecondSummary> seconds;
  std::optional<std::vector<SecondSummary>> overview;
  bool hasOverview = false;
  std::size_t damagedSeconds = 0;
};

// Runs a piece of reading; what SQLite refuses is remembered, not thrown.
template <typename Work>
void attemptPalpateSalvage(PalpateRecovery& salvage, Work work) {
  try {
    work();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    if (salvage.sqliteError.empty()) salvage.sqliteError = error.what();
  }
}

void readBlocks(SqliteDatabase& database,
                Findings& found,
                PalpateRecovery& salvage,
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
      ++salvage.damagedBlocks;
  }
}

// SQLite's own check of its trees; flipped values it doesn't see.
void checkIntegrity(SqliteDatabase& database) {
  constexpr std::int64_t kMostPages = std::int64_t{1} << 28;  // the check needs a bit for each
  if (database.integerOf("PRAGMA page_count") > kMostPages)
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
               PalpateRecovery& salvage,
               const Progress& progress) {
  PalpateConnection access(path);
  SqliteDatabase& database = access.database();
  salvage.unfinished = access.unfinished();
  salvage.beingWritten = access.beingWritten();
  found.meta = access.meta();
  salvage.damagedRows += found.meta.damaged;
  attemptPalpateSalvage(salvage, [&] { readBlocks(database, found, salvage, progress); });
  attemptPalpateSalvage(
      salvage, [&] { found.layout = std::make_shared<SensorLayout>(readLayout(database)); });
  attemptPalpateSalvage(salvage, [&] {
    EventsReport events = readEventRows(database);
    salvage.events = std::move(events.events);
    salvage.damagedRows += events.damaged;
  });
  attemptPalpateSalvage(salvage,
                        [&] { found.seconds = readSecondRows(database, found.damagedSeconds); });
  attemptPalpateSalvage(salvage, [&] {
    const auto numSeconds = found.meta.integer("seconds");
    found.hasOverview = numSeconds && *numSeconds > 0;
    if (found.hasOverview && found.layout)
      found.overview = readOverview(database, found.layout->numMatrices(), *numSeconds);
  });
  attemptPalpateSalvage(salvage, [&] { checkIntegrity(database); });
}

void scanFile(const fs::path& path,
              Findings& found,
              PalpateRecovery& salvage,
              const Progress& progress) {
  // Windows overlap by more than the longest row, so that rows are found wherever they lie.
  constexpr std::size_t kOverlap = 8192;
  constexpr std::size_t kWindow = 1u << 20;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, "can't be opened for reading");
  std::error_code ignored;
  const double size = static_cast<double>(fs::file_size(path, ignored));
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
      if (found.blocks->add(block)) ++salvage.blocksFromPages;
    });
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
  constexpr std::array kKeys{"frames", "angle_samples", "temperature_samples"};
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  std::int64_t expected = found.meta.integer(kKeys[static_cast<std::size_t>(stream)]).value_or(0);
  if (stream == Stream::kTactile) {
    std::int64_t inSeconds = 0;
    for (const SecondSummary& row : found.seconds)
      if (row.matrix == 0 && row.frames > 0 && row.frames < kMost && inSeconds < kMost)
        inSeconds += row.frames;
    expected = std::max(expected, inSeconds);
  }
  const auto& blocks = found.blocks->stream(stream);
  if (!blocks.empty())
    expected = std::max(expected, blocks.rbegin()->first + blocks.rbegin()->second.n);
  return std::clamp<std::int64_t>(expected, 0, kMost);
}

// Puts the blocks of a stream together, numbered without holes; what makes no sense is left out.
// Returns the number of items that are missing.
std::size_t assemble(const Findings& found,
                     Stream stream,
                     BlockStorage& storage,
                     PalpateRecovery& salvage) {
  BlockIndex index;
  std::int64_t items = 0;
  std::int64_t next = 0;
  for (const auto& [first, place] : found.blocks->stream(stream)) {
    const bool fits = first >= next &&
                      indexBlock(found.blocks->load(place.id), storage.width(stream), index) &&
                      storage.add(stream, {items, place.n, place.t0Us, place.t1Us, place.id});
    if (!fits) {
      ++salvage.damagedBlocks;
      continue;
    }
    items += place.n;
    next = first + place.n;
  }
  return static_cast<std::size_t>(std::max<std::int64_t>(0, expectedItems(found, stream) - items));
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

void findLayout(Findings& found, PalpateRecovery& salvage) {
  if (found.layout || found.blocks->stream(Stream::kTactile).empty()) return;
  if (everyFrameHas(*found.blocks, sdh2().layout->numCells()))
    salvage.layoutAssumed = true;
  else
    salvage.layoutLost = true;
}

void buildProfile(const fs::path& path,
                  const Findings& found,
                  PalpateRecovery& salvage,
                  const Progress& progress) {
  auto storage = std::make_shared<BlockStorage>(
      path, [blocks = found.blocks](std::int64_t id) { return blocks->load(id); });
  const std::shared_ptr<const SensorLayout> layout = found.layout ? found.layout : sdh2().layout;
  storage->setWidth(Stream::kTactile, layout->numCells());
  for (Stream stream : {Stream::kAngles, Stream::kTemperatures})
    storage->setWidth(stream, widthOf(*found.blocks, stream));
  std::array<std::size_t, 3> lost{};
  for (Stream stream : kStreams) {
    std::size_t& missing = lost[static_cast<std::size_t>(stream)];
    if (stream == Stream::kTactile && salvage.layoutLost)
      missing = static_cast<std::size_t>(expectedItems(found, stream));
    else
      missing = assemble(found, stream, *storage, salvage);
  }
  salvage.lostFrames = lost[0];
  salvage.lostAngles = lost[1];
  salvage.lostTemperatures = lost[2];
  salvage.frames = storage->numFrames();
  salvage.angles = storage->numAngles();
  salvage.temperatures = storage->numTemperatures();
  const bool empty = salvage.frames + salvage.angles + salvage.temperatures == 0;
  // A recording may have no sample yet, whatever is damaged beside.
  const bool lostAny = lost[0] + lost[1] + lost[2] + salvage.damagedBlocks > 0;
  if (empty && (!found.layout || lostAny)) return;
  ProfileInfo info;
  info.format = "palpate";
  info.serial = found.meta["serial"];
  info.firmware = found.meta["firmware"];
  info.sensorRevision = found.meta["sensor_revision"];
  for (const BlockEntry& place : storage->places(Stream::kTactile))
    if (found.blocks->load(place.id).coding != BlockCoding::kCountsRuns)
      info.valueType = ValueType::kFloat;
  HandDescription hand =
      describeHand(*layout, storage->width(Stream::kAngles), storage->width(Stream::kTemperatures));
  salvage.profile.emplace(std::move(info), std::move(hand), std::move(storage));
  if (salvage.whole() && !salvage.beingWritten)
    salvage.damagedRows += damagedSeconds(found, *salvage.profile, salvage.unfinished, progress);
  else
    salvage.damagedRows += found.damagedSeconds;
}

}  // namespace

PalpateRecovery recoverPalpateProfile(const fs::path& path, const Progress& progress) {
  PalpateRecovery salvage;
  Findings found;
  attemptPalpateSalvage(salvage, [&] { readBySql(path, found, salvage, progress); });
  bool doubtful =
      !salvage.sqliteError.empty() || salvage.damagedBlocks > 0 || found.meta.damaged > 0;
  for (Stream stream : kStreams) {
    const auto& blocks = found.blocks->stream(stream);
    const std::int64_t end =
        blocks.empty() ? 0 : blocks.rbegin()->first + blocks.rbegin()->second.n;
    doubtful = doubtful || hasHoles(blocks) || end < expectedItems(found, stream);
  }
  // Never while it is being written: a rollback journal is at work, and closing a file that this
  // process also writes would drop SQLite's locks on it.
  if (doubtful && !salvage.beingWritten) scanFile(path, found, salvage, progress);
  findLayout(found, salvage);
  buildProfile(path, found, salvage, progress);
  return salvage;
}

}  // namespace palpate
