// The feature with the dock Recognise: asks about the selection or the held object, shows answers
// on the full screen, and measures the zero of the empty hand.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <QPointer>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/control/empty_hand_cycle.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/grasp_collector.h>

#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions of recognition.
struct RecogniseActions {
  explicit RecogniseActions(ActionRegistry& book);

  // Recognises the selection, or what is held.
  QAction* whatIsIt = nullptr;
  // Shows the answer on the full screen.
  QAction* presentationMode = nullptr;
};

class RecognisePanel;
class PresentationWindow;

class RecogniseFeature : public Feature {
  Q_OBJECT
 public:
  RecogniseFeature(WindowState& windowState, QWidget* window);
  ~RecogniseFeature() override;

  RecognisePanel& panel() noexcept { return *panel_; }
  // Makes what is shown beside the answer on the whole screen; may be empty.
  std::function<QWidget*(QWidget* parent)> makeScene;
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  void settle() override;

 private:
  void connectAll();
  // Whether what is shown is an emulated hand, or was recorded of one.
  bool isOfEmulatedHand() const;
  // The source or the appearance has changed.
  void renew();
  void ask();
  void askOfRecording();
  void askOfHand();
  void listen(bool on);
  // Frames have ceased to arrive from the shown hand, or arrive again.
  void followSilence();
  // Why nothing arrives from the shown hand; empty: frames arrive, or no hand is shown. A replay
  // that has ended can still be asked about its last grasp.
  QString silence() const;
  // Processes the items that arrived from the hand since the last call, without asking a question.
  void takeItems();
  // Called by a timer: processes new items, continues a zero measurement, and asks repeatedly when
  // the user wants that.
  void readLiveGrasps();
  void showFull();
  void showWhyNoModel();
  void takeEnded(Profile grasp);
  // The zero of the empty hand: closes it until the pads touch, holds, opens.
  void beginZero();
  void goOnWithZero();
  void cancelZero();
  void sayNoZero(const std::string& why);
  // Shows a grasp; opens its recording first if necessary.
  void showGrasp(const std::filesystem::path& file, std::size_t begin, std::size_t end);
  void showWanted();
  bool cancel();

  RecogniseActions actions_;
  RecognisePanel* panel_;
  Dock* dock_;
  QPointer<PresentationWindow> full_;
  // The items of the connected hand.
  std::shared_ptr<CaptureQueue> queue_;
  std::unique_ptr<GraspCollector> collector_;
  std::vector<CaptureItem> items_;
  std::optional<Profile> lastGrasp_;
  QTimer liveTimer_;
  // The contact ended because no frames arrive.
  bool silent_ = false;
  // Calls of the timer since the last question.
  int sinceAsked_ = 0;
  // Null when the connected source cannot be moved.
  std::unique_ptr<EmptyHandCycle> zeroRun_;
  // The zero of the empty hand in this session.
  std::optional<EmptyHandZero> zero_;
  struct Wanted {
    std::filesystem::path file;
    std::size_t begin = 0, end = 0;
  };
  std::optional<Wanted> wanted_;
  // The source of which answers are shown; only compared.
  const void* answeredOf_ = nullptr;
};

}  // namespace palpate::gui
