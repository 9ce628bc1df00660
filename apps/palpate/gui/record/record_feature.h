// The feature that records the connected source: starts and stops recordings, sets marks, offers to
// open the result, and offers to recover recordings that were never finished.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gui/record/record_actions.h"
#include "gui/record/recovery_finder.h"
#include "gui/source/recording_settings.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

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
