// Recordings that are made of what is connected: start, stop, marks, what is offered afterwards,
// and what an earlier day left unfinished.
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
  // Looks for recordings that were never finished, and offers to recover them.
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
  bool offering_ = true;  // false: something that ends the window was announced
  RecordingSettings settings_;
  std::vector<std::filesystem::path> lastRecorded_;  // parts
  RecoveryFinder unfinished_;
  std::vector<std::filesystem::path> recovered_;  // files of the recovery that runs
};

}  // namespace palpate::gui
