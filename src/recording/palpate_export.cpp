// writePalpate(): a whole profile as a finished native recording.
#include <cstdlib>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_writer.h"

#include "recording/palpate_lock.h"

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

}  // namespace

void writePalpate(const Profile& profile,
                  std::span<const RecordingEvent> events,
                  const fs::path& path,
                  Overwrite overwrite,
                  const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  requireWritable(path, overwrite);
  if (RecordingLock::isHeld(path)) throw FileError(path, "is being written by another program");
  if (overwrite == Overwrite::kRefuse) refuseForeignJournal(path);
  const TemporaryNeighbour temporary(path);
  std::map<std::string, std::string> meta;
  if (!profile.info().serial.empty()) meta["serial"] = profile.info().serial;
  if (!profile.info().firmware.empty()) meta["firmware"] = profile.info().firmware;
  meta["hand"] = profile.hand().name;
  PalpateWriterOptions options;
  options.synced = false;                // nobody sees the file before it is whole and synced
  options.commitIntervalUs = INT64_MAX;  // full blocks
  PalpateWriter writer(temporary.file(), profile.hand().layout, meta, options);
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
    if (progress && i % kFramesPerReport == 0 &&
        !progress(static_cast<double>(i) / static_cast<double>(profile.numFrames())))
      throw Cancelled();
    profile.readFrame(i, frame);
    addBefore(frame.hostUs);
    writer.addFrame(frame);
  }
  addBefore(INT64_MAX);
  for (const RecordingEvent& event : events) writer.addEvent(event);
  writer.finish();
  // The journal of an unfinished recording that is replaced would be played back into the new one.
  std::error_code ignored;
  fs::remove(journalPathOf(path), ignored);
  publishFile(temporary.file(), path, overwrite);
}

}  // namespace palpate
