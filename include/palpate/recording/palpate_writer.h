// Writes a native recording `*.palpate` (docs/palpate_format.md) so that what was committed survives a
// killed process and a full disk: rollback journal, synchronous=FULL, a commit every 100 ms at most.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/hand_state.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Something that happened, at a time or over a span.
struct RecordingEvent {
  std::int64_t tUs = 0;   // [us since 1970]
  std::int64_t t1Us = 0;  // end; equals tUs for a moment
  std::string kind;       // "gap", "label", "note", "settings", ..
  std::optional<int> matrix;
  std::string text;
  std::string json;  // more of it, one JSON object; may be empty
};

struct PalpateWriterOptions {
  std::int64_t commitIntervalUs = 100'000;  // host time between commits at most [us]
  std::string vfs;                          // SQLite file system to use; empty: the default one
  bool synced = true;  // synchronous=FULL; off only for conversions, which sync at the end
};

// One recording being written; not thread-safe (the recorder's thread owns it).
class PalpateWriter {
 public:
  // Creates PATH (never replaces one) and its lock PATH.lock. Throws FileError: exists, locked by
  // another program, can't be written.
  PalpateWriter(const std::filesystem::path& path,
                std::shared_ptr<const SensorLayout> layout,
                const std::map<std::string, std::string>& meta = {},
                const PalpateWriterOptions& options = {});
  // Commits what is there when it can; the file stays an unfinished recording.
  ~PalpateWriter();
  PalpateWriter(const PalpateWriter&) = delete;
  PalpateWriter& operator=(const PalpateWriter&) = delete;

  // Each appends in order of time and commits when the interval has passed since the last commit.
  // Throw std::invalid_argument (wrong size, not finite, time not later than before), FileError (the
  // disk is full, ..): then everything up to the last commit is safe, and only that.
  void addFrame(const TactileFrame& frame);
  void addAngles(const JointAngles& angles);
  void addTemperatures(const Temperatures& temperatures);
  void addEvent(const RecordingEvent& event);
  void setCounter(const std::string& name, std::int64_t value);

  void commit();
  // Writes index and last summaries, syncs, turns the journal off: a finished recording.
  void finish();

  std::int64_t framesOnDisk() const noexcept;  // committed
  std::int64_t bytesOnDisk() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Writes a whole profile as a finished recording: temporary file, synced, renamed.
void writePalpate(const Profile& profile,
                  const std::filesystem::path& path,
                  Overwrite overwrite = Overwrite::kRefuse,
                  const Progress& progress = {});

}  // namespace palpate
