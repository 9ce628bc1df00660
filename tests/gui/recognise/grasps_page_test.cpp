// The page Grasps of the dock Recognise by itself: table, scatter plot, and what is left out.
#include "gui/recognise/grasps_page.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QPushButton>
#include <QSignalSpy>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <map>

#include <palpate/recognition/plateau_features.h>

#include "gui/chart/plot.h"
#include "gui/picture/picture_export.h"
#include "gui/recognise/feature_scatter.h"
#include "gui/recognise/grasp_table_model.h"
#include "gui/recognise/recognise_fixture.h"
#include "gui/recognise/training_page.h"
#include "gui/testing/layout_faults.h"
#include "gui/testing/make_active.h"
#include "gui/widgets/figures_table.h"

namespace palpate::gui::grasps_page_test {
namespace {

class GraspsPageTest : public RecognisePanelTest {
 protected:
  GraspsPageTest() {
    panel_->teaching().setFolder(teach({"ball", "pen"}, 4));
    panel_->show();
    panel_->showPage("Grasps");
    settle();
  }
  GraspsPage& page() { return panel_->grasps(); }
  QTableView& table() { return page().table(); }
  QString cell(int row, int column) {
    return table().model()->index(row, column).data().toString();
  }
  void choose(const QString& object, int number) {
    page().choose(dynamic_cast<const QSortFilterProxyModel&>(*table().model())
                      .mapToSource(table().model()->index(rowOf(object, number), 0))
                      .row());
  }
  // Row of the table with this object and number.
  int rowOf(const QString& object, int number) {
    for (int row = 0; row < table().model()->rowCount(); ++row)
      if (cell(row, GraspTableModel::kObject) == object &&
          cell(row, GraspTableModel::kNumber) == QString::number(number))
        return row;
    throw std::runtime_error("no such grasp");
  }
};

TEST_F(GraspsPageTest, ListsEachGraspWithItsFeatures) {
  ASSERT_TRUE(page().shown());
  ASSERT_EQ(table().model()->rowCount(), 8);
  ASSERT_EQ(table().model()->columnCount(),
            GraspTableModel::kFirstFeature + static_cast<int>(plateauFeatureNames().size()));
  const auto header = [&](int column) {
    return table().model()->headerData(column, Qt::Horizontal).toString();
  };
  EXPECT_EQ(header(GraspTableModel::kFirstFeature), "size_z");
  EXPECT_EQ(header(GraspTableModel::kFirstFeature + 1), "ln_major");
  EXPECT_EQ(cell(rowOf("pen", 3), GraspTableModel::kRecording), "pen.palpate");
  EXPECT_TRUE(cell(0, GraspTableModel::kTime).startsWith("20"));
  // Sorted by a figure, not by its text.
  const int column = GraspTableModel::kFirstFeature;
  table().sortByColumn(column, Qt::DescendingOrder);
  for (int row = 1; row < 8; ++row)
    EXPECT_GE(cell(row - 1, column).toDouble(), cell(row, column).toDouble());
  EXPECT_EQ(cell(0, GraspTableModel::kObject), "ball") << "the larger one";
  EXPECT_TRUE(layoutFaults(page()).isEmpty()) << layoutFaults(page()).join("\n").toStdString();
}

TEST_F(GraspsPageTest, TableAndPlotChooseTheSameGrasp) {
  FeatureScatter& scatter = page().scatter();
  ASSERT_EQ(scatter.names().count(), 2);
  table().sortByColumn(GraspTableModel::kNumber, Qt::DescendingOrder);
  choose("pen", 2);
  const FeatureRow& pen =
      panel_->teaching().table()->rows.at(static_cast<std::size_t>(scatter.chosen()));
  EXPECT_EQ(pen.className, "pen");
  EXPECT_EQ(pen.number, 2u);
  scatter.plot().replot(QCustomPlot::rpImmediateRefresh);
  const QPoint at = scatter.pointOf(5).toPoint();
  ASSERT_TRUE(scatter.rowAt(at));
  const FeatureRow& other =
      panel_->teaching().table()->rows.at(static_cast<std::size_t>(*scatter.rowAt(at)));
  QTest::mouseClick(&scatter.plot(), Qt::LeftButton, {}, at);
  const QModelIndexList rows = table().selectionModel()->selectedRows();
  ASSERT_EQ(rows.size(), 1);
  EXPECT_EQ(rows.front().data().toString().toStdString(), other.className);
  EXPECT_EQ(cell(rows.front().row(), GraspTableModel::kNumber).toStdString(),
            std::to_string(other.number));
  EXPECT_TRUE(scatter.tipOf(5).contains("pen: pen.palpate, grasp 2"))
      << scatter.tipOf(5).toStdString();
  EXPECT_FALSE(scatter.rowAt(QPointF(-100, -100)));
  // Also while Shift is held, and nothing was chosen before.
  table().clearSelection();
  QTest::mouseClick(&scatter.plot(), Qt::LeftButton, Qt::ShiftModifier, at);
  EXPECT_EQ(table().selectionModel()->selectedRows(), rows);
}

TEST_F(GraspsPageTest, AxesAreChosenAndKept) {
  auto* y = find<QComboBox>("scatterY");
  const int index = y->findText("closing_mm in mm");
  ASSERT_GE(index, 0);
  y->setCurrentIndex(index);
  emit y->activated(index);
  EXPECT_EQ(page().scatter().plot().yAxis->label(), "closing_mm in mm");
  panel_ = std::make_unique<RecognisePanel>(settings_, testing::dataFolder(), ask_);
  panel_->show();
  settle();
  EXPECT_EQ(find<QComboBox>("scatterY")->currentText(), "closing_mm in mm");
}

TEST_F(GraspsPageTest, WhatIsLeftOutDoesNotTrain) {
  EXPECT_FALSE(find<QPushButton>("graspsUndo")->isEnabled());
  choose("pen", 1);
  auto* leave = find<QPushButton>("graspsLeaveOut");
  leave->click();
  EXPECT_EQ(leave->text(), "Take in");
  EXPECT_EQ(find<QLabel>("graspsState")->text(), "8 grasps, 1 left out");
  const QModelIndex pen = table().model()->index(rowOf("pen", 1), GraspTableModel::kObject);
  EXPECT_EQ(pen.data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
  EXPECT_EQ(find<FiguresTable>("teachObjects")->item(1, 1)->text(), "3");
  // By its mark.
  const QModelIndex ball = table().model()->index(rowOf("ball", 4), GraspTableModel::kObject);
  EXPECT_TRUE(table().model()->setData(ball, Qt::Unchecked, Qt::CheckStateRole));
  const auto out = folder_ / "mine.json";
  ask_.newFiles = {pathText(out)};
  find<QPushButton>("teachTrain")->click();
  settle();
  const TrainedModel model = loadModel(out);
  std::map<std::string, std::size_t> grasps;
  for (const ModelInput& input : model.inputs) grasps[input.className] += input.grasps;
  EXPECT_EQ(grasps, (std::map<std::string, std::size_t>{{"ball", 3}, {"pen", 3}}));
  EXPECT_EQ(model.options.at("left_out").size(), 2u);
  find<QPushButton>("checkNow")->click();
  settle();
  EXPECT_EQ(panel_->teaching().checked()->samples.numSamples(), 6u);
  // Kept for this folder, and taken back step by step.
  TrainingController later(settings_);
  EXPECT_EQ(later.leftOut(), panel_->teaching().leftOut());
  later.setFolder(folder_ / "another");
  EXPECT_TRUE(later.leftOut().empty());
  find<QPushButton>("graspsUndo")->click();
  find<QPushButton>("graspsUndo")->click();
  EXPECT_TRUE(panel_->teaching().leftOut().empty());
  EXPECT_FALSE(find<QPushButton>("graspsUndo")->isEnabled());
}

// With the focus anywhere on the page; a window's own action of these keys is not triggered.
TEST_F(GraspsPageTest, KeysUndoAndRedoLeavingOut) {
  QAction ofTheWindow;
  ofTheWindow.setShortcuts({QKeySequence("Ctrl+Z"), QKeySequence("Ctrl+Shift+Z")});
  panel_->addAction(&ofTheWindow);
  QSignalSpy triggered(&ofTheWindow, &QAction::triggered);
  makeActive(*panel_);
  const auto numOut = [&] { return panel_->teaching().leftOut().size(); };
  for (const int number : {1, 2}) {
    choose("pen", number);
    QTest::keyClick(&table(), Qt::Key_Space);
  }
  ASSERT_EQ(numOut(), 2u);
  QTest::keyClick(&table(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(numOut(), 1u);
  QTest::keyClick(find<QPushButton>("graspsCopy"), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(numOut(), 0u);
  QTest::keyClick(&table(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(numOut(), 0u) << "nothing is left to undo";
  const auto redo = [&] {
    QTest::keyClick(
        find<QPushButton>("graspsCopy"), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  };
  redo();
  EXPECT_EQ(numOut(), 1u);
  redo();
  EXPECT_EQ(numOut(), 2u);
  EXPECT_EQ(triggered.count(), 0);
  // Elsewhere the keys are those of the window.
  QTest::keyClick(panel_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(triggered.count(), 1);
  EXPECT_EQ(numOut(), 2u);
  // After another change there is nothing to do again.
  QTest::keyClick(&table(), Qt::Key_Z, Qt::ControlModifier);
  choose("ball", 1);
  QTest::keyClick(&table(), Qt::Key_Space);
  redo();
  EXPECT_EQ(numOut(), 2u);
}

// The picture names the objects by the points that it draws, also on white paper.
TEST_F(GraspsPageTest, ThePictureHasALegendOfTheObjects) {
  choose("pen", 2);
  find<QPushButton>("graspsLeaveOut")->click();
  for (const bool forPrint : {false, true}) {
    PictureLook look;
    look.size = {600, 420};
    look.forPrint = forPrint;
    const std::string text = pictureBytes(
                                 ImageFormat::kSvg,
                                 [&](QPainter& painter) { page().paint(painter, look); },
                                 {.size = look.size},
                                 "a.svg")
                                 .toStdString();
    for (const char* name : {">ball<", ">pen<", ">left out<"})
      EXPECT_NE(text.find(name), std::string::npos) << name << "\n" << text;
  }
}

TEST_F(GraspsPageTest, RowsAreCopiedExportedAndOpened) {
  choose("pen", 2);
  find<QPushButton>("graspsCopy")->click();
  const QStringList lines = QApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_TRUE(lines[0].startsWith("object\trecording\tgrasp\tbegin\tend\ttime\tquality\t"))
      << lines[0].toStdString();
  EXPECT_TRUE(lines[0].contains("\tsize_z\tln_major\t")) << lines[0].toStdString();
  EXPECT_TRUE(lines[1].startsWith("pen\t")) << lines[1].toStdString();
  const auto tables = page().tables();
  ASSERT_EQ(tables.size(), 1u);
  const TextTable text = tables.front().make();
  EXPECT_EQ(text.numRows, 8u);
  EXPECT_EQ(text.row(0).size(), text.header.size());
  std::filesystem::path file;
  std::size_t begin = 0, end = 0;
  QObject::connect(&page(), &GraspsPage::graspAsked, [&](const auto& path, auto first, auto last) {
    file = path;
    begin = first;
    end = last;
  });
  const int row = rowOf("pen", 2);
  emit table().doubleClicked(table().model()->index(row, 0));
  EXPECT_EQ(file.filename(), "pen.palpate");
  EXPECT_LT(begin, end);
  file.clear();
  QTest::keyClick(&table(), Qt::Key_Return);
  EXPECT_EQ(file.filename(), "pen.palpate") << "by the keyboard, too";
  QTest::keyClick(&table(), Qt::Key_Space);
  EXPECT_EQ(panel_->teaching().leftOut().size(), 1u);
}

}  // namespace
}  // namespace palpate::gui::grasps_page_test
