// writePalpate(): a whole profile as a finished native recording.
#include <cstdlib>

#include "palpate/core/error.h"
#include "palpate/core/progress_steps.h"
#include "palpate/recording/palpate_writer.h"

#include "recording/native/palpate_lock.h"
#include "recording/native/sqlite_database.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

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
      throw FileError(path, "can't be written: " + std::generic_category().message(errno));
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

// Calls add() for the samples of one stream up to a time, from where it stopped last.
template <typename TimeOf, typename Add>
void addUntil(std::size_t& next, std::size_t count, std::int64_t untilUs, TimeOf timeOf, Add add) {
  while (next < count && timeOf(next) <= untilUs) add(next++);
}

void writeAll(const Profile& profile,
              std::span<const RecordingEvent> events,
              const fs::path& file,
              const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  std::map<std::string, std::string> meta;
  if (!profile.info().serial.empty()) meta["serial"] = profile.info().serial;
  if (!profile.info().firmware.empty()) meta["firmware"] = profile.info().firmware;
  if (!profile.info().sensorRevision.empty())
    meta["sensor_revision"] = profile.info().sensorRevision;
  meta["hand"] = profile.hand().name;
  PalpateWriterOptions options;
  options.synced = false;                // nobody sees the file before it is whole and synced
  options.commitIntervalUs = INT64_MAX;  // full blocks
  PalpateWriter writer(file, profile.hand().layout, meta, options);
  std::size_t angle = 0;
  std::size_t temperature = 0;
  const auto addBefore = [&](std::int64_t untilUs) {
    addUntil(
        angle,
        profile.numAngles(),
        untilUs,
        [&](std::size_t i) { return profile.angleTimeUs(i); },
        [&](std::size_t i) { writer.addAngles(profile.angles(i)); });
    addUntil(
        temperature,
        profile.numTemperatures(),
        untilUs,
        [&](std::size_t i) { return profile.temperatureTimeUs(i); },
        [&](std::size_t i) { writer.addTemperatures(profile.temperatures(i)); });
  };
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    addBefore(frame.hostUs);
    writer.addFrame(frame);
  }
  addBefore(INT64_MAX);
  for (const RecordingEvent& event : events) writer.addEvent(event);
  writer.finish();
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
  const auto isLeft = [&] { return fs::file_size(journal, ignored) > 0 && !ignored; };
  try {
    SqliteDatabase old(path, SqliteDatabase::Mode::kReadWrite);
    old.integerOf("SELECT count(*) FROM sqlite_schema");
  } catch (const Error&) {
    if (isLeft())
      throw FileError(
          path,
          "was left in the middle of a commit and can't be replaced as it is; save it with "
          "'palpate recover', or move it away together with its journal");
  }
  // What is left now is an empty shell, or belongs to no recording.
  fs::remove(journal, ignored);
}

// Without the name of the temporary file, which is nobody's business.
[[noreturn]] void rethrowAs(const fs::path& path, const FileError& error) {
  const std::string what = error.what();
  const std::string own = error.path().string() + ": ";
  throw FileError(path, what.starts_with(own) ? what.substr(own.size()) : what);
}

}  // namespace

void writePalpate(const Profile& profile,
                  std::span<const RecordingEvent> events,
                  const fs::path& path,
                  Overwrite overwrite,
                  const Progress& progress) {
  requireWritable(path, overwrite);
  if (RecordingLock::isHeld(path)) throw FileError(path, "is being written by another program");
  if (overwrite == Overwrite::kRefuse) refuseForeignJournal(path);
  const TemporaryNeighbour temporary(path);
  try {
    writeAll(profile, events, temporary.file(), progress);
  } catch (const FileError& error) {
    if (error.path() != temporary.file()) throw;
    rethrowAs(path, error);
  }
  if (overwrite == Overwrite::kReplace) settleJournal(path);
  publishFile(temporary.file(), path, overwrite);
}

}  // namespace palpate
