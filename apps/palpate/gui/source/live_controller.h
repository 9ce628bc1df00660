// Opens, closes and monitors the live source of the window. Takes new frames and results once per
// refresh of the screen; a worker thread does what may take time (open, start and finish a
// recording, close), one task after the other.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/core/time.h>

#include "gui/source/abandonable.h"
#include "gui/source/live_source.h"

namespace palpate::gui {

class LiveController : public QObject {
  Q_OBJECT
 public:
  enum class State { kNone, kConnecting, kConnected, kEnding };
  // Without a frame for so long [ms], the picture is stale.
  static constexpr int kStaleMs = 400;

  explicit LiveController(std::filesystem::path dataFolder, QObject* parent = nullptr);
  // Closes the connection and waits until that is done; a running recording is finished.
  ~LiveController() override;

  // Closes the present connection first.
  void connectTo(const Connection& connection);
  // Closes the connection, or cancels one that is being opened. ended() follows when nothing is
  // connected any more.
  void end();
  // Stops a motion of the connected hand at once; the connection stays.
  void stopMotion();
  State state() const noexcept { return state_; }
  // The present connection, or the last one.
  const Connection& connection() const noexcept { return connection_; }
  // Null unless connected.
  LiveSource* source() noexcept { return source_.get(); }
  // The objects around an emulated hand; null for other hands.
  std::shared_ptr<const std::vector<SceneObject>> objects() const {
    return source_ ? source_->objects.load() : nullptr;
  }

  // Link health, updated four times a second.
  const LinkHealth& health() const noexcept { return health_; }
  // The newest frame is older than kStaleMs, or there is none, or its port is known to be gone.
  bool stale() const noexcept { return stale_; }
  // The motion port is known to be gone: joint angles and temperatures are old.
  bool motionGone() const noexcept { return motionGone_; }
  // Time since the newest frame arrived, or since connecting [s].
  double silentS() const;
  bool hasReceivedFrames() const noexcept { return framesCame_; }

  // True while a recording is requested, waits for a frame, runs, or is being finished.
  bool recording() const noexcept { return recording_; }
  // `make` is called in the worker thread, since it may search for a free name. What it throws is
  // reported by recordingFailed().
  void startRecording(std::function<RecordingOptions()> make);
  void stopRecording();
  // As CaptureSession::continueRecordingIn(); failed() reports what it throws. A stopRecording() or
  // end() after it comes after it in the worker, too.
  void continueRecordingIn(const std::filesystem::path& folder);
  void mark(const QString& text, std::optional<int> digit);
  // Adds or removes series of the connected session, in the worker, since it may wait for a port.
  // `done` follows, or sensorsFailed() with what `change` throws; neither when the connection has
  // ended meanwhile.
  void changeSensors(std::function<void(CaptureSession&)> change, std::function<void()> done);
  // Folder of future recordings; the preflight check examines it.
  void setFolder(const std::filesystem::path& folder) { folder_ = folder; }
  const std::optional<PreflightCheck>& preflight() const noexcept { return beforeRun_; }

  // How a folder is looked at, in another thread; tests supply their own.
  std::function<FolderState(const std::filesystem::path&)> lookAtFolder = folderStateOf;

  // Called by the timers; public for tests.
  void refresh();
  void refreshHealth();

 signals:
  void stateChanged();
  // source() is not null from now on: whatever needs it, Stop above all, takes it.
  void sourceOpened();
  // Everything has taken the new source: it is shown now.
  void sourceReady();
  // source() is about to become null: drop all references to it now.
  void leaving();
  // Nothing is connected, and nothing is being opened.
  void ended();
  void failed(const QString& message);
  void sensorsFailed(const QString& message);
  void frameReceived(const palpate::TactileFrame& frame);
  void resultsReceived(const palpate::LiveResults& results);
  void staleChanged(bool stale);
  void refreshed();
  void eventsReceived(const std::vector<palpate::Event>& events);
  // Frames are written to disk, from now on or from the first one that arrives.
  void recordingStarted();
  void recordingFailed(const QString& message);
  void recordingEnded(const palpate::RecordingReport& report);

 private:
  // Hands the source to the worker thread, which closes it.
  void release();
  void opened(std::shared_ptr<LiveSource> source, std::uint64_t generation, const QString& error);
  void setState(State state);
  void inWorker(std::function<void()> work);
  void check();
  bool portsChanged();

  const std::filesystem::path dataFolder_;
  Connection connection_;
  State state_ = State::kNone;
  std::shared_ptr<LiveSource> source_;
  // Counts the requested connections.
  std::uint64_t generation_ = 0;
  std::shared_ptr<std::atomic<bool>> cancelled_;
  QTimer refreshTimer_;
  QTimer lookTimer_;
  LinkHealth health_;
  bool stale_ = true;
  bool motionGone_ = false;
  // Of the tactile and the motion port, at the last look.
  std::pair<PortState, PortState> portStates_ = {PortState::kClosed, PortState::kClosed};
  bool framesCame_ = false;
  // Monotonic time at which the newest frame was taken [us].
  std::int64_t lastFrameUs_ = 0;
  bool recording_ = false;
  bool stopping_ = false;
  std::filesystem::path folder_;
  std::optional<PreflightCheck> beforeRun_;
  int looks_ = 0;
  // Number of tasks in the worker that open or close a source.
  int pending_ = 0;
  // The preflight check of `checked_`.
  Abandonable check_;
  std::filesystem::path checked_;
  // One thread: one task after the other.
  QThreadPool worker_;
};

}  // namespace palpate::gui
