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
  // The cells, as far as there is room.
  QRectF window;
  QRectF rectOf(const ConfusionCell& cell) const;
};

// Computes the layout. `side`: side of a cell [px]; nothing: the largest with which everything
// fits.
ConfusionGrid confusionGrid(const ConfusionMatrix& matrix,
                            const QRectF& area,
                            const QFont& plain,
                            std::optional<double> side = {});
// With that of "unknown", if an answer was so.
int confusionColumns(const ConfusionMatrix& matrix);
// The name of a class; "unknown" for ConfusionMatrix::kUnknown.
QString confusionName(const ConfusionMatrix& matrix, int index);
// For names beside cells of this side [px].
QFont confusionNameFont(const QFont& plain, double side);

// Paints a name along a row or, rotated, a column; illegible ones are left out. A marked one stands
// out and is legible.
void paintConfusionName(QPainter& painter,
                        const QRectF& where,
                        const QString& name,
                        QFont font,
                        Qt::Alignment side,
                        const QColor& color,
                        bool marked = false);
// Paints a cell, whose number is left out where the cell is smaller than `minSide` [px].
void paintConfusionCell(QPainter& painter,
                        const QRectF& where,
                        const ConfusionMatrix& matrix,
                        const ConfusionCell& cell,
                        const ThemeColors& colors,
                        bool highlighted = false,
                        double minSide = 13.0);
// Paints the whole matrix as large as fits, for a picture: finer than a screen, so that numbers of
// smaller cells are legible, too.
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme);

}  // namespace palpate::gui
