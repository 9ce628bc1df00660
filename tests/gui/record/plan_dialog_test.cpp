#include "gui/record/plan_dialog.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>

#include <palpate/core/error.h>

#include "gui/appearance/text_size.h"
#include "gui/record/plan_model.h"
#include "gui/testing/held_readings.h"
#include "gui/testing/layout_faults.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::plan_dialog_test {
namespace {

class PlanDialogTest : public WindowStateTest {
 protected:
  PlanDialogTest()
      : controller_(windowState_->settings),
        record_(windowState_->actions.make("record", "Hand", "&Record")) {
    QObject::connect(record_, &QAction::triggered, record_, [this] { ++recorded_; });
    ask_.choices = {"Start over"};
    controller_.addRow({.object = "ball", .run = "left", .repetitions = 2, .notes = "slowly"});
    controller_.addRow({.object = "cup"});
    dialog_ = std::make_unique<PlanDialog>(*windowState_, controller_, record_);
    dialog_->show();
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = dialog_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  void click(const char* name) { QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton); }
  QAbstractItemModel* table() { return find<QTableView>("planTable")->model(); }
  QString cell(int row, int column) { return table()->index(row, column).data().toString(); }
  QString said() { return find<QLabel>("planSaid")->text(); }

  PlanController controller_;
  QAction* record_;
  int recorded_ = 0;
  std::unique_ptr<PlanDialog> dialog_;
};

TEST_F(PlanDialogTest, WhileATableIsReadThePlanIsNotEditedAndAFailureIsToldAnywhere) {
  testing::writeFile(folder_ / "p.csv", "object,repetitions\nball,x\n");
  QSignalSpy failed(&windowState_->messages, &Messages::failed);
  {
    HeldReadings held;
    controller_.importCsv(folder_ / "p.csv");
    for (const char* each : {"planAdd", "planImport"})
      EXPECT_FALSE(find<QPushButton>(each)->isEnabled()) << each;
    EXPECT_FALSE(table()->flags(table()->index(0, 0)).testFlag(Qt::ItemIsEditable));
    EXPECT_FALSE(table()->setData(table()->index(0, 0), "cone"));
    EXPECT_EQ(cell(0, PlanModel::kObject), "ball");
    dialog_->hide();
  }
  controller_.settle();
  EXPECT_TRUE(find<QPushButton>("planAdd")->isEnabled());
  EXPECT_TRUE(table()->flags(table()->index(0, 0)).testFlag(Qt::ItemIsEditable));
  ASSERT_EQ(failed.size(), 1);
  EXPECT_TRUE(failed[0][1].toString().contains("'x' is not a whole number"));
}

TEST_F(PlanDialogTest, ShowsThePlanAndWhatComesNext) {
  EXPECT_EQ(find<QLabel>("planProgress")->text(), "0 of 3");
  EXPECT_EQ(find<QLabel>("planNext")->accessibleName(), "next: ball, left, 1 of 2");
  ASSERT_EQ(table()->rowCount(), 2);
  EXPECT_EQ(cell(0, PlanModel::kObject), "ball");
  EXPECT_EQ(cell(0, PlanModel::kDone), "0 of 2");
  EXPECT_TRUE(table()->index(0, 0).data(Qt::FontRole).value<QFont>().bold()) << "the next one";
  EXPECT_FALSE(table()->index(1, 0).data(Qt::FontRole).value<QFont>().bold());
}

TEST_F(PlanDialogTest, CellsAreEditedAndABadValueIsNamedByRowAndColumn) {
  const QModelIndex repetitions = table()->index(1, PlanModel::kRepetitions);
  EXPECT_TRUE(table()->setData(repetitions, "5"));
  EXPECT_EQ(controller_.plan().rows()[1].repetitions, 5);
  EXPECT_FALSE(table()->setData(repetitions, "many"));
  EXPECT_EQ(said(), "row 2, repetitions: 'many' is not a whole number");
  EXPECT_FALSE(table()->setData(repetitions, "0"));
  EXPECT_EQ(said(), "row 2, repetitions: must be 1..999");
  EXPECT_FALSE(table()->setData(table()->index(0, PlanModel::kObject), " "));
  EXPECT_EQ(said(), "row 1, object: is empty");
  EXPECT_EQ(controller_.plan().rows()[0].object, "ball");
  EXPECT_FALSE(table()->flags(table()->index(0, PlanModel::kDone)) & Qt::ItemIsEditable);
}

// A recording begins while its object is being typed.
TEST_F(PlanDialogTest, WhatIsBeingTypedIsKeptAndTaken) {
  auto* view = find<QTableView>("planTable");
  const QModelIndex object = table()->index(0, PlanModel::kObject);
  view->setCurrentIndex(object);
  view->edit(object);
  auto* editor = qobject_cast<QLineEdit*>(view->indexWidget(object));
  ASSERT_TRUE(editor);
  editor->selectAll();
  QTest::keyClicks(editor, "mug");
  controller_.hold();
  EXPECT_EQ(editor->text(), "mug");
  dialog_->takeTyped();
  EXPECT_EQ(controller_.plan().rows()[0].object, "mug");
  controller_.release();
  EXPECT_EQ(editor->text(), "mug");
}

TEST_F(PlanDialogTest, TheLimitsOfTheCheckAreFoldedAndSet) {
  EXPECT_TRUE(find<QLabel>("planLimitsSummary")->accessibleName().contains("1.0 s at least") ||
              find<QLabel>("planLimitsSummary")->text().contains("1.0 s"));
  find<QAbstractButton>("planLimitsHeader")->click();
  QCoreApplication::processEvents();
  ASSERT_TRUE(find<QDoubleSpinBox>("planLeastS")->isVisible());
  EXPECT_TRUE(layoutFaults(*dialog_).isEmpty()) << layoutFaults(*dialog_).join("\n").toStdString();
  find<QDoubleSpinBox>("planLeastS")->setValue(2.5);
  find<QDoubleSpinBox>("planMostSaturated")->setValue(10.0);
  find<QSpinBox>("planMostLost")->setValue(3);
  EXPECT_DOUBLE_EQ(controller_.limits().leastS, 2.5);
  EXPECT_DOUBLE_EQ(controller_.limits().mostSaturated, 0.1);
  EXPECT_EQ(controller_.limits().mostLost, 3);
  PlanDialog later(*windowState_, controller_, record_);
  EXPECT_EQ(later.findChild<QDoubleSpinBox*>("planLeastS")->value(), 2.5);
  click("planUsualLimits");
  EXPECT_EQ(controller_.limits(), TakeCheckOptions());
}

TEST_F(PlanDialogTest, RowsAreAddedAndRemoved) {
  click("planAdd");
  EXPECT_EQ(table()->rowCount(), 3);
  find<QTableView>("planTable")->selectRow(0);
  click("planRemove");
  EXPECT_EQ(cell(0, PlanModel::kObject), "cup");
}

TEST_F(PlanDialogTest, TablesAreReadAndWritten) {
  const QString path = QString::fromStdString((folder_ / "plan.csv").string());
  testing::writeFile(folder_ / "plan.csv", "object,repetitions\npen,x\n");
  ask_.files = {path};
  ask_.newFiles = {path};
  click("planImport");
  EXPECT_EQ(said(), "reading plan.csv…") << "in the background";
  controller_.settle();
  EXPECT_EQ(said(),
            "plan.csv: line 2, repetitions: 'x' is not a whole number; the plan is as it was");
  EXPECT_EQ(table()->rowCount(), 2);
  click("planExport");
  EXPECT_EQ(said(), "");
  EXPECT_EQ(testing::readFile(folder_ / "plan.csv"),
            "object,run,repetitions,notes,done\nball,left,2,slowly,0\ncup,,1,,0\n");
  click("planImport");
  controller_.settle();
  EXPECT_EQ(table()->rowCount(), 2);
}

TEST_F(PlanDialogTest, RecordNextFollowsThePlan) {
  EXPECT_FALSE(find<QCheckBox>("planFollow")->isChecked());
  click("planRecord");
  EXPECT_EQ(recorded_, 1);
  EXPECT_TRUE(controller_.followed());
  EXPECT_TRUE(find<QCheckBox>("planFollow")->isChecked());
  record_->setProperty(kRecordingProperty, true);
  emit record_->changed();
  EXPECT_EQ(find<QPushButton>("planRecord")->text(), "Stop &recording");
  record_->setEnabled(false);
  EXPECT_FALSE(find<QPushButton>("planRecord")->isEnabled());
}

TEST_F(PlanDialogTest, TheLastTakeIsRepeatedAndThePlanBegunAnew) {
  EXPECT_FALSE(find<QPushButton>("planRepeat")->isEnabled());
  RecordingReport report;
  report.paths = {folder_ / "none.palpate"};
  controller_.begin(0.0);
  controller_.end(report);
  controller_.settle();
  EXPECT_EQ(cell(0, PlanModel::kDone), "0 of 2");
  EXPECT_TRUE(cell(0, PlanModel::kState).startsWith("to be decided: can't be checked"))
      << cell(0, PlanModel::kState).toStdString();
  EXPECT_TRUE(find<QPushButton>("planRepeat")->toolTip().startsWith("none.palpate"));
  click("planRepeat");
  EXPECT_EQ(cell(0, PlanModel::kDone), "0 of 2");
  EXPECT_EQ(cell(0, PlanModel::kState), "to be repeated · none.palpate");
  click("planAnew");
  EXPECT_TRUE(controller_.plan().rows()[0].takes.empty());
}

// Where there is room, no column is smaller than its usual text.
TEST_F(PlanDialogTest, TheColumnsHaveTheRoomThatIsThere) {
  dialog_->resize(1400, 460);
  QCoreApplication::processEvents();
  const auto* table = find<QTableView>("planTable");
  EXPECT_GE(table->columnWidth(PlanModel::kObject), 18 * table->fontMetrics().averageCharWidth());
  EXPECT_GE(table->columnWidth(PlanModel::kNotes), 22 * table->fontMetrics().averageCharWidth());
}

// All columns are seen without scrolling, and the last one has room for what it says.
TEST_F(PlanDialogTest, TheLastColumnIsWholeWithLargeText) {
  controller_.addRow({.object = "cup"});
  RecordingReport report;
  report.paths = {folder_ / "none.palpate"};
  controller_.begin(0.0);
  controller_.end(report);
  controller_.settle();
  controller_.reject(folder_ / "none.palpate");
  auto* table = find<QTableView>("planTable");
  for (const int pt : {15, 18, 0}) {
    applyTextPt(pt);
    QCoreApplication::processEvents();
    QCoreApplication::processEvents();
    EXPECT_EQ(table->horizontalScrollBar()->maximum(), 0) << pt;
    EXPECT_GE(table->columnWidth(PlanModel::kState),
              table->fontMetrics().horizontalAdvance("one is to be decided"))
        << pt;
  }
}

TEST_F(PlanDialogTest, NothingIsCutOff) {
  table()->setData(table()->index(0, PlanModel::kObject), QString(150, 'x'));
  table()->setData(table()->index(1, PlanModel::kRepetitions), "x");
  for (const QSize size : {QSize(820, 460), QSize(720, 360)}) {
    dialog_->resize(size);
    QTest::qWait(0);
    const QStringList faults = layoutFaults(*dialog_);
    EXPECT_TRUE(faults.isEmpty()) << faults.join("\n").toStdString();
  }
}

}  // namespace
}  // namespace palpate::gui::plan_dialog_test
