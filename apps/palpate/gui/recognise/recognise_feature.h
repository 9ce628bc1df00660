// The dock Recognise: what it is asked about (the selection, what is held), the answer on the whole
// screen, and the zero of the empty hand.
#pragma once

#include <QPointer>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/control/empty_hand_cycle.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/grasp_collector.h>

#include "gui/recognise/recognise_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class RecognisePanel;
class PresentationWindow;

class RecogniseFeature : public Feature {
  Q_OBJECT
 public:
  RecogniseFeature(WindowState& windowState, QWidget* window);
  ~RecogniseFeature() override;

  RecognisePanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  void settle() override;

 private:
  void connectAll();
  void renew();  // another recording, another look
  void ask();
  void askOfRecording();
  void askOfHand();
  void listen(bool on);
  // Takes in what has come from the hand since the last time; asks nothing.
  void takeItems();
  // A round: takes in what has come, goes on with a zero, and asks by itself where that is wanted.
  void readLiveGrasps();
  void showFull();
  void takeEnded(Profile grasp);
  // The zero of the empty hand: close until the pads touch, hold, open.
  void beginZero();
  void goOnWithZero();
  void cancelZero();
  void sayNoZero(const std::string& why);
  // A grasp of a recording that may have to be opened first.
  void showGrasp(const std::filesystem::path& file, std::size_t begin, std::size_t end);
  void showWanted();
  bool cancel();

  RecogniseActions actions_;
  RecognisePanel* panel_;
  Dock* dock_;
  QPointer<PresentationWindow> full_;
  // Of what is connected.
  std::shared_ptr<CaptureQueue> queue_;
  std::unique_ptr<GraspCollector> collector_;
  std::vector<CaptureItem> items_;
  std::optional<Profile> lastGrasp_;
  QTimer liveTimer_;
  int sinceAsked_ = 0;                       // rounds
  std::unique_ptr<EmptyHandCycle> zeroRun_;  // null: what is connected can't be moved
  std::optional<EmptyHandZero> zero_;        // of today
  struct Wanted {
    std::filesystem::path file;
    std::size_t begin = 0, end = 0;
  };
  std::optional<Wanted> wanted_;
};

}  // namespace palpate::gui
