// The feature that recovers damaged and unfinished recordings: a line that says what is missing of
// the displayed recording, and the action that saves what can be read as a new recording.
#pragma once

#include <QAction>
#include <filesystem>
#include <set>

#include "gui/source/background_job.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class OfferStrip;
class OpeningStrip;

class RecoveryFeature : public Feature {
  Q_OBJECT
 public:
  RecoveryFeature(WindowState& windowState, QWidget* window);

  std::vector<BannerSpec> strips() override;

 private:
  // What is missing of the displayed recording; empty: nothing that is known.
  QString damageOfDisplayed() const;
  void offer();
  void recoverChosen();
  void recover(const std::filesystem::path& path);

  QAction* recover_;
  OfferStrip* offer_;
  OpeningStrip* strip_;
  BackgroundJob job_;
  // Recordings whose line was closed.
  std::set<std::filesystem::path> declined_;
};

}  // namespace palpate::gui
