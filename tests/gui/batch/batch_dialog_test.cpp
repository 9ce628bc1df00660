#include "gui/batch/batch_dialog.h"

#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QTest>
#include <algorithm>

#include <gtest/gtest.h>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/result_file.h"

#include "gui/batch/batch_fields.h"
#include "gui/batch/batch_results.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/layout_faults.h"
#include "testing/testing.h"

namespace palpate::gui::batch_dialog_test {
namespace {

namespace fs = std::filesystem;

class BatchDialogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "in/deep");
    saveRecording(synthesize({.durationS = 2.0, .grasps = 1}), {}, folder_ / "in/a.dsa");
    fs::copy_file(folder_ / "in/a.dsa", folder_ / "in/deep/b.dsa");
    start();
  }
  void start() {
    dialog_ = std::make_unique<BatchDialog>(settings_, controller_, ask_);
    dialog_->show();
  }
  static QString text(const fs::path& path) { return QString::fromStdString(path.string()); }
  void look() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !dialog_->looking(); }, 20'000));
  }
  void choose(BatchChoices choices) {
    dialog_->setChoices(choices);
    look();
  }
  void run() {
    dialog_->start();
    ASSERT_TRUE(controller_.busy());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !controller_.busy(); }, 30'000));
  }
  BatchChoices both() { return {.paths = {text(folder_ / "in")}, .folder = text(folder_ / "out")}; }
  template <class Widget>
  Widget* find(const char* name) {
    return dialog_->findChild<Widget*>(name);
  }
  bool canStart() { return find<QPushButton>("batchStart")->isEnabled(); }

  testing::TemporaryFolder folder_;
  QSettings settings_{text(folder_ / "s.ini"), QSettings::IniFormat};
  BatchController controller_;
  FakeAsk ask_;
  std::unique_ptr<BatchDialog> dialog_;
};

TEST_F(BatchDialogTest, ShowsTheFirstNamesAndHowManyRecordingsThereAre) {
  choose(both());
  EXPECT_EQ(dialog_->problem(), "");
  EXPECT_TRUE(canStart());
  EXPECT_EQ(find<QLabel>("batchCount")->text(), "2 recordings");
  EXPECT_EQ(find<QLabel>("batchPreview")->text(), "a.dsa → a.npz\ndeep/b.dsa → deep/b.npz");
  find<QLineEdit>("batchNames")->setText("{ending}/{folder}_{name}_x");
  EXPECT_FALSE(canStart()) << "names that are not known yet";
  look();
  EXPECT_EQ(find<QLabel>("batchPreview")->text(),
            "a.dsa → dsa/a_x.npz\ndeep/b.dsa → dsa/deep_b_x.npz");
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written before Start";
}

TEST_F(BatchDialogTest, AFileForEachGraspHasItsNumberInItsName) {
  saveRecording(
      synthesize({.durationS = 24.0, .grasps = 3}), {}, folder_ / "in/a.dsa", Overwrite::kReplace);
  fs::remove_all(folder_ / "in/deep");
  BatchChoices choices = both();
  choices.form = "palpate";
  choose(choices);
  auto* each = find<QCheckBox>("batchEachGrasp");
  ASSERT_TRUE(each->isVisible());
  each->setChecked(true);
  look();
  EXPECT_EQ(find<QLineEdit>("batchNames")->text(), "{name}_{n}");
  EXPECT_EQ(find<QLabel>("batchPreview")->text(), "a.dsa → a_01.palpate");
  find<QLineEdit>("batchNames")->setText("{name}");
  look();
  EXPECT_TRUE(dialog_->problem().contains("{n}")) << dialog_->problem().toStdString();
  find<QLineEdit>("batchNames")->setText("{name}_{n}");
  look();
  run();
  for (const char* name : {"a_01.palpate", "a_02.palpate", "a_03.palpate"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  EXPECT_EQ(controller_.outcome()->report.status.done, 1u);
  look();
  run();
  EXPECT_EQ(controller_.outcome()->report.status.skipped, 1u) << "they are whole";
  EXPECT_TRUE(loadBatchChoices(settings_).eachGrasp);
  each->setChecked(false);
  EXPECT_EQ(find<QLineEdit>("batchNames")->text(), "{name}");
}

TEST_F(BatchDialogTest, PicturesAreDrawnOfEachRecording) {
  BatchChoices choices = both();
  choices.work = BatchWork::kRender;
  choices.map = "viridis";
  choose(choices);
  EXPECT_TRUE(find<QWidget>("batchPicture")->isVisible());
  EXPECT_TRUE(find<QWidget>("batchFilters")->isVisible());
  EXPECT_FALSE(find<QWidget>("batchSpeed")->isVisible()) << "of a movie only";
  EXPECT_FALSE(find<QWidget>("batchForm")->isVisible());
  run();
  const QImage image(text(folder_ / "out/a.png"));
  EXPECT_EQ(image.size(), QSize(1800, 1440)) << "900 x 720 units, twice as many pixels";
  EXPECT_TRUE(fs::exists(folder_ / "out/deep/b.png"));
  EXPECT_EQ(controller_.outcome()->report.status.done, 2u);
  choices.picture = "svg";
  choose(choices);
  run();
  EXPECT_NE(testing::readFile(folder_ / "out/a.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(loadBatchChoices(settings_), choices);
}

TEST_F(BatchDialogTest, FitsOnASmallScreenWhateverIsMade) {
  for (const BatchWork work : {BatchWork::kConvert,
                               BatchWork::kSignals,
                               BatchWork::kSlip,
                               BatchWork::kFeatures,
                               BatchWork::kRender}) {
    BatchChoices choices = both();
    choices.work = work;
    choices.form = "h5";
    choices.picture = "mp4";
    saveBatchChoices(choices, settings_);
    start();
    look();
    EXPECT_LE(dialog_->height(), 660) << static_cast<int>(work);
    EXPECT_LE(dialog_->minimumSizeHint().height(), 660) << static_cast<int>(work);
    EXPECT_TRUE(layoutFaults(*dialog_).isEmpty())
        << layoutFaults(*dialog_).join("\n").toStdString();
  }
}

TEST_F(BatchDialogTest, WhatCanNotBeDoneIsSaidAndStartIsOff) {
  const auto expect = [&](const BatchChoices& choices, const char* words) {
    choose(choices);
    EXPECT_TRUE(dialog_->problem().contains(words)) << dialog_->problem().toStdString();
    EXPECT_EQ(find<QLabel>("batchSaid")->text(), dialog_->problem());
    EXPECT_FALSE(canStart());
    dialog_->start();
    EXPECT_FALSE(controller_.busy());
  };
  BatchChoices choices = both();
  choices.paths.clear();
  expect(choices, "add the recordings");
  choices.paths = {text(folder_ / "nowhere")};
  expect(choices, "nowhere");
  choices = both();
  choices.folder.clear();
  expect(choices, "choose a folder");
  choices.folder = text(folder_ / "in/a.dsa");
  expect(choices, "is not a folder");
  choices.folder = text(folder_ / "in/made");
  expect(choices, "is in the folder being read");
  choices = both();
  for (const auto& [names, words] : {std::pair{"{hand}", "{hand} isn't known"},
                                     std::pair{"{name", "a brace without its partner"},
                                     std::pair{"../{name}", "below the folder of the results"},
                                     std::pair{"{folder}x", "would be made from both"}}) {
    choices.names = names;
    if (QString(names) == "{folder}x") fs::copy_file(folder_ / "in/a.dsa", folder_ / "in/c.dsa");
    expect(choices, words);
  }
  choices = both();
  choices.filters = "sharpen";
  expect(choices, "Filters: ");
  choices.work = BatchWork::kSignals;
  choices.filters = "";
  choices.smooth = "median";
  expect(choices, "Smooth: ");
  choices.work = BatchWork::kSlip;
  choices.reference = "somewhere";
  expect(choices, "Reference: ");
  fs::create_directories(folder_ / "empty");
  choices = both();
  choices.paths = {text(folder_ / "empty")};
  expect(choices, "no recording");
}

TEST_F(BatchDialogTest, WhatIsNotFilledInYetIsAHintAndNoProblem) {
  look();
  EXPECT_FALSE(find<QLabel>("batchSaid")->property("problem").toBool()) << "at first sight";
  BatchChoices choices = both();
  choices.folder.clear();
  choose(choices);
  EXPECT_EQ(find<QLabel>("batchSaid")->text(), "choose a folder for the results");
  EXPECT_FALSE(find<QLabel>("batchSaid")->property("problem").toBool());
  choices.folder = text(folder_ / "in/made");
  choose(choices);
  EXPECT_TRUE(find<QLabel>("batchSaid")->property("problem").toBool()) << "this is a mistake";
}

TEST_F(BatchDialogTest, OnlyFieldsWithAnEffectAreSeen) {
  const auto seen = [&](const char* name) { return find<QWidget>(name)->isVisible(); };
  BatchChoices choices = both();
  choices.form = "h5";
  choose(choices);
  EXPECT_TRUE(seen("batchSignals") && seen("batchFilters") && !seen("batchUnitsRow"));
  choices.form = "csv";
  choose(choices);
  EXPECT_TRUE(!seen("batchSignals") && seen("batchUnitsRow") && !seen("batchMethod"));
  choices.form = "palpate";
  choose(choices);
  EXPECT_FALSE(seen("batchFilters")) << "palpate filter makes filtered recordings";
  choices.work = BatchWork::kSlip;
  choose(choices);
  EXPECT_TRUE(seen("batchMethod") && seen("batchSegments") && !seen("batchForm"));
  EXPECT_TRUE(seen("batchTableForm") && seen("batchUnitsRow"));
  choices.table = "mat";
  choose(choices);
  EXPECT_FALSE(seen("batchUnitsRow")) << "its columns have their units";
  choices.work = BatchWork::kFeatures;
  choose(choices);
  EXPECT_TRUE(seen("batchSet") && !seen("batchUnitsRow") && !seen("batchMatrix"));
  EXPECT_TRUE(seen("batchTableForm"));
  choices.table = "mcap";
  choose(choices);
  EXPECT_TRUE(dialog_->problem().contains("has no time")) << dialog_->problem().toStdString();
}

TEST_F(BatchDialogTest, TablesAreWrittenInEveryForm) {
  const auto* forms = find<QComboBox>("batchTableForm");
  std::vector<std::string> offered = {".hdf5"};  // the same as .h5
  BatchChoices choices = both();
  choices.work = BatchWork::kSignals;
  for (int i = 0; i < forms->count(); ++i) {
    choices.table = forms->itemData(i).toString();
    offered.push_back("." + choices.table.toStdString());
    EXPECT_TRUE(forms->itemText(i).startsWith("." + choices.table + ": "));
    if (choices.table == "h5") continue;  // a build may have none
    choose(choices);
    EXPECT_EQ(dialog_->choices(), choices);
    run();
    EXPECT_EQ(controller_.outcome()->report.status.done, 2u) << offered.back();
    EXPECT_TRUE(fs::exists(folder_ / ("out/a" + offered.back())));
  }
  std::vector<std::string> all = resultEndings();
  std::ranges::sort(offered);
  std::ranges::sort(all);
  EXPECT_EQ(offered, all);
  EXPECT_EQ(testing::readFile(folder_ / "out/a.npz").substr(0, 2), "PK") << "a zip file";
  EXPECT_EQ(testing::readFile(folder_ / "out/a.json").front(), '{');
}

TEST_F(BatchDialogTest, TheChoicesAreRemembered) {
  BatchChoices choices = both();
  choices.work = BatchWork::kSlip;
  choices.method = "register";
  choices.table = "json";
  choices.reference = "17";
  choices.segments = true;
  choices.stepTaxels = 0.25;
  choices.unitsRow = true;
  choices.matrix = 3;
  choices.names = "{name}_slips";
  choices.resume = false;
  choices.threads = 2;
  choose(choices);
  EXPECT_EQ(dialog_->choices(), choices);
  run();
  dialog_.reset();
  EXPECT_EQ(loadBatchChoices(settings_), choices);
  start();
  EXPECT_EQ(dialog_->choices(), choices);
  settings_.setValue("batch/form", "mp3");
  settings_.setValue("batch/table", "mp3");
  settings_.setValue("batch/work", 99);
  EXPECT_EQ(loadBatchChoices(settings_).form, "npz");
  EXPECT_EQ(loadBatchChoices(settings_).table, "csv");
  EXPECT_EQ(loadBatchChoices(settings_).work, BatchWork::kConvert);
}

TEST_F(BatchDialogTest, PathsAreAddedOnceAndRemovedAndDropped) {
  ask_.files = {text(folder_ / "in/a.dsa")};
  ask_.folders = {text(folder_ / "in")};
  for (int twice = 0; twice < 2; ++twice) {
    find<QPushButton>("batchAddFiles")->click();
    find<QPushButton>("batchAddFolder")->click();
  }
  const QStringList two = {text(folder_ / "in/a.dsa"), text(folder_ / "in")};
  EXPECT_EQ(dialog_->choices().paths, two);
  find<QListWidget>("batchPaths")->setCurrentRow(0);
  find<QPushButton>("batchRemove")->click();
  EXPECT_EQ(dialog_->choices().paths, QStringList{two[1]});
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(two[0])});
  QDragEnterEvent enter(QPoint(5, 5), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(dialog_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(dialog_.get(), &drop);
  EXPECT_TRUE(drop.isAccepted());
  EXPECT_EQ(dialog_->choices().paths, QStringList({two[1], two[0]}));
}

TEST_F(BatchDialogTest, WhatFailedIsListedWithItsReasonAndReported) {
  testing::writeFile(folder_ / "in/bad.dsa", "hello");
  choose(both());
  run();
  const auto* table = find<QTableView>("batchTable");
  const QAbstractItemModel& rows = *table->model();
  ASSERT_EQ(rows.rowCount(), 1);
  EXPECT_EQ(rows.index(0, 0).data().toString(), "bad.dsa");
  EXPECT_EQ(rows.index(0, 1).data().toString(), "failed");
  EXPECT_TRUE(rows.index(0, 2).data().toString().startsWith("is not a .dsa"))
      << rows.index(0, 2).data().toString().toStdString();
  EXPECT_EQ(find<QLabel>("batchSummary")->text(), "2 done, 1 failed; 2 files.");
  EXPECT_EQ(find<QLabel>("batchSaid")->text(), "Ended: 2 done, 1 failed");
  find<QCheckBox>("batchShowAll")->setChecked(true);
  EXPECT_EQ(rows.rowCount(), 3);
  find<QPushButton>("batchCopy")->click();
  EXPECT_EQ(QApplication::clipboard()->text().count('\n'), 4);
  QString revealed;
  dialog_->results().reveal = [&](const QString& path) { revealed = path; };
  emit const_cast<QTableView*>(table)->doubleClicked(rows.index(2, 0));
  EXPECT_EQ(revealed, text(folder_ / "in/deep/b.dsa"));
  ask_.newFiles = {text(folder_ / "report")};
  find<QPushButton>("batchSaveReport")->click();
  const std::string report = testing::readFile(folder_ / "report.csv");
  EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 4) << report;
  EXPECT_EQ(report.rfind("source,result,state,text,files\n", 0), 0U) << report;
  // Once more: what is whole is kept.
  look();
  run();
  EXPECT_EQ(find<QLabel>("batchSummary")->text(), "0 done, 2 skipped, 1 failed; 2 files.");
}

// Nothing failed: what was made is listed.
TEST_F(BatchDialogTest, WhatWasMadeIsListedWhereNothingFailed) {
  choose(both());
  run();
  EXPECT_EQ(find<QLabel>("batchSummary")->text(), "2 done; 2 files.");
  EXPECT_EQ(find<QTableView>("batchTable")->model()->rowCount(), 2);
  EXPECT_FALSE(find<QCheckBox>("batchShowAll")->isEnabled());
}

TEST_F(BatchDialogTest, ALongPathLosesItsFoldersAndNotItsName) {
  choose(both());
  run();
  auto* table = find<QTableView>("batchTable");
  const QModelIndex path = table->model()->index(0, 0);
  const QModelIndex what = table->model()->index(0, 2);
  struct Seen : QStyledItemDelegate {
    using QStyledItemDelegate::initStyleOption;
  };
  const auto elided = [&](const QModelIndex& index) {
    QStyleOptionViewItem option;
    option.textElideMode = table->textElideMode();
    auto* delegate = static_cast<QStyledItemDelegate*>(table->itemDelegateForIndex(index));
    (delegate->*(&Seen::initStyleOption))(&option, index);
    return option.textElideMode;
  };
  EXPECT_EQ(elided(path), Qt::ElideLeft);
  EXPECT_EQ(elided(what), Qt::ElideMiddle);
}

TEST_F(BatchDialogTest, AnHdf5FileIsReadAndAChangedOneFails) {
  for (const char* name : {"in/x.h5", "in/changed.h5"})
    saveRecording(synthesize({.durationS = 2.0, .grasps = 1}), {}, folder_ / name);
  std::string bytes = testing::readFile(folder_ / "in/changed.h5");
  bytes[bytes.size() / 2] ^= 1;
  testing::writeFile(folder_ / "in/changed.h5", bytes);
  BatchChoices choices = both();
  choices.paths = {text(folder_ / "in/x.h5"), text(folder_ / "in/changed.h5")};
  choose(choices);
  run();
  EXPECT_EQ(find<QLabel>("batchSummary")->text(), "1 done, 1 failed; 1 file.");
  const QAbstractItemModel& rows = *find<QTableView>("batchTable")->model();
  ASSERT_EQ(rows.rowCount(), 1);
  EXPECT_TRUE(rows.index(0, 2).data().toString().contains("checksum"));
}

}  // namespace
}  // namespace palpate::gui::batch_dialog_test
