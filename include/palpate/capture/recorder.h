// The recorder: takes what a capture session delivers and writes it as native recordings, on a
// thread of its own. It keeps the last two seconds, so that a recording holds what came just before
// its start.
//
// What came is committed within 100 ms (a round every 15 ms, a commit every 45). When the disk is
// full or fails, capture goes on, up to 64 MB wait in memory, and writing is tried again every 100
// ms; when that was not enough, an event "gap" says exactly what is missing, and status() says it
// at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/core/time.h>

namespace palpate {

struct RecorderOptions {
  double preTriggerS = 2.0;        // what is kept from before a start [s], 0..60
  double commitIntervalMs = 50.0;  // oldest item not committed, at most [ms], 1..10000
  std::string vfs;                 // SQLite file system to write with; empty: the default one
  CaptureQueueOptions queue;       // queues; wakeAtItems 1 means half of the tactile one
  // Bytes left on the disk of a folder, nothing when unknown; empty: statvfs.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> freeBytes;
  // Told of every event that the recorder itself makes (gap, clock, alarm); on its thread.
  std::function<void(const RecordingEvent&)> notice;
};

// One recording. Limits count from the first frame that comes after the start: what was kept from
// before comes on top.
struct RecordingOptions {
  std::filesystem::path path;               // NAME.palpate; must not exist
  std::map<std::string, std::string> meta;  // operator, object, run, notes, program, ..
  // More of it, asked for when the file is made (serial number, settings); may be empty.
  std::function<std::map<std::string, std::string>()> describe;
  // Counters of the recording (bad checksums, ..), asked for with every commit, at least once a
  // second, and at the end; may be empty.
  std::function<std::map<std::string, std::int64_t>()> counters;
  double preTriggerS = 2.0;                     // [s], at most what the recorder keeps
  std::optional<double> splitS;                 // a new part after so long [s], >= 1
  std::optional<std::int64_t> splitBytes;       // or at about this size of a part, >= 64 KiB
  std::optional<double> stopAfterS;             // > 0
  std::optional<std::int64_t> stopAfterFrames;  // >= 1
  std::optional<std::int64_t> stopAfterBytes;   // of all parts, about; >= 64 KiB
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Parts that follow NAME.palpate are NAME_002.palpate, ..; a number that is taken is passed over.
std::filesystem::path partPath(const std::filesystem::path& path, int part);

struct RecordingReport {
  // parts in order; empty: no frame came, no file was made
  std::vector<std::filesystem::path> paths;
  std::int64_t frames = 0;  // taken into the recording, in all parts
  std::int64_t angles = 0;
  std::int64_t temperatures = 0;
  std::int64_t events = 0;
  // Number of received items that are missing in the recording because a queue overflowed or
  // the disk failed; gap events say which.
  std::int64_t lost = 0;
  // Number of items that could not be recorded, because their time is not later than the
  // previous one or a value is not a number.
  std::int64_t refused = 0;
  std::int64_t gaps = 0;           // intervals longer than max(1 s, 5 median intervals)
  std::int64_t writeFailures = 0;  // commits that failed, and were tried again
  double durationS = 0.0;          // first to last frame [s]
  double rateHz = 0.0;             // 1 / median interval; 0 with fewer than two frames
  double meanRateHz = 0.0;         // (frames - 1) / duration
  std::int64_t bytes = 0;          // on disk, all parts
  bool complete = true;  // every part is finished and nothing was lost, refused or left unwritten
  std::string message;   // what is wrong, one line; empty: nothing
};

struct RecorderStatus {
  enum class State {
    kIdle,       // nothing is recorded; the last seconds are kept
    kWaiting,    // for the first frame: there is no file yet
    kRecording,  // frames go to disk
  };
  State state = State::kIdle;
  std::filesystem::path path;  // of the current part
  int parts = 0;
  std::int64_t frames = 0;
  std::int64_t angles = 0;
  std::int64_t temperatures = 0;
  double elapsedS = 0.0;          // since the start [s]
  double recordedS = 0.0;         // first to newest frame [s]
  std::int64_t framesOnDisk = 0;  // committed
  std::int64_t bytesOnDisk = 0;   // all parts
  std::int64_t lost = 0;
  std::int64_t refused = 0;
  std::string writeError;  // what the disk said last; empty: writing works
  // Time for which a write has been blocked by the disk [s].
  double blockedS = 0.0;
  std::optional<std::uint64_t> freeBytes;  // on the recording's disk, asked for once a second
};

// start(), stop() and the others may be called from one controlling thread, offer() from any.
class Recorder {
 public:
  // The clock must outlive the recorder. Throws std::invalid_argument.
  explicit Recorder(RecorderOptions options = {}, const Clock& clock = systemClock());
  ~Recorder();  // stops
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Runs step() on a thread until halt(); both do nothing when that is so already.
  void run();
  void halt() noexcept;
  // One round: takes what waits, writes, commits what is due. Throws std::logic_error while run()
  // does it.
  void step();

  // Where items go in; never waits (unless feed.blockWhenFull). False: lost, and counted.
  bool push(CaptureItem item);
  // Clears the stored pre-trigger data, because a new source begins. Throws std::logic_error while
  // the thread runs or a recording is made.
  void clearPreTrigger();

  // Asks for a recording. Throws FileError (exists, no such folder, not writable),
  // std::invalid_argument (not a .palpate, options), std::logic_error (records already).
  void start(RecordingOptions options);
  // Everything offered before is written, the file is finished. Returns the last report when
  // nothing is being recorded (it may have stopped by itself); an empty one when nothing ever was.
  RecordingReport stop();
  bool recording() const;  // from start() until stopped, by itself or by stop()
  RecorderStatus status() const;
  CaptureQueueStats queueStats() const;

  // Host time as stamps have it [us since 1970]: the clock's or, when stamps come from another time
  // (a replay), the newest stamp.
  std::int64_t nowUs() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Bytes that may still be written in a folder, or in the one it is going to be made in; asked of
// the file system itself (statvfs), so that it is known without a mount table, too. Nothing when it
// can't be asked.
std::optional<std::uint64_t> freeBytesOf(const std::filesystem::path& folder);

}  // namespace palpate
