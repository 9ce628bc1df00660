#include "gui/picture/exported_view.h"

namespace palpate::gui {

QSizeF ExportedView::sizeOnScreen() const {
  constexpr QSizeF kLeast(160.0, 120.0);  // of a dock that is nearly closed
  const QSizeF shown = size ? size() : widget ? QSizeF(widget->size()) : QSizeF(900, 720);
  return shown.expandedTo(kLeast);
}

std::vector<ExportedTable> ExportedView::tablesNow() const {
  return tables ? tables() : std::vector<ExportedTable>();
}

std::optional<FramePictures> ExportedView::framePicturesNow() const {
  return framePictures ? framePictures() : std::nullopt;
}

}  // namespace palpate::gui
