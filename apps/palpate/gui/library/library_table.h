// The table of the library: every key that moves in it moves in it, and nothing else in the window.
#pragma once

#include <QTableView>

namespace palpate::gui {

class LibraryTable : public QTableView {
  Q_OBJECT
 public:
  // `model`: of the columns of LibraryModel.
  explicit LibraryTable(QAbstractItemModel* model, QWidget* parent = nullptr);
  // The chosen rows with the heading of the columns that are seen, for a spreadsheet.
  void copyRows();

 signals:
  void openRequested();
  void compareAsked();
  void searchAsked();

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace palpate::gui
