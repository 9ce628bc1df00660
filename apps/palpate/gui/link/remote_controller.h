// Carries out remote control in the window: a recording that others start is the window's own,
// seen, marked and stopped like one by the button, under the names and in the folder that the
// operator chose.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/interop/remote_fields.h>
#include <palpate/interop/remote_protocol.h>

#include "gui/source/live_controller.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

class RemoteController : public QObject, public RemoteTarget {
  Q_OBJECT
 public:
  // Both must outlive it. `settings`: those of the window now; asked on its thread.
  RemoteController(LiveController& live,
                   std::function<RecordingSettings()> settings,
                   QObject* parent = nullptr);
  // Tests hand in shorter ones.
  void setLimits(const StartLimits& limits) { limits_ = limits; }

  // On the server's thread: hands it to the window's.
  void carryOut(const RemoteRequest& request, Done done) override;

 private:
  // What goes wrong in the worker, in the words of remote control.
  struct Problem {
    std::string code = "folder";
  };
  struct Starting {
    Done done;
    std::shared_ptr<Problem> problem;
    std::optional<std::chrono::steady_clock::time_point> begun;  // frames may come to it
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
  std::map<std::string, std::string> meta_;  // that was set from outside
  QString nameTemplate_;                     // the same; empty: the window's
  std::optional<Starting> starting_;
  std::vector<Done> stopping_;  // who waits for the end
  QTimer timer_;                // while a start is waited for
};

}  // namespace palpate::gui
