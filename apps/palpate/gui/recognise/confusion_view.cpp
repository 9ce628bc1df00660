#include "gui/recognise/confusion_view.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

namespace {

constexpr double kConfusionViewZoomStep = 1.15;

class ConfusionNames : public QHeaderView {
 public:
  ConfusionNames(Qt::Orientation orientation, ConfusionView* view)
      : QHeaderView(orientation, view), view_(*view) {
    setMinimumSectionSize(1);
    setSectionResizeMode(Fixed);
  }

 protected:
  // The marked name may be larger than its cell: it is painted over its neighbours.
  void paintEvent(QPaintEvent* event) override {
    QHeaderView::paintEvent(event);
    const int section = markedSection();
    if (section < 0) return;
    const bool across = orientation() == Qt::Horizontal;
    const int from = sectionViewportPosition(section), size = sectionSize(section);
    QPainter painter(viewport());
    paintSection(
        &painter, across ? QRect(from, 0, size, height()) : QRect(0, from, width(), size), section);
  }

  void paintSection(QPainter* painter, const QRect& rect, int section) const override {
    if (!view_.matrix()) return;
    painter->save();
    QRectF where = rect;
    if (orientation() == Qt::Horizontal) {
      painter->translate(rect.left(), height());
      painter->rotate(-90.0);
      where = QRectF(0, 0, height() - view_.fontMetrics().height(), rect.width());
    }
    paintConfusionName(*painter,
                       where,
                       model()->headerData(section, orientation()).toString(),
                       confusionNameFont(view_.font(), view_.side()),
                       orientation() == Qt::Horizontal ? Qt::AlignLeft : Qt::AlignRight,
                       section == model()->rowCount() ? colorsOf().muted : colorsOf().text,
                       section == markedSection());
    painter->restore();
  }

 private:
  int markedSection() const {
    const QModelIndex marked = view_.marked();
    return orientation() == Qt::Horizontal ? marked.column() : marked.row();
  }

  ConfusionView& view_;
};

class ConfusionCells : public QStyledItemDelegate {
 public:
  explicit ConfusionCells(ConfusionView* view) : QStyledItemDelegate(view), view_(*view) {}

  void paint(QPainter* painter,
             const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const QModelIndex marked = view_.marked();
    painter->save();
    paintConfusionCell(*painter,
                       option.rect.adjusted(0, 0, -1, -1),
                       *view_.matrix(),
                       view_.cellOf(index),
                       colorsOf(),
                       marked.row() == index.row() || marked.column() == index.column());
    painter->setBrush(Qt::NoBrush);
    const bool isChosen = option.state & QStyle::State_Selected;
    if (isChosen || marked == index) {
      painter->setPen(QPen(isChosen ? colorsOf().text : colorsOf().muted, isChosen ? 2 : 1));
      painter->drawRect(option.rect.adjusted(1, 1, -2, -2));
    }
    painter->restore();
  }

 private:
  ConfusionView& view_;
};

}  // namespace

ConfusionView::ConfusionView(QWidget* parent) : QTableWidget(parent) {
  setFrameShape(QFrame::NoFrame);
  setShowGrid(false);
  setEditTriggers(NoEditTriggers);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setSelectionMode(SingleSelection);
  setTabKeyNavigation(false);
  setCornerButtonEnabled(false);
  setHorizontalScrollMode(ScrollPerPixel);
  setVerticalScrollMode(ScrollPerPixel);
  setMouseTracking(true);
  setHorizontalHeader(new ConfusionNames(Qt::Horizontal, this));
  setVerticalHeader(new ConfusionNames(Qt::Vertical, this));
  setItemDelegate(new ConfusionCells(this));
  directions_ = makeLabel(this, {}, "muted", "was ↓  called →");
  directions_->move(0, 0);
  keepKeys(*this, {Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down});
  keepKeys(*this, {Qt::Key_Return, Qt::Key_Enter}, [this] {
    if (const auto cell = chosen()) emit cellOpened(cell->first, cell->second);
  });
  // On some keyboards the plus needs Shift.
  keepKeys(*this, {Qt::Key_Plus, Qt::SHIFT | Qt::Key_Plus}, [this] {
    setSide(side() * kConfusionViewZoomStep);
  });
  keepKeys(*this, {Qt::Key_Minus}, [this] { setSide(side() / kConfusionViewZoomStep); });
  keepKeys(*this, {Qt::Key_0}, [this] { showAll(); });
  connect(this, &QTableWidget::entered, this, &ConfusionView::hover);
  connect(this, &QTableWidget::viewportEntered, this, [this] { hover({}); });
  connect(selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    hover({});
    if (const auto cell = chosen()) emit cellChosen(cell->first, cell->second);
  });
  connect(this, &QTableWidget::doubleClicked, this, [this](const QModelIndex& index) {
    emit cellOpened(cellOf(index).first, cellOf(index).second);
  });
  fitToText(*this, [this] { layOut(); });
}

ConfusionCell ConfusionView::cellOf(const QModelIndex& index) const {
  return {index.row(), index.column() < rowCount() ? index.column() : ConfusionMatrix::kUnknown};
}

QModelIndex ConfusionView::indexOf(const Cell& cell) const {
  return model()->index(cell.first,
                        cell.second == ConfusionMatrix::kUnknown ? rowCount() : cell.second);
}

void ConfusionView::setMatrix(std::optional<ConfusionMatrix> matrix) {
  matrix_ = std::move(matrix);
  hovered_ = {};
  side_.reset();
  clear();
  setRowCount(matrix_ ? static_cast<int>(matrix_->classes().size()) : 0);
  setColumnCount(matrix_ ? confusionColumns(*matrix_) : 0);
  directions_->setVisible(rowCount() > 0);
  QStringList names;
  for (int column = 0; column < columnCount(); ++column) {
    names << confusionName(*matrix_, cellOf(model()->index(0, column)).second);
    for (int row = 0; row < rowCount(); ++row) {
      const QString count =
          QString::number(matrix_->at(row, cellOf(model()->index(row, column)).second));
      auto* item = new QTableWidgetItem(count);
      item->setToolTip(confusionName(*matrix_, row) + " called " + names.last() + ": " + count);
      item->setData(Qt::AccessibleTextRole, item->toolTip());
      setItem(row, column, item);
    }
  }
  setHorizontalHeaderLabels(names);
  setVerticalHeaderLabels(names);
  layOut();
}

std::optional<ConfusionCell> ConfusionView::chosen() const {
  const QModelIndex index = chosenIndex();
  return index.isValid() ? std::optional(cellOf(index)) : std::nullopt;
}

void ConfusionView::choose(std::optional<Cell> cell) {
  setCurrentIndex(cell ? indexOf(*cell) : QModelIndex());
  scrollTo(currentIndex());
}

QModelIndex ConfusionView::marked() const { return hovered_.isValid() ? hovered_ : chosenIndex(); }

void ConfusionView::hover(const QModelIndex& index) {
  hovered_ = index;
  viewport()->update();
  horizontalHeader()->viewport()->update();
  verticalHeader()->viewport()->update();
}

double ConfusionView::side() const {
  if (!matrix_) return 0.0;
  const double fits = confusionGrid(*matrix_, rect(), font()).side;
  return side_ ? std::clamp(*side_, std::min(fits, kReadableConfusionSide), kLargestConfusionSide)
               : std::max(fits, kReadableConfusionSide);
}

void ConfusionView::setSide(std::optional<double> side) {
  side_ = side;
  if (side_) side_ = this->side();
  layOut();
  scrollTo(chosenIndex());
}

void ConfusionView::showAll() { setSide(kSmallestConfusionSide); }

QRectF ConfusionView::rectOf(const Cell& cell) const {
  return matrix_ ? visualRect(indexOf(cell)).intersected(viewport()->rect()) : QRect();
}

void ConfusionView::layOut() {
  if (rowCount() == 0) return;
  const QRectF cells = confusionGrid(*matrix_, rect(), font(), side()).window;
  horizontalHeader()->setFixedHeight(static_cast<int>(cells.top()));
  verticalHeader()->setFixedWidth(static_cast<int>(cells.left()));
  for (QHeaderView* header : {horizontalHeader(), verticalHeader()})
    header->setDefaultSectionSize(static_cast<int>(side()));
  updateGeometries();
}

void ConfusionView::resizeEvent(QResizeEvent* event) {
  QTableWidget::resizeEvent(event);
  layOut();
}

void ConfusionView::wheelEvent(QWheelEvent* event) {
  if (!(event->modifiers() & Qt::ControlModifier)) return QTableWidget::wheelEvent(event);
  setSide(side() * std::pow(kConfusionViewZoomStep, event->angleDelta().y() / 120.0));
  event->accept();
}

bool ConfusionView::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::Leave) hover({});
  return QTableWidget::viewportEvent(event);
}

}  // namespace palpate::gui
