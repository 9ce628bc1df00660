#include "gui/widgets/rows_table.h"

#include <QHeaderView>
#include <algorithm>

#include "gui/widgets/keep_keys.h"

namespace palpate::gui {

RowsTable::RowsTable(QWidget* parent) : QTableView(parent) {
  constexpr int kAroundText = 8;  // above and below the text of a row together [px]
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setTabKeyNavigation(false);
  setShowGrid(false);
  setWordWrap(false);
  // Names of one object differ at their ends.
  setTextElideMode(Qt::ElideMiddle);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kAroundText);
  horizontalHeader()->setHighlightSections(false);
  keepKeys(*this, kRowKeys);
  keepKeys(*this, QKeySequence::SelectAll);
}

QModelIndexList RowsTable::chosenRows() const {
  QModelIndexList rows = selectionModel()->selectedRows();
  std::sort(rows.begin(), rows.end());
  return rows;
}

QModelIndexList RowsTable::chosenOrAllRows() const {
  QModelIndexList rows = chosenRows();
  if (rows.isEmpty())
    for (int row = 0; row < model()->rowCount(); ++row) rows.append(model()->index(row, 0));
  return rows;
}

QModelIndex RowsTable::moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) {
  if (action != MoveHome && action != MoveEnd) return QTableView::moveCursor(action, modifiers);
  return model()->index(action == MoveHome ? 0 : model()->rowCount() - 1,
                        std::max(0, currentIndex().column()));
}

}  // namespace palpate::gui
