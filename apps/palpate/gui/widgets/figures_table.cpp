#include "gui/widgets/figures_table.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <numeric>
#include <utility>

#include "gui/widgets/keep_keys.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kDetailRole = Qt::UserRole + 1;
constexpr int kWarningRole = Qt::UserRole + 2;
constexpr int kFiguresTablePadding = 6;  // [px] beside a figure
constexpr int kIcon = 16;                // [px] side of an icon
constexpr int kFiguresTableAir = 5;      // [px] above and below
constexpr int kLongestWhole = 150;       // [px] of a text; a longer one may be shortened
// Further rows are reached by scrolling.
constexpr int kFiguresTableMostRowsSeen = 6;

class FigureDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter,
             const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const ThemeColors& colors = colorsOf();
    if (option.state & QStyle::State_Selected) painter->fillRect(option.rect, colors.accentSoft);
    painter->save();
    painter->setPen(colors.border);
    painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
    const QString text = index.data().toString(), detail = index.data(kDetailRole).toString();
    const QRect room = option.rect.adjusted(
        kFiguresTablePadding, kFiguresTableAir - 1, -kFiguresTablePadding, -kFiguresTableAir);
    const int line = option.fontMetrics.height();
    const int side = index.data(Qt::TextAlignmentRole).toInt() & Qt::AlignHorizontal_Mask;
    const auto icon = index.data(Qt::DecorationRole).value<QIcon>();
    const int aside = icon.isNull() ? 0 : kIcon + kFiguresTablePadding;
    if (!icon.isNull())
      icon.paint(painter, QRect(room.left(), room.center().y() - kIcon / 2, kIcon, kIcon));
    const auto draw = [&](const QString& words, int top) {
      painter->drawText(QRect(room.left() + aside, top, room.width() - aside, line),
                        side | Qt::AlignVCenter,
                        option.fontMetrics.elidedText(words, Qt::ElideRight, room.width() - aside));
    };
    const int top = detail.isEmpty() ? room.center().y() - line / 2 : room.top();
    painter->setFont(option.font);
    painter->setPen(index.data(kWarningRole).toBool() ? colors.warning : colors.text);
    draw(text, top);
    painter->setPen(colors.muted);
    draw(detail, top + line);
    painter->restore();
  }
};

}  // namespace

FiguresTable::FiguresTable(const std::vector<FigureColumn>& columns, QWidget* parent)
    : QTableWidget(0, static_cast<int>(columns.size()), parent) {
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setTabKeyNavigation(false);
  setShowGrid(false);
  setWordWrap(false);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  setItemDelegate(new FigureDelegate(this));
  verticalHeader()->hide();
  QHeaderView* header = horizontalHeader();
  header->setHighlightSections(false);
  header->setMinimumSectionSize(24);
  header->setDefaultAlignment(Qt::AlignRight | Qt::AlignVCenter);
  for (int i = 0; i < columnCount(); ++i) {
    const FigureColumn& column = columns[static_cast<std::size_t>(i)];
    auto* item = new QTableWidgetItem(column.name);
    item->setToolTip(column.tip);
    item->setTextAlignment((column.words ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    setHorizontalHeaderItem(i, item);
    letters_.push_back(column.letters);
  }
  keepKeys(*this, kRowKeys);
  fitToText(*this, [this] { fitTextSize(); });
  connect(this, &QTableWidget::itemSelectionChanged, this, [this] {
    if (const int row = chosenRow(); row >= 0) emit rowChosen(row);
  });
}

void FiguresTable::setRows(const std::vector<std::vector<FigureCell>>& rows) {
  const bool sameCount = rowCount() == static_cast<int>(rows.size());
  const QSignalBlocker blocker(this);
  if (!sameCount) clearSelection();
  setRowCount(static_cast<int>(rows.size()));
  for (int y = 0; y < rowCount(); ++y)
    for (int x = 0; x < columnCount(); ++x) {
      const FigureCell& cell = rows[static_cast<std::size_t>(y)].at(static_cast<std::size_t>(x));
      QTableWidgetItem* item = this->item(y, x);
      if (item == nullptr) {
        item = new QTableWidgetItem;
        item->setTextAlignment(Qt::Alignment(horizontalHeaderItem(x)->textAlignment()));
        setItem(y, x, item);
      }
      item->setText(cell.text);
      item->setData(kDetailRole, cell.detail);
      item->setData(kWarningRole, cell.warning);
      item->setToolTip(cell.tip);
      item->setIcon(cell.icon);
    }
  const std::vector<int> before = std::exchange(needed_, neededWidths());
  if (needed_ != before) fitColumns();
  if (!sameCount || needed_ != before) updateGeometry();
}

std::vector<int> FiguresTable::neededWidths() const {
  std::vector<int> widths;
  const QFontMetrics metrics = fontMetrics();
  for (int x = 0; x < columnCount(); ++x) {
    int width =
        horizontalHeader()->fontMetrics().horizontalAdvance(horizontalHeaderItem(x)->text());
    for (int y = 0; y < rowCount(); ++y) {
      const QTableWidgetItem* cell = item(y, x);
      // Names of files and the like are shortened, and their tool tips have them in full.
      const int letters = std::max(metrics.horizontalAdvance(cell->text()),
                                   metrics.horizontalAdvance(cell->data(kDetailRole).toString()));
      const int icon = cell->icon().isNull() ? 0 : kIcon + kFiguresTablePadding;
      width = std::max(width, std::min(letters + icon, kLongestWhole));
    }
    widths.push_back(width + 2 * kFiguresTablePadding + 1);
  }
  return widths;
}

void FiguresTable::setSingleLine() {
  linesOfRow_ = 1;
  fitTextSize();
}

void FiguresTable::fitTextSize() {
  verticalHeader()->setDefaultSectionSize(linesOfRow_ * fontMetrics().height() +
                                          2 * kFiguresTableAir);
  widths_.clear();
  for (const int letters : letters_)
    widths_.push_back(letters * fontMetrics().horizontalAdvance('0') + 2 * kFiguresTablePadding);
  needed_ = neededWidths();
  fitColumns();
  updateGeometry();
}

void FiguresTable::fitColumns() {
  const int room = viewport()->width();
  const std::size_t last = needed_.size() - 1;
  int wanted = 0;
  for (std::size_t i = 0; i < last; ++i) wanted += std::max(0, widths_[i] - needed_[i]);
  // What is left when each column has what it needs.
  const int spare = std::max(0, room - std::accumulate(needed_.begin(), needed_.end(), 0));
  const double share = wanted > 0 ? std::min(1.0, static_cast<double>(spare) / wanted) : 0.0;
  int used = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const int more = static_cast<int>(share * std::max(0, widths_[i] - needed_[i]));
    horizontalHeader()->resizeSection(static_cast<int>(i), needed_[i] + more);
    used += needed_[i] + more;
  }
  horizontalHeader()->resizeSection(static_cast<int>(last), std::max(room - used, needed_[last]));
}

void FiguresTable::resizeEvent(QResizeEvent* event) {
  QTableWidget::resizeEvent(event);
  fitColumns();
}

int FiguresTable::chosenRow() const {
  const QModelIndexList rows = selectionModel()->selectedRows();
  return rows.isEmpty() ? -1 : rows.front().row();
}

QSize FiguresTable::sizeHint() const {
  const int rows = std::clamp(rowCount(), 1, kFiguresTableMostRowsSeen);
  return {
      420,
      horizontalHeader()->sizeHint().height() + rows * verticalHeader()->defaultSectionSize() + 2};
}

QSize FiguresTable::minimumSizeHint() const {
  // A table that doesn't scroll sideways shows all of its columns.
  const int width = horizontalScrollBarPolicy() == Qt::ScrollBarAlwaysOff
                        ? std::accumulate(needed_.begin(), needed_.end(), 0)
                        : 0;
  return {std::max(200, width),
          horizontalHeader()->sizeHint().height() + verticalHeader()->defaultSectionSize()};
}

}  // namespace palpate::gui
