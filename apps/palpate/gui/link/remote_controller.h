// Carries out remote-control requests in the window. A recording that another program starts is a
// normal recording of the window: it is shown, marked and stopped in the same way, with the
// operator's names and folder.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/interop/remote_fields.h>
#include <palpate/interop/remote_protocol.h>
#include <palpate/recording/recording_data.h>

#include "gui/source/live_controller.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

class RemoteController : public QObject, public RemoteTarget {
  Q_OBJECT
 public:
  // `live` must outlive this. `settings` returns the window's present settings; it is called in the
  // window's thread.
  RemoteController(LiveController& live,
                   std::function<RecordingSettings()> settings,
                   QObject* parent = nullptr);
  // Tests set shorter limits.
  void setLimits(const StartLimits& limits) { limits_ = limits; }

  // Called in the server's thread; passes the request on to the window's thread.
  void carryOut(const RemoteRequest& request, Done done) override;

 private:
  // The error code of remote control for a failure in the worker.
  struct Problem {
    std::string code = "folder";
  };
  struct Starting {
    Done done;
    std::shared_ptr<Problem> problem;
    // When the recording began; from then on frames can be written.
    std::optional<std::chrono::steady_clock::time_point> begun;
  };

  void handle(const RemoteRequest& request, const Done& done);
  void start(const std::string& name, const Done& done);
  void stop(const Done& done);
  void note(const std::string& text, const Done& done);
  void answerWithNames(RemoteAnswer answer, const Done& done) const;
  RemoteAnswer status() const;
  RecordingSettings settingsNow() const;
  void look();
  void failStart(const std::string& code, const std::string& message);

  LiveController& live_;
  const std::function<RecordingSettings()> settings_;
  StartLimits limits_;
  // Recording details that were set by remote control.
  RecordingMeta meta_;
  // Name template set by remote control; empty: the window's own.
  QString nameTemplate_;
  std::optional<Starting> starting_;
  // Requests that wait for the end of the recording.
  std::vector<Done> stopping_;
  // Runs while a start request waits for its answer.
  QTimer timer_;
};

}  // namespace palpate::gui
