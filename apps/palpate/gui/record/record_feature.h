// The feature that records the connected source: starts and stops recordings, also after a
// countdown, sets marks, offers to open, rename or discard the result, follows a plan of
// recordings, and offers to recover recordings that were never finished.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QElapsedTimer>
#include <QList>
#include <filesystem>
#include <optional>
#include <vector>

#include "gui/record/plan_controller.h"
#include "gui/record/recorded_take.h"
#include "gui/record/recording_countdown.h"
#include "gui/record/recovery_finder.h"
#include "gui/source/recording_settings.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that record and mark.
struct RecordActions {
  explicit RecordActions(ActionRegistry& book);

  QAction* record = nullptr;
  QAction* recordingSettings = nullptr;
  // Opens the last recording that was made.
  QAction* openRecorded = nullptr;
  // Opens the plan of recordings.
  QAction* recordingPlan = nullptr;
  QAction* renameRecorded = nullptr;
  QAction* discardRecorded = nullptr;
  QAction* mark = nullptr;
  // For the digit keys 0..9.
  QList<QAction*> labels;
};

class CountdownStrip;
class OfferStrip;
class PlanDialog;

class RecordFeature : public Feature {
  Q_OBJECT
 public:
  RecordFeature(WindowState& windowState, QWidget* window);
  ~RecordFeature() override;

  PlanController& plan() noexcept { return plan_; }
  RecordedTake& lastTake() noexcept { return take_; }
  RecordingCountdown& countdown() noexcept { return countdown_; }
  RecoveryFinder& unfinished() noexcept { return unfinished_; }
  // Searches for recordings that were never finished, and offers to recover them.
  void offerUnfinished();
  std::vector<BannerSpec> strips() override;
  void start() override;
  void remember() override;
  void settle() override;

 private:
  void connectActions();
  void connectRecorder();
  void connectUnfinished();
  void connectTake();
  void connectCountdown();
  void connectPlan();
  void tellPlan();
  void showPlan();
  void addKeysToPlan();
  // Asks about a take that is to be decided, in the line above the views or that of the plan.
  void askAbout(const std::filesystem::path& file, OfferStrip& line);
  void askInPlan();
  bool escape();
  void use(const RecordingSettings& settings);
  void takeFolder();
  void toggle();
  // Asks whether a plan of another session or hand is still followed. False: nothing is recorded.
  bool isPlanSure();
  void offerAnotherFolder();
  // `counted`: the settings when the countdown began; `planned`: they were those of a planned take.
  void begin(const RecordingSettings& counted, bool planned);
  void mark(const QString& label, std::optional<int> digit);
  void showState();
  void showCountdown();
  void offer(const RecordingReport& report);
  void offerTake(const QString& text);
  void dismissTake();

  RecordActions actions_;
  OfferStrip* offer_;
  // A recording that waits for the disk was seen, and another folder offered.
  bool waitsForDisk_ = false;
  // False once something was announced that closes the window.
  bool offering_ = true;
  RecordingSettings settings_;
  PlanController plan_;
  // Made when it is asked for.
  PlanDialog* planDialog_ = nullptr;
  // The take about which the plan asks.
  std::optional<std::filesystem::path> askedInPlan_;
  // The planned take whose problem the line above the views tells.
  std::optional<std::filesystem::path> doubted_;
  RecordedTake take_;
  // What the line about it says.
  QString takeText_;
  RecordingCountdown countdown_{this};
  CountdownStrip* countdownStrip_;
  // The take of the plan that it counts down to; empty: of no plan.
  QString countedTake_;
  // The recording that runs was begun as a take of the plan.
  bool isPlanned_ = false;
  // When Escape cancelled the countdown; it then does nothing else.
  QElapsedTimer escaped_;
  RecoveryFinder unfinished_;
  // Files of the running recovery.
  std::vector<std::filesystem::path> recovered_;
  // How much the last one of them holds.
  QString recoveredText_;
};

}  // namespace palpate::gui
