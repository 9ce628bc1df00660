#include "gui/picture/table_picture.h"

#include <QFont>
#include <QFontInfo>
#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr double kTablePictureMargin = 12.0;     // [units]
constexpr double kCellGap = 14.0;                // [units] least space between columns
constexpr double kTablePictureRowHeight = 1.75;  // [heights of the text]
constexpr int kSmallestText = 5;                 // [units]

// The space that the table needs with a font.
struct TablePictureExtent {
  std::vector<double> columns;
  double row = 0.0;
  double title = 0.0;
  QSizeF whole;
};

TablePictureExtent tablePictureExtentOf(const TablePicture& table, const QFont& font, bool titled) {
  const QFontMetricsF metrics(font);
  TablePictureExtent extent;
  extent.row = metrics.height() * kTablePictureRowHeight;
  extent.title = titled && !(table.title.isEmpty() && table.caption.isEmpty()) ? extent.row : 0.0;
  double width = 2 * kTablePictureMargin;
  for (qsizetype column = 0; column < table.header.size(); ++column) {
    double widest = metrics.horizontalAdvance(table.header[column]);
    for (const QStringList& row : table.rows)
      widest = std::max(widest, metrics.horizontalAdvance(row.value(column)));
    extent.columns.push_back(widest);
    width += widest + (column > 0 ? kCellGap : 0.0);
  }
  const double height = extent.title + extent.row * static_cast<double>(table.rows.size() + 1) +
                        2 * kTablePictureMargin;
  extent.whole = {width, height};
  return extent;
}

}  // namespace

void paintTable(QPainter& painter,
                const PictureLook& look,
                const TablePicture& table,
                const QFont& font,
                Theme theme) {
  const ThemeColors& colors = colorsOf(look.forPrint ? Theme::kLight : theme);
  QFont fitting = font;
  int size = look.textUnits > 0 ? look.textUnits : QFontInfo(font).pixelSize();
  fitting.setPixelSize(size);
  TablePictureExtent extent = tablePictureExtentOf(table, fitting, look.titled);
  while (size > kSmallestText &&
         (extent.whole.width() > look.size.width() || extent.whole.height() > look.size.height())) {
    fitting.setPixelSize(--size);
    extent = tablePictureExtentOf(table, fitting, look.titled);
  }
  painter.save();
  painter.fillRect(QRectF(QPointF(), look.size), colors.window);
  const double right = look.size.width() - kTablePictureMargin;
  double y = kTablePictureMargin / 2;
  if (extent.title > 0.0) {
    const QRectF line(kTablePictureMargin, y, right - kTablePictureMargin, extent.row);
    QFont bold = fitting;
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(colors.text);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, table.title);
    painter.setFont(fitting);
    painter.setPen(look.forPrint ? colors.text : colors.muted);
    painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, table.caption);
    y += extent.row;
  }
  painter.setFont(fitting);
  // The spare width is distributed between the columns.
  const auto columns = static_cast<double>(table.header.size());
  const double spare = std::max(0.0, look.size.width() - extent.whole.width());
  const double gap = kCellGap + (columns > 1 ? spare / (columns - 1) : 0.0);
  const auto paintRow = [&](const QStringList& cells, const QColor& color) {
    painter.setPen(color);
    double x = kTablePictureMargin;
    for (std::size_t column = 0; column < extent.columns.size(); ++column) {
      const QRectF cell(x, y, extent.columns[column], extent.row);
      const auto side = column == 0 ? Qt::AlignLeft : Qt::AlignRight;
      painter.drawText(cell,
                       static_cast<int>(side | Qt::AlignVCenter | Qt::TextDontClip),
                       cells.value(static_cast<qsizetype>(column)));
      x += extent.columns[column] + gap;
    }
    y += extent.row;
    painter.setPen(QPen(look.forPrint ? colors.muted : colors.border, 0.5));
    painter.drawLine(QPointF(kTablePictureMargin, y), QPointF(right, y));
  };
  paintRow(table.header, look.forPrint ? colors.text : colors.muted);
  for (const QStringList& row : table.rows) paintRow(row, colors.text);
  painter.restore();
}

}  // namespace palpate::gui
