#include "gui/recognise/confusion_painter.h"

#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

constexpr double kMaxNames = 0.38;  // of the width
constexpr double kMinSideInPicture = 6.0;
constexpr double kNameOfSide = 0.86;  // font size relative to the side of a cell
constexpr int kMinNamePx = 6;         // smaller names are left out

constexpr double kConfusionPainterAir = 4.0;

double nameWidth(const ConfusionMatrix& matrix, const QFont& font, double most) {
  const QFontMetricsF metrics(font);
  double width = 0.0;
  for (const std::string& name : matrix.classes())
    width = std::max(width, metrics.horizontalAdvance(QString::fromStdString(name)));
  return std::min(width + 3 * kConfusionPainterAir, most);
}

}  // namespace

QRectF ConfusionGrid::rectOf(const ConfusionCell& cell) const {
  const int column = cell.second == ConfusionMatrix::kUnknown ? rows : cell.second;
  return QRectF(
      window.left() + column * side, window.top() + cell.first * side, side - 1.0, side - 1.0);
}

int confusionColumns(const ConfusionMatrix& matrix) {
  const int rows = static_cast<int>(matrix.classes().size());
  for (int row = 0; row < rows; ++row)
    if (matrix.at(row, ConfusionMatrix::kUnknown) > 0) return rows + 1;
  return rows;
}

QString confusionName(const ConfusionMatrix& matrix, int index) {
  return index == ConfusionMatrix::kUnknown
             ? QString("unknown")
             : QString::fromStdString(matrix.classes()[static_cast<std::size_t>(index)]);
}

QFont confusionNameFont(const QFont& plain, double side) {
  QFont font = plain;
  font.setPixelSize(std::max(
      1,
      std::min(QFontInfo(plain).pixelSize(), static_cast<int>(std::lround(kNameOfSide * side)))));
  return font;
}

ConfusionGrid confusionGrid(const ConfusionMatrix& matrix,
                            const QRectF& area,
                            const QFont& plain,
                            std::optional<double> side) {
  ConfusionGrid grid;
  grid.rows = static_cast<int>(matrix.classes().size());
  if (grid.rows == 0) return grid;
  grid.columns = confusionColumns(matrix);
  const double most = kMaxNames * area.width();
  grid.side = side.value_or(kLargestConfusionSide);
  double names = 0.0, above = 0.0;
  // Smaller cells have smaller names, which leave more room for the cells; a few iterations
  // suffice.
  for (int round = 0; round < (side ? 1 : 4); ++round) {
    grid.font = confusionNameFont(plain, grid.side);
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
                       std::min(grid.columns * grid.side, area.width() - names),
                       std::min(grid.rows * grid.side, area.height() - above));
  return grid;
}

void paintConfusionName(QPainter& painter,
                        const QRectF& where,
                        const QString& name,
                        QFont font,
                        Qt::Alignment side,
                        const QColor& color,
                        bool marked) {
  if (font.pixelSize() < kMinNamePx && !marked) return;
  const double width = where.width() - 2 * kConfusionPainterAir;
  if (marked) {
    // Makes the name as large as is legible, if there is room.
    const auto largest = static_cast<int>(kReadableConfusionSide * kNameOfSide);
    while (font.pixelSize() < largest && QFontMetricsF(font).horizontalAdvance(name) < 0.9 * width)
      font.setPixelSize(font.pixelSize() + 1);
    // Fills the background, because the name may be larger than its cell.
    const double more = std::max(0.0, (QFontMetricsF(font).height() - where.height()) / 2.0);
    painter.fillRect(where.adjusted(0, -more, 0, more), colorsOf().panel);
  }
  painter.setFont(font);
  painter.setPen(marked ? colorsOf().accent : color);
  painter.drawText(where.adjusted(kConfusionPainterAir, -20, -kConfusionPainterAir, 20),
                   static_cast<int>(side | Qt::AlignVCenter),
                   QFontMetricsF(font).elidedText(name, Qt::ElideRight, width));
}

void paintConfusionCell(QPainter& painter,
                        const QRectF& where,
                        const ConfusionMatrix& matrix,
                        const ConfusionCell& cell,
                        const ThemeColors& colors,
                        bool highlighted,
                        double minSide) {
  double support = static_cast<double>(matrix.at(cell.first, ConfusionMatrix::kUnknown));
  for (int called = 0; called < static_cast<int>(matrix.classes().size()); ++called)
    support += static_cast<double>(matrix.at(cell.first, called));
  const std::size_t count = matrix.at(cell.first, cell.second);
  const double share = support > 0.0 ? static_cast<double>(count) / support : 0.0;
  const bool right = cell.first == cell.second;
  // A single error must be visible, so its tone has a minimum.
  const double tone = count == 0 ? 0.0 : std::max(share, right ? 0.25 : 0.75);
  const QColor ground = mixed(colors.taxel, right ? colors.accent : colors.warning, tone);
  painter.fillRect(where, highlighted ? mixed(ground, colors.text, 0.14) : ground);
  const double side = where.width() + 1.0;
  if (count == 0 || side < minSide) return;
  QFont small = painter.font();
  small.setPixelSize(
      std::max(1, std::min(QFontInfo(small).pixelSize(), static_cast<int>(side * 0.6))));
  painter.setFont(small);
  painter.setPen(tone > 0.5 ? colors.window : colors.text);
  painter.drawText(where, Qt::AlignCenter, QString::number(count));
}

void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme) {
  const ThemeColors& colors = colorsOf(theme);
  const QFont plain = painter.font();
  const ConfusionGrid grid = confusionGrid(matrix, area, plain);
  if (grid.rows == 0) return;
  const double names = grid.window.left() - area.left();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(colors.muted);
  painter.drawText(area, Qt::AlignLeft | Qt::AlignTop, "was ↓  called →");
  for (int column = 0; column < grid.columns; ++column) {
    const int called = column < grid.rows ? column : ConfusionMatrix::kUnknown;
    painter.save();
    painter.translate(grid.window.left() + column * grid.side, grid.window.top());
    painter.rotate(-90.0);
    paintConfusionName(painter,
                       QRectF(0, 0, names, grid.side),
                       confusionName(matrix, called),
                       grid.font,
                       Qt::AlignLeft,
                       column < grid.rows ? colors.text : colors.muted);
    painter.restore();
  }
  for (int row = 0; row < grid.rows; ++row) {
    paintConfusionName(painter,
                       QRectF(area.left(), grid.window.top() + row * grid.side, names, grid.side),
                       confusionName(matrix, row),
                       grid.font,
                       Qt::AlignRight,
                       colors.text);
    painter.setFont(plain);
    for (int column = 0; column < grid.columns; ++column) {
      const ConfusionCell cell(row, column < grid.rows ? column : ConfusionMatrix::kUnknown);
      paintConfusionCell(
          painter, grid.rectOf(cell), matrix, cell, colors, false, kMinSideInPicture);
    }
  }
  painter.restore();
}

}  // namespace palpate::gui
