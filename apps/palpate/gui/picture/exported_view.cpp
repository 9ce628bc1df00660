#include "gui/picture/exported_view.h"

#include <algorithm>

namespace palpate::gui {

QSizeF ExportedView::sizeOnScreen() const {
  // Least size [px], for a dock that is nearly closed.
  constexpr QSizeF kMinimum(160.0, 120.0);
  const QSizeF shown = size ? size() : widget ? QSizeF(widget->size()) : QSizeF(900, 720);
  return shown.expandedTo(kMinimum);
}

QSizeF ExportedView::proportionsNow() const {
  if (proportions) return proportions();
  const QSizeF shown = sizeOnScreen();
  return {shown.width(), std::max(shown.height(), minHeightShare * shown.width())};
}

QSizeF ExportedView::sizeOnPaperMm(double widthMm) const {
  const QSizeF shown = proportionsNow();
  const double heightMm = widthMm * shown.height() / shown.width();
  return {widthMm, minHeightShare > 0.0 ? std::max(heightMm, kMinChartMm) : heightMm};
}

std::vector<ExportedTable> ExportedView::tablesNow() const {
  return tables ? tables() : std::vector<ExportedTable>();
}

std::optional<FramePictures> ExportedView::framePicturesNow() const {
  return framePictures ? framePictures() : std::nullopt;
}

}  // namespace palpate::gui
