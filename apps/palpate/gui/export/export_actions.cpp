#include "gui/export/export_actions.h"

#include "gui/appearance/icons.h"

namespace palpate::gui {

ExportActions::ExportActions(ActionRegistry& book) {
  exportPicture = book.make("exportPicture", "File", "&Export…", {key("Ctrl+E")});
  exportAgain = book.make("exportAgain", "File", "Export as &last time", {key("Ctrl+Shift+E")});
  copyPicture = book.make("copyPicture", "File", "Cop&y", {key("Ctrl+C")});
  copyPicture->setToolTip("Copy the view that was clicked last (Ctrl+C)");
  copyTable = book.make("copyTable", "File", "Copy &table", {key("Ctrl+Alt+C")});
  exportPicture->setIconText(" Export");
  book.setIcon(exportPicture, IconShape::kExport);
}

}  // namespace palpate::gui
