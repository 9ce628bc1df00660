#include "palpate/recording/palpate_writer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/palpate_lock.h"
#include "recording/palpate_rows.h"
#include "recording/sqlite_database.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

void refuseExisting(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw FileError(path, "is a folder");
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw FileError(path, "exists already; a recording is never replaced");
}

void requireFinite(const char* what, const std::vector<double>& values, std::size_t& width) {
  if (values.empty() || (width != 0 && values.size() != width))
    throw std::invalid_argument(std::string(what) + ": expected " + std::to_string(width) +
                                " values, got " + std::to_string(values.size()));
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    throw std::invalid_argument(std::string(what) + ": a value is not a number");
  width = values.size();
}

void requireLater(const char* what, std::optional<std::int64_t>& last, std::int64_t hostUs) {
  if (last && hostUs <= *last)
    throw std::invalid_argument(std::string(what) + ": time must be later than the last one's");
  last = hostUs;
}

}  // namespace

struct PalpateWriter::Impl {
  Impl(const fs::path& path,
       std::shared_ptr<const SensorLayout> sensorLayout,
       const std::map<std::string, std::string>& meta,
       PalpateWriterOptions writerOptions)
      : options(std::move(writerOptions)),
        layout(std::move(sensorLayout)),
        lock(path),
        database((refuseExisting(path), path), SqliteDatabase::Mode::kCreate, options.vfs) {
    database.execute(
        "PRAGMA page_size=4096; PRAGMA auto_vacuum=NONE;"
        "PRAGMA journal_mode=TRUNCATE; PRAGMA application_id=" +
        std::to_string(kPalpateApplicationId) +
        "; PRAGMA user_version=" + std::to_string(kPalpateVersion) + ";");
    database.execute(options.synced ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=OFF");
    database.execute("BEGIN IMMEDIATE");
    createTables(database);
    insertMeta(database, "format", "palpate");
    for (const auto& [key, value] : meta) insertMeta(database, key, value);
    insertMatrices(database, *layout);
    database.execute("COMMIT");
    rows.emplace(database);
  }

  void begin() {
    if (!database.inTransaction()) database.execute("BEGIN IMMEDIATE");
  }

  // `nowUs`: host time of the sample that was just added.
  void commitWhenDue(std::int64_t nowUs) {
    if (!pendingSinceUs) pendingSinceUs = nowUs;
    if (nowUs - *pendingSinceUs >= options.commitIntervalUs) commit();
  }

  void commit() {
    for (BlockPacker* packer : {&tactile, &angles, &temperatures}) packer->flush();
    if (database.inTransaction()) database.execute("COMMIT");
    pendingSinceUs.reset();
    committedFrames = tactile.numItems();
  }

  PalpateWriterOptions options;
  std::shared_ptr<const SensorLayout> layout;
  RecordingLock lock;
  SqliteDatabase database;
  std::optional<RowWriter> rows;
  BlockPacker::Sink sink = [this](const Block& block) {
    begin();
    rows->block(block);
    if (block.stream == Stream::kTactile && block.coding != BlockCoding::kCountsRuns)
      allCounts = false;
  };
  BlockPacker tactile{Stream::kTactile, sink};
  BlockPacker angles{Stream::kAngles, sink};
  BlockPacker temperatures{Stream::kTemperatures, sink};
  SecondSummarizer seconds{[this](const SecondSummary& row) {
    begin();
    rows->second(row);
  }};
  std::optional<std::int64_t> lastFrameUs;
  std::optional<std::int64_t> lastAnglesUs;
  std::optional<std::int64_t> lastTemperaturesUs;
  std::optional<std::int64_t> pendingSinceUs;  // host time of the oldest sample not committed
  std::size_t numAxes = 0;
  std::size_t numTemperatureSensors = 0;
  std::int64_t committedFrames = 0;
  std::int64_t numEvents = 0;
  bool allCounts = true;  // every frame so far
  bool finished = false;
};

PalpateWriter::PalpateWriter(const fs::path& path,
                             std::shared_ptr<const SensorLayout> layout,
                             const std::map<std::string, std::string>& meta,
                             const PalpateWriterOptions& options) {
  if (!layout) throw std::invalid_argument("PalpateWriter: no sensor layout");
  impl_ = std::make_unique<Impl>(path, std::move(layout), meta, options);
}

PalpateWriter::~PalpateWriter() {
  if (!impl_ || impl_->finished) return;
  try {
    impl_->commit();
  } catch (const std::exception&) {
    // What was committed is safe; there is nobody left to tell about the rest.
  }
}

void PalpateWriter::addFrame(const TactileFrame& frame) {
  if (frame.values.size() != impl_->layout->numPlaces())
    throw std::invalid_argument("frame: expected " + std::to_string(impl_->layout->numPlaces()) +
                                " values, got " + std::to_string(frame.values.size()));
  if (!std::all_of(
          frame.values.begin(), frame.values.end(), [](float v) { return std::isfinite(v); }))
    throw std::invalid_argument("frame: a value is not a number");
  requireLater("frame", impl_->lastFrameUs, frame.hostUs);
  impl_->tactile.addFrame(frame.hostUs, frame.deviceMs, frame.values);
  impl_->seconds.add(frame);
  impl_->commitWhenDue(frame.hostUs);
}

void PalpateWriter::addAngles(const JointAngles& angles) {
  requireFinite("angles", angles.deg, impl_->numAxes);
  requireLater("angles", impl_->lastAnglesUs, angles.hostUs);
  impl_->angles.addSample(angles.hostUs, angles.deg);
  impl_->commitWhenDue(angles.hostUs);
}

void PalpateWriter::addTemperatures(const Temperatures& temperatures) {
  requireFinite("temperatures", temperatures.degC, impl_->numTemperatureSensors);
  requireLater("temperatures", impl_->lastTemperaturesUs, temperatures.hostUs);
  impl_->temperatures.addSample(temperatures.hostUs, temperatures.degC);
  impl_->commitWhenDue(temperatures.hostUs);
}

void PalpateWriter::addEvent(const RecordingEvent& event) {
  impl_->begin();
  impl_->rows->event(++impl_->numEvents, event);
}

void PalpateWriter::setCounter(const std::string& name, std::int64_t value) {
  impl_->begin();
  impl_->rows->counter(name, value);
}

void PalpateWriter::commit() { impl_->commit(); }

void PalpateWriter::finish() {
  Impl& impl = *impl_;
  impl.seconds.flush();
  impl.commit();
  impl.begin();
  createBlockIndex(impl.database);
  insertMeta(impl.database, "value_type", impl.allCounts ? "counts" : "float");
  insertMeta(impl.database, "finished", "1");
  impl.database.execute("COMMIT");
  impl.database.execute("PRAGMA synchronous=FULL; PRAGMA journal_mode=DELETE;");
  impl.finished = true;
}

std::int64_t PalpateWriter::framesOnDisk() const noexcept { return impl_->committedFrames; }

std::int64_t PalpateWriter::bytesOnDisk() const {
  std::error_code failure;
  const auto size = fs::file_size(impl_->database.path(), failure);
  return failure ? 0 : static_cast<std::int64_t>(size);
}

}  // namespace palpate
