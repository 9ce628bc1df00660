// The feature that records the connected source: starts and stops recordings, sets marks, offers to
// open the result, and offers to recover recordings that were never finished.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <filesystem>
#include <optional>
#include <vector>

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
  QAction* mark = nullptr;
  // For the digit keys 0..9.
  QList<QAction*> labels;
};

class OfferStrip;

class RecordFeature : public Feature {
  Q_OBJECT
 public:
  RecordFeature(WindowState& windowState, QWidget* window);

  RecoveryFinder& unfinished() noexcept { return unfinished_; }
  // Searches for recordings that were never finished, and offers to recover them.
  void offerUnfinished();
  std::vector<BannerSpec> strips() override;
  void start() override;

 private:
  void connectActions();
  void connectRecorder();
  void connectUnfinished();
  void use(const RecordingSettings& settings);
  void takeFolder();
  void toggle();
  void mark(const QString& label, std::optional<int> digit);
  void showState();
  void offer(const RecordingReport& report);

  RecordActions actions_;
  OfferStrip* offer_;
  // False once something was announced that closes the window.
  bool offering_ = true;
  RecordingSettings settings_;
  // The files of the last recording, one for each part.
  std::vector<std::filesystem::path> lastRecorded_;
  RecoveryFinder unfinished_;
  // Files of the running recovery.
  std::vector<std::filesystem::path> recovered_;
};

}  // namespace palpate::gui
