#include "gui/recognise/confusion_painter.h"

#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

constexpr double kMostNames = 0.38;  // of the width
constexpr double kLeastSideInPicture = 6.0;
constexpr double kNameOfSide = 0.86;  // font size relative to the side of a cell
constexpr int kLeastNamePx = 6;       // smaller names are left out

constexpr double kConfusionPainterAir = 4.0;

QFont nameFont(const QFont& plain, double side) {
  QFont font = plain;
  font.setPixelSize(std::max(
      1,
      std::min(QFontInfo(plain).pixelSize(), static_cast<int>(std::lround(kNameOfSide * side)))));
  return font;
}

double nameWidth(const ConfusionMatrix& matrix, const QFont& font, double most) {
  const QFontMetricsF metrics(font);
  double width = 0.0;
  for (const std::string& name : matrix.classes())
    width = std::max(width, metrics.horizontalAdvance(QString::fromStdString(name)));
  return std::min(width + 3 * kConfusionPainterAir, most);
}

bool hovered(const ConfusionMarks& marks, int row, int called) {
  return marks.hovered && (marks.hovered->first == row || marks.hovered->second == called);
}

void confusionPainterPaintNames(QPainter& painter,
                                const QRectF& area,
                                const ConfusionGrid& grid,
                                const ConfusionMatrix& matrix,
                                const ThemeColors& colors,
                                const ConfusionMarks& marks) {
  const QFont plain = painter.font();
  const double width = grid.window.left() - area.left() - 2 * kConfusionPainterAir;
  const QFontMetricsF plainMetrics(plain);
  painter.setPen(colors.muted);
  painter.drawText(QRectF(area.left(), area.top(), area.width(), plainMetrics.height()),
                   Qt::AlignLeft,
                   "was ↓  called →");
  const bool readable = grid.font.pixelSize() >= kLeastNamePx;
  const auto write =
      [&](const QString& name, bool marked, bool muted, const QRectF& where, auto align) {
        if (!readable && !marked) return;
        QFont font = grid.font;
        if (marked) {
          // Makes the name as large as is legible, if there is room.
          const auto largest = static_cast<int>(kReadableConfusionSide * kNameOfSide);
          while (font.pixelSize() < largest &&
                 QFontMetricsF(font).horizontalAdvance(name) < 0.9 * width)
            font.setPixelSize(font.pixelSize() + 1);
          // Fills the background, because the name may be larger than its cell.
          const QFontMetricsF own(font);
          painter.setPen(Qt::NoPen);
          painter.setBrush(colors.window);
          const double more = std::max(0.0, (own.height() - where.height()) / 2.0);
          painter.drawRect(where.adjusted(0, -more, 0, more));
        }
        painter.setFont(font);
        painter.setPen(marked ? colors.accent : muted ? colors.muted : colors.text);
        painter.drawText(where.adjusted(0, -20, 0, 20),
                         static_cast<int>(align | Qt::AlignVCenter),
                         QFontMetricsF(font).elidedText(name, Qt::ElideRight, width));
      };
  // Highlighted names are drawn last, over their neighbours.
  for (const bool marked : {false, true}) {
    painter.save();
    painter.setClipRect(QRectF(area.left(), grid.window.top(), area.width(), grid.window.height()),
                        Qt::IntersectClip);
    for (int row = 0; row < grid.rows; ++row) {
      if (marked != (marks.hovered && marks.hovered->first == row)) continue;
      write(confusionName(matrix, row),
            marked,
            false,
            QRectF(area.left(),
                   grid.origin.y() + row * grid.side,
                   width + kConfusionPainterAir,
                   grid.side),
            Qt::AlignRight);
    }
    painter.restore();
    painter.save();
    painter.setClipRect(QRectF(grid.window.left(), area.top(), grid.window.width(), area.height()),
                        Qt::IntersectClip);
    for (int column = 0; column < grid.columns; ++column) {
      const int called = grid.calledOf(column);
      if (marked != (marks.hovered && marks.hovered->second == called)) continue;
      painter.save();
      painter.translate(grid.origin.x() + column * grid.side,
                        grid.window.top() - kConfusionPainterAir);
      painter.rotate(-90.0);
      write(confusionName(matrix, called),
            marked,
            called == ConfusionMatrix::kUnknown,
            QRectF(0.0, 0.0, width, grid.side),
            Qt::AlignLeft);
      painter.restore();
    }
    painter.restore();
  }
  painter.setFont(plain);
}

void paintCells(QPainter& painter,
                const ConfusionGrid& grid,
                const ConfusionMatrix& matrix,
                const ThemeColors& colors,
                const ConfusionMarks& marks) {
  painter.setClipRect(grid.window, Qt::IntersectClip);
  QFont small = painter.font();
  small.setPixelSize(
      std::max(1, std::min(QFontInfo(small).pixelSize(), static_cast<int>(grid.side * 0.6))));
  painter.setFont(small);
  for (int row = 0; row < grid.rows; ++row) {
    double support = 0.0;
    for (int column = 0; column < grid.columns; ++column)
      support += static_cast<double>(matrix.at(row, grid.calledOf(column)));
    for (int column = 0; column < grid.columns; ++column) {
      const QRectF cell = grid.rectOf({row, grid.calledOf(column)});
      if (!cell.intersects(grid.window)) continue;
      const int called = grid.calledOf(column);
      const std::size_t count = matrix.at(row, called);
      const double share = support > 0.0 ? static_cast<double>(count) / support : 0.0;
      const bool right = called == row;
      // A single error must be visible, so its tone has a minimum.
      const double tone = count == 0 ? 0.0 : std::max(share, right ? 0.25 : 0.75);
      QColor ground = mixed(colors.taxel, right ? colors.accent : colors.warning, tone);
      if (hovered(marks, row, grid.calledOf(column))) ground = mixed(ground, colors.text, 0.14);
      painter.fillRect(cell, ground);
      if (count > 0 && grid.side >= grid.leastSideForNumbers) {
        painter.setPen(tone > 0.5 ? colors.window : colors.text);
        painter.drawText(cell, Qt::AlignCenter, QString::number(count));
      }
    }
  }
  const auto frame = [&](const ConfusionCell& at, const QColor& color, double width) {
    painter.setPen(QPen(color, width));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(grid.rectOf(at));
  };
  if (marks.hovered) frame(*marks.hovered, colors.muted, 1.0);
  if (marks.chosen) frame(*marks.chosen, colors.text, 2.0);
}

}  // namespace

QRectF ConfusionGrid::rectOf(const ConfusionCell& cell) const {
  return QRectF(origin.x() + columnOf(cell.second) * side,
                origin.y() + cell.first * side,
                side - 1.0,
                side - 1.0);
}

QString confusionName(const ConfusionMatrix& matrix, int index) {
  return index == ConfusionMatrix::kUnknown
             ? QString("unknown")
             : QString::fromStdString(matrix.classes()[static_cast<std::size_t>(index)]);
}

ConfusionGrid confusionGrid(const ConfusionMatrix& matrix,
                            const QRectF& area,
                            const QFont& plain,
                            std::optional<double> side,
                            QPointF scrolled) {
  ConfusionGrid grid;
  grid.rows = static_cast<int>(matrix.classes().size());
  if (grid.rows == 0) return grid;
  bool unknown = false;
  for (int i = 0; i < grid.rows; ++i)
    unknown = unknown || matrix.at(i, ConfusionMatrix::kUnknown) > 0;
  grid.columns = grid.rows + (unknown ? 1 : 0);
  const double most = kMostNames * area.width();
  grid.side = side.value_or(kLargestConfusionSide);
  double names = 0.0, above = 0.0;
  // Smaller cells have smaller names, which leave more room for the cells; a few iterations
  // suffice.
  for (int round = 0; round < (side ? 1 : 4); ++round) {
    grid.font = nameFont(plain, grid.side);
    names = nameWidth(matrix, grid.font, most);
    above = names + QFontMetricsF(plain).height();
    if (!side)
      grid.side = std::clamp(
          std::min((area.width() - names) / grid.columns, (area.height() - above) / grid.rows),
          kSmallestConfusionSide,
          kLargestConfusionSide);
  }
  grid.window = QRectF(area.left() + names,
                       area.top() + above,
                       std::min(grid.wholeWidth(), area.width() - names),
                       std::min(grid.wholeHeight(), area.height() - above));
  grid.origin = grid.window.topLeft() - scrolled;
  return grid;
}

void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionGrid& grid,
                    const ConfusionMatrix& matrix,
                    Theme theme,
                    const ConfusionMarks& marks) {
  if (grid.rows == 0) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  confusionPainterPaintNames(painter, area, grid, matrix, colorsOf(theme), marks);
  paintCells(painter, grid, matrix, colorsOf(theme), marks);
  painter.restore();
}

void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme) {
  ConfusionGrid grid = confusionGrid(matrix, area, painter.font());
  grid.leastSideForNumbers = kLeastSideInPicture;
  paintConfusion(painter, area, grid, matrix, theme);
}

}  // namespace palpate::gui
