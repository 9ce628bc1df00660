// Connects, ends and watches the live source of the window: pulls what is new once per refresh of
// the screen, and does what may take time (open, start and finish a recording, end) in a worker,
// one after the other.
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
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/core/time.h>

#include "gui/source/live_source.h"

namespace palpate::gui {

class LiveController : public QObject {
  Q_OBJECT
 public:
  enum class State { kNone, kConnecting, kConnected, kEnding };
  static constexpr int kStaleMs = 400;  // so long without a frame, and the picture is old

  explicit LiveController(std::filesystem::path dataFolder, QObject* parent = nullptr);
  // Ends what is connected and waits for that: a running recording is finished.
  ~LiveController() override;

  // Ends what is connected before.
  void connectTo(const Connection& connection);
  // Gives up a connection in the making, too. ended() follows when nothing is left.
  void end();
  State state() const noexcept { return state_; }
  const Connection& connection() const noexcept { return connection_; }  // the present or last one
  // Null unless connected.
  LiveSource* source() noexcept { return source_.get(); }

  // As the last look found it (four a second).
  const LinkHealth& health() const noexcept { return health_; }
  // The newest frame is older than kStaleMs, or there is none.
  bool stale() const noexcept { return stale_; }
  double silentS() const;  // since the newest frame came, or since connecting [s]
  bool hasReceivedFrames() const noexcept { return framesCame_; }

  // Asked for, waiting for a frame, running, or being finished.
  bool recording() const noexcept { return recording_; }
  // `make` is called in the worker: it may look for a free name. What it throws is told by
  // recordingFailed().
  void startRecording(std::function<RecordingOptions()> make);
  void stopRecording();
  void mark(const QString& text, std::optional<int> digit);
  // Where recordings will go: what the check before a run looks at.
  void setFolder(const std::filesystem::path& folder) { folder_ = folder; }
  const std::optional<PreflightCheck>& preflight() const noexcept { return beforeRun_; }

  // What the timers do.
  void refresh();
  void refreshHealth();

 signals:
  void stateChanged();
  void sourceOpened();  // source() is there
  void leaving();       // source() is about to go: let go of it now
  void ended();         // nothing is connected, and nothing is on its way
  void failed(const QString& message);
  void frameReceived(const palpate::TactileFrame& frame);
  void resultsReceived(const palpate::LiveResults& results);
  void staleChanged(bool stale);
  void refreshed();
  void eventsReceived(const std::vector<palpate::RecordingEvent>& events);
  void recordingStarted();  // frames go to disk, or will with the first one
  void recordingFailed(const QString& message);
  void recordingEnded(const palpate::RecordingReport& report);

 private:
  void release();  // hands the source to the worker, which ends it
  void opened(std::shared_ptr<LiveSource> source, std::uint64_t generation, const QString& error);
  void setState(State state);
  void inWorker(std::function<void()> work);
  void check();

  const std::filesystem::path dataFolder_;
  Connection connection_;
  State state_ = State::kNone;
  std::shared_ptr<LiveSource> source_;
  std::uint64_t generation_ = 0;  // of connections asked for
  std::shared_ptr<std::atomic<bool>> cancelled_;
  QTimer refreshTimer_;
  QTimer lookTimer_;
  LinkHealth health_;
  bool stale_ = true;
  bool framesCame_ = false;
  std::int64_t lastFrameUs_ = 0;  // monotonic time when it was taken [us]
  bool recording_ = false;
  bool stopping_ = false;
  std::filesystem::path folder_;
  std::optional<PreflightCheck> beforeRun_;
  bool checking_ = false;
  int looks_ = 0;
  int pending_ = 0;      // work in the worker that ends or opens a source
  QThreadPool checker_;  // a folder that hangs holds up nothing but its own check
  QThreadPool worker_;   // one thread: one thing after the other
};

}  // namespace palpate::gui
