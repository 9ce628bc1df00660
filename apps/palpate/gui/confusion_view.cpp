#include "gui/confusion_view.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr double kMostNames = 0.38;  // of the width
constexpr double kLargestCell = 44.0;
constexpr double kLeastCellForText = 13.0;
constexpr double kAir = 4.0;

struct Grid {
  int rows = 0, columns = 0;  // the last column may be "unknown"
  bool unknown = false;
  QRectF cells;
  double side = 0.0;
};

Grid gridOf(const ConfusionMatrix& matrix, const QRectF& area, const QFontMetricsF& metrics) {
  Grid grid;
  grid.rows = static_cast<int>(matrix.classes().size());
  for (int i = 0; i < grid.rows; ++i)
    grid.unknown = grid.unknown || matrix.at(i, ConfusionMatrix::kUnknown) > 0;
  grid.columns = grid.rows + (grid.unknown ? 1 : 0);
  double names = 0.0;
  for (const std::string& name : matrix.classes())
    names = std::max(names, metrics.horizontalAdvance(QString::fromStdString(name)));
  names = std::min(names + 2 * kAir, kMostNames * area.width());
  const double above = names + metrics.height();
  grid.side = std::min({(area.width() - names) / grid.columns,
                        (area.height() - above - kAir) / grid.rows,
                        kLargestCell});
  grid.side = std::max(grid.side, 3.0);
  grid.cells = QRectF(
      area.left() + names, area.top() + above, grid.side * grid.columns, grid.side * grid.rows);
  return grid;
}

int calledOf(const Grid& grid, int column) {
  return column < grid.rows ? column : ConfusionMatrix::kUnknown;
}

QString nameOf(const ConfusionMatrix& matrix, int index) {
  return index == ConfusionMatrix::kUnknown
             ? QString("unknown")
             : QString::fromStdString(matrix.classes()[static_cast<std::size_t>(index)]);
}

QColor mixed(const QColor& from, const QColor& to, double part) {
  const auto mix = [part](int a, int b) { return static_cast<int>(a + part * (b - a)); };
  return {mix(from.red(), to.red()), mix(from.green(), to.green()), mix(from.blue(), to.blue())};
}

}  // namespace

void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme,
                    std::optional<std::pair<int, int>> chosen) {
  const ThemeColors& colors = colorsOf(theme);
  const QFontMetricsF metrics(painter.font());
  const Grid grid = gridOf(matrix, area, metrics);
  if (grid.rows == 0) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  const double namesWidth = grid.cells.left() - area.left() - 2 * kAir;
  // Names overlap where the cells are lower than text: every second one, ..
  const int every = std::max(1, static_cast<int>(metrics.height() * 0.9 / grid.side + 0.99));
  painter.setPen(colors.muted);
  painter.drawText(QRectF(area.left(), area.top(), namesWidth + kAir, metrics.height()),
                   Qt::AlignRight,
                   metrics.elidedText("was ↓  called →", Qt::ElideRight, namesWidth));
  for (int i = 0; i < grid.rows; i += every) {
    painter.setPen(colors.text);
    painter.drawText(QRectF(area.left(),
                            grid.cells.top() + i * grid.side - metrics.height(),
                            namesWidth + kAir,
                            grid.side + 2 * metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter,
                     metrics.elidedText(nameOf(matrix, i), Qt::ElideRight, namesWidth));
  }
  for (int i = 0; i < grid.columns; i += every) {
    painter.save();
    painter.translate(grid.cells.left() + (i + 0.5) * grid.side, grid.cells.top() - kAir);
    painter.rotate(-90.0);
    const int called = calledOf(grid, i);
    painter.setPen(called == ConfusionMatrix::kUnknown ? colors.muted : colors.text);
    painter.drawText(QRectF(0.0, -metrics.height(), namesWidth, 2 * metrics.height()),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(nameOf(matrix, called), Qt::ElideRight, namesWidth));
    painter.restore();
  }
  for (int y = 0; y < grid.rows; ++y) {
    double support = 0.0;
    for (int x = 0; x < grid.columns; ++x)
      support += static_cast<double>(matrix.at(y, calledOf(grid, x)));
    for (int x = 0; x < grid.columns; ++x) {
      const int called = calledOf(grid, x);
      const std::size_t count = matrix.at(y, called);
      const double share = support > 0.0 ? static_cast<double>(count) / support : 0.0;
      const QRectF cell(grid.cells.left() + x * grid.side,
                        grid.cells.top() + y * grid.side,
                        grid.side - 1.0,
                        grid.side - 1.0);
      const bool right = called == y;
      // A single mistake is to be seen.
      const double tone = count == 0 ? 0.0 : std::max(share, right ? 0.15 : 0.35);
      const QColor ground = mixed(colors.taxel, right ? colors.accent : colors.warning, tone);
      painter.fillRect(cell, ground);
      if (count > 0 && grid.side >= kLeastCellForText) {
        painter.setPen(tone > 0.5 ? colors.window : colors.text);
        QFont small = painter.font();
        painter.save();
        small.setPixelSize(
            std::min(QFontInfo(small).pixelSize(), static_cast<int>(grid.side * 0.6)));
        painter.setFont(small);
        painter.drawText(cell, Qt::AlignCenter, QString::number(count));
        painter.restore();
      }
      if (chosen && *chosen == std::pair(y, called)) {
        painter.setPen(QPen(colors.text, 2.0));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(cell.adjusted(1, 1, -1, -1));
      }
    }
  }
  painter.restore();
}

ConfusionView::ConfusionView(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void ConfusionView::setMatrix(std::optional<ConfusionMatrix> matrix) {
  matrix_ = std::move(matrix);
  chosen_.reset();
  update();
}

void ConfusionView::setTheme(Theme theme) {
  theme_ = theme;
  update();
}

void ConfusionView::choose(std::optional<std::pair<int, int>> cell) {
  chosen_ = cell;
  update();
  if (cell) emit cellChosen(cell->first, cell->second);
}

void ConfusionView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (matrix_)
    paintConfusion(
        painter, QRectF(rect()).adjusted(kAir, kAir, -kAir, -kAir), *matrix_, theme_, chosen_);
}

std::optional<std::pair<int, int>> ConfusionView::cellAt(const QPointF& at) const {
  if (!matrix_) return std::nullopt;
  const Grid grid =
      gridOf(*matrix_, QRectF(rect()).adjusted(kAir, kAir, -kAir, -kAir), QFontMetricsF(font()));
  if (!grid.cells.contains(at)) return std::nullopt;
  const int x =
      std::min(static_cast<int>((at.x() - grid.cells.left()) / grid.side), grid.columns - 1);
  const int y = std::min(static_cast<int>((at.y() - grid.cells.top()) / grid.side), grid.rows - 1);
  return std::pair(y, calledOf(grid, x));
}

void ConfusionView::mousePressEvent(QMouseEvent* event) {
  if (const auto cell = cellAt(event->position())) choose(cell);
}

void ConfusionView::keyPressEvent(QKeyEvent* event) {
  if (!matrix_) return QWidget::keyPressEvent(event);
  const Grid grid = gridOf(*matrix_, QRectF(rect()), QFontMetricsF(font()));
  int y = chosen_ ? chosen_->first : 0;
  int x = !chosen_ ? 0 : chosen_->second == ConfusionMatrix::kUnknown ? grid.rows : chosen_->second;
  switch (event->key()) {
    case Qt::Key_Left:
      --x;
      break;
    case Qt::Key_Right:
      ++x;
      break;
    case Qt::Key_Up:
      --y;
      break;
    case Qt::Key_Down:
      ++y;
      break;
    default:
      return QWidget::keyPressEvent(event);
  }
  choose(std::pair(std::clamp(y, 0, grid.rows - 1),
                   calledOf(grid, std::clamp(x, 0, grid.columns - 1))));
}

bool ConfusionView::event(QEvent* event) {
  // Keys that move in it play nothing back.
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down) {
      event->accept();
      return true;
    }
  }
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (const auto cell = cellAt(help->pos()))
      QToolTip::showText(help->globalPos(),
                         nameOf(*matrix_, cell->first) + " called " +
                             nameOf(*matrix_, cell->second) + ": " +
                             QString::number(matrix_->at(cell->first, cell->second)),
                         this);
    else
      QToolTip::hideText();
    return true;
  }
  return QWidget::event(event);
}

}  // namespace palpate::gui
