#include "gui/recognise/confusion_view.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScrollBar>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

using Cell = ConfusionCell;

constexpr double kConfusionViewZoomStep = 1.15;
constexpr double kConfusionViewAir = 4.0;

QRectF areaOf(const QWidget& viewport) {
  return QRectF(viewport.rect())
      .adjusted(kConfusionViewAir, kConfusionViewAir, -kConfusionViewAir, -kConfusionViewAir);
}

}  // namespace

ConfusionView::ConfusionView(QWidget* parent) : QAbstractScrollArea(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setFrameShape(QFrame::NoFrame);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  viewport()->setAutoFillBackground(false);
  viewport()->setMouseTracking(true);
}

void ConfusionView::setMatrix(std::optional<ConfusionMatrix> matrix) {
  matrix_ = std::move(matrix);
  chosen_.reset();
  hovered_.reset();
  side_.reset();
  layOut();
}

QString ConfusionView::textOf(const Cell& cell) const {
  return confusionName(*matrix_, cell.first) + " called " + confusionName(*matrix_, cell.second) +
         ": " + QString::number(matrix_->at(cell.first, cell.second));
}

void ConfusionView::choose(std::optional<Cell> cell) {
  chosen_ = cell;
  if (cell) reveal(*cell);
  viewport()->update();
  setAccessibleDescription(cell && matrix_ ? textOf(*cell) : QString());
  if (cell) emit cellChosen(cell->first, cell->second);
}

double ConfusionView::side() const {
  if (!matrix_) return 0.0;
  const double fits = confusionGrid(*matrix_, areaOf(*viewport()), font()).side;
  return side_ ? std::clamp(*side_, std::min(fits, kReadableConfusionSide), kLargestConfusionSide)
               : std::max(fits, kReadableConfusionSide);
}

void ConfusionView::setSide(std::optional<double> side) {
  side_ = side;
  if (side_) side_ = this->side();
  layOut();
  if (chosen_) reveal(*chosen_);
}

void ConfusionView::showAll() { setSide(kSmallestConfusionSide); }

// The layout of the shown matrix with its present scroll position.
ConfusionGrid ConfusionView::gridInSight() const {
  return confusionGrid(*matrix_,
                       areaOf(*viewport()),
                       font(),
                       side(),
                       QPointF(horizontalScrollBar()->value(), verticalScrollBar()->value()));
}

QRectF ConfusionView::rectOf(const Cell& cell) const {
  if (!matrix_) return {};
  const ConfusionGrid grid = gridInSight();
  return grid.rectOf(cell).intersected(grid.window);
}

void ConfusionView::layOut() {
  // Each scroll bar reduces the room for the other, so the layout is computed twice.
  for (int round = 0; round < 2; ++round) {
    int wide = 0, high = 0, width = 0, height = 0;
    if (matrix_ && !matrix_->classes().empty()) {
      const ConfusionGrid grid = confusionGrid(*matrix_, areaOf(*viewport()), font(), side());
      width = static_cast<int>(grid.window.width());
      height = static_cast<int>(grid.window.height());
      const auto rest = [](double whole, double seen) {
        return std::max(0, static_cast<int>(std::ceil(whole - seen - 0.01)));
      };
      wide = rest(grid.wholeWidth(), grid.window.width());
      high = rest(grid.wholeHeight(), grid.window.height());
      horizontalScrollBar()->setSingleStep(std::max(1, static_cast<int>(grid.side)));
      verticalScrollBar()->setSingleStep(std::max(1, static_cast<int>(grid.side)));
    }
    horizontalScrollBar()->setRange(0, wide);
    horizontalScrollBar()->setPageStep(std::max(1, width));
    verticalScrollBar()->setRange(0, high);
    verticalScrollBar()->setPageStep(std::max(1, height));
  }
  viewport()->update();
}

void ConfusionView::reveal(const Cell& cell) {
  if (!matrix_) return;
  const ConfusionGrid grid = confusionGrid(*matrix_, areaOf(*viewport()), font(), side());
  const auto into = [&](QScrollBar* bar, int index, double room) {
    const double from = index * grid.side, to = from + grid.side;
    if (from < bar->value()) bar->setValue(static_cast<int>(from));
    if (to > bar->value() + room) bar->setValue(static_cast<int>(std::ceil(to - room)));
  };
  into(horizontalScrollBar(), grid.columnOf(cell.second), grid.window.width());
  into(verticalScrollBar(), cell.first, grid.window.height());
}

void ConfusionView::paintEvent(QPaintEvent*) {
  if (!matrix_) return;
  QPainter painter(viewport());
  painter.setFont(font());
  const QRectF area = areaOf(*viewport());
  const ConfusionGrid grid = gridInSight();
  paintConfusion(
      painter, area, grid, *matrix_, shownTheme(), {chosen_, hovered_ ? hovered_ : chosen_});
}

void ConfusionView::resizeEvent(QResizeEvent*) { layOut(); }

void ConfusionView::scrollContentsBy(int, int) { viewport()->update(); }

std::optional<Cell> ConfusionView::cellAt(const QPointF& at) const {
  if (!matrix_) return std::nullopt;
  const ConfusionGrid grid = gridInSight();
  if (!grid.window.contains(at) || grid.rows == 0) return std::nullopt;
  const int column =
      std::clamp(static_cast<int>((at.x() - grid.origin.x()) / grid.side), 0, grid.columns - 1);
  const int row =
      std::clamp(static_cast<int>((at.y() - grid.origin.y()) / grid.side), 0, grid.rows - 1);
  return Cell(row, grid.calledOf(column));
}

void ConfusionView::mousePressEvent(QMouseEvent* event) {
  const auto cell = cellAt(event->position());
  if (!cell || event->button() != Qt::LeftButton) return;
  choose(cell);
  emit cellClicked(cell->first, cell->second);
}

void ConfusionView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const auto cell = cellAt(event->position())) emit cellOpened(cell->first, cell->second);
}

void ConfusionView::mouseMoveEvent(QMouseEvent* event) {
  const auto cell = cellAt(event->position());
  if (cell == hovered_) return;
  hovered_ = cell;
  viewport()->update();
}

void ConfusionView::wheelEvent(QWheelEvent* event) {
  if (!(event->modifiers() & Qt::ControlModifier)) return QAbstractScrollArea::wheelEvent(event);
  setSide(side() * std::pow(kConfusionViewZoomStep, event->angleDelta().y() / 120.0));
  event->accept();
}

void ConfusionView::moveChosen(int columns, int rows) {
  const ConfusionGrid grid = confusionGrid(*matrix_, areaOf(*viewport()), font(), side());
  if (grid.rows == 0) return;
  const Cell from = chosen_.value_or(Cell(0, 0));
  hovered_.reset();
  const int row = std::clamp(from.first + (chosen_ ? rows : 0), 0, grid.rows - 1);
  const int column =
      std::clamp(grid.columnOf(from.second) + (chosen_ ? columns : 0), 0, grid.columns - 1);
  choose(Cell(row, grid.calledOf(column)));
}

void ConfusionView::keyPressEvent(QKeyEvent* event) {
  if (!matrix_) return QWidget::keyPressEvent(event);
  switch (event->key()) {
    case Qt::Key_Left:
      return moveChosen(-1, 0);
    case Qt::Key_Right:
      return moveChosen(1, 0);
    case Qt::Key_Up:
      return moveChosen(0, -1);
    case Qt::Key_Down:
      return moveChosen(0, 1);
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (chosen_) emit cellOpened(chosen_->first, chosen_->second);
      return;
    case Qt::Key_Plus:
      return setSide(side() * kConfusionViewZoomStep);
    case Qt::Key_Minus:
      return setSide(side() / kConfusionViewZoomStep);
    case Qt::Key_0:
      return showAll();
    default:
      return QWidget::keyPressEvent(event);
  }
}

bool ConfusionView::event(QEvent* event) {
  // Keys that navigate in the matrix must not trigger shortcuts of the playback.
  if (event->type() == QEvent::ShortcutOverride) {
    switch (static_cast<QKeyEvent*>(event)->key()) {
      case Qt::Key_Left:
      case Qt::Key_Right:
      case Qt::Key_Up:
      case Qt::Key_Down:
      case Qt::Key_Return:
      case Qt::Key_Enter:
      case Qt::Key_Plus:
      case Qt::Key_Minus:
      case Qt::Key_0:
        event->accept();
        return true;
      default:
        break;
    }
  }
  return QAbstractScrollArea::event(event);
}

bool ConfusionView::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::Leave && hovered_) {
    hovered_.reset();
    viewport()->update();
  }
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (const auto cell = cellAt(help->pos()))
      QToolTip::showText(help->globalPos(), textOf(*cell), this);
    else
      QToolTip::hideText();
    return true;
  }
  return QAbstractScrollArea::viewportEvent(event);
}

}  // namespace palpate::gui
