// A table whose rows are chosen as a whole, and copied or opened. The keys that move in it are not
// passed on as shortcuts of the window; Tab leaves it.
#pragma once

#include <QTableView>

namespace palpate::gui {

class RowsTable : public QTableView {
  Q_OBJECT
 public:
  explicit RowsTable(QWidget* parent = nullptr);
  // The chosen rows from above, as indexes of their first cells.
  QModelIndexList chosenRows() const;
  // The same, or all rows where none is chosen.
  QModelIndexList chosenOrAllRows() const;

 protected:
  // Home and End move to the first and last row, not column.
  QModelIndex moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) override;
};

}  // namespace palpate::gui
