#include "gui/source/live_controller.h"

#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/time.h>

namespace palpate::gui {
namespace {

// Refresh period of the screen [ms].
constexpr int kLiveControllerRefreshMs = 16;
constexpr int kLiveControllerLookMs = 250;
constexpr int kLooksPerCheck = 4;

// The folder, or its nearest parent that exists: the free space of that disk is examined.
std::filesystem::path existingPartOf(std::filesystem::path folder) {
  std::error_code ignored;
  while (!folder.empty() && folder != folder.root_path() &&
         !std::filesystem::is_directory(folder, ignored))
    folder = folder.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

// A port that ended in order, as that of a replay, is not gone.
bool isPortGone(PortState state) {
  return state == PortState::kLost || state == PortState::kConnecting || state == PortState::kFault;
}

}  // namespace

LiveController::LiveController(std::filesystem::path dataFolder, QObject* parent)
    : QObject(parent), dataFolder_(std::move(dataFolder)) {
  worker_.setMaxThreadCount(1);
  refreshTimer_.setInterval(kLiveControllerRefreshMs);
  refreshTimer_.setTimerType(Qt::PreciseTimer);
  lookTimer_.setInterval(kLiveControllerLookMs);
  connect(&refreshTimer_, &QTimer::timeout, this, &LiveController::refresh);
  connect(&lookTimer_, &QTimer::timeout, this, &LiveController::refreshHealth);
}

LiveController::~LiveController() {
  blockSignals(true);
  if (cancelled_) *cancelled_ = true;
  source_.reset();
  worker_.waitForDone();
}

void LiveController::inWorker(std::function<void()> work) { worker_.start(std::move(work)); }

void LiveController::setState(State state) {
  if (state == state_) return;
  state_ = state;
  emit stateChanged();
}

void LiveController::stopMotion() {
  if (source_ && source_->control && source_->control->status().phase != GraspPhase::kIdle)
    source_->control->stop();
}

void LiveController::release() {
  ++generation_;
  if (cancelled_) *cancelled_ = true;
  refreshTimer_.stop();
  lookTimer_.stop();
  beforeRun_.reset();
  check_.abandon();
  if (!source_) return;
  // Even while the worker is busy.
  stopMotion();
  emit leaving();
  const bool recorded = recording_;
  recording_ = stopping_ = false;
  ++pending_;
  inWorker([this, recorded, source = std::move(source_)]() mutable {
    // Destroying the control stops every motion; that comes first.
    source->control.reset();
    source->session->stop();
    const RecordingReport report = recorded ? source->session->stopRecording() : RecordingReport{};
    source.reset();
    QMetaObject::invokeMethod(
        this,
        [this, recorded, report] {
          --pending_;
          if (recorded) emit recordingEnded(report);
          if (state_ != State::kEnding || pending_ > 0) return;
          setState(State::kNone);
          emit ended();
        },
        Qt::QueuedConnection);
  });
  source_.reset();
}

void LiveController::connectTo(const Connection& connection) {
  release();
  connection_ = connection;
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  setState(State::kConnecting);
  ++pending_;
  inWorker([this, connection, cancelled = cancelled_, generation = generation_] {
    std::shared_ptr<LiveSource> source;
    QString error;
    try {
      source = openSource(connection, dataFolder_, [&](double) { return !*cancelled; });
    } catch (const Cancelled&) {
    } catch (const std::exception& failure) {
      error = QString::fromUtf8(failure.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, source, generation, error] { opened(source, generation, error); },
        Qt::QueuedConnection);
  });
}

void LiveController::opened(std::shared_ptr<LiveSource> source,
                            std::uint64_t generation,
                            const QString& error) {
  --pending_;
  // The connection was cancelled, or another one was requested meanwhile.
  if (generation != generation_) {
    if (source) {
      ++pending_;
      inWorker([this, source = std::move(source)]() mutable {
        source.reset();
        QMetaObject::invokeMethod(this, [this] {
          if (--pending_ > 0 || state_ != State::kEnding) return;
          setState(State::kNone);
          emit ended();
        });
      });
    } else if (pending_ == 0 && state_ == State::kEnding) {
      setState(State::kNone);
      emit ended();
    }
    return;
  }
  if (!source) {
    setState(State::kNone);
    if (!error.isEmpty()) emit failed(error);
    emit ended();
    return;
  }
  source_ = std::move(source);
  stale_ = true;
  framesCame_ = false;
  lastFrameUs_ = systemClock().monotonicUs();
  looks_ = 0;
  health_ = source_->session->health();
  refreshTimer_.start();
  lookTimer_.start();
  setState(State::kConnected);
  emit sourceOpened();
  if (source_) emit sourceReady();
  emit staleChanged(true);
  refreshHealth();
}

void LiveController::end() {
  if (state_ == State::kNone || state_ == State::kEnding) return;
  release();
  setState(State::kEnding);
  if (pending_ > 0) return;
  setState(State::kNone);
  emit ended();
}

double LiveController::silentS() const {
  return static_cast<double>(systemClock().monotonicUs() - lastFrameUs_) / kUsPerS;
}

void LiveController::refresh() {
  if (!source_) return;
  const SharedFrame frame = source_->session->takeFrame();
  const std::int64_t nowUs = systemClock().monotonicUs();
  if (frame) {
    lastFrameUs_ = nowUs;
    framesCame_ = true;
  }
  const bool stale = !framesCame_ || nowUs - lastFrameUs_ > kStaleMs * kUsPerMs ||
                     isPortGone(source_->session->device().status().tactile.state);
  if (stale != stale_) {
    stale_ = stale;
    emit staleChanged(stale);
    // What is said of the link changes with the picture. The looks of the timer are not counted
    // faster by this.
    const int looks = looks_;
    refreshHealth();
    if (!source_) return;
    looks_ = looks;
  }
  if (frame) emit frameReceived(*frame);
  // A slot of the signals above may have closed the connection.
  if (!source_) return;
  if (const auto results = source_->chain->take()) emit resultsReceived(*results);
}

void LiveController::refreshHealth() {
  if (!source_) return;
  health_ = source_->session->health();
  const auto events = source_->session->takeEvents();
  // What the last check found isn't true any more when a port has gone or is back.
  const bool changed = portsChanged();
  if (looks_++ % kLooksPerCheck == 0 || changed) check();
  if (!events.empty()) emit eventsReceived(events);
  emit refreshed();
  // The recording stopped by itself: at a limit, or at the end of its source.
  if (recording_ && !stopping_ && source_ && looks_ > 1 && !source_->session->recording())
    stopRecording();
}

bool LiveController::portsChanged() {
  const auto& motion = health_.device.motion;
  const std::pair now(health_.device.tactile.state, motion ? motion->state : PortState::kClosed);
  motionGone_ = motion && isPortGone(now.second);
  return std::exchange(portStates_, now) != now;
}

void LiveController::check() {
  // A folder that doesn't answer is asked once, and delays no other.
  if (check_.busy() && checked_ == folder_) return;
  checked_ = folder_;
  check_.start(
      [this, folder = folder_, look = lookAtFolder](
          const Abandonable::Asker&) -> Abandonable::Take {
        const FolderState state = look(existingPartOf(folder));
        return [this, state] {
          if (source_) beforeRun_ = source_->session->checkPreflight(state);
        };
      },
      [](const QString&) {});
}

void LiveController::startRecording(std::function<RecordingOptions()> make) {
  if (!source_ || recording_) return;
  recording_ = true;
  // refreshHealth() must not take the recording for ended before it has begun.
  looks_ = 0;
  emit stateChanged();
  inWorker([this, make = std::move(make), source = source_, generation = generation_] {
    QString error;
    try {
      RecordingOptions options = make();
      if (source->emulated)
        options.meta["emulated"] = sceneTitle(source->connection.scene).toStdString();
      source->session->startRecording(std::move(options));
    } catch (const std::exception& failure) {
      error = QString::fromUtf8(failure.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, error, generation] {
          if (generation != generation_) return;
          if (error.isEmpty()) {
            refreshHealth();
            emit recordingStarted();
          } else {
            recording_ = false;
            emit stateChanged();
            emit recordingFailed(error);
          }
        },
        Qt::QueuedConnection);
  });
}

void LiveController::continueRecordingIn(const std::filesystem::path& folder) {
  if (!source_ || !recording_) return;
  inWorker([this, folder, source = source_, generation = generation_] {
    try {
      source->session->continueRecordingIn(folder);
      // The folder that can't be written isn't checked meanwhile.
      QMetaObject::invokeMethod(
          this,
          [this, folder, generation] {
            if (generation != generation_ || !recording_) return;
            folder_ = folder;
            check();
          },
          Qt::QueuedConnection);
    } catch (const std::exception& failure) {
      const QString error = QString::fromUtf8(failure.what());
      QMetaObject::invokeMethod(
          this, [this, error] { emit failed(error); }, Qt::QueuedConnection);
    }
  });
}

void LiveController::stopRecording() {
  if (!source_ || !recording_ || stopping_) return;
  stopping_ = true;
  inWorker([this, source = source_, generation = generation_] {
    const RecordingReport report = source->session->stopRecording();
    QMetaObject::invokeMethod(
        this,
        [this, report, generation] {
          // release() reports this recording.
          if (generation != generation_) return;
          recording_ = stopping_ = false;
          refreshHealth();
          emit stateChanged();
          emit recordingEnded(report);
        },
        Qt::QueuedConnection);
  });
}

void LiveController::changeSensors(std::function<void(CaptureSession&)> change,
                                   std::function<void()> done) {
  if (!source_) return;
  inWorker([this,
            change = std::move(change),
            done = std::move(done),
            source = source_,
            generation = generation_] {
    QString error;
    try {
      change(*source->session);
    } catch (const std::exception& failure) {
      error = QString::fromUtf8(failure.what()).simplified();
    }
    QMetaObject::invokeMethod(
        this,
        [this, error, generation, done] {
          if (generation != generation_) return;
          refreshHealth();
          if (error.isEmpty())
            done();
          else
            emit sensorsFailed(error);
        },
        Qt::QueuedConnection);
  });
}

void LiveController::mark(const QString& text, std::optional<int> digit) {
  if (source_) source_->session->mark(text.toStdString(), digit);
}

}  // namespace palpate::gui
