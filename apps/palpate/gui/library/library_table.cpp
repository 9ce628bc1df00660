#include "gui/library/library_table.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <algorithm>

namespace palpate::gui {
namespace {

bool isOwnKey(const QKeyEvent& key) {
  if (key.matches(QKeySequence::Copy)) return true;
  if ((key.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier | Qt::ControlModifier)) != 0)
    return false;
  switch (key.key()) {
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Home:
    case Qt::Key_End:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Slash:
      return true;
    case Qt::Key_A:
    case Qt::Key_F:
      return key.modifiers() == Qt::ControlModifier;
    default:
      return false;
  }
}

}  // namespace

LibraryTable::LibraryTable(QAbstractItemModel* model, QWidget* parent) : QTableView(parent) {
  setObjectName("libraryTable");
  setModel(model);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  // Tab leaves the table.
  setTabKeyNavigation(false);
  setDragEnabled(true);
  setShowGrid(false);
  // Names of one object differ at their ends.
  setTextElideMode(Qt::ElideMiddle);
  setWordWrap(false);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  setContextMenuPolicy(Qt::CustomContextMenu);
  setSortingEnabled(true);
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  QHeaderView* header = horizontalHeader();
  header->setHighlightSections(false);
  header->setSectionsMovable(true);
  header->setStretchLastSection(true);
  header->setMinimumSectionSize(36);
  constexpr int kLetters[] = {26, 13, 17, 14, 12, 8, 18, 18, 18};
  constexpr int kPadding = 24;  // [px] around the text of a cell
  for (int column = 0; column < model->columnCount(); ++column)
    header->resizeSection(column,
                          kLetters[column] * fontMetrics().horizontalAdvance('0') + kPadding);
}

bool LibraryTable::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && isOwnKey(*static_cast<QKeyEvent*>(event))) {
    event->accept();
    return true;
  }
  return QTableView::event(event);
}

void LibraryTable::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy)) {
    copyRows();
    return;
  }
  const bool control = (event->modifiers() & Qt::ControlModifier) != 0;
  switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (control)
        emit compareRequested();
      else
        emit openRequested();
      return;
    case Qt::Key_Slash:
      emit searchRequested();
      return;
    case Qt::Key_F:
      if (control) {
        emit searchRequested();
        return;
      }
      break;
    case Qt::Key_Home:
    case Qt::Key_End: {
      // Moves to the first or last row, not column.
      const int row = event->key() == Qt::Key_Home ? 0 : model()->rowCount() - 1;
      if (row < 0) return;
      if ((event->modifiers() & Qt::ShiftModifier) == 0) selectRow(row);
      scrollTo(model()->index(row, 0));
      return;
    }
    default:
      break;
  }
  QTableView::keyPressEvent(event);
}

void LibraryTable::copyRows() {
  QModelIndexList rows = selectionModel()->selectedRows();
  if (rows.isEmpty()) return;
  std::sort(
      rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.row() < b.row(); });
  QStringList lines;
  const auto addLine = [&](auto cell) {
    QStringList cells;
    for (int at = 0; at < model()->columnCount(); ++at) {
      const int column = horizontalHeader()->logicalIndex(at);
      if (!isColumnHidden(column)) cells.append(cell(column).toString().simplified());
    }
    lines.append(cells.join('\t'));
  };
  addLine([&](int column) { return model()->headerData(column, Qt::Horizontal); });
  for (const QModelIndex& row : rows)
    addLine([&](int column) { return row.siblingAtColumn(column).data(); });
  QApplication::clipboard()->setText(lines.join('\n') + '\n');
}

}  // namespace palpate::gui
