// The table widget of the library. Keys that navigate in the table are not passed on as shortcuts
// of the window.
#pragma once

#include <QTableView>

namespace palpate::gui {

class LibraryTable : public QTableView {
  Q_OBJECT
 public:
  // `model` has the columns of LibraryModel.
  explicit LibraryTable(QAbstractItemModel* model, QWidget* parent = nullptr);
  // Copies the chosen rows with the headings of the visible columns, for a spreadsheet.
  void copyRows();

 signals:
  void openRequested();
  void compareRequested();
  void searchRequested();

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace palpate::gui
