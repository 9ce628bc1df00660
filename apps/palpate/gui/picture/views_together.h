// Several views of the window in one picture or movie, arranged as on the screen: matrices, hand
// and timeline.
#pragma once

#include <QRectF>
#include <QSizeF>
#include <functional>
#include <vector>

#include "gui/picture/exported_view.h"

namespace palpate::gui {

// How views are arranged in a picture.
struct Arrangement {
  QSizeF size;
  // Of each view: shares of the size, 0..1.
  std::vector<QRectF> places;
};
// Arranges views as their places on the screen [px] tell: those beside each other make a row, rows
// lie below each other; what is between them on the screen is left out. `heightsInPicture`: heights
// that differ from those on the screen [px]; empty: none.
Arrangement arrangementOf(const std::vector<QRectF>& onScreen,
                          const std::vector<double>& heightsInPicture = {});

// The frames of several views painted in their places. All are of the same recording; times and the
// selected frames are those of the first. `ground` is what shows between them.
FramePictures framesTogether(std::vector<FramePictures> parts,
                             const std::vector<QRectF>& places,
                             const QColor& ground);

// The views that `parts` returns as one view, which is there when there are at least two of them.
// Only views whose widgets are visible and that have a picture of each frame (framePart,
// framePictures) count.
ExportedView viewsTogether(std::function<std::vector<const ExportedView*>()> parts);

}  // namespace palpate::gui
