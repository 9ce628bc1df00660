// The menus and boxes of the window that a feature fills or opens elsewhere, too.
#pragma once

class QAction;
class QComboBox;
class QMenu;

namespace palpate::gui {

struct Menus {
  QMenu* edit = nullptr;               // also shown over the timeline
  QMenu* connections = nullptr;        // of the button Connect
  QMenu* only = nullptr;               // one matrix of the hand in space alone
  QMenu* scanned = nullptr;            // which taxels are scanned; also shown over the matrices
  QMenu* recent = nullptr;             // files that were opened last
  QComboBox* speed = nullptr;          // of the toolbar; index into PlaybackController::kSpeeds
  QComboBox* recordings = nullptr;     // that are open
  QAction* recordingsShown = nullptr;  // shows and hides it
};

}  // namespace palpate::gui
