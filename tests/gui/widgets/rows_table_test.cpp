#include "gui/widgets/rows_table.h"

#include <QStandardItemModel>
#include <QTest>

#include <gtest/gtest.h>

namespace palpate::gui::rows_table_test {
namespace {

class RowsTableTest : public ::testing::Test {
 protected:
  RowsTableTest() { table_.setModel(&model_); }
  static std::vector<int> rowsOf(const QModelIndexList& indexes) {
    std::vector<int> rows;
    for (const QModelIndex& index : indexes) rows.push_back(index.row());
    return rows;
  }

  QStandardItemModel model_{4, 3};
  RowsTable table_;
};

TEST_F(RowsTableTest, HomeAndEndMoveToTheFirstAndLastRow) {
  table_.setCurrentIndex(model_.index(1, 2));
  QTest::keyClick(&table_, Qt::Key_End);
  EXPECT_EQ(table_.currentIndex(), model_.index(3, 2));
  QTest::keyClick(&table_, Qt::Key_Home);
  EXPECT_EQ(table_.currentIndex(), model_.index(0, 2));
  QTest::keyClick(&table_, Qt::Key_End, Qt::ShiftModifier);
  EXPECT_EQ(rowsOf(table_.chosenRows()), (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(RowsTableTest, WhatIsChosenComesFromAboveElseAllRows) {
  EXPECT_TRUE(table_.chosenRows().isEmpty());
  EXPECT_EQ(rowsOf(table_.chosenOrAllRows()), (std::vector<int>{0, 1, 2, 3}));
  for (const int row : {2, 0})
    table_.selectionModel()->select(model_.index(row, 1),
                                    QItemSelectionModel::Select | QItemSelectionModel::Rows);
  EXPECT_EQ(rowsOf(table_.chosenRows()), (std::vector<int>{0, 2}));
  EXPECT_EQ(rowsOf(table_.chosenOrAllRows()), (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace palpate::gui::rows_table_test
