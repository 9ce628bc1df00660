// The recorder writes the items of a capture session as native recordings, on a thread of its own.
// It keeps the last two seconds in memory, so that a recording also contains what happened just
// before its start.
//
// Items are committed within 100 ms (while recording, a round with a commit every 80 ms). When the
// disk is full or fails, capture continues: up to 64 MB wait in memory, and writing is retried
// every 100 ms. If that does not suffice, an event "gap" states exactly what is missing, and
// status() reports it at once.
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
#include <palpate/capture/contact_trigger.h>
#include <palpate/core/option_check.h>
#include <palpate/core/time.h>
#include <palpate/device/frame_losses.h>
#include <palpate/model/series.h>
#include <palpate/recording/mcap_recording.h>

namespace palpate {

struct RecorderOptions {
  // Time kept in memory for the start of a recording [s], 0..60.
  double preTriggerS = 2.0;
  // Maximum age of an item that is not committed [ms], 1..10000.
  double commitIntervalMs = 80.0;
  // Where a recording goes on when its folder is gone or can't be written, the first that can;
  // empty: the home folder, and the one for temporary files.
  std::vector<std::filesystem::path> emergencyFolders;
  std::string vfs;            // SQLite file system (VFS); empty: the default one
  CaptureQueueOptions queue;  // queues; wakeAtItems 1 means half of the tactile queue
  // Returns the free bytes on the disk of a folder, empty when unknown; if not set, statvfs is
  // used.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> freeBytes;
  // Called with every event that the recorder itself creates (gap, clock, alarm), on its thread.
  std::function<void(const Event&)> notice;
};

// Options of one recording. Limits count from the first frame after the start; items kept from
// before the start are not counted.
struct RecordingOptions {
  std::filesystem::path path;  // NAME.palpate; must not exist
  RecordingMeta meta;          // operator, object, run, notes, program, ..
  // Returns further meta data when the file is created (serial number, settings); may be empty.
  std::function<RecordingMeta()> describe;
  // Returns counters of the recording (bad checksums, ..); called with every commit, at least once
  // a second, and at the end; may be empty.
  std::function<std::map<std::string, std::int64_t>()> counters;
  // Returns the series beside those of the hand, in the order of their indexes from kHandSeries on;
  // one whose columns are not known yet has none. Called when a file is created, and when samples
  // of one come that is not known yet; may be empty.
  std::function<std::vector<SeriesDescription>()> series;
  // Returns the events of gaps that are still going on at this time [us since 1970], at which the
  // recording ends; called once, before the last `counters`; may be empty.
  std::function<std::vector<Event>(std::int64_t untilUs)> openGaps;
  double preTriggerS = 2.0;                     // [s], limited to what the recorder keeps
  std::optional<double> splitS;                 // a new part after this time [s], >= 1
  std::optional<std::int64_t> splitBytes;       // or at about this size of a part, >= 64 KiB
  std::optional<double> stopAfterS;             // > 0
  std::optional<std::int64_t> stopAfterFrames;  // >= 1
  std::optional<std::int64_t> stopAfterBytes;   // size of all parts, approximate; >= 64 KiB
  // Contact, for the two options that follow.
  ContactTriggerOptions contact = {};
  // The recording begins with the first contact that is present after the start, and preTriggerS
  // before it; until then nothing is written (RecorderStatus::State::kArmed). All limits then count
  // from the contact.
  bool startOnContact = false;
  // It ends after a contact, once there has been none for this time [s]. What is missing
  // (the stream was interrupted) doesn't count as released.
  static constexpr OptionRange kStopWithoutContactS{0.05, 1e6, "s"};
  std::optional<double> stopWithoutContactS = {};
  // When it ends by itself and can't be written: it waits for the disk, Recorder::continueIn() or
  // stop(), which finishes what can be written within 2 s. False: it does that at once.
  bool waitForDisk = false;
  // Writes the same into NAME.mcap beside each part, too, on a thread of its own, to which nothing
  // waits. Where that can't keep up or its disk fails it stops, with an event "alarm"; the
  // recording goes on. What has been taken for a second is in the file at the latest.
  std::optional<McapWriteOptions> mcap;
  std::size_t mcapQueueItems = 16'384;  // that wait for it at most
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Path of the MCAP file beside a part: NAME.mcap.
std::filesystem::path mcapPathOf(const std::filesystem::path& path);

// Path of a part: NAME.palpate is followed by NAME_002.palpate, ..; existing files are skipped.
std::filesystem::path partPath(const std::filesystem::path& path, int part);

// What was recorded of a series beside those of the hand.
struct RecordedSeries {
  std::string name;
  std::int64_t samples = 0;
  std::int64_t lost = 0;  // received samples that are missing, see RecordingReport::lost
  double rateHz = 0.0;    // (samples - 1) / time from the first to the last; 0: not known
};

// Name of a counter of a series: "lost" (sent but not received, by the usual rate), "suspect" (rows
// that were refused), "reconnects".
inline std::string seriesCounter(const std::string& series, const std::string& what) {
  return "series_" + series + "_" + what;
}

struct RecordingReport {
  // Parts in order, those that are there now; empty when no frame arrived and so no file was
  // created.
  std::vector<std::filesystem::path> paths;
  // Recorded in all parts; of a recording that could not be finished those that are on disk.
  std::int64_t frames = 0;
  std::int64_t angles = 0;
  std::int64_t temperatures = 0;
  std::int64_t samples = 0;            // of other series
  std::vector<RecordedSeries> series;  // the same of each of them
  std::int64_t events = 0;
  // Number of received items that are missing in the recording because a queue overflowed or
  // the disk failed; gap events say which. Of a recording that could not be finished, the frames
  // that waited for the disk are counted, too; no event tells of them.
  std::int64_t lost = 0;
  // Number of items that could not be recorded, because their time is not later than the
  // previous one or a value is not a number.
  std::int64_t refused = 0;
  // The newest RecordingOptions::counters, as stored in the file: what the connection counted
  // during the recording (bad_checksums, lost: frames that were sent but not received, ..).
  std::map<std::string, std::int64_t> counters;
  // One of them; 0 where it wasn't counted.
  std::int64_t counter(const std::string& name) const;
  // What the hand sent and the recording lacks, and what it has beyond the hand's range.
  FrameLosses losses() const;
  std::int64_t gaps = 0;           // intervals longer than max(1 s, 5 median intervals)
  double gapsS = 0.0;              // their sum [s]
  double openGapS = 0.0;           // its end without frames, of RecordingOptions::openGaps [s]
  std::int64_t writeFailures = 0;  // commits that failed, and were tried again
  // Stamps of the first and the last recorded frame [us since 1970]; 0: no frame was recorded.
  std::int64_t firstFrameUs = 0;
  std::int64_t lastFrameUs = 0;
  double durationS = 0.0;   // first to last frame [s]
  double rateHz = 0.0;      // 1 / median interval; 0 with fewer than two frames
  double meanRateHz = 0.0;  // (frames - 1) / duration
  std::int64_t bytes = 0;   // on disk, all parts
  // RecordingOptions::mcap: the files that were begun, and why that stopped before the end; empty:
  // it did not.
  std::vector<std::filesystem::path> mcapPaths;
  std::string mcapFailure;
  // Of a recording that waited for contact (startOnContact): it was stopped before there was any,
  // as was asked for; `paths` is empty then.
  bool nothingTouched = false;
  // True when every part is finished where it was begun, and nothing was lost, refused or left
  // unwritten.
  bool complete = true;
  std::string message;  // one line that describes a problem; empty: none

  // "no frame came in its last 8.0 s"; empty: frames came up to its end.
  std::string openGapText() const;
};

struct RecorderStatus {
  enum class State {
    kIdle,       // no recording; the last seconds are kept in memory
    kArmed,      // waiting for contact: there is no file yet
    kWaiting,    // waiting for the first frame: there is no file yet
    kRecording,  // frames are written to disk
  };
  State state = State::kIdle;
  std::filesystem::path path;  // of the current part
  int parts = 0;
  std::int64_t frames = 0;
  std::int64_t angles = 0;
  std::int64_t temperatures = 0;
  std::int64_t samples = 0;            // of other series
  std::vector<RecordedSeries> series;  // the same of each of them
  double elapsedS = 0.0;               // since the start, or since the contact that began it [s]
  // Stamps of the first and the newest recorded frame [us since 1970]; 0: there is none yet.
  std::int64_t firstFrameUs = 0;
  std::int64_t lastFrameUs = 0;
  double recordedS = 0.0;  // first to newest frame [s]
  // RecordingOptions::stopAfterS of this recording.
  std::optional<double> stopAfterS;
  std::int64_t framesOnDisk = 0;  // committed
  std::int64_t bytesOnDisk = 0;   // all parts
  std::int64_t lost = 0;
  std::int64_t refused = 0;
  // Last error of the disk; empty while writing works.
  std::string writeError;
  // Why and where it goes on under another name: its file was deleted, renamed or replaced, or its
  // folder is gone. Empty: it did not. Stays until it ends.
  std::string relocation;
  // It has ended by itself and can't be finished (RecordingOptions::waitForDisk): what waits in
  // memory is lost if it is stopped now.
  bool waitsForDisk = false;
  // Why the MCAP file beside the recording stopped; empty: it did not.
  std::string mcapFailure;
  // Time for which a write has been blocked by the disk [s].
  double blockedS = 0.0;
  // On the disk of the running recording, updated once a second; empty without one.
  std::optional<std::uint64_t> freeBytes;
};

// One controlling thread calls all functions, except push(), which any thread may call.
class Recorder {
 public:
  // The clock must outlive the recorder. Throws std::invalid_argument.
  explicit Recorder(RecorderOptions options = {}, const Clock& clock = systemClock());
  ~Recorder();  // stops
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Runs step() on a thread until halt(). Both have no effect if already done.
  void run();
  void halt() noexcept;
  // Runs one round: takes the waiting items, writes them, commits what is due. Throws
  // std::logic_error while run() is active.
  void step();

  // The names of all series, for gaps. Safe from any thread.
  void nameSeries(std::vector<std::string> names);
  // Adds an item; never waits (unless feed.blockWhenFull). Returns false when it was lost (and
  // counted).
  bool push(CaptureItem item);
  // Clears the stored pre-trigger data, because a new source begins. Throws std::logic_error while
  // the thread runs or a recording is made.
  void clearPreTrigger();

  // Starts a recording. Throws FileError (it or its NAME.mcap exists, no such folder, not
  // writable), std::invalid_argument (not a .palpate, options), std::logic_error (already
  // recording).
  void start(RecordingOptions options);
  // Continues the running recording in another folder, when the present one can't be written any
  // more (the disk is full): the next part, under the name of the first, begins with all items that
  // are not on the disk yet. The part before it stays unfinished where it is. A file that is no
  // longer found under its name is copied whole instead, as it is without being asked where an
  // emergency folder takes it; where this folder can't take all of it, it stays as it was, and
  // status().writeError says so.
  // Throws std::logic_error (not recording), FileError (no such folder, not writable).
  void continueIn(const std::filesystem::path& folder);
  // Writes all items pushed before and finishes the file. Returns the last report if no recording
  // runs (it may have stopped by itself), or an empty one if there never was a recording.
  RecordingReport stop();
  // True from start() until the recording stops, by itself or by stop().
  bool recording() const;
  RecorderStatus status() const;
  CaptureQueueStats queueStats() const;

  // Present host time in the time of the stamps [us since 1970]: that of the clock or, when the
  // stamps have another time (a replay), the newest stamp.
  std::int64_t nowUs() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Free bytes in a folder, or in the existing folder above one that is yet to be created. Uses the
// file system itself (statvfs), so that it works without a mount table, too. Empty when unknown.
std::optional<std::uint64_t> freeBytesOf(const std::filesystem::path& folder);

}  // namespace palpate
