// The Import dialog: preview by the worker, choices, presets, refusals.
#include "gui/import/import_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>

#include <gtest/gtest.h>

#include "gui/import/import_fields.h"
#include "gui/testing/fake_ask.h"
#include "testing/testing.h"

namespace palpate::gui::import_dialog_test {
namespace {

std::string tableText(const char* header) {
  std::string text = header;
  text += "\n";
  for (int row = 0; row < 20; ++row) {
    text += std::to_string(row * 10);
    for (int i = 0; i < 256; ++i) text += ";" + std::to_string(i);
    text += "\n";
  }
  return text;
}

class ImportDialogTest : public ::testing::Test {
 protected:
  ImportDialogTest()
      : settings_(QString::fromStdString((folder_ / "settings.ini").string()),
                  QSettings::IniFormat) {
    std::string header = "time_ms";
    for (int i = 0; i < 256; ++i) header += ";p" + std::to_string(i);
    testing::writeFile(folder_ / "pad.csv", tableText(header.c_str()));
    open();
  }
  void open() {
    dialog_ = std::make_unique<ImportDialog>(settings_, std::vector<std::filesystem::path>{}, ask_);
    dialog_->QWidget::show();
  }
  QString path(const char* name) const { return QString::fromStdString((folder_ / name).string()); }
  void awaitPreview() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !dialog_->busy(); }, 30'000));
  }
  void showPad() {
    dialog_->setHand("flat_pad_16x16");
    dialog_->setData(path("pad.csv"));
    awaitPreview();
  }
  template <class Widget>
  Widget* find(const char* name) {
    return dialog_->findChild<Widget*>(name);
  }

  testing::TemporaryFolder folder_;
  QSettings settings_;
  FakeAsk ask_;
  std::unique_ptr<ImportDialog> dialog_;
};

TEST_F(ImportDialogTest, ShowsWhatTheFileHoldsAndWhatBecomesWhat) {
  awaitPreview();
  EXPECT_EQ(dialog_->problem(), "choose a file");
  EXPECT_FALSE(find<QPushButton>("importOk")->isEnabled());
  showPad();
  EXPECT_EQ(dialog_->problem(), "");
  EXPECT_TRUE(find<QPushButton>("importOk")->isEnabled());
  EXPECT_EQ(find<QLabel>("importForm")->text(), "text, separated by semicolons, names in line 1");
  const auto* columns = find<QTableWidget>("importColumns");
  EXPECT_EQ(columns->horizontalHeaderItem(0)->text(), "time_ms\nms");
  EXPECT_EQ(columns->item(2, 0)->text(), "20");
  EXPECT_EQ(columns->item(2, 3)->text(), "2");
  const QString choices = find<QLabel>("importChoices")->text();
  EXPECT_TRUE(choices.contains("p0 to p255")) << choices.toStdString();
  EXPECT_TRUE(choices.contains("All 20 rows: 20 frames, 100.0 Hz, 0 gaps"))
      << choices.toStdString();
  EXPECT_EQ(dialog_->request().out, path("pad.palpate"));
}

TEST_F(ImportDialogTest, OnlyTheRowsOfTheHandAreOffered) {
  showPad();
  auto* fields = find<ImportFields>("importFields");
  const auto shown = [&] {
    QStringList names;
    for (int row = 0; row < fields->rowCount(); ++row)
      if (!fields->isRowHidden(row)) names << fields->verticalHeaderItem(row)->text();
    return names;
  };
  EXPECT_EQ(shown(), QStringList{"All matrices"});
  dialog_->setHand("sdh2");
  awaitPreview();
  EXPECT_EQ(shown().size(), 9);  // all, six matrices, joint angles, temperatures
  EXPECT_TRUE(dialog_->problem().contains("6 matrices of 14 x 6"))
      << dialog_->problem().toStdString();
}

TEST_F(ImportDialogTest, TheOrderOfComponentsIsAskedOfAHandThatHasThem) {
  showPad();
  auto* components = find<QComboBox>("importComponents");
  EXPECT_TRUE(components->isHidden());
  std::filesystem::create_directory(folder_ / "skin");
  testing::writeFile(folder_ / "skin" / "hand.json",
                     R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
          "components": 3, "signed": true,
          "matrices": [{"name": "pad", "rows": 1, "columns": 2, "pitch_mm": 4.0}]})");
  testing::writeFile(folder_ / "skin.csv", "time_s,a0,a1,a2,a3,a4,a5\n0,1,2,3,4,5,-6\n");
  dialog_->setHand(path("skin"));
  dialog_->setData(path("skin.csv"));
  awaitPreview();
  EXPECT_FALSE(components->isHidden());
  EXPECT_EQ(dialog_->problem(), "");
  const auto choices = [&] { return find<QLabel>("importChoices")->text(); };
  EXPECT_TRUE(choices().contains("x, y, z of each taxel")) << choices().toStdString();
  components->setCurrentIndex(2);
  awaitPreview();
  EXPECT_EQ(dialog_->request().mapping.components, ComponentOrder::kPlanar);
  EXPECT_FALSE(choices().contains("x, y, z of each taxel")) << choices().toStdString();
  dialog_->setHand("flat_pad_16x16");
  awaitPreview();
  EXPECT_TRUE(components->isHidden());
}

TEST_F(ImportDialogTest, ChangedFieldsAreTriedAtOnce) {
  showPad();
  auto* fields = find<ImportFields>("importFields");
  fields->item(0, 0)->setText("#1..#256");
  fields->item(0, 1)->setText("0.5");
  awaitPreview();
  ASSERT_EQ(dialog_->request().mapping.matrices.size(), 1u);
  EXPECT_EQ(dialog_->request().mapping.matrices[0].columns, "#1..#256");
  EXPECT_EQ(dialog_->request().mapping.matrices[0].values.scale, 0.5);
  EXPECT_EQ(dialog_->problem(), "");
  fields->item(0, 0)->setText("q*");
  awaitPreview();
  EXPECT_TRUE(dialog_->problem().contains("no column of numbers matches"));
  fields->item(0, 1)->setText("half");
  EXPECT_TRUE(dialog_->problem().contains("\"half\" is not a number"));
  fields->item(0, 0)->setText("");
  fields->item(0, 1)->setText("");
  find<QDoubleSpinBox>("importRate")->setValue(250.0);
  awaitPreview();
  EXPECT_EQ(dialog_->request().mapping.time.rateHz, 250.0);
  EXPECT_TRUE(find<QLabel>("importChoices")->text().contains("250 Hz"));
}

// A file with times would be read at the rate of another one.
TEST_F(ImportDialogTest, ARateIsOfOneFileUnlessItIsOfAMapping) {
  showPad();
  auto* rate = find<QDoubleSpinBox>("importRate");
  rate->setValue(250.0);
  saveImportRequest(dialog_->request(), settings_);
  std::filesystem::copy_file(folder_ / "pad.csv", folder_ / "other.csv");
  dialog_->setData(path("other.csv"));
  EXPECT_EQ(rate->text(), "times of the file");
  rate->setValue(250.0);
  find<QLineEdit>("importData")->setText(path("pad.csv"));
  emit find<QLineEdit>("importData")->editingFinished();
  EXPECT_EQ(rate->text(), "times of the file");
  rate->setValue(250.0);
  emit find<QLineEdit>("importData")->editingFinished();
  EXPECT_EQ(rate->value(), 250.0) << "the same file";
  ask_.texts = {"pad at 250 Hz"};
  find<QPushButton>("importSavePreset")->click();
  rate->setValue(10.0);
  dialog_->setData(path("other.csv"));
  EXPECT_EQ(rate->value(), 250.0);
  awaitPreview();
  open();
  EXPECT_EQ(find<QDoubleSpinBox>("importRate")->text(), "times of the file");
  awaitPreview();
}

TEST_F(ImportDialogTest, WhatIsLeftOutIsAWarningInTheWordsOfTheWindow) {
  showPad();
  EXPECT_FALSE(find<QLabel>("importWarnings")->isVisible());
  std::string text = "time_ms";
  for (int i = 0; i < 256; ++i) text += ",p" + std::to_string(i);
  text += "\n";
  for (const char* time : {"10", "20", "20", "30"}) {
    text += time;
    for (int i = 0; i < 256; ++i) text += i == 7 ? ",nan" : ",1";
    text += "\n";
  }
  testing::writeFile(folder_ / "twice.csv", text);
  dialog_->setData(path("twice.csv"));
  awaitPreview();
  const auto* warnings = find<QLabel>("importWarnings");
  EXPECT_TRUE(warnings->isVisible());
  EXPECT_EQ(warnings->property("role").toString(), "warning");
  EXPECT_TRUE(warnings->text().contains("3 NaN (taken as 0)")) << warnings->text().toStdString();
  EXPECT_TRUE(warnings->text().contains("a rate (Time, in Hz) keeps all rows"))
      << warnings->text().toStdString();
  EXPECT_FALSE(warnings->text().contains("--"));
}

TEST_F(ImportDialogTest, DecimalCommasAreNamedAndRead) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    text += "0," + std::to_string(row);
    for (int i = 0; i < 256; ++i) text += "\t1,5";
    text += "\n";
  }
  testing::writeFile(folder_ / "comma.txt", text);
  dialog_->setHand("flat_pad_16x16");
  dialog_->setData(path("comma.txt"));
  awaitPreview();
  EXPECT_TRUE(dialog_->problem().contains("decimal comma")) << dialog_->problem().toStdString();
  find<QComboBox>("importDecimal")->setCurrentIndex(1);
  awaitPreview();
  EXPECT_EQ(dialog_->problem(), "");
}

TEST_F(ImportDialogTest, MappingsAreRememberedByName) {
  showPad();
  find<ImportFields>("importFields")->item(0, 0)->setText("p*");
  find<ImportFields>("importFields")->item(0, 2)->setText("-3");
  awaitPreview();
  ask_.texts = {"my/pad 1"};
  find<QPushButton>("importSavePreset")->click();
  EXPECT_EQ(find<QComboBox>("importPreset")->currentText(), "my/pad 1");
  open();
  awaitPreview();
  EXPECT_TRUE(dialog_->request().mapping.matrices.empty());
  showPad();
  auto* presets = find<QComboBox>("importPreset");
  presets->setCurrentText("my/pad 1");
  emit presets->activated(presets->currentIndex());
  awaitPreview();
  ASSERT_EQ(dialog_->request().mapping.matrices.size(), 1u);
  EXPECT_EQ(dialog_->request().mapping.matrices[0].columns, "p*");
  EXPECT_EQ(dialog_->request().mapping.matrices[0].values.offset, -3.0);
  find<QPushButton>("importRemovePreset")->click();
  EXPECT_TRUE(importPresets(settings_).names().isEmpty());
}

TEST_F(ImportDialogTest, NothingIsReplacedUnasked) {
  testing::writeFile(folder_ / "pad.palpate", "mine");
  showPad();
  EXPECT_EQ(dialog_->problem(), "pad.palpate exists already: replace it, or choose another name");
  find<QCheckBox>("importReplace")->setChecked(true);
  EXPECT_EQ(dialog_->problem(), "");
  find<QLineEdit>("importOut")->setText(path("pad.csv"));
  EXPECT_TRUE(dialog_->problem().contains(".palpate"));
  dialog_->accept();
  EXPECT_TRUE(dialog_->isVisible());
  find<QLineEdit>("importOut")->setText(path("other.palpate"));
  dialog_->accept();
  EXPECT_EQ(dialog_->result(), QDialog::Accepted);
}

TEST_F(ImportDialogTest, EscapeClosesIt) {
  showPad();
  QTest::keyClick(dialog_.get(), Qt::Key_Escape);
  EXPECT_FALSE(dialog_->isVisible());
  EXPECT_EQ(dialog_->result(), QDialog::Rejected);
}

TEST_F(ImportDialogTest, FurtherFilesBecomeSeries) {
  testing::writeFile(folder_ / "Wrist Force.csv", "time_ms,fx_N,fz_N\n0,1,2\n50,3,4\n100,5,6\n");
  showPad();
  ask_.files = {path("Wrist Force.csv")};
  find<QPushButton>("importAddSeries")->click();
  awaitPreview();
  auto* table = find<QTableWidget>("importSeries");
  ASSERT_EQ(table->rowCount(), 1);
  EXPECT_EQ(table->item(0, 0)->text(), "wrist_force");
  ASSERT_EQ(dialog_->request().series.size(), 1u);
  EXPECT_EQ(dialog_->request().series[0].file, folder_ / "Wrist Force.csv");
  EXPECT_TRUE(find<QLabel>("importChoices")->text().contains("series wrist_force: 2 columns"));
  EXPECT_EQ(dialog_->problem(), "");
  table->item(0, 0)->setText("Wrist");
  awaitPreview();
  EXPECT_TRUE(dialog_->problem().contains("\"wrist\"")) << dialog_->problem().toStdString();
  table->item(0, 0)->setText("wrist");
  table->item(0, 1)->setText("fast");
  awaitPreview();
  EXPECT_TRUE(dialog_->problem().contains("rate")) << dialog_->problem().toStdString();
  table->item(0, 1)->setText("20");
  awaitPreview();
  EXPECT_EQ(dialog_->problem(), "");
  EXPECT_EQ(dialog_->request().series[0].rateHz, 20.0);
  table->selectRow(0);
  find<QPushButton>("importRemoveSeries")->click();
  EXPECT_TRUE(dialog_->request().series.empty());
}

}  // namespace
}  // namespace palpate::gui::import_dialog_test
