// Menus and combo boxes of the window that features fill or also open elsewhere.
#pragma once

class QAction;
class QComboBox;
class QMenu;

namespace palpate::gui {

struct Menus {
  // Menu Edit; also the context menu of the timeline.
  QMenu* edit = nullptr;
  // Menu of the button Connect.
  QMenu* connections = nullptr;
  // Shows only one matrix in the hand in 3-D.
  QMenu* only = nullptr;
  // Which taxels are scanned; also the context menu of the matrices.
  QMenu* scanned = nullptr;
  // Files that were opened last.
  QMenu* recent = nullptr;
  // The presets; also the menu of a button in the tool bar.
  QMenu* layout = nullptr;
  // Speeds in the toolbar; the index is that of PlaybackController::kSpeeds.
  QComboBox* speed = nullptr;
  // The open recordings.
  QComboBox* recordings = nullptr;
  // Shows and hides the box of open recordings.
  QAction* recordingsShown = nullptr;
};

}  // namespace palpate::gui
