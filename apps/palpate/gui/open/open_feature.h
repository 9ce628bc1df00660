// The feature that opens recordings: start page, menus, drag and drop, and the handling of each
// recording that was opened.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/open/thumbnails.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that open, close and switch between recordings.
struct OpenActions {
  explicit OpenActions(ActionRegistry& book);

  QAction* open = nullptr;
  QAction* openDemo = nullptr;
  QAction* nextRecording = nullptr;
  QAction* previousRecording = nullptr;
  QAction* closeRecording = nullptr;
};

class OpeningStrip;
class StartPage;

class OpenFeature : public Feature {
  Q_OBJECT
 public:
  OpenFeature(WindowState& windowState, QWidget* window);

  std::vector<CentralViewSpec> centre() override;
  std::vector<BannerSpec> strips() override;
  void start() override;
  void remember() override;

 protected:
  // Handles files that are dragged over the window.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void connectOpener();
  void connectActions();
  void connectStartPage();
  void showLastConnection();
  // Keeps the picture of a recording for the start page, once it has been shown.
  void keepThumbnail(const OpenedRecordingPtr& recording);
  void openDemoRecording();
  void take(const OpenedRecordingPtr& recording, const OpenArrival& arrival);
  void listRecordings();
  void fillRecentMenu();
  void showNeighbour(int step);
  void closeCurrent();

  OpenActions actions_;
  Thumbnails thumbnails_;
  StartPage* startPage_;
  OpeningStrip* strip_;
};

}  // namespace palpate::gui
