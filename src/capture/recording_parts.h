// One recording while it is written: decides which items belong to it, splits it into parts, and
// handles failures of the disk. Not thread-safe: the recorder's thread owns it.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/capture/recorder.h"
#include "palpate/core/file_id.h"
#include "palpate/core/time.h"
#include "palpate/recording/palpate_writer.h"

#include "capture/interval_statistics.h"
#include "capture/mcap_mirror.h"

namespace palpate {

// True for keys of `meta` that the writer sets itself.
bool isReservedMeta(std::string_view key) noexcept;

// Checks before the first frame whether the file can be created. Throws FileError: exists, no
// folder, not writable.
void requireNewFile(const std::filesystem::path& path);

// Throws FileError: no such folder, not writable.
void requireWritableFolder(const std::filesystem::path& folder);

// Items lost in the queues, by CaptureStream.
using QueueLosses = std::array<std::uint64_t, kCaptureStreams>;

// Times of a round on both clocks.
struct RoundTime {
  std::int64_t monoUs = 0;  // used for waiting and retrying
  std::int64_t nowUs = 0;   // host time in the time of the stamps
  // The items taken in this round arrived after this monotonic time.
  std::int64_t sinceMonoUs = 0;
};

class RecordingParts {
 public:
  using Notice = std::function<void(const Event&)>;
  // `start` is the time at which the recording was requested. The clock must outlive it.
  RecordingParts(RecordingOptions options,
                 const RecorderOptions& recorder,
                 RoundTime start,
                 const Clock& clock,
                 Notice notice);

  // Takes the item if it belongs to the recording. A failing disk causes no exception: it is noted,
  // and writing is retried.
  void add(const CaptureItem& item, RoundTime time);
  // Commits what is due and repeats what failed.
  void round(RoundTime time);
  // Continues in another folder; see Recorder::continueIn(). When that fails, too, nothing changes,
  // and the failure is noted.
  void continueIn(const std::filesystem::path& folder, RoundTime time);
  // True when a limit of the options has been reached.
  bool ended(RoundTime time) const;
  // Tries to finish; returns false after a failure, to be called again.
  bool finish(RoundTime time);

  // RecordingOptions::waitForDisk.
  bool waitsForDisk() const noexcept { return options_.waitForDisk; }
  // The oldest item that no commit has taken came after this monotonic time; empty: there is none.
  std::optional<std::int64_t> oldestUncommittedMonoUs() const noexcept { return dirtySinceMonoUs_; }
  // What the queues lost since the start; its gaps arrive as events.
  void noteQueueLosses(const QueueLosses& lost) noexcept { lostInQueues_ = lost; }
  // Monotonic time since which it records: of the request, or of the contact that began it.
  std::int64_t startMonoUs() const noexcept { return start_.monoUs; }
  void describe(RecorderStatus& status) const;
  RecordingReport report() const;
  const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  void awaitContact(const CaptureItem& item, RoundTime time);
  void endAfterRelease(const TactileFrame& frame);
  bool belongs(const CaptureItem& item);
  void hold(const CaptureItem& item);
  void take(const CaptureItem& item, RoundTime time);
  void open(RoundTime time);
  bool isOfOtherLayout(const TactileFrame& frame) const;
  // The name of the first part in another folder, as no file there has.
  std::filesystem::path freeBaseIn(const std::filesystem::path& folder) const;
  std::unique_ptr<PalpateWriter> makeWriter(const std::shared_ptr<const SensorLayout>& layout);
  bool splitDue(const TactileFrame& frame) const;
  void split(const TactileFrame& frame, RoundTime time);
  bool closeOldPart(RoundTime time);
  // Does the work on the open part or the previous one; a file that is gone is made anew, and the
  // work repeated. False: it failed, and that is noted.
  bool succeeds(std::unique_ptr<PalpateWriter>& part,
                RoundTime time,
                const std::function<void()>& work);
  bool isMended(std::unique_ptr<PalpateWriter>& part, const std::string& why, RoundTime time);
  std::vector<std::filesystem::path> foldersAfter(const std::filesystem::path& own) const;
  enum class Kept { kWhole, kNowhere, kUnreadable };
  // Without a wanted folder it is the first of foldersAfter() that takes it. Unless it was kept,
  // whyNotKept_ says why.
  Kept keepElsewhere(PalpateWriter& part,
                     const std::string& why,
                     RoundTime time,
                     const std::optional<std::filesystem::path>& wanted);
  bool goesOnAnew(std::unique_ptr<PalpateWriter>& part, const std::string& why, RoundTime time);
  void noteRelocation(std::string text, RoundTime time);
  void leaveFolder(const std::filesystem::path& folder);
  void noteFinished(const std::filesystem::path& path);
  void write(const CaptureItem& item, RoundTime time);
  void writeTo(const CaptureItem& item);
  void append(PalpateWriter& writer, const CaptureItem& item) const;
  void learnSeries();
  bool isRemoved(std::size_t index) const;
  std::vector<RecordedSeries> recordedSeries() const;
  std::int64_t lostByQueues() const;
  void keepUncommitted(const CaptureItem& item);
  void replace(std::unique_ptr<PalpateWriter>& part);
  void recordLoss(const CaptureItem& item);
  void endLossIntervals();
  void endLossInterval(std::size_t stream);
  void addOwn(Event event);
  void addOpenGaps(RoundTime time);
  void writePendingEvents();
  void updateCounters(RoundTime time);
  void commit(RoundTime time);
  void commitWriter();
  void onCommitFailed(const std::string& what, RoundTime time);
  void onCommitSucceeded(RoundTime time);
  std::int64_t bytesOnDisk() const;
  std::int64_t framesOnDisk() const;
  std::vector<const PalpateWriter*> vanishing() const;
  std::string abandonedText() const;
  void lookAfterMcap(RoundTime time);

  const RecordingOptions options_;
  const std::int64_t commitIntervalUs_;
  const std::string vfs_;
  const std::vector<std::filesystem::path> emergencyFolders_;
  const std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> freeBytes_;
  RoundTime start_;
  const Clock& clock_;
  const Notice notice_;
  // The path of the first part, or that of the first one in another folder.
  std::filesystem::path base_;
  std::filesystem::path folder_;

  // Contact.
  std::optional<ContactTrigger> contact_;
  bool armed_ = false;              // waits for contact
  std::deque<CaptureItem> before_;  // items of the time before it

  // Parts.
  std::vector<std::filesystem::path> paths_;
  int nextPart_ = 1;
  std::unique_ptr<PalpateWriter> writer_;
  std::unique_ptr<PalpateWriter> closing_;  // previous part while it can't be finished
  std::shared_ptr<const SensorLayout> layout_;
  std::shared_ptr<const SensorLayout> closingLayout_;
  std::int64_t partFirstUs_ = 0;
  std::int64_t committedUs_ = 0;  // stamp of the last frame that a commit took
  bool partHasFrames_ = false;
  std::vector<std::pair<std::filesystem::path, FileId>> finished_;
  std::int64_t framesInOldParts_ = 0;
  std::int64_t bytesInOldParts_ = 0;
  std::deque<CaptureItem> held_;  // items that wait for a file
  bool frameHeld_ = false;

  // The MCAP file beside it.
  std::unique_ptr<McapMirror> mcap_;
  std::string mcapFailure_;

  // Items that wait for a commit, for a part in another folder: of the open part and of the
  // previous one. After very long failures the oldest are missing.
  std::deque<CaptureItem> uncommitted_;
  std::deque<CaptureItem> uncommittedBefore_;
  std::optional<CaptureLoss> forgottenFrames_;
  // Why and where a part went on under another name; empty: none did.
  std::string relocation_;
  std::string whyNotKept_;  // at the last attempt
  std::int64_t nextRelocationMonoUs_ = 0;
  std::int64_t restUs_ = 0;        // after the last one; 0: there was none for long
  int relocationsHere_ = 0;        // in a row into the folder in which it was
  bool relocationFailed_ = false;  // the last one
  bool finishing_ = false;
  bool gapsTaken_ = false;  // RecordingOptions::openGaps
  // Parts that were left unfinished in another folder.
  std::vector<std::filesystem::path> abandoned_;

  // Items that wait for a commit.
  std::optional<std::int64_t> dirtySinceMonoUs_;
  std::size_t dirtyItems_ = 0;
  std::vector<Event> unwrittenEvents_;  // own events that are not written yet
  std::optional<std::int64_t> countersMonoUs_;
  std::map<std::string, std::int64_t> lastCounters_;

  // Failures.
  std::string error_;  // last error of the disk; empty while writing works
  std::optional<RoundTime> failingSince_;
  std::int64_t nextTryMonoUs_ = 0;
  std::array<std::optional<CaptureLoss>, kCaptureStreams> losses_;
  std::string refusedWhy_;
  bool unfinished_ = false;

  // Counts.
  IntervalStatistics intervals_;
  std::int64_t framesSinceStart_ = 0;
  std::optional<std::int64_t> endUs_;  // the recording ends before this stamp
  bool ended_ = false;
  RecordingReport counts_;
  QueueLosses lostInQueues_{};

  // Series beside those of the hand. All parts have those that are known, in the same order: a file
  // counts them in the order in which their columns became known.
  struct FurtherSeries {
    SeriesDescription description;
    std::optional<std::size_t> indexInFile;  // empty: its columns are not known yet
    std::int64_t samples = 0;
    std::int64_t lost = 0;  // by the disk
    std::int64_t firstUs = 0;
    std::int64_t lastUs = 0;
  };
  std::vector<FurtherSeries> further_;  // from kHandSeries on
  std::vector<std::size_t> inFile_;     // which of them are in the files, in their order
};

}  // namespace palpate
