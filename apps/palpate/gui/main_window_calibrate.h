// The main window's Calibrate dock: what it is told of the recording that is shown, and what it does to the window.
#pragma once

#include <QPointer>
#include <optional>
#include <string>

#include <palpate/recording/recording_event.h>

#include "gui/main_window.h"

namespace palpate::gui {

class CalibratePanel;

class MainWindow::CalibrateView : public QObject {
 public:
  // Adds the dock to the window's.
  explicit CalibrateView(MainWindow& window);
  void place();                         // where it is by default, hidden
  void connectAll();                    // once all parts are there
  void show();                          // another recording, another look
  void makeRoomFor(const Dock* asked);  // where it is this dock
  bool cancel();
  ExportedView exported();
  void leave();  // the window goes: what is at work ends, while all it needs is there

 private:
  void followEvents();
  void tellKept();
  // Instead of those of its kind that are there; nothing: only takes these away.
  void keep(const std::string& kind,
            const std::optional<RecordingEvent>& event,
            const QString& name);
  void zoomTo(double fromS, double toS);

  MainWindow& window_;
  CalibratePanel* panel_;
  Dock* dock_;
  QPointer<EventEditor> followed_;
};

}  // namespace palpate::gui
