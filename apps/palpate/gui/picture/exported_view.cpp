#include "gui/picture/exported_view.h"

namespace palpate::gui {

QSizeF ExportedView::sizeOnScreen() const {
  // Least size [px], for a dock that is nearly closed.
  constexpr QSizeF kLeast(160.0, 120.0);
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
