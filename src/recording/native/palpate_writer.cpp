#include "palpate/recording/palpate_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_id.h"
#include "palpate/core/output_file.h"
#include "palpate/core/progress.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/palpate_blocks.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording_lock.h"

#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"
#include "recording/native/sqlite_database.h"
#include "recording/profile_meta.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

void refuseExisting(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw FileError(path, "is a folder");
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw FileError(path, "exists already; a recording is never replaced");
  refuseForeignJournal(path);
}

void requireReadable(const SensorLayout& layout) {
  if (layout.numMatrices() > kMaxMatrices || layout.numReadings() > kMaxPlaces)
    throw std::invalid_argument("PalpateWriter: at most " + std::to_string(kMaxMatrices) +
                                " matrices with " + std::to_string(kMaxPlaces) + " places in all");
}

// The values of series beside those of the hand may be missing (NaN).
void requireValues(const std::string& what, const Sample& sample, std::size_t width) {
  const std::vector<double>& values = sample.values;
  if (values.empty() || values.size() > kMaxSampleValues || (width != 0 && values.size() != width))
    throw std::invalid_argument(what + ": expected " + std::to_string(width) + " values, got " +
                                std::to_string(values.size()));
  if (!std::all_of(values.begin(), values.end(), [&](double v) {
        return std::isfinite(v) || (std::isnan(v) && sample.series >= kHandSeries);
      }))
    throw std::invalid_argument(what + ": a value is not a number");
}

void requireLater(const std::string& what, std::optional<std::int64_t> last, std::int64_t hostUs) {
  constexpr std::int64_t kLatestSampleUs = std::int64_t{1} << 60;  // what a block can hold
  if (hostUs < -kLatestSampleUs || hostUs > kLatestSampleUs)
    throw std::invalid_argument(what + ": time is out of range");
  if (last && hostUs <= *last)
    throw std::invalid_argument(what + ": time must be later than the last one's");
}

// Tells a file that was just given its name from one that somebody put there in the same moment.
struct PublishedFile {
  // Of a file that is complete, before it has its name.
  explicit PublishedFile(const OutputFile& file) : id(fileIdOf(file.descriptor())) {
    beginning.resize(kCompared);
    const ssize_t got = ::pread(file.descriptor(), beginning.data(), beginning.size(), 0);
    beginning.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  }
  // Some network file systems give a file another identity with its name: then the content decides.
  bool isAt(const fs::path& path, const std::optional<FileId>& found) const {
    return found == id || beginningOfFile(path, kCompared) == beginning;
  }

  static constexpr std::size_t kCompared = 1u << 20;
  std::optional<FileId> id;
  std::string beginning;
};

// As if there had been that many commits: so a copy of another recording in its place differs from
// it even after equally many.
void setNumCommits(std::string& database, std::uint32_t number) {
  for (const std::size_t at : {24u, 92u})  // the counter, and the one for which the size is valid
    for (std::size_t i = 0; i < 4; ++i)
      database.at(at + i) = static_cast<char>(number >> (24 - 8 * i) & 0xFF);
}

// Whether earlier programs couldn't read the layout, or would read it wrongly.
bool needsNewVersion(const SensorLayout& layout) {
  return layout.decidesTouch() || !layout.hasSquareTaxels();
}

// The recording without a sample: made in memory, so that the file appears whole or not at all, at
// whatever moment the process is killed.
PublishedFile publishEmpty(const fs::path& path,
                           const SensorLayout& layout,
                           const RecordingMeta& meta) {
  SqliteDatabase database(":memory:", SqliteDatabase::Mode::kCreate);
  database.execute(
      "PRAGMA page_size=4096; PRAGMA auto_vacuum=NONE; PRAGMA application_id=" +
      std::to_string(kPalpateApplicationId) + "; PRAGMA user_version=" +
      std::to_string(needsNewVersion(layout) ? kPalpateVersionWithSeries : kPalpateVersion) + ";");
  database.execute("BEGIN IMMEDIATE");
  createTables(database, layout);
  insertMeta(database, "format", "palpate");
  for (const auto& [key, value] : meta)
    if (key != kTouchRulesKey) insertMeta(database, key, value);
  if (layout.decidesTouch()) insertMeta(database, kTouchRulesKey, touchRulesText(layout));
  insertMatrices(database, layout);
  database.execute("COMMIT");
  std::string bytes = database.bytes();
  setNumCommits(bytes, RowCrc().text(bytes).value());
  OutputFile file(path, Overwrite::kRefuse);
  file.write(bytes);
  const PublishedFile published(file);
  file.commit();
  return published;
}

// A folder of its own beside PATH: SQLite needs its journal and lock next to the file.
class TemporaryNeighbour {
 public:
  explicit TemporaryNeighbour(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::string name = path.filename().string();
    name.insert(0, 1, '.');
    name += ".XXXXXX";
    std::string pattern = (folder / name).string();
    if (!mkdtemp(pattern.data()))
      throw FileError(path, "can't be written: " + writeFailureText(errno));
    folder_ = pattern;
  }
  ~TemporaryNeighbour() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path file() const { return folder_ / "recording.palpate"; }

 private:
  fs::path folder_;
};

void writeAll(const Profile& profile,
              std::span<const Event> events,
              PalpateWriter& writer,
              const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  for (const SeriesDescription& each : profile.furtherSeries()) writer.addSeries(each);
  std::vector<std::size_t> next(profile.series().size());
  // One series after the other: which samples a block has depends on this order.
  const auto addBefore = [&](std::int64_t untilUs) {
    for (std::size_t series = 0; series < next.size(); ++series)
      for (std::size_t& i = next[series];
           i < profile.numSamples(series) && profile.sampleTimeUs(series, i) <= untilUs;
           ++i)
        writer.addSample(profile.sample(series, i));
  };
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    addBefore(frame.hostUs);
    writer.addFrame(frame);
  }
  addBefore(INT64_MAX);
  for (const Event& event : events) writer.addEvent(event);
}

// A journal that is still needed by the recording that is about to be replaced would be played back
// into the new one. It is played back into the old one first, so that the old one is whole without
// it at whatever moment the process dies. Throws FileError when that can't be done: nothing was
// changed then.
void settleJournal(const fs::path& path) {
  const fs::path journal = journalPathOf(path);
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(journal, ignored))) return;
  if (!fs::is_regular_file(journal, ignored))
    throw FileError(journal, "is not a regular file: move it away first");
  if (!fs::exists(fs::symlink_status(path, ignored))) return refuseForeignJournal(path);
  try {
    SqliteDatabase old(path, SqliteDatabase::Mode::kReadWrite);
    old.integerOf("SELECT count(*) FROM sqlite_schema");
  } catch (const Error&) {
    if (hasHotJournal(path))
      throw FileError(
          path,
          "was left in the middle of a commit and can't be replaced as it is; save it with "
          "'palpate recover', or move it away together with its journal");
  }
  // What is left now is an empty shell, or belongs to no recording.
  fs::remove(journal, ignored);
}

// Without the name of the temporary file, which callers must not see.
[[noreturn]] void rethrowAs(const fs::path& path, const FileError& error) {
  const std::string what = error.what();
  const std::string own = error.path().string() + ": ";
  throw FileError(path, what.starts_with(own) ? what.substr(own.size()) : what);
}

}  // namespace

struct PalpateWriter::Impl {
  Impl(const fs::path& path,
       std::shared_ptr<const SensorLayout> sensorLayout,
       const RecordingMeta& meta,
       PalpateWriterOptions writerOptions)
      : options(std::move(writerOptions)),
        layout(std::move(sensorLayout)),
        lock(std::make_unique<RecordingLock>(path)) {
    refuseExisting(path);
    file = opened(path, publishEmpty(path, *layout, meta));
  }

  // The file of a recording, opened for writing.
  struct OpenFile {
    OpenFile(const fs::path& path,
             const PublishedFile& published,
             const PalpateWriterOptions& options)
        : database(path, SqliteDatabase::Mode::kReadWrite, options.vfs) {
      if (!published.isAt(path, database.file()))
        throw FileError(path, "is gone: something else was put in its place");
      version = database.version();
      database.execute("PRAGMA journal_mode=PERSIST");
      database.keepJournalOpen();
      database.execute(options.synced ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=OFF");
      rows.emplace(database);
      beginCommit.emplace(database.prepare("BEGIN IMMEDIATE"));
      endCommit.emplace(database.prepare("COMMIT"));
    }
    SqliteDatabase database;
    std::optional<RowWriter> rows;
    std::optional<SqliteStatement> beginCommit;
    std::optional<SqliteStatement> endCommit;
    std::optional<FileId> journal;                   // once it is there
    std::optional<SqliteDatabase::Version> version;  // after the last commit
    bool commitFailed = false;  // since then: it may have taken effect nevertheless
  };

  // Opens what was just given its name. Throws FileError when something else is there by now.
  std::unique_ptr<OpenFile> opened(const fs::path& path, const PublishedFile& published) const {
    try {
      return std::make_unique<OpenFile>(path, published, options);
    } catch (...) {
      // Nobody has seen the file yet: none is better than one that nobody writes.
      std::error_code ignored;
      if (published.id && fileIdOf(path) == published.id) fs::remove(path, ignored);
      throw;
    }
  }

  bool isGone() const {
    const SqliteDatabase& database = file->database;
    return database.file() && !leadsTo(database.path(), *database.file());
  }
  // SQLite itself looks only when it opens a journal, and this one stays open.
  void requireFile() const {
    const SqliteDatabase& database = file->database;
    if (database.file()) requireLeadsTo(database.path(), *database.file());
  }

  void moveTo(const fs::path& path) {
    // Under the same name the lock is our own, unless somebody removed that, too.
    std::unique_ptr<RecordingLock> newLock;
    const bool sameName = path == file->database.path();
    if (!sameName || !lock || !lock->isThere()) newLock = std::make_unique<RecordingLock>(path);
    OutputFile copy(path, Overwrite::kRefuse);
    try {
      file->database.copyTo(copy);
      if (!isOwn()) throw FormatError(file->database.path(), "was overwritten");
    } catch (const FormatError&) {
      unreadable = true;
      throw;
    }
    const auto journal = fileIdOf(journalPathOf(path));
    if (!journal || journal != file->journal) refuseForeignJournal(path);
    const PublishedFile published(copy);
    copy.commit();
    removeJournal();
    file = opened(path, published);
    if (newLock) lock = std::move(newLock);
  }

  // Whether the file is as the last commit left it.
  bool isOwn() const {
    const auto found = file->database.version();
    if (unreadable || !found || !file->version) return false;
    if (*found == *file->version) return true;
    return file->commitFailed && found->numCommits == file->version->numCommits + 1;
  }
  [[noreturn]] void throwOverwritten() {
    unreadable = true;
    throw FileError(file->database.path(), "was overwritten or damaged while it was being written");
  }

  // The journal of a file that is gone belongs to nothing any more; what somebody else put in its
  // place stays.
  void removeJournal() {
    const fs::path path = journalPathOf(file->database.path());
    std::error_code ignored;
    if (file->journal && fileIdOf(path) == file->journal) fs::remove(path, ignored);
    file->journal.reset();
  }

  // Refuses a sample while too much waits for the disk.
  void requireRoom(std::size_t most = kMaxPendingBytes) const {
    if (pending.bytes >= most)
      throw FileError(file->database.path(),
                      "nothing could be written for too long; the memory for what waits is full");
  }

  // `nowUs`: host time of the sample that was just added.
  void commitWhenDue(std::int64_t nowUs) {
    if (!pendingSinceUs) pendingSinceUs = nowUs;
    if (nowUs - *pendingSinceUs >= options.commitIntervalUs) {
      pendingSinceUs = nowUs;  // after a failure the next attempt is an interval away
      if (options.synced) return commit();
      flushPackers();
    }
    commitIfLarge();
  }
  // Conversions need no commits, but what they hold in memory is bounded.
  void commitIfLarge() {
    constexpr std::size_t kLargestUnsynced = 1u << 20;
    if (!options.synced && pending.bytes >= kLargestUnsynced) commit();
  }

  void flushPackers() {
    tactile.flush();
    for (WrittenSeries& each : series) each.packer.flush();
  }

  // Somebody may have removed the open journal. SQLite would go on with a file that has no name,
  // and after a crash nobody would find it; so it makes a new one.
  void renewJournal() {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(journalPathOf(file->database.path()), ignored))) return;
    file->database.execute("PRAGMA journal_mode=DELETE; PRAGMA journal_mode=PERSIST");
    file->journal.reset();
  }

  // Writes what waits; `last` is the end of the same transaction.
  template <typename Last>
  void commit(Last last) {
    flushPackers();
    requireFile();
    std::optional<RowWriter>& rows = file->rows;
    const std::int32_t version = neededVersion();
    try {
      renewJournal();
      file->beginCommit->run();
      // Without this, blocks would be written into whatever was copied into the file.
      if (!isOwn()) throwOverwritten();
      file->version = file->database.version();
      for (std::size_t i = 0; i < pending.series.size(); ++i)
        insertSeries(file->database, numSeries + i, pending.series[i]);
      std::int64_t id = numBlocks;
      for (const Block& block : pending.blocks) rows->block(++id, block);
      if (version > formatVersion)
        file->database.execute("PRAGMA user_version=" + std::to_string(version));
      id = numSeconds;
      for (const SecondSummary& row : pending.seconds) rows->second(++id, row);
      id = numEvents;
      for (const Event& event : pending.events) rows->event(++id, event);
      for (const auto& [name, value] : pending.counters) rows->counter(name, value);
      last();
      file->endCommit->run();
    } catch (const FormatError&) {
      file->database.rollBack();
      throwOverwritten();
    } catch (...) {
      file->database.rollBack();
      file->commitFailed = true;
      throw;
    }
    file->version = file->database.version();
    file->commitFailed = false;
    if (!file->journal) file->journal = fileIdOf(journalPathOf(file->database.path()));
    formatVersion = std::max(formatVersion, version);
    numSeries += pending.series.size();
    numBlocks += static_cast<std::int64_t>(pending.blocks.size());
    numSeconds += static_cast<std::int64_t>(pending.seconds.size());
    numEvents += static_cast<std::int64_t>(pending.events.size());
    pending = {};
    pendingSinceUs.reset();
    committedFrames = tactile.numItems();
  }
  // The version in the file is the lowest one that has everything in it.
  std::int32_t neededVersion() const {
    const bool inUs = std::any_of(pending.blocks.begin(),
                                  pending.blocks.end(),
                                  [](const Block& block) { return hasDeviceUs(block.coding); });
    if (series.size() > kHandSeries || needsNewVersion(*layout)) return kPalpateVersionWithSeries;
    return inUs ? kPalpateVersionWithDeviceUs : kPalpateVersion;
  }
  void commit() {
    if (pending.empty() && tactile.empty() &&
        std::all_of(series.begin(), series.end(), [](const auto& s) { return s.packer.empty(); }))
      return requireFile();
    commit([] {});
  }

  // What no commit has taken yet.
  struct Pending {
    std::vector<SeriesDescription> series;
    std::vector<Block> blocks;
    std::vector<SecondSummary> seconds;
    std::vector<Event> events;
    std::map<std::string, std::int64_t> counters;
    std::size_t bytes = 0;
    bool empty() const {
      return series.empty() && blocks.empty() && seconds.empty() && events.empty() &&
             counters.empty();
    }
  };

  PalpateWriterOptions options;
  std::shared_ptr<const SensorLayout> layout;
  std::unique_ptr<RecordingLock> lock;
  std::unique_ptr<OpenFile> file;
  Pending pending;
  BlockPacker::Sink sink = [this](const Block& block) {
    pending.blocks.push_back(block);
    pending.bytes += sizeof(Block) + block.data.size();
    if (block.stream == Stream::kTactile && valueCoding(block.coding) != BlockCoding::kCountsRuns)
      allCounts = false;
  };
  BlockPacker tactile{Stream::kTactile, sink};
  struct WrittenSeries {
    std::string name;
    BlockPacker packer;
    std::size_t width = 0;  // 0: that of the first sample
    std::optional<std::int64_t> lastUs = std::nullopt;
  };
  std::deque<WrittenSeries> series{{"angles", BlockPacker(Stream::kAngles, sink)},
                                   {"temperatures", BlockPacker(Stream::kTemperatures, sink)}};
  std::size_t numSeries = kHandSeries;  // whose description is committed
  std::int32_t formatVersion = kPalpateVersion;
  SecondSummarizer seconds{[this](const SecondSummary& row) {
    pending.seconds.push_back(row);
    pending.bytes += sizeof row;
  }};
  std::optional<std::int64_t> lastFrameUs;
  std::optional<std::int64_t> pendingSinceUs;  // host time of the oldest sample not committed
  std::int64_t committedFrames = 0;
  std::int64_t numBlocks = 0;  // rows committed
  std::int64_t numSeconds = 0;
  std::int64_t numEvents = 0;
  bool allCounts = true;  // every frame so far
  // Of the last frame; nothing: there is none yet.
  std::optional<std::shared_ptr<const Baseline>> notedBaseline;
  bool finished = false;
  bool unreadable = false;
};

PalpateWriter::PalpateWriter(const fs::path& path,
                             std::shared_ptr<const SensorLayout> layout,
                             const RecordingMeta& meta,
                             const PalpateWriterOptions& options) {
  if (!layout) throw std::invalid_argument("PalpateWriter: no sensor layout");
  requireReadable(*layout);
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
  const bool hasReadings = impl_->layout->decidesTouch();
  const std::vector<float>& stored = hasReadings ? frame.readings : frame.values;
  if (stored.size() != impl_->layout->numReadings())
    throw std::invalid_argument("frame: expected " + std::to_string(impl_->layout->numReadings()) +
                                " values, got " + std::to_string(stored.size()));
  if (frame.allValues().size() != frame.values.size())
    throw std::invalid_argument("frame: a different number of filtered values than of values");
  const std::vector<float>& all = hasReadings ? stored : frame.allValues();
  if (!std::all_of(all.begin(), all.end(), [](float v) { return std::isfinite(v); }))
    throw std::invalid_argument("frame: a value is not a number");
  requireLater("frame", impl_->lastFrameUs, frame.hostUs);
  impl_->requireRoom();
  if (hasReadings && impl_->options.notesBaselines) noteBaseline(frame);
  impl_->lastFrameUs = frame.hostUs;
  impl_->tactile.addFrame(frame);
  impl_->seconds.add(frame);
  impl_->commitWhenDue(frame.hostUs);
}

void PalpateWriter::noteBaseline(const TactileFrame& frame) {
  if (impl_->notedBaseline == frame.baseline) return;
  const Baseline none{std::vector<float>(frame.readings.size()), {}};
  try {
    addEvent(baselineEvent(frame.baseline ? *frame.baseline : none, frame.hostUs));
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {  // longer than an event may be
    throw std::invalid_argument(error.what());
  }
  impl_->notedBaseline = frame.baseline;
}

std::size_t PalpateWriter::addSeries(const SeriesDescription& description) {
  validate(description);
  std::deque<Impl::WrittenSeries>& series = impl_->series;
  if (series.size() == kMaxSeries)
    throw std::invalid_argument("at most " + std::to_string(kMaxSeries) + " series");
  for (const Impl::WrittenSeries& other : series)
    if (other.name == description.name)
      throw std::invalid_argument("two series have the name " + description.name);
  series.push_back({description.name,
                    BlockPacker(streamOfSeries(series.size()), impl_->sink),
                    description.columns.size()});
  impl_->pending.series.push_back(description);
  return series.size() - 1;
}

void PalpateWriter::addSample(const Sample& sample) {
  if (sample.series >= impl_->series.size())
    throw std::invalid_argument("there is no series " + std::to_string(sample.series));
  Impl::WrittenSeries& series = impl_->series[sample.series];
  requireValues(series.name, sample, series.width);
  requireLater(series.name, series.lastUs, sample.hostUs);
  // Series beside those of the hand leave half of the memory to it.
  impl_->requireRoom(sample.series < kHandSeries ? kMaxPendingBytes : kMaxPendingBytes / 2);
  series.width = sample.values.size();
  series.lastUs = sample.hostUs;
  // The hand's own have never had them: its files stay as they are.
  series.packer.addSample(
      sample.hostUs, sample.values, sample.series < kHandSeries ? std::nullopt : sample.deviceUs);
  impl_->commitWhenDue(sample.hostUs);
}

void PalpateWriter::addEvent(const Event& event) {
  const std::size_t bytes = event.kind.size() + event.text.size() + event.json.size();
  if (bytes > kMaxEventBytes)
    throw std::invalid_argument("event: longer than " + std::to_string(kMaxEventBytes) + " bytes");
  impl_->requireRoom();
  impl_->pending.events.push_back(event);
  impl_->pending.bytes += sizeof event + bytes;
  impl_->commitIfLarge();
}

void PalpateWriter::setCounter(const std::string& name, std::int64_t value) {
  impl_->pending.counters[name] = value;
}

void PalpateWriter::commit() { impl_->commit(); }

void PalpateWriter::finish() {
  Impl& impl = *impl_;
  if (!impl.finished) {
    impl.seconds.flush();
    impl.commit([&impl] {
      SqliteDatabase& database = impl.file->database;
      createBlockIndex(database);
      insertMeta(
          database, "seconds", std::to_string(writeOverview(database, impl.layout->numMatrices())));
      insertMeta(database, "frames", std::to_string(impl.tactile.numItems()));
      for (std::size_t i = 0; i < impl.series.size(); ++i)
        insertMeta(database,
                   samplesKey(streamOfSeries(i)),
                   std::to_string(impl.series[i].packer.numItems()));
      insertMeta(database, "value_type", impl.allCounts ? "counts" : "float");
      insertMeta(database, "finished", "1");
    });
    impl.finished = true;
  }
  // The journal is deleted by its name.
  impl.requireFile();
  try {
    impl.file->database.execute("PRAGMA synchronous=FULL; PRAGMA journal_mode=DELETE;");
  } catch (const FormatError&) {
    impl.throwOverwritten();
  }
  impl.requireFile();
  impl.lock.reset();
}

void PalpateWriter::abandon() noexcept { impl_->finished = true; }

bool PalpateWriter::isGone() const noexcept { return impl_->isGone(); }

bool PalpateWriter::isUnreadable() const noexcept { return impl_->unreadable; }

const fs::path& PalpateWriter::path() const noexcept { return impl_->file->database.path(); }

void PalpateWriter::moveTo(const fs::path& path) { impl_->moveTo(path); }

bool PalpateWriter::pendingFull() const noexcept {
  return impl_->pending.bytes >= kMaxPendingBytes;
}

std::int64_t PalpateWriter::framesOnDisk() const noexcept { return impl_->committedFrames; }

std::int64_t PalpateWriter::bytesOnDisk() const { return impl_->file->database.sizeBytes(); }

void writePalpate(const fs::path& path,
                  std::shared_ptr<const SensorLayout> layout,
                  const RecordingMeta& meta,
                  const std::function<void(PalpateWriter&)>& fill,
                  Overwrite overwrite) {
  requireWritable(path, overwrite);
  if (RecordingLock::isHeld(path)) throw FileError(path, "is being written by another program");
  if (overwrite == Overwrite::kRefuse) refuseForeignJournal(path);
  const TemporaryNeighbour temporary(path);
  try {
    PalpateWriterOptions options;
    options.synced = false;                // nobody sees the file before it is whole and synced
    options.commitIntervalUs = INT64_MAX;  // full blocks
    PalpateWriter writer(temporary.file(), std::move(layout), meta, options);
    fill(writer);
    writer.finish();
  } catch (const FileError& error) {
    if (error.path() != temporary.file()) throw;
    rethrowAs(path, error);
  }
  if (overwrite == Overwrite::kReplace) settleJournal(path);
  publishFile(temporary.file(), path, overwrite);
}

void writePalpate(const Profile& profile,
                  std::span<const Event> events,
                  const fs::path& path,
                  Overwrite overwrite,
                  const Progress& progress,
                  const RecordingMeta& meta) {
  writePalpate(
      path,
      // What was filtered has no readings any more.
      profile.givesReadings() || !profile.layout().decidesTouch()
          ? profile.hand().layout
          : std::make_shared<const SensorLayout>(withoutTouchRules(profile.layout())),
      writtenMeta(profile.info(), profile.hand(), meta),
      [&](PalpateWriter& writer) {
        // The summaries are those of the file as it was recorded.
        writeAll(profile.givesReadings()
                     ? profile.withBaselines(recordedBaselinesOf(events, profile.layout()))
                     : profile,
                 events,
                 writer,
                 progress);
      },
      overwrite);
}

}  // namespace palpate
