#include "palpate/capture/recorder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "capture/recording_parts.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kIdleRound{100};  // without a recording
constexpr std::int64_t kShortestWaitUs = 5'000;
constexpr std::chrono::milliseconds kFinishRetry{100};
constexpr int kFinishAttempts = 20;  // 2 s
constexpr std::int64_t kClockJumpUs = 50'000;
// Stamps that differ from the clock by more than this belong to a replay.
constexpr std::int64_t kOtherTimeUs = 2'000'000;
constexpr std::int64_t kFreeBytesUs = 1'000'000;
constexpr std::int64_t kBlockedUs = 250'000;
constexpr std::size_t kMaxKept = 32'768;

void requireRecorder(bool right, const std::string& message) {
  if (!right) throw std::invalid_argument("Recorder: " + message);
}

CaptureQueueOptions feedFor(CaptureQueueOptions options) {
  if (options.wakeAtItems <= 1)
    options.wakeAtItems = std::max<std::size_t>(1, options.tactileItems / 2);
  return options;
}

}  // namespace

std::int64_t RecordingReport::counter(const std::string& name) const {
  const auto at = counters.find(name);
  return at == counters.end() ? 0 : at->second;
}

FrameLosses RecordingReport::losses() const {
  return {.lost = counter("lost"),
          .refused = counter("suspect"),
          .outOfRange = counter("out_of_range")};
}

struct Recorder::Impl {
  Impl(RecorderOptions given, const Clock& theClock)
      : options(std::move(given)), clock(theClock), queue("the recorder", feedFor(options.queue)) {
    requireRecorder(options.preTriggerS >= 0.0 && options.preTriggerS <= 60.0,
                    "preTriggerS must be 0..60");
    requireRecorder(options.commitIntervalMs >= 1.0 && options.commitIntervalMs <= 10'000.0,
                    "commitIntervalMs must be 1..10000");
    if (!options.freeBytes) options.freeBytes = freeBytesOf;
  }

  RoundTime now() const {
    const std::int64_t monoUs = clock.monotonicUs();
    return {monoUs, nowUs(), takenMonoUs.value_or(monoUs)};
  }

  std::int64_t nowUs() const { return otherTime.load() ? newestUs.load() : host->nowUs(); }

  // Lost in the queues since the start, by CaptureStream.
  QueueLosses lostInQueues() const {
    QueueLosses lost = queue.stats().lost;
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < lost.size(); ++i) lost[i] -= lostAtStart[i];
    return lost;
  }

  // Keeps the items of the last seconds, measured from the newest stamp.
  void keep(const CaptureItem& item) {
    if (!leavesRoom(item, kept.size(), kMaxKept)) return;
    kept.push_back(item);
    keptNewestUs = std::max(keptNewestUs, stampOf(item));
    const std::int64_t horizonUs =
        keptNewestUs - static_cast<std::int64_t>(std::llround(options.preTriggerS * 1e6));
    while (!kept.empty() && (stampOf(kept.front()) < horizonUs || kept.size() > kMaxKept))
      kept.pop_front();
  }

  void notify(const Event& event) const {
    if (options.notice) options.notice(event);
  }

  // Events of the recorder itself bypass its queue, because only the recorder makes room in it.
  void checkClock(std::vector<CaptureItem>& out) {
    const std::int64_t offsetUs = host->wallOffsetUs();
    if (std::abs(offsetUs - wallOffsetUs) <= kClockJumpUs) return;
    const double seconds = static_cast<double>(offsetUs - wallOffsetUs) / 1e6;
    wallOffsetUs = offsetUs;
    const std::int64_t atUs = nowUs();
    const Event event{atUs,
                      atUs,
                      "clock",
                      {},
                      "the wall clock moved by " + fixedText(seconds, 3) +
                          " s; time stamps continue without a jump",
                      Json::object().set("wall_offset_us", offsetUs).text(-1)};
    notify(event);
    out.emplace_back(event);
  }

  void beginWhenAsked() {
    std::optional<RecordingOptions> asked;
    RoundTime askedAt;
    {
      const std::lock_guard lock(mutex);
      std::swap(asked, request);
      askedAt = requestTime;
    }
    if (!asked) return;
    parts = std::make_unique<RecordingParts>(
        std::move(*asked), options, askedAt, clock, [this](const Event& event) { notify(event); });
    freeBytesMonoUs.reset();
    finishAttempts = 0;
    const RoundTime time = now();
    for (const CaptureItem& item : kept) parts->add(item, time);
  }

  void moveWhenAsked() {
    std::optional<fs::path> folder;
    {
      const std::lock_guard lock(mutex);
      std::swap(folder, folderRequest);
    }
    if (folder && parts) parts->continueIn(*folder, now());
    if (folder) freeBytesMonoUs.reset();
  }

  void handle(std::vector<CaptureItem>& taken) {
    const RoundTime time = now();
    for (const CaptureItem& item : taken) {
      if (parts) parts->add(item, time);
      keep(item);
    }
    taken.clear();
  }

  // One round; see step().
  void round() {
    roundBeganUs.store(clock.monotonicUs());
    bool stopping = false;
    {
      const std::lock_guard lock(mutex);
      stopping = stopRequested;
    }
    beginWhenAsked();
    moveWhenAsked();
    // Items that arrived during a slow write are as old as that write; so the time is taken again.
    const std::int64_t takingMonoUs = clock.monotonicUs();
    std::vector<Event> ownGaps;
    queue.take(items, &ownGaps);
    if (stopping) queue.takeOpenGaps(items, &ownGaps);
    for (const Event& gap : ownGaps) notify(gap);
    checkClock(items);
    handle(items);
    takenMonoUs = takingMonoUs;
    if (parts) {
      const RoundTime time = now();
      parts->noteQueueLosses(lostInQueues());
      parts->round(time);
      if (stopping || parts->ended(time)) finish(time, stopping);
    }
    publish();
    roundBeganUs.store(-1);
  }

  // Time until the next round: while recording, until the oldest item that may have come since the
  // last one is due on the disk.
  std::chrono::microseconds untilNextRound() const {
    if (finishing) return kFinishRetry;
    if (!parts || !takenMonoUs) return kIdleRound;
    const auto intervalUs = static_cast<std::int64_t>(options.commitIntervalMs * 1000.0);
    const std::int64_t oldestUs = parts->oldestUncommittedMonoUs().value_or(*takenMonoUs);
    return std::chrono::microseconds(std::clamp(oldestUs + intervalUs - clock.monotonicUs(),
                                                kShortestWaitUs,
                                                std::max(kShortestWaitUs, intervalUs)));
  }

  void finish(RoundTime time, bool stopping) {
    finishing = true;
    if (!parts->finish(time)) {
      if (!stopping && parts->waitsForDisk()) return;
      if (++finishAttempts < kFinishAttempts) return;
    }
    RecordingReport done = parts->report();
    parts.reset();  // tries again to commit
    end(std::move(done));
  }

  void giveUp(const std::string& why) {
    RecordingReport done;
    if (parts) done = parts->report();
    done.complete = false;
    done.message = why;
    parts.reset();
    end(std::move(done));
  }

  void end(RecordingReport done) {
    finishing = false;
    const std::lock_guard lock(mutex);
    report = std::move(done);
    request.reset();
    folderRequest.reset();
    stopRequested = false;
    active = false;
    stopped.notify_all();
  }

  void publish() {
    std::optional<std::uint64_t> freeNow;
    const std::int64_t monoUs = clock.monotonicUs();
    const bool ask = parts && (!freeBytesMonoUs || monoUs - *freeBytesMonoUs >= kFreeBytesUs);
    if (ask) {
      freeNow = options.freeBytes(parts->folder());
      freeBytesMonoUs = monoUs;
    }
    RecorderStatus next;
    if (parts) parts->describe(next);
    next.waitsForDisk = parts && finishing && parts->waitsForDisk();
    const std::lock_guard lock(mutex);
    // A contact began it later than it was asked for.
    if (parts) requestTime.monoUs = parts->startMonoUs();
    // Free space is not reported after the recording has ended.
    if (parts) next.freeBytes = ask ? freeNow : status.freeBytes;
    status = std::move(next);
  }

  RecorderOptions options;
  const Clock& clock;
  std::optional<HostTime> host{clock};  // as used for the stamps of a live hand
  CaptureQueue queue;
  std::atomic<bool> otherTime = false;          // stamps are not in the clock's time
  std::atomic<std::int64_t> newestUs = 0;       // stamp of the newest sample pushed
  std::atomic<std::int64_t> roundBeganUs = -1;  // monotonic; -1 between rounds

  // Used by the recorder's thread only.
  std::vector<CaptureItem> items;
  std::optional<std::int64_t> takenMonoUs;  // time at which the last round took its items
  std::deque<CaptureItem> kept;
  std::int64_t keptNewestUs = INT64_MIN;
  std::unique_ptr<RecordingParts> parts;
  std::int64_t wallOffsetUs = 0;
  std::optional<std::int64_t> freeBytesMonoUs;
  int finishAttempts = 0;
  std::atomic<bool> finishing = false;

  mutable std::mutex mutex;
  std::condition_variable stopped;
  std::optional<RecordingOptions> request;
  RoundTime requestTime;
  std::optional<fs::path> folderRequest;
  QueueLosses lostAtStart{};
  bool active = false;
  bool stopRequested = false;
  RecordingReport report;
  RecorderStatus status;

  std::jthread thread;
};

std::string RecordingReport::openGapText() const {
  return openGapS > 0.0 ? "no frame came in its last " + fixedText(openGapS, 1) + " s" : "";
}

Recorder::Recorder(RecorderOptions options, const Clock& clock)
    : impl_(std::make_unique<Impl>(std::move(options), clock)) {}

Recorder::~Recorder() {
  stop();
  halt();
}

void Recorder::run() {
  Impl& impl = *impl_;
  if (impl.thread.joinable()) return;
  impl.thread = std::jthread([&impl](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      impl.queue.wait(impl.untilNextRound(), stop);
      try {
        impl.round();
      } catch (const std::exception& error) {  // out of memory: committed data are safe
        impl.giveUp(error.what());
      } catch (...) {
        impl.giveUp("an unknown exception");
      }
    }
  });
}

void Recorder::halt() noexcept {
  if (!impl_->thread.joinable()) return;
  impl_->thread.request_stop();
  impl_->thread.join();
  impl_->thread = {};
}

void Recorder::step() {
  if (impl_->thread.joinable()) throw std::logic_error("Recorder: its thread makes the rounds");
  impl_->round();
}

void Recorder::nameSeries(std::vector<std::string> names) {
  impl_->queue.nameSeries(std::move(names));
}

bool Recorder::push(CaptureItem item) {
  if (const auto* frame = std::get_if<SharedFrame>(&item); frame && !*frame) return false;
  // Other series have the clock's time, whatever the hand has.
  if (streamOf(item) <= CaptureStream::kTemperatures) {
    const std::int64_t stampUs = stampOf(item);
    impl_->newestUs.store(stampUs);
    impl_->otherTime.store(std::abs(stampUs - impl_->host->nowUs()) > kOtherTimeUs);
  }
  return impl_->queue.put(std::move(item));
}

void Recorder::clearPreTrigger() {
  Impl& impl = *impl_;
  if (impl.thread.joinable() || recording())
    throw std::logic_error("Recorder: can't forget while it runs");
  impl.queue.take(impl.items);
  impl.queue.takeOpenGaps(impl.items);
  impl.items.clear();
  impl.kept.clear();
  impl.keptNewestUs = INT64_MIN;
  impl.newestUs.store(0);
  impl.otherTime.store(false);
  impl.host.emplace(impl.clock);
  impl.wallOffsetUs = 0;
}

void Recorder::start(RecordingOptions options) {
  options.validate();
  requireNewFile(options.path);
  if (options.mcap) requireNewFile(mcapPathOf(options.path));
  Impl& impl = *impl_;
  RoundTime time{impl.clock.monotonicUs(), impl.nowUs(), 0};
  // Before the first item the time of the stamps is unknown; every item counts as after the start
  // then.
  if (impl.newestUs.load() == 0) time.nowUs = INT64_MIN / 2;
  const QueueLosses lost = impl.queue.stats().lost;
  const std::lock_guard lock(impl.mutex);
  if (impl.active) throw std::logic_error("Recorder: already recording");
  impl.lostAtStart = lost;
  impl.active = true;
  const bool armed = options.startOnContact;
  impl.request = std::move(options);
  impl.requestTime = time;
  impl.report = {};
  impl.status = {};
  impl.status.state = armed ? RecorderStatus::State::kArmed : RecorderStatus::State::kWaiting;
  impl.queue.wake();
}

void Recorder::continueIn(const fs::path& folder) {
  requireWritableFolder(folder);
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->active) throw std::logic_error("Recorder: not recording");
  impl_->folderRequest = folder;
  impl_->queue.wake();
}

RecordingReport Recorder::stop() {
  Impl& impl = *impl_;
  std::unique_lock lock(impl.mutex);
  if (!impl.active) return impl.report;
  impl.stopRequested = true;
  lock.unlock();
  if (impl.thread.joinable()) {
    impl.queue.wake();
    lock.lock();
    impl.stopped.wait(lock, [&impl] { return !impl.active; });
    return impl.report;
  }
  while (recording()) impl.round();
  lock.lock();
  return impl.report;
}

bool Recorder::recording() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->active;
}

RecorderStatus Recorder::status() const {
  const Impl& impl = *impl_;
  const std::int64_t beganUs = impl.roundBeganUs.load();
  const std::int64_t monoUs = impl.clock.monotonicUs();
  const std::lock_guard lock(impl.mutex);
  RecorderStatus status = impl.status;
  if (impl.active) status.elapsedS = static_cast<double>(monoUs - impl.requestTime.monoUs) / 1e6;
  if (impl.active && beganUs >= 0 && monoUs - beganUs >= kBlockedUs)
    status.blockedS = static_cast<double>(monoUs - beganUs) / 1e6;
  return status;
}

CaptureQueueStats Recorder::queueStats() const { return impl_->queue.stats(); }

std::int64_t Recorder::nowUs() const { return impl_->nowUs(); }

}  // namespace palpate
