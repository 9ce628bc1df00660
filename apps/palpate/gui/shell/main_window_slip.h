// The main window's Slip dock: whose slip it shows, what of it stands in the timeline and in the hand in space.
#pragma once

#include <vector>

#include "gui/bench/event_marks.h"
#include "gui/shell/main_window.h"

namespace palpate::gui {

class SlipPanel;

class MainWindow::SlipView : public QObject {
 public:
  // Adds the dock to the window's.
  explicit SlipView(MainWindow& window);
  void place();       // where it is by default, hidden
  void connectAll();  // once all parts are there
  void show();        // another recording, another look
  void makeRoomFor(const Dock* asked);
  bool cancel();
  ExportedView exported();
  // The slips that were found in the recording that is shown, among its events.
  void addSlips(std::vector<EventMark>& marks) const;
  void showLive(const LiveResults& results);
  void renewHand(const HandDescription& hand);  // other taxels are scanned
  void leave();                                 // the window goes

 private:
  void showArrows();
  void tellStage();

  MainWindow& window_;
  SlipPanel* panel_;
  Dock* dock_;
  const void* liveOf_ = nullptr;  // the source that the panel was told of
};

}  // namespace palpate::gui
