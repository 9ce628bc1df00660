#include "gui/open/open_actions.h"

#include "gui/appearance/icons.h"

namespace palpate::gui {

OpenActions::OpenActions(ActionRegistry& book) {
  open = book.make("open", "File", "&Open…", {key("Ctrl+O")});
  openDemo = book.make("openDemo", "File", "Open the &demo recording", {key("Ctrl+D")});
  nextRecording = book.make("nextRecording", "File", "&Next open recording", {key("Ctrl+Tab")});
  previousRecording =
      book.make("previousRecording", "File", "&Previous open recording", {key("Ctrl+Shift+Tab")});
  closeRecording = book.make("closeRecording", "File", "&Close recording", {key("Ctrl+W")});
  open->setIconText(" " + plainText(*open));
  book.setIcon(open, IconShape::kOpen);
}

}  // namespace palpate::gui
