#include "palpate/recording/palpate_salvage.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/palpate_blocks.h"

#include "recording/page_scan.h"
#include "recording/palpate_access.h"
#include "recording/palpate_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPageBytes = 4096;

// Intact blocks by stream and first item; where two cover the same item, the longer one counts.
class BlockCollection {
 public:
  // False: one like it is there already.
  bool add(Block block) {
    auto& stream = streams_[static_cast<std::size_t>(block.stream)];
    const auto [place, isNew] = stream.try_emplace(block.first, std::move(block));
    if (!isNew && block.n > place->second.n) place->second = std::move(block);
    return isNew;
  }
  const std::map<std::int64_t, Block>& stream(Stream stream) const {
    return streams_[static_cast<std::size_t>(stream)];
  }
  bool empty() const {
    return std::all_of(streams_.begin(), streams_.end(), [](const auto& s) { return s.empty(); });
  }

 private:
  std::array<std::map<std::int64_t, Block>, 3> streams_;
};

Block blockFrom(const SqliteStatement& row) {
  Block block;
  block.stream = static_cast<Stream>(std::clamp<std::int64_t>(row.integer(1), 0, 255));
  block.first = row.integer(2);
  block.n = row.integer(3);
  block.t0Us = row.integer(4);
  block.t1Us = row.integer(5);
  block.coding = static_cast<BlockCoding>(std::clamp<std::int64_t>(row.integer(6), 0, 255));
  const auto data = row.blob(8);
  block.data.assign(data.begin(), data.end());
  return block;
}

// Everything SQLite still gives; sets sqliteError when it gives up on the way.
void readBySql(SqliteDatabase& database, BlockCollection& blocks, PalpateSalvage& salvage) {
  SqliteStatement rows = database.prepare(
      "SELECT id, stream, first, n, t0_us, t1_us, coding, crc32, data FROM block NOT INDEXED");
  while (rows.next()) {
    Block block = blockFrom(rows);
    if (!plausible(block) || rows.integer(7) != static_cast<std::int64_t>(blockCrc(block)))
      ++salvage.damagedBlocks;
    else
      blocks.add(std::move(block));
  }
}

void readEvents(SqliteDatabase& database, PalpateSalvage& salvage) {
  SqliteStatement rows = database.prepare(
      "SELECT id, t_us, t1_us, kind, matrix, text, json, crc32 FROM event ORDER BY t_us, id");
  while (rows.next()) {
    RecordingEvent event{
        rows.integer(1), rows.integer(2), rows.text(3), {}, rows.text(5), rows.text(6)};
    if (!rows.isNull(4)) event.matrix = static_cast<int>(rows.integer(4));
    if (rows.integer(7) == static_cast<std::int64_t>(eventCrc(rows.integer(0), event)))
      salvage.events.push_back(std::move(event));
    else
      ++salvage.damagedRows;
  }
}

// Runs a piece of reading; what SQLite refuses is remembered, not thrown.
template <typename Work>
void attempt(PalpateSalvage& salvage, Work work) {
  try {
    work();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    if (salvage.sqliteError.empty()) salvage.sqliteError = error.what();
  }
}

void scanFile(const fs::path& path,
              BlockCollection& blocks,
              PalpateSalvage& salvage,
              const Progress& progress) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, "can't be opened for reading");
  std::error_code ignored;
  const double size = static_cast<double>(fs::file_size(path, ignored));
  std::vector<std::byte> page(kPageBytes);
  constexpr std::size_t kPagesPerReport = 1024;
  for (std::size_t number = 0; in; ++number) {
    in.read(reinterpret_cast<char*>(page.data()), static_cast<std::streamsize>(page.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    if (progress && number % kPagesPerReport == 0 &&
        !progress(std::min(1.0, static_cast<double>(number * kPageBytes) / std::max(size, 1.0))))
      throw Cancelled();
    scanPage(std::span(page).first(got), [&](Block block) {
      if (blocks.add(std::move(block))) ++salvage.blocksFromPages;
    });
  }
}

// Items that must have existed before and between the blocks, and do no more.
std::size_t missingItems(const std::map<std::int64_t, Block>& stream) {
  std::int64_t next = 0;
  std::int64_t missing = 0;
  for (const auto& [first, block] : stream) {
    if (first > next) missing += first - next;
    next = std::max(next, first + block.n);
  }
  return static_cast<std::size_t>(missing);
}

std::size_t samplesWidth(const std::map<std::int64_t, Block>& stream) {
  if (stream.empty()) return 0;
  const Block& block = stream.begin()->second;
  const std::size_t perItem = block.data.size() / static_cast<std::size_t>(block.n);
  return perItem < 12 ? 0 : (perItem - 12) / (block.coding == BlockCoding::kPlainF64 ? 8 : 4);
}

// Hands every item of a stream to `add` in order; what is not later than the one before is left out.
template <typename Add>
void eachItem(const std::map<std::int64_t, Block>& stream, std::size_t numValues, Add add) {
  std::optional<std::int64_t> last;
  BlockIndex index;
  for (const auto& [first, block] : stream) {
    if (!indexBlock(block, numValues, index)) continue;
    for (std::size_t i = 0; i < index.begin.size(); ++i) {
      if (last && index.hostUs[i] <= *last) continue;
      last = index.hostUs[i];
      add(block, index.begin[i], index.hostUs[i]);
    }
  }
}

}  // namespace

namespace {

Profile profileFrom(const BlockCollection& blocks,
                    std::shared_ptr<const SensorLayout> layout,
                    ProfileInfo info) {
  ProfileBuilder builder(layout);
  std::vector<float> frame(layout->numPlaces());
  eachItem(blocks.stream(Stream::kTactile),
           frame.size(),
           [&](const Block& block, std::uint32_t begin, std::int64_t hostUs) {
             readFrameValues(block, begin, frame);
             builder.addFrame(hostUs, frame);
           });
  std::vector<double> sample(samplesWidth(blocks.stream(Stream::kAngles)));
  eachItem(blocks.stream(Stream::kAngles),
           sample.size(),
           [&](const Block& block, std::uint32_t begin, std::int64_t hostUs) {
             readSampleValues(block, begin, sample);
             builder.addAngles(hostUs, sample);
           });
  sample.resize(samplesWidth(blocks.stream(Stream::kTemperatures)));
  eachItem(blocks.stream(Stream::kTemperatures),
           sample.size(),
           [&](const Block& block, std::uint32_t begin, std::int64_t hostUs) {
             readSampleValues(block, begin, sample);
             builder.addTemperatures(hostUs, sample);
           });
  return builder.finish(std::move(info));
}

}  // namespace

PalpateSalvage salvagePalpate(const fs::path& path, const Progress& progress) {
  PalpateSalvage salvage;
  BlockCollection blocks;
  std::shared_ptr<const SensorLayout> layout;
  ProfileInfo info;
  info.format = "palpate";
  attempt(salvage, [&] {
    PalpateAccess access(path);
    salvage.unfinished = access.unfinished();
    SqliteDatabase& database = access.database();
    attempt(salvage, [&] { readBySql(database, blocks, salvage); });
    attempt(salvage, [&] { layout = std::make_shared<SensorLayout>(readLayout(database)); });
    attempt(salvage, [&] { readEvents(database, salvage); });
    attempt(salvage, [&] {
      info.serial = readMeta(database, "serial");
      info.firmware = readMeta(database, "firmware");
    });
  });
  const bool doubtful = !salvage.sqliteError.empty() || salvage.damagedBlocks > 0 ||
                        missingItems(blocks.stream(Stream::kTactile)) > 0 || blocks.empty();
  if (doubtful) scanFile(path, blocks, salvage, progress);
  if (blocks.empty()) return salvage;
  if (!layout) {
    layout = sdh2().layout;
    salvage.layoutAssumed = true;
  }
  salvage.lostFrames = missingItems(blocks.stream(Stream::kTactile));
  salvage.lostAngles = missingItems(blocks.stream(Stream::kAngles));
  salvage.lostTemperatures = missingItems(blocks.stream(Stream::kTemperatures));
  salvage.profile = profileFrom(blocks, layout, std::move(info));
  salvage.frames = salvage.profile->numFrames();
  salvage.angles = salvage.profile->numAngles();
  salvage.temperatures = salvage.profile->numTemperatures();
  return salvage;
}

}  // namespace palpate
