// The Filter dock by mouse and keyboard.
#include "gui/filter/filter_panel.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <algorithm>

#include <palpate/core/error.h>

#include "gui/filter/filter_list.h"
#include "gui/source/file_reading.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/held_readings.h"
#include "testing/testing.h"

namespace palpate::gui::filter_panel_test {
namespace {

class FilterPanelTest : public ::testing::Test {
 protected:
  FilterPanelTest() {
    panel_.setSource({"0 p", "0 d", "1 p", "1 d", "2 p", "2 d"}, 31.25, false);
    panel_.resize(455, 640);
    panel_.show();
  }
  std::string text() { return recipeText(panel_.editor().recipe()); }
  FilterList& list() { return *panel_.findChild<FilterList*>("filterList"); }
  QString totals() { return panel_.findChild<QLabel*>("filterTotals")->text(); }
  void trigger(const QString& entry) {
    for (QMenu* menu : panel_.findChildren<QMenu*>())
      for (QAction* action : menu->actions())
        if (action->text() == entry) return action->trigger();
    FAIL() << "no entry " << entry.toStdString();
  }
  template <class Widget>
  Widget* option(const char* key) {
    return panel_.findChild<Widget*>(QString("option_") + key);
  }

  RecipeEditor editor_;
  FakeAsk ask_;
  FilterPanel panel_{editor_, ask_};
};

// Frequencies reach up to half of the rate of the frames.
TEST_F(FilterPanelTest, ShowsTheTrueRangeOfAFrequency) {
  trigger("Low-pass (Butterworth)");
  list().choose(0);
  const auto shows = [this](const QString& range) {
    const auto labels = panel_.findChildren<QLabel*>();
    return std::any_of(
        labels.begin(), labels.end(), [&](const QLabel* label) { return label->text() == range; });
  };
  panel_.setSource({"0 p"}, 31.0, false);
  EXPECT_TRUE(shows("0.001 to below 15.50"));
  EXPECT_TRUE(option<QDoubleSpinBox>("cutoff")->toolTip().contains("half of the 31.00 frames/s"));
  panel_.setSource({"0 p"}, 230.0, false);
  EXPECT_TRUE(shows("0.001 to below 115.00"));
  panel_.setSource({"0 p"}, 0.0, false);
  EXPECT_TRUE(shows("0.001–10000")) << "the rate is not known";
}

TEST_F(FilterPanelTest, AddsFiltersBehindTheChosenOne) {
  EXPECT_FALSE(panel_.on());
  trigger("Median");
  trigger("Kalman, zero order");
  EXPECT_EQ(text(), "median | kalman");
  EXPECT_TRUE(panel_.on());  // who adds a filter wants to see it
  list().choose(0);
  trigger("Box");
  EXPECT_EQ(text(), "median | box | kalman");
  EXPECT_EQ(list().chosen(), 1u);
}

TEST_F(FilterPanelTest, OptionsAreFieldsWithRanges) {
  trigger("Gaussian");
  auto* size = option<QSpinBox>("size");
  ASSERT_NE(size, nullptr);
  EXPECT_EQ(size->minimum(), 1);
  EXPECT_EQ(size->maximum(), 31);
  EXPECT_EQ(size->suffix(), " taxels");
  size->stepUp();
  EXPECT_EQ(text(), "gaussian:size=5");
  size->setValue(6);  // typed: even ones don't exist
  EXPECT_EQ(text(), "gaussian:size=7");
  EXPECT_EQ(size->value(), 7);
  auto* sigma = option<QDoubleSpinBox>("sigma");
  EXPECT_FALSE(sigma->isEnabled());
  EXPECT_EQ(sigma->text(), "automatic");
  for (QCheckBox* box : panel_.findChildren<QCheckBox*>())
    if (box->text() == "automatic") box->click();
  EXPECT_TRUE(sigma->isEnabled());
  sigma->setValue(1.75);
  EXPECT_EQ(text(), "gaussian:size=7,sigma=1.75");
  option<QCheckBox>("masked")->click();
  EXPECT_EQ(text(), "gaussian:size=7,sigma=1.75,masked=1");
}

TEST_F(FilterPanelTest, ChoicesAndMatrices) {
  trigger("Opening");
  auto* shape = option<QComboBox>("shape");
  shape->setCurrentIndex(2);
  emit shape->activated(2);
  EXPECT_EQ(text(), "opening:shape=ellipse");
  for (QToolButton* button : panel_.findChildren<QToolButton*>())
    if (button->text() == "0 p" || button->text() == "2 d") button->click();
  EXPECT_EQ(text(), "opening:shape=ellipse,matrices=1+2+3+4");
}

TEST_F(FilterPanelTest, TheOrderChangesByKeyAndButton) {
  panel_.editor().setRecipe(parseRecipe(std::vector<std::string>{"median | box | kalman"}));
  list().choose(2);
  QTest::keyClick(&list(), Qt::Key_Up, Qt::AltModifier);
  EXPECT_EQ(text(), "median | kalman | box");
  EXPECT_EQ(list().chosen(), 1u);
  for (QPushButton* button : panel_.findChildren<QPushButton*>())
    if (button->text() == "Down") button->click();
  EXPECT_EQ(text(), "median | box | kalman");
  list().choose(2);
  emit list().moved(2, 0);
  EXPECT_EQ(text(), "kalman | median | box");
  QTest::keyClick(&list(), Qt::Key_Delete);
  EXPECT_EQ(panel_.editor().recipe().steps.size(), 2u);
}

TEST_F(FilterPanelTest, TicksSwitchStepsOffAndOn) {
  panel_.editor().setRecipe(parseRecipe(std::vector<std::string>{"median | box"}));
  list().topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  EXPECT_EQ(text(), "(median) | box");
  list().topLevelItem(0)->setCheckState(0, Qt::Checked);
  EXPECT_EQ(text(), "median | box");
}

TEST_F(FilterPanelTest, ShowsCostAndDelay) {
  panel_.editor().setRecipe(parseRecipe(std::vector<std::string>{"median | temporal-min"}));
  panel_.setOn(true);
  panel_.showFigures(FilterFigures{{1.64, 0.4}, {0, 2}, 2});
  EXPECT_EQ(list().topLevelItem(0)->text(1), "1.6");
  EXPECT_EQ(list().topLevelItem(1)->text(2), "2");
  EXPECT_TRUE(totals().contains("2.0 µs per frame")) << totals().toStdString();
  EXPECT_TRUE(totals().contains("0.05 % of a core at 230 frames/s")) << totals().toStdString();
  EXPECT_TRUE(totals().contains("2 frames (64 ms) later")) << totals().toStdString();
  panel_.editor().setRecipe(parseRecipe(std::vector<std::string>{"rts"}));
  panel_.showFigures(FilterFigures{{9.0}, {0}, 0});
  EXPECT_TRUE(totals().contains("not for a live hand")) << totals().toStdString();
}

TEST_F(FilterPanelTest, RecipesArePresetsAndFiles) {
  const testing::TemporaryFolder folder;
  trigger(QString::fromStdString(recipePresets()[2].name));
  EXPECT_TRUE(panel_.editor().recipe().sameSteps(recipePresets()[2]));
  ask_.newFiles = {pathText(folder.path() / "mine.json")};
  trigger("Save the recipe…");
  trigger("Remove all filters");
  EXPECT_EQ(text(), "");
  ask_.files = {pathText(folder.path() / "mine.json"), pathText(folder.path() / "bad.json")};
  trigger("Open a recipe…");
  FileReading::settleAll(panel_);
  EXPECT_TRUE(panel_.editor().recipe().sameSteps(recipePresets()[2]));
  QSignalSpy message(&panel_, &FilterPanel::message);
  testing::writeFile(folder / "bad.json", "{}");
  trigger("Open a recipe…");
  FileReading::settleAll(panel_);
  ASSERT_EQ(message.size(), 1);
  EXPECT_TRUE(message[0][0].toString().contains("bad.json"));
  EXPECT_TRUE(panel_.editor().recipe().sameSteps(recipePresets()[2]));
}

TEST_F(FilterPanelTest, ARecipeThatWasChosenForOneSourceIsNotOpenedForAnother) {
  const testing::TemporaryFolder folder;
  writeRecipe(folder / "r.json", recipePresets()[2], false);
  ask_.files = {pathText(folder.path() / "r.json")};
  QSignalSpy message(&panel_, &FilterPanel::message);
  {
    HeldReadings held;
    trigger("Open a recipe…");
    panel_.setSource({"a"}, 30.0, false);
  }
  FileReading::settleAll(panel_);
  QCoreApplication::processEvents();
  EXPECT_TRUE(panel_.editor().recipe().empty());
  EXPECT_EQ(message.size(), 1);
}

}  // namespace
}  // namespace palpate::gui::filter_panel_test
