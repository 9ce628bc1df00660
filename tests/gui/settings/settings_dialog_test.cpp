#include "gui/settings/settings_dialog.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFontInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "gui/appearance/text_size.h"
#include "gui/testing/fake_ask.h"
#include "testing/testing.h"

namespace palpate::gui::settings_dialog_test {
namespace {

class SettingsDialogTest : public ::testing::Test {
 protected:
  SettingsDialogTest() {
    begin_.theme = ThemeChoice::kDark;
    begin_.textPt = 11;
    begin_.map = ColorMapName::kViridis;
    begin_.range = RangeMode::kFrame;
    begin_.units.angle = AngleUnit::kRadian;
    begin_.units.pressure = PressureUnit::kNewtonPerSquareCentimetre;
    begin_.recordings = "/gone/recordings";
    begin_.exports = "/gone/exports";
    begin_.reopen = false;
    begin_.forgotten = {"session"};
    dialog_ = std::make_unique<SettingsDialog>(
        begin_,
        [](const QString& folder) { return folder.startsWith("/bad") ? "can't be used" : ""; },
        ask_,
        nullptr);
    QObject::connect(dialog_.get(), &SettingsDialog::changed, [this](const WindowChoices& now) {
      told_.push_back(now);
    });
  }
  template <class Widget>
  Widget* find(const char* name) {
    return dialog_->findChild<Widget*>(name);
  }
  QString problem() { return find<QLabel>("settingsProblem")->text(); }
  bool canFinish() {
    return dialog_->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->isEnabled();
  }
  testing::TemporaryFolder folder_;
  WindowChoices begin_;
  FakeAsk ask_;
  std::unique_ptr<SettingsDialog> dialog_;
  std::vector<WindowChoices> told_;
};

TEST_F(SettingsDialogTest, ShowsWhatIsChosen) {
  EXPECT_EQ(dialog_->choices(), begin_);
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(problem(), "") << "a folder that is gone is no mistake of the user";
}

TEST_F(SettingsDialogTest, TheTextGrowsFromTheSizeOfTheDesktop) {
  auto* text = find<QSpinBox>("settingsTextPt");
  text->setValue(text->minimum());
  text->stepUp();
  EXPECT_EQ(text->value(),
            std::lround(QFontInfo(QApplication::font()).pointSizeF() / textScale()) + 1);
  text->setValue(7);
  text->stepDown();
  EXPECT_EQ(text->value(), text->minimum());
}

TEST_F(SettingsDialogTest, TellsEveryChangeAtOnceAndCancelTakesThemBack) {
  find<QComboBox>("settingsTheme")->setCurrentText("light");
  find<QSpinBox>("settingsTextPt")->setValue(6);
  find<QComboBox>("settingsMap")->setCurrentText("grey");
  find<QCheckBox>("settingsReopen")->setChecked(true);
  find<QCheckBox>("settingsForget_session")->setChecked(false);
  find<QCheckBox>("settingsForget_window")->setChecked(true);
  ASSERT_EQ(told_.size(), 6u);
  EXPECT_EQ(told_.front().theme, ThemeChoice::kLight);
  EXPECT_EQ(told_.back().textPt, 0) << "as the desktop";
  EXPECT_EQ(told_.back().map, ColorMapName::kGrey);
  EXPECT_TRUE(told_.back().reopen);
  EXPECT_EQ(told_.back().forgotten, QStringList{"window"});
  dialog_->reject();
  EXPECT_EQ(told_.back(), begin_);
}

TEST_F(SettingsDialogTest, OffersUnitsAndSaysWhatTheyDontChange) {
  EXPECT_EQ(find<QComboBox>("settingsAngle")->currentText(), "radians, rad");
  EXPECT_EQ(find<QComboBox>("settingsTemperature")->currentText(), "Celsius, °C");
  find<QComboBox>("settingsAngle")->setCurrentIndex(0);
  find<QComboBox>("settingsTemperature")->setCurrentText("kelvin, K");
  find<QComboBox>("settingsArea")->setCurrentText("cm²");
  find<QComboBox>("settingsPressure")->setCurrentText("kPa");
  ASSERT_EQ(told_.size(), 4u);
  EXPECT_EQ(
      told_.back().units,
      (DisplayUnits{.temperature = TemperatureUnit::kKelvin, .area = AreaUnit::kSquareCentimetre}));
  EXPECT_TRUE(find<QLabel>("settingsUnitsNote")->text().contains("files"));
  dialog_->reject();
  EXPECT_EQ(told_.back().units, begin_.units);
}

TEST_F(SettingsDialogTest, EveryAccessKeyIsOfOneField) {
  std::vector<QString> keys;
  const auto take = [&](const QString& text) {
    const auto at = text.indexOf('&');
    if (at >= 0) keys.push_back(text.mid(at + 1, 1).toLower());
  };
  for (const QLabel* label : dialog_->findChildren<QLabel*>())
    if (label->buddy()) take(label->text());
  for (const QAbstractButton* button : dialog_->findChildren<QAbstractButton*>())
    take(button->text());
  std::sort(keys.begin(), keys.end());
  EXPECT_GE(keys.size(), 11u);
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST_F(SettingsDialogTest, AFolderThatCantBeUsedIsRefused) {
  find<QLineEdit>("settingsRecordings")->setText("/bad/place");
  EXPECT_EQ(problem(), "can't be used");
  EXPECT_FALSE(canFinish());
  EXPECT_TRUE(told_.empty());
  find<QLineEdit>("settingsRecordings")->setText("/gone/recordings");
  EXPECT_TRUE(canFinish());
  find<QLineEdit>("settingsExports")->setText("pictures");
  EXPECT_EQ(problem(), "The folder of exports isn't an absolute path");
  find<QLineEdit>("settingsExports")->setText("/gone/elsewhere");
  EXPECT_TRUE(problem().startsWith("There is no folder /gone/elsewhere"));
  find<QLineEdit>("settingsExports")->setText(QString::fromStdString(folder_.path().string()));
  EXPECT_EQ(problem(), "");
  EXPECT_EQ(told_.back().exports.toStdString(), folder_.path().string());
}

TEST_F(SettingsDialogTest, BrowseFillsTheField) {
  ask_.folders = {"/other"};
  for (QPushButton* button : dialog_->findChildren<QPushButton*>())
    if (button->accessibleName().contains("recordings")) button->click();
  EXPECT_EQ(ask_.folders.asked, QStringList("Folder of recordings"));
  EXPECT_EQ(ask_.folders.began, QStringList("/gone/recordings"));
  EXPECT_EQ(dialog_->choices().recordings, "/other");
}

}  // namespace
}  // namespace palpate::gui::settings_dialog_test
