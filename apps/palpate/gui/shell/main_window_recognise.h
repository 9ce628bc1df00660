// The main window's Recognise dock: what it is asked about (the selection, what is held), and what it does to the window.
#pragma once

#include <QPointer>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/control/empty_hand_run.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/grasp_collector.h>

#include "gui/shell/main_window.h"

namespace palpate::gui {

class RecognisePanel;
class ShowWindow;

class MainWindow::RecogniseView : public QObject {
 public:
  // Adds the dock to the window's.
  RecogniseView(MainWindow& window, const std::filesystem::path& dataFolder);
  void place();       // where it is by default, hidden
  void connectAll();  // once all parts are there
  void show();        // another recording, another look
  bool cancel();
  ExportedView exported();
  void leave();  // the window goes

 private:
  void ask();
  void askOfRecording();
  void askOfHand();
  void listen(bool on);
  // Takes in what has come from the hand since the last time; asks nothing.
  void takeItems();
  // A round: takes in what has come, goes on with a zero, and asks by itself where that is wanted.
  void hear();
  void showFull();
  void makeRoom();
  void takeEnded(Profile grasp);
  // The zero of the empty hand: close until the pads touch, hold, open.
  void beginZero();
  void goOnWithZero();
  void giveUpZero();
  void sayNoZero(const std::string& why);
  // A grasp of a recording that may have to be opened first.
  void showGrasp(const std::filesystem::path& file, std::size_t begin, std::size_t end);
  void showWanted();

  MainWindow& window_;
  RecognisePanel* panel_;
  Dock* dock_;
  QPointer<ShowWindow> full_;
  // Of what is connected.
  std::shared_ptr<CaptureFeed> feed_;
  std::unique_ptr<GraspCollector> collector_;
  std::vector<CaptureItem> items_;
  std::optional<Profile> lastGrasp_;
  QTimer hearing_;
  int sinceAsked_ = 0;  // rounds
  std::unique_ptr<EmptyHandRun>
      zeroRun_;                        // of the source that is connected; null: it has no control
  std::optional<EmptyHandZero> zero_;  // of today
  struct Wanted {
    std::filesystem::path file;
    std::size_t begin = 0, end = 0;
  };
  std::optional<Wanted> wanted_;
};

}  // namespace palpate::gui
