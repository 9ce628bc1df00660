// The main window's Calibrate dock: what it is told of the recording that is shown, and what it does to the window.
#pragma once

#include <QPointer>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_reader.h>
#include <palpate/filter/recipe.h>
#include <palpate/recording/recording_event.h>

#include "gui/bench/event_marks.h"
#include "gui/calibrate/applied_calibration.h"
#include "gui/shell/main_window.h"

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
  // The loading steps that were found in the recording that is shown, among its events.
  void addSteps(std::vector<EventMark>& marks) const;
  // main_window_pressure.cpp: pressures and forces beside the counts, of a recording or live
  void showLive(const LiveResults& results);
  const QString& text() const noexcept { return text_; }  // what values are told in
  void leave();  // the window goes: what is at work ends, while all it needs is there

 private:
  void followEvents();
  void tellKept();
  void connectPressures();
  void renewPressures();
  void renewLive(const QString& path);
  void renewRecording(const QString& path);
  void showFrame();
  void showForces(const std::shared_ptr<const PressureFrame>& pressure);
  void applied();
  void filterGhosts(bool on);
  // Instead of those of its kind that are there; nothing: only takes these away.
  void keep(const std::string& kind,
            const std::optional<RecordingEvent>& event,
            const QString& name);
  void zoomTo(double fromS, double toS);

  MainWindow& window_;
  CalibratePanel* panel_;
  Dock* dock_;
  QPointer<EventEditor> followed_;
  KeptWithRecording kept_;
  QString text_ = "none: values are counts";
  std::unique_ptr<PressureReader> reader_;  // of the recording that is shown; null: no pressures
  struct Told {
    const void* of = nullptr;  // recording or live source
    QString path;              // of the calibration
    KeptWithRecording kept;
    bool operator==(const Told&) const = default;
  };
  std::optional<Told> told_;  // what the pressures that are shown are of
  struct Filters {
    Recipe recipe;
    bool on = false;
  };
  std::optional<Filters> filtersBefore_;  // high sensitivity began
};

}  // namespace palpate::gui
