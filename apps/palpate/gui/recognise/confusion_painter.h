// A confusion matrix on paper: where its cells and names are, and how they look. Names are as small
// as their cells need.
#pragma once

#include <QFont>
#include <QPainter>
#include <QRectF>
#include <optional>
#include <utility>

#include <palpate/recognition/classification_report.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

// truth, called (ConfusionMatrix::kUnknown: the last column)
using ConfusionCell = std::pair<int, int>;

constexpr double kSmallestConfusionSide = 3.0;   // of a cell [px],
constexpr double kReadableConfusionSide = 14.0;  // from here on names beside one another are read
constexpr double kLargestConfusionSide = 44.0;

struct ConfusionGrid {
  int rows = 0, columns = 0;  // the last column may be "unknown"
  QFont font;                 // of the names
  double side = 0.0;          // of a cell
  QRectF window;              // what shows cells
  QPointF origin;             // of the first cell, left and above of the window when scrolled
  double wholeWidth() const { return side * columns; }
  double wholeHeight() const { return side * rows; }
  int calledOf(int column) const { return column < rows ? column : ConfusionMatrix::kUnknown; }
  int columnOf(int called) const { return called == ConfusionMatrix::kUnknown ? rows : called; }
  QRectF rectOf(const ConfusionCell& cell) const;
};

// `side`: of a cell; nothing: as large as all of it fits.
ConfusionGrid confusionGrid(const ConfusionMatrix& matrix,
                            const QRectF& area,
                            const QFont& plain,
                            std::optional<double> side = {},
                            QPointF scrolled = {});
QString confusionName(const ConfusionMatrix& matrix, int index);

struct ConfusionMarks {
  std::optional<ConfusionCell> chosen;   // framed
  std::optional<ConfusionCell> hovered;  // its row and column stand out
};
// With the painter's font.
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionGrid& grid,
                    const ConfusionMatrix& matrix,
                    Theme theme,
                    const ConfusionMarks& marks = {});
// All of it, as large as fits.
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme);

}  // namespace palpate::gui
