// Paints a confusion matrix and computes its layout, for ConfusionView and for export. The font of
// the names shrinks with the cells.
#pragma once

#include <QFont>
#include <QPainter>
#include <QRectF>
#include <optional>
#include <utility>

#include <palpate/recognition/classification_report.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

// (truth, called); called is ConfusionMatrix::kUnknown for the last column.
using ConfusionCell = std::pair<int, int>;

// [px] side of a cell
constexpr double kSmallestConfusionSide = 3.0;
// [px] from this side on, the names of neighbouring cells are legible
constexpr double kReadableConfusionSide = 14.0;
constexpr double kLargestConfusionSide = 44.0;

// The layout of a painted matrix.
struct ConfusionGrid {
  // The last column may be "unknown".
  int rows = 0, columns = 0;
  // Font of the names.
  QFont font;
  // Side of a cell [px].
  double side = 0.0;
  // The visible part of the cells.
  QRectF window;
  // The top left of the first cell; outside the window when scrolled.
  QPointF origin;
  // Smaller cells have no numbers [px].
  double leastSideForNumbers = 13.0;
  double wholeWidth() const { return side * columns; }
  double wholeHeight() const { return side * rows; }
  int calledOf(int column) const { return column < rows ? column : ConfusionMatrix::kUnknown; }
  int columnOf(int called) const { return called == ConfusionMatrix::kUnknown ? rows : called; }
  QRectF rectOf(const ConfusionCell& cell) const;
};

// Computes the layout. `side`: side of a cell [px]; nothing: the largest with which everything
// fits.
ConfusionGrid confusionGrid(const ConfusionMatrix& matrix,
                            const QRectF& area,
                            const QFont& plain,
                            std::optional<double> side = {},
                            QPointF scrolled = {});
// The name of a class; "unknown" for ConfusionMatrix::kUnknown.
QString confusionName(const ConfusionMatrix& matrix, int index);

// The highlighted cells.
struct ConfusionMarks {
  // This cell is drawn with a frame.
  std::optional<ConfusionCell> chosen;
  // The row and column of this cell are highlighted.
  std::optional<ConfusionCell> hovered;
};
// Paints a matrix with a given layout; the font is the painter's.
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionGrid& grid,
                    const ConfusionMatrix& matrix,
                    Theme theme,
                    const ConfusionMarks& marks = {});
// Paints the whole matrix as large as fits, for a picture: finer than a screen, so that numbers of
// smaller cells are legible, too.
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme);

}  // namespace palpate::gui
