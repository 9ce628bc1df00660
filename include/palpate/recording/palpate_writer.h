// Writes a native recording `*.palpate` (docs/notes/palpate_format.md) so that what was committed
// survives a killed process and a full disk: rollback journal, synchronous=FULL, a commit every 100
// ms at most.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>
#include <palpate/model/series.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// The most bytes that wait in memory while commits fail: 30 s of two hands at 300 frames/s are 10
// MB.
constexpr std::size_t kMaxPendingBytes = 64u << 20;

struct PalpateWriterOptions {
  std::int64_t commitIntervalUs = 100'000;  // host time between commits at most [us]
  std::string vfs;                          // SQLite file system to use; empty: the default one
  // Whether every commit waits for the disk (synchronous=FULL). It is off only for conversions,
  // which sync at the end; then the interval only gathers samples into blocks, which are committed
  // in large pieces.
  bool synced = true;
  // Whether a frame with readings is preceded by the event of its baseline, where that is another
  // one than that of the frame before: so a file tells over what it was recorded.
  bool notesBaselines = false;
};

// One recording being written; not thread-safe (the recorder's thread owns it).
class PalpateWriter {
 public:
  // Creates PATH (never replaces one) and its lock PATH.lock. Throws FileError: exists, locked by
  // another program, can't be written.
  PalpateWriter(const std::filesystem::path& path,
                std::shared_ptr<const SensorLayout> layout,
                const RecordingMeta& meta = {},
                const PalpateWriterOptions& options = {});
  // Commits what is there if it can. Without finish() the file stays an unfinished recording.
  ~PalpateWriter();
  PalpateWriter(const PalpateWriter&) = delete;
  PalpateWriter& operator=(const PalpateWriter&) = delete;

  // Adds a series beside those of the hand; before or between samples. Returns its index. Throws
  // std::invalid_argument (not valid, a name that is there already).
  std::size_t addSeries(const SeriesDescription& description);

  // Each appends in order of time and commits when the interval has passed since the last commit.
  // Throw std::invalid_argument (wrong size, not finite, no such series, time not later than
  // before): nothing was added. Throw FileError (the disk is full, ..): what was committed before
  // is safe; later samples, also that of this call, are kept in memory, and the next commit that is
  // due writes them. Only when kMaxPendingBytes are kept does a call refuse its sample:
  // pendingFull() is then true.
  void addFrame(const TactileFrame& frame);
  void addSample(const Sample& sample);
  void addEvent(const Event& event);
  void setCounter(const std::string& name, std::int64_t value);

  // Throws FileError; what is not on disk then stays in memory for the next commit.
  void commit();
  // Writes index and last summaries, syncs, turns the journal off: a finished recording. Throws
  // FileError; then finish() can be called again.
  void finish();
  // Whether the file was moved, renamed, deleted or replaced since it was created. Then commit()
  // and finish() throw FileError and write nothing.
  bool isGone() const noexcept;
  // Whether something else was written into the file in place, or moveTo() couldn't read it: what
  // was committed can't be had from it any more, and commit() and finish() throw FileError and
  // write nothing into it.
  bool isUnreadable() const noexcept;
  // Goes on under another name after isGone() (or the same one, when it is free): all that was
  // committed is copied from the open file, and what waits is kept. Takes as long as copying the
  // file. Throws FileError (PATH exists, can't be written), FormatError (the open file can't be
  // read): nothing has changed then.
  void moveTo(const std::filesystem::path& path);
  // Gives the recording up: what no commit has taken is dropped, and the destructor writes nothing.
  // What was committed stays as an unfinished recording.
  void abandon() noexcept;
  // Whether samples are being refused because commits have failed for too long.
  bool pendingFull() const noexcept;

  std::int64_t framesOnDisk() const noexcept;  // committed
  std::int64_t bytesOnDisk() const;            // of the open file, also when it is gone
  const std::filesystem::path& path() const noexcept;

 private:
  struct Impl;
  void noteBaseline(const TactileFrame& frame);
  std::unique_ptr<Impl> impl_;
};

// Writes a finished recording whose samples `fill` adds: temporary file, synced, renamed. Nothing
// remains when `fill` throws. Samples wait in memory only until they fill blocks. Throws FileError
// (also when PATH is being written, or a rollback journal of another recording lies beside it).
void writePalpate(const std::filesystem::path& path,
                  std::shared_ptr<const SensorLayout> layout,
                  const RecordingMeta& meta,
                  const std::function<void(PalpateWriter&)>& fill,
                  Overwrite overwrite = Overwrite::kRefuse);

// Writes a whole profile in the same way. `meta`: as readRecordingMeta(); what the profile and the
// file say by themselves (hand, serial number, number of frames, ..) stands in place of it. Throws
// FileError, Cancelled.
void writePalpate(const Profile& profile,
                  std::span<const Event> events,
                  const std::filesystem::path& path,
                  Overwrite overwrite = Overwrite::kRefuse,
                  const Progress& progress = {},
                  const RecordingMeta& meta = {});

}  // namespace palpate
