// The dock Hand against the emulated hand: what is clicked is what arrives there.
#include "gui/hand/hand_dock.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include "palpate/device/sdh2.h"
#include <palpate/control/tactile_masks.h>
#include <palpate/model/preshape.h>

#include "calibration/sample_calibrations.h"
#include "control/emulated_bench.h"
#include "gui/hand/hand_dock_bench.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/hand/tactile_settings_panel.h"
#include "gui/testing/make_active.h"
#include "gui/widgets/value_slider.h"
#include "testing/testing.h"

namespace palpate::gui::hand_dock_test {
namespace {
using testing::EmulatedBench;
using testing::stillHand;

// As the test's hand, but hot.
class HotHand final : public HandModel {
 public:
  const HandDescription& hand() const override { return still_.hand(); }
  void advanceTo(double timeS) override { still_.advanceTo(timeS); }
  double timeS() const override { return still_.timeS(); }
  JointMotion& joints() override { return still_.joints(); }
  std::vector<MatrixSetting>& settings() override { return still_.settings(); }
  void scan(std::span<std::uint16_t> counts) override { still_.scan(counts); }
  std::vector<double> temperatures() override { return {40, 41, 42, 71.5, 44, 45, 46, 47, 48}; }
  std::vector<MatrixTruth> truth() const override { return still_.truth(); }

 private:
  testing::StillHand still_;
};

class HandDockTest : public HandDockBench {};

TEST_F(HandDockTest, WithoutAHandItSaysSoAndOffersNothing) {
  EXPECT_EQ(state(), "No hand is connected.");
  for (const char* name : {"openHand",
                           "graspHand",
                           "reactiveGrasp",
                           "slipAwareGrasp",
                           "relaxHand",
                           "stopHand",
                           "resetSettings"})
    EXPECT_FALSE(isEnabled(name)) << name;
  EXPECT_EQ(find<QPushButton>("graspHand")->toolTip(), "No hand is connected");
  EXPECT_EQ(find<ValueSlider>("threshold2")->field()->text(), "–");
}

TEST_F(HandDockTest, OpeningItMovesNothing) {
  connectTo(stillHand());
  EXPECT_TRUE(await([&] { return isEnabled("graspHand") && isEnabled("reactiveGrasp"); }));
  EXPECT_EQ(state(), "Ready.");
  EXPECT_TRUE(bench_->log.deeds().empty());
}

TEST_F(HandDockTest, GraspGoesWhereTheControlsSay) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  auto* preshape = find<QComboBox>("preshape");
  preshape->setCurrentIndex(preshape->findData("cylindrical"));
  type("closeRatio", "0,25");  // a comma is a point
  type("velocity", "80");
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->log.firstSince("m", 0).has_value(); }));
  // Table of the study: 0 | -30 + 30 c, 30 + 35 c.
  std::vector<double> target;
  for (const auto& command : bench_->log.named("p"))
    if (!command.values.empty()) target = command.values;
  EXPECT_EQ(target, (std::vector<double>{0, -22.5, 38.75, -22.5, 38.75, -22.5, 38.75}));
  EXPECT_TRUE(await([&] { return state().contains("plain grasp: cylindrical"); }))
      << state().toStdString();
  EXPECT_FALSE(isEnabled("graspHand"));
  EXPECT_FALSE(isEnabled("reactiveGrasp"));
  EXPECT_TRUE(isEnabled("stopHand"));
  EXPECT_TRUE(await([&] { return state() == "finished: at its target, touching nothing"; }));
  EXPECT_TRUE(isEnabled("graspHand"));
}

TEST_F(HandDockTest, StopStops) {
  connectTo(stillHand());
  type("velocity", "5");
  type("closeRatio", "1");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  click("stopHand");
  EXPECT_TRUE(await([&] { return state() == "stopped by the user"; }));
  EXPECT_FALSE(bench_->handMoves());
}

TEST_F(HandDockTest, ASlipAwareGraspClosesUnderWatchAndIsStopped) {
  connectTo(stillHand());
  type("limit", "2500");
  ASSERT_TRUE(await([&] { return isEnabled("slipAwareGrasp"); }));
  EXPECT_TRUE(find<QPushButton>("slipAwareGrasp")->toolTip().contains("when the object slips"));
  click("slipAwareGrasp");
  ASSERT_TRUE(bench_->awaitMotion());
  const auto request = bench_->control->status().request;
  ASSERT_TRUE(request);
  EXPECT_EQ(request->mode, GraspMode::kSlip);
  EXPECT_EQ(request->limitCounts, 2500);
  EXPECT_EQ(request->holding.maxLimitCounts, 2500) << "never below where it begins";
  EXPECT_FALSE(request->holding.loosen) << "a loaded hand isn't opened";
  EXPECT_TRUE(await([&] { return !isEnabled("slipAwareGrasp"); }));
  click("stopHand");
  EXPECT_TRUE(await([&] { return state() == "stopped by the user"; }));
}

// From a field, from a menu that is open, from another window.
TEST_F(HandDockTest, EscapeStopsFromAnyFocus) {
  connectTo(stillHand());
  type("velocity", "5");
  type("closeRatio", "1");
  QWidget other;
  auto* line = new QLineEdit(&other);
  other.show();
  QMenu menu;
  menu.addAction("nothing");
  const std::vector<std::function<QWidget*()>> places = {
      [&]() -> QWidget* {
        find<ValueSlider>("limit")->field()->setFocus();
        return find<ValueSlider>("limit")->field();
      },
      [&]() -> QWidget* {
        line->setFocus();
        return line;
      },
      [&]() -> QWidget* {
        menu.popup({10, 10});
        return &menu;
      }};
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_TRUE(await([&] { return isEnabled("graspHand"); })) << i;
    click("graspHand");
    ASSERT_TRUE(bench_->awaitMotion()) << i;
    QWidget* place = places[i]();
    QTest::keyClick(place, Qt::Key_Escape);
    EXPECT_TRUE(await([&] { return !bench_->handMoves(); })) << i;
    EXPECT_TRUE(await([&] { return state() == "stopped by the user"; }))
        << i << state().toStdString();
    // Whatever else Escape means there it didn't do: first the hand.
    EXPECT_TRUE(place != &menu || menu.isVisible());
  }
  // Nothing moves: Escape is Escape again.
  QTest::keyClick(&menu, Qt::Key_Escape);
  EXPECT_FALSE(menu.isVisible());
}

TEST_F(HandDockTest, ReactiveGraspSaysWhereItStopped) {
  connectTo(testing::handWith("ball"));
  // A touch at this velocity: with the limit kept the hand would touch at 0.4 deg/s.
  find<QCheckBox>("keepLimit")->setChecked(false);
  type("velocity", "60");
  type("limit", "300");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  EXPECT_TRUE(await([&] { return state().startsWith("limit reached: finger "); }))
      << state().toStdString();
  // L-M14: a hard ball at 60 deg/s is pressed far beyond.
  EXPECT_TRUE(state().contains("after the stop")) << state().toStdString();
  // Once more: it is over the limit, and says so.
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  QSignalSpy explained(dock_.get(), &HandDock::explained);
  click("reactiveGrasp");
  EXPECT_TRUE(await([&] { return state().contains("over the limit of 300 already"); }))
      << state().toStdString();
  // Once, for those who don't see the dock; see HandFeature.
  dock_->refresh();
  ASSERT_EQ(explained.count(), 1);
  EXPECT_TRUE(explained[0][0].toString().contains("over the limit of 300 already"));
}

TEST_F(HandDockTest, RelaxTakesThePower) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("relaxHand"); }));
  click("relaxHand");
  EXPECT_TRUE(await([&] { return !bench_->log.named("power").empty(); }));
}

TEST_F(HandDockTest, SettingsGoToTheMatrixThatWasChosen) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold1")->value() == 300.0; }));
  EXPECT_EQ(find<ValueSlider>("threshold0")->value(), 150.0);
  type("threshold3", "77");
  EXPECT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 77; }));
  ValueSlider* sensitivity = find<ValueSlider>("sensitivity4");
  QTest::keyClick(sensitivity->slider(), Qt::Key_Right);  // 0.05 more
  EXPECT_TRUE(await([&] { return std::abs(onTheHand()[4].sensitivity - 0.55) < 1e-6; }));
  type("threshold-1", "60");  // all
  EXPECT_TRUE(await([&] {
    const auto now = onTheHand();
    return std::all_of(
        now.begin(), now.end(), [](const auto& each) { return each.thresholdCounts == 60; });
  }));
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold5")->value() == 60.0; }));
  click("resetSettings");
  EXPECT_TRUE(await([&] {
    const auto now = onTheHand();
    return now[0].thresholdCounts == 150 && now[5].thresholdCounts == 300 &&
           std::abs(now[4].sensitivity - 0.5) < 1e-6;
  }));
}

// The row for all matrices showed the threshold of the first one.
TEST_F(HandDockTest, TheRowForAllMatricesTellsThatTheyDiffer) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold5")->value() == 300.0; }));
  QDoubleSpinBox* all = find<ValueSlider>("threshold-1")->field();
  auto* line = all->findChild<QLineEdit*>();
  EXPECT_EQ(all->text(), "");
  EXPECT_EQ(line->placeholderText(), "differ");
  EXPECT_EQ(find<ValueSlider>("sensitivity-1")->field()->text(), "0.50") << "the same for all";
  // Neither a look into the field nor a discarded number sets anything.
  all->setFocus();
  QTest::keyClick(all, Qt::Key_Return);
  QTest::keyClicks(all, "0");
  QTest::keyClick(all, Qt::Key_Escape);
  QTest::keyClicks(all, "x");
  all->clearFocus();
  EXPECT_FALSE(isEnabled("undoSettings"));
  EXPECT_EQ(onTheHand()[5].thresholdCounts, 300);
  const auto allAre = [&](int threshold) {
    const auto now = onTheHand();
    return std::all_of(now.begin(), now.end(), [&](const auto& each) {
      return each.thresholdCounts == threshold;
    });
  };
  // The least value can be chosen, too.
  type("threshold-1", "0");
  EXPECT_TRUE(await([&] { return allAre(0); }));
  EXPECT_TRUE(await([&] { return all->text() == "0" && line->placeholderText().isEmpty(); }));
  type("threshold-1", "70");
  EXPECT_TRUE(await([&] { return allAre(70) && all->text() == "70"; }));
}

TEST_F(HandDockTest, AThresholdOrLimitBeyondItsRangeIsRefusedAndSaid) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold5")->value() == 300.0; }));
  type("threshold5", "5000");
  EXPECT_TRUE(state().contains(": 5000 is out of 0 .. 4095 counts; 300 stays") &&
              state().contains("Threshold of "))
      << state().toStdString();
  type("limit", "5000");
  EXPECT_TRUE(state().startsWith("Limit: 5000 is out of 3 .. 3300 counts; 200 stays"))
      << state().toStdString();
  // What was sent before another setting is on the hand with it.
  type("threshold4", "444");
  EXPECT_TRUE(await([&] { return onTheHand()[4].thresholdCounts == 444; }));
  EXPECT_EQ(onTheHand()[5].thresholdCounts, 300);
}

// Who types 500 and presses Grasp wants no grasp at another velocity.
TEST_F(HandDockTest, APressThatRefusesANumberMovesNothing) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  QDoubleSpinBox* velocity = find<ValueSlider>("velocity")->field();
  makeActive(*dock_);
  const auto typeInVelocity = [&](const char* text) {
    velocity->setFocus();
    velocity->selectAll();
    QTest::keyClicks(velocity, text);
  };
  const auto expectRefused = [&] {
    EXPECT_FALSE(bench_->control->status().request.has_value());
    EXPECT_FALSE(bench_->control->status().last.has_value());
    EXPECT_TRUE(state().startsWith(
        "Velocity: 500 is out of 0.2 .. 100 deg/s; 10.0 stays, and nothing was started"))
        << state().toStdString();
  };
  typeInVelocity("500");
  click("graspHand");
  expectRefused();
  QCoreApplication::processEvents();
  // By its key.
  typeInVelocity("500");
  find<QPushButton>("graspHand")->click();
  expectRefused();
  QCoreApplication::processEvents();
  // Without Enter a good number counts, and the press after a refusal is one as any other.
  typeInVelocity("20");
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->control->status().request.has_value(); }));
  EXPECT_EQ(bench_->control->status().request->velocityDegPerS, 20.0);
  EXPECT_FALSE(state().contains("out of")) << state().toStdString();
  click("stopHand");
}

// Nothing that was typed is wrong for motors that are to be off.
TEST_F(HandDockTest, RelaxIsNeverRefusedByANumber) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("relaxHand"); }));
  QDoubleSpinBox* velocity = find<ValueSlider>("velocity")->field();
  makeActive(*dock_);
  velocity->setFocus();
  velocity->selectAll();
  QTest::keyClicks(velocity, "500");
  click("relaxHand");
  EXPECT_TRUE(state().contains("500 is out of")) << state().toStdString();
  EXPECT_TRUE(await([&] { return bench_->control->status().motorsOff; }));
}

TEST_F(HandDockTest, ASliderSendsWhenItIsLetGo) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold2")->value() == 150.0; }));
  QSlider* slider = find<ValueSlider>("threshold2")->slider();
  int chosen = 0;
  QObject::connect(
      find<ValueSlider>("threshold2"), &ValueSlider::chosen, dock_.get(), [&] { ++chosen; });
  slider->setSliderDown(true);
  for (const int value : {160, 180, 210}) slider->setSliderPosition(value);
  EXPECT_EQ(chosen, 0);
  slider->setSliderDown(false);
  EXPECT_EQ(chosen, 1);
  EXPECT_TRUE(await([&] { return onTheHand()[2].thresholdCounts == 210; }));
}

TEST_F(HandDockTest, SettingsAreKeptByNameForEachHand) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold0")->value() == 150.0; }));
  type("threshold0", "42");
  ASSERT_TRUE(await([&] { return onTheHand()[0].thresholdCounts == 42; }));
  ASSERT_TRUE(await([&] { return isEnabled("saveSettings"); }));
  QTest::qWait(0);
  ask_.texts = {"soft / things"};
  ASSERT_TRUE(
      await([&] { return bench_->session->device().info().matrices.at(0).thresholdCounts == 42; }));
  click("saveSettings");
  auto* names = find<QComboBox>("savedSettings");
  EXPECT_EQ(names->currentText(), "soft / things");
  const QStringList keys = settings_.allKeys().filter("hands/");
  ASSERT_EQ(keys.size(), 1);
  EXPECT_EQ(keys[0].section('/', 2), "settings/soft%20%2F%20things") << "of this hand";
  click("resetSettings");
  EXPECT_EQ(names->currentIndex(), 0) << "the settings are no longer those that were saved";
  ASSERT_TRUE(await([&] { return onTheHand()[0].thresholdCounts == 150; }));
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold0")->value() == 150.0; }));
  // As after a restart.
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  dock_->setHand(bench_->session.get(), bench_->control.get());
  names = find<QComboBox>("savedSettings");
  ASSERT_EQ(names->count(), 2);
  names->setCurrentIndex(1);
  emit names->activated(1);
  EXPECT_TRUE(await([&] { return onTheHand()[0].thresholdCounts == 42; }));
  EXPECT_EQ(names->currentIndex(), 1);
  // They are replaced and deleted only after a question.
  click("saveSettings");
  click("removeSettings");
  EXPECT_EQ(ask_.choices.asked,
            QStringList({"Replace the settings \"soft / things\" with the current ones?",
                         "Delete the settings \"soft / things\"?"}));
  EXPECT_EQ(names->count(), 2);
  ask_.choices = {"Delete"};
  click("removeSettings");
  EXPECT_EQ(names->count(), 1);
}

TEST_F(HandDockTest, WarnsOfAHotMotor) {
  connectTo(std::make_unique<HotHand>());
  auto* heat = find<QLabel>("handHeat");
  EXPECT_TRUE(await([&] { return heat->isVisible(); }));
  EXPECT_TRUE(heat->text().contains("motor 3 71.5 °C")) << heat->text().toStdString();
  EXPECT_FALSE(heat->text().contains("motor 2"));
}

TEST_F(HandDockTest, PresentValuesHaveTheChosenUnitsAndTargetsStayInDegrees) {
  connectTo(std::make_unique<HotHand>());
  const auto* heat = find<QLabel>("handHeat");
  ASSERT_TRUE(await([&] { return heat->text().contains("71.5 °C"); }));
  dock_->showPage("Joints");
  dock_->setUnits({.angle = AngleUnit::kRadian, .temperature = TemperatureUnit::kKelvin});
  EXPECT_TRUE(heat->text().contains("motor 3 344.")) << heat->text().toStdString();
  EXPECT_TRUE(heat->text().endsWith(" K."));
  // Beside its target, which is in degrees.
  EXPECT_TRUE(await([&] { return find<QLabel>("presentAngle1")->text().endsWith("°"); }));
}

TEST_F(HandDockTest, AGoneMotionPortIsSaidAndNothingIsOffered) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  bench_->hand->unplug(false, true);
  EXPECT_TRUE(await([&] { return state().startsWith("The hand can't be moved:"); }));
  EXPECT_FALSE(isEnabled("graspHand"));
  EXPECT_FALSE(isEnabled("reactiveGrasp"));
  EXPECT_TRUE(isEnabled("stopHand"));  // always
}

// L-M2: a matrix that is set to feel nothing is marked, and a grasp that stands on it is refused by
// name.
TEST_F(HandDockTest, AMatrixThatCannotTellTheLimitIsMarkedAndNamed) {
  connectTo(testing::handWith("ball"));
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  auto* name = find<QLabel>("matrixName1");
  EXPECT_EQ(name->toolTip(), "");
  type("sensitivity1", "0");
  ASSERT_TRUE(await([&] { return onTheHand()[1].sensitivity == 0.0; }));
  EXPECT_TRUE(await([&] { return name->toolTip().contains("finger 0 distal can't measure it"); }))
      << name->toolTip().toStdString();
  EXPECT_FALSE(name->styleSheet().isEmpty());
  EXPECT_EQ(find<QLabel>("matrixName3")->toolTip(), "");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  EXPECT_TRUE(await([&] { return state().startsWith("reactive grasp refused"); }))
      << state().toStdString();
  EXPECT_TRUE(state().contains("finger 0 distal")) << state().toStdString();
  type("sensitivity1", "0.5");
  EXPECT_TRUE(await([&] { return name->toolTip().isEmpty(); }));
}

// The refusal stayed, in red, after its cause was gone.
TEST_F(HandDockTest, ARefusalGoesWhenTheLimitCanBeMeasured) {
  connectTo(testing::handWith("ball"));
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  TaxelSelection distal(*sdh2().layout);
  distal.addAll(1);
  const auto scan = [&](MaskChoice choice) {
    for (const DeviceCommand& command :
         maskCommands(*bench_->session->device().hand().layout, distal, choice))
      bench_->control->change(command);
  };
  scan(MaskChoice::kWithout);
  ASSERT_TRUE(await([&] {
    return bench_->session->device().hand().layout->matrix(1).numEnabled() == 0 &&
           isEnabled("reactiveGrasp");
  }));
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return state().contains("no taxel of it is scanned"); }))
      << state().toStdString();
  dock_->refresh();
  ASSERT_TRUE(state().contains("no taxel of it is scanned")) << "its cause is still there";
  scan(MaskChoice::kAll);
  EXPECT_TRUE(await([&] {
    return state() ==
           "Ready. The last grasp was refused: its limit couldn't be measured; now it can.";
  })) << state().toStdString();
}

TEST_F(HandDockTest, TheRefusalOfHighSensitivityGoesWithItsNoiseLines) {
  connectTo(testing::handWith("empty"));
  SensitivityModes& modes = dock_->sensitivity();
  find<QToolButton>("sensitivityHigh")->click();
  ASSERT_TRUE(await([&] { return state().contains("noise lines"); }));
  modes.renewNoiseLines();
  dock_->refresh();
  EXPECT_TRUE(state().contains("noise lines")) << "there are none yet";
  modes.noiseLines = [](const std::string&) {
    return std::optional(testing::evenNoise(0.3, 40.0, 2.0));
  };
  modes.renewNoiseLines();
  dock_->refresh();
  EXPECT_FALSE(state().contains("noise lines")) << state().toStdString();
}

TEST_F(HandDockTest, ARefusedModeLeavesRedo) {
  connectTo(testing::handWith("empty"));
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold2")->value() == 150.0; }));
  type("threshold2", "180");
  ASSERT_TRUE(await([&] { return isEnabled("undoSettings"); }));
  click("undoSettings");
  ASSERT_TRUE(await([&] { return isEnabled("redoSettings"); }));
  find<QToolButton>("sensitivityHigh")->click();
  ASSERT_TRUE(await([&] { return state().contains("noise lines"); }));
  dock_->refresh();
  ASSERT_TRUE(isEnabled("redoSettings"));
  click("redoSettings");
  EXPECT_TRUE(await([&] { return onTheHand()[2].thresholdCounts == 180; }));
}

// The friction was to be seen for less than a second.
TEST_F(HandDockTest, ARefusedNumberIsMarkedUntilTheNextOne) {
  applyTheme(*qApp, Theme::kDark);
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold5")->value() == 300.0; }));
  const auto* line = find<ValueSlider>("threshold5")->field()->findChild<QLineEdit*>();
  type("threshold5", "5000");
  EXPECT_TRUE(line->font().bold());
  type("threshold5", "200");
  EXPECT_FALSE(find<ValueSlider>("threshold5")->field()->font().bold());
  EXPECT_FALSE(line->font().bold());
  qApp->setStyleSheet({});
}

// As the refusals: only fingers that the preshape moves, and of a slip-aware grasp the highest
// limit that it may go to.
TEST_F(HandDockTest, TheMarkOfAMatrixAgreesWithTheRefusals) {
  connectTo(testing::handWith("ball"));
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  auto* folded = find<QLabel>("matrixName3");
  type("sensitivity3", "0");
  EXPECT_TRUE(
      await([&] { return folded->toolTip().contains("finger 1 distal can't measure it"); }));
  auto* preshape = find<QComboBox>("preshape");
  preshape->setCurrentIndex(preshape->findData("pinch-parallel"));
  EXPECT_TRUE(await([&] { return folded->toolTip().isEmpty(); })) << "it stays folded away";
  type("threshold0", "2000");
  auto* name = find<QLabel>("matrixName0");
  EXPECT_TRUE(await([&] { return name->toolTip().contains("its threshold of 2000"); }))
      << name->toolTip().toStdString();
  ASSERT_TRUE(await([&] { return isEnabled("slipAwareGrasp"); }));
  click("slipAwareGrasp");
  EXPECT_TRUE(await([&] { return state().contains("2200 counts can't be measured"); }))
      << state().toStdString();
  // The status has room for four lines; the rest is reached by scrolling.
  dock_->resize(380, 800);
  QCoreApplication::processEvents();
  const auto* status = find<QLabel>("handState");
  EXPECT_GE(status->height(), status->heightForWidth(status->width()));
}

// L-M3: the hand goes on to its target, and nobody can tell it anything meanwhile.
TEST_F(HandDockTest, DuringAnUnplugInAMotionItSaysThatTheHandGoesOnAndNothingOfItAfterwards) {
  connectTo(stillHand());
  type("velocity", "10");
  type("closeRatio", "1");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  bench_->hand->unplug(false, true);
  ASSERT_TRUE(await([&] { return !isEnabled("relaxHand"); })) << "the port is known to be gone";
  ASSERT_TRUE(bench_->handMoves());
  EXPECT_TRUE(state().startsWith("The hand is still moving to its target"))
      << state().toStdString();
  EXPECT_TRUE(state().contains("emergency stop")) << state().toStdString();
  EXPECT_FALSE(state().contains("can't move")) << state().toStdString();
  bench_->hand->replug();
  ASSERT_TRUE(await([&] { return isEnabled("relaxHand") && !bench_->handMoves(); }));
  dock_->refresh();
  EXPECT_FALSE(state().contains("still moving")) << state().toStdString();
  EXPECT_TRUE(state().startsWith("Ready")) << state().toStdString();
}

TEST_F(HandDockTest, AControllerThatDoesNotAnswerInAMotionIsStoppedAndItSaysSo) {
  connectTo(stillHand());
  type("velocity", "10");
  type("closeRatio", "1");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  bench_->hand->mute(true);
  ASSERT_TRUE(await([&] { return state().startsWith("Stop commands are sent"); }))
      << state().toStdString();
  EXPECT_TRUE(state().contains("emergency stop")) << state().toStdString();
  EXPECT_TRUE(await([&] { return !bench_->handMoves(); }));
  bench_->hand->mute(false);
  ASSERT_TRUE(await([&] { return state().startsWith("failed: "); })) << state().toStdString();
}

TEST_F(HandDockTest, AfterAnUnplugAtRestItSaysThatThePortIsBack) {
  connectTo(stillHand());
  type("velocity", "60");
  type("closeRatio", "0.2");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(await([&] { return state().startsWith("finished"); })) << state().toStdString();
  bench_->hand->unplug(false, true);
  ASSERT_TRUE(await([&] { return !isEnabled("relaxHand"); })) << "the port is known to be gone";
  dock_->refresh();
  bench_->hand->replug();
  ASSERT_TRUE(await([&] { return isEnabled("relaxHand"); }));
  dock_->refresh();
  EXPECT_EQ(state().toStdString(), "Ready. The motion port was disconnected, and is back.");
}

// By a client, say: the buttons are grey.
TEST_F(HandDockTest, WhatIsRefusedDuringAnUnplugHidesNotThatTheHandGoesOn) {
  connectTo(stillHand());
  type("velocity", "10");
  type("closeRatio", "1");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  bench_->hand->unplug(false, true);
  ASSERT_TRUE(await([&] { return !isEnabled("relaxHand"); })) << "the port is known to be gone";
  EXPECT_THROW(bench_->control->grasp({}), DeviceError);
  dock_->refresh();
  EXPECT_TRUE(state().contains("still moving to its target")) << state().toStdString();
}

// L-M8
TEST_F(HandDockTest, ReturnPressesTheFocusedButtonAndSpaceNever) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  auto* grasp = find<QPushButton>("graspHand");
  grasp->setFocus();
  QTest::keyClick(grasp, Qt::Key_Space);
  EXPECT_EQ(bench_->control->status().phase, GraspPhase::kIdle) << "Space moves nothing";
  QTest::keyClick(grasp, Qt::Key_Return);
  EXPECT_NE(bench_->control->status().phase, GraspPhase::kIdle);
  auto* stop = find<QPushButton>("stopHand");
  stop->setFocus();
  QTest::keyClick(stop, Qt::Key_Enter, Qt::KeypadModifier);
  EXPECT_TRUE(await([&] { return state() == "stopped by the user"; })) << state().toStdString();
}

// L-M8: what Tab meets comes in the order in which it is read.
TEST_F(HandDockTest, TabGoesThroughTheButtonsAsTheyStand) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand") && isEnabled("reactiveGrasp"); }));
  QStringList met;
  QWidget* stop = find<QPushButton>("stopHand");
  for (QWidget* at = stop->nextInFocusChain(); at != stop; at = at->nextInFocusChain())
    if (qobject_cast<QPushButton*>(at) && dock_->isAncestorOf(at)) met.append(at->objectName());
  EXPECT_EQ(met.mid(0, 5).join(" ").toStdString(),
            "graspHand reactiveGrasp slipAwareGrasp openHand relaxHand");
}

// L-M9
TEST_F(HandDockTest, ButtonsStandStillWhateverIsSaid) {
  dock_->resize(380, 800);
  connectTo(testing::handWith("ball"));
  // The second grasp is refused, because the first one stays above its limit; and both are quick.
  find<QCheckBox>("keepLimit")->setChecked(false);
  type("velocity", "60");
  type("limit", "300");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  const auto places = [&] {
    QCoreApplication::processEvents();
    QMap<QString, QPoint> at;
    for (const QPushButton* each : dock_->findChildren<QPushButton*>())
      at[each->objectName()] = each->mapTo(dock_.get(), QPoint());
    return at;
  };
  const auto before = places();
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return state().startsWith("limit reached: finger "); }));
  EXPECT_EQ(places(), before) << state().toStdString();
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return state().contains("already"); }));
  EXPECT_EQ(places(), before) << state().toStdString();
}

// L-M9: a warning moves no button either.
TEST_F(HandDockTest, AHotMotorMovesNoButton) {
  const auto place = [&] {
    QCoreApplication::processEvents();
    return find<QPushButton>("graspHand")->mapTo(dock_.get(), QPoint());
  };
  const QPoint before = place();
  connectTo(std::make_unique<HotHand>());
  ASSERT_TRUE(await([&] { return find<QLabel>("handHeat")->isVisible(); }));
  EXPECT_EQ(place(), before);
}

// L-minor 9
TEST_F(HandDockTest, AButtonThatIsGreySaysWhy) {
  const std::vector<const char*> names{
      "graspHand", "reactiveGrasp", "slipAwareGrasp", "openHand", "relaxHand"};
  for (const char* name : names)
    EXPECT_EQ(find<QPushButton>(name)->toolTip(), "No hand is connected") << name;
  EXPECT_EQ(find<QPushButton>("stopHand")->toolTip(), "No hand is connected");
  connectTo(stillHand());
  type("velocity", "5");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand") && isEnabled("reactiveGrasp"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  dock_->refresh();
  for (const char* name : names) {
    const QString tip = find<QPushButton>(name)->toolTip();
    EXPECT_TRUE(isEnabled(name) || tip == "A plain grasp runs; Stop (Esc) ends it")
        << name << tip.toStdString();
  }
  EXPECT_FALSE(isEnabled("openHand"));
}

TEST_F(HandDockTest, APressInVainIsAnsweredUntilTheButtonCanBePressed) {
  connectTo(stillHand());
  type("velocity", "5");
  type("closeRatio", "1");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  dock_->refresh();
  EXPECT_TRUE(state().startsWith("closing")) << state().toStdString();
  click("openHand");
  EXPECT_TRUE(state().startsWith("Open: A plain grasp runs; Stop (Esc) ends it.\nclosing"))
      << state().toStdString();
  click("moveJoint0");
  EXPECT_TRUE(state().startsWith("Move ")) << state().toStdString();
  EXPECT_TRUE(state().contains(": A plain grasp runs; Stop (Esc) ends it.\nclosing"))
      << state().toStdString();
  click("startSequence");
  EXPECT_TRUE(state().startsWith("Start: A plain grasp runs; Stop (Esc) ends it.\nclosing"))
      << state().toStdString();
  QTest::mouseClick(find<QPushButton>("openHand"), Qt::RightButton);
  EXPECT_TRUE(state().startsWith("Start: ")) << "that is no press";
  click("graspHand");
  bench_->control->stop();  // from elsewhere
  EXPECT_TRUE(await([&] { return state() == "stopped by the user"; })) << state().toStdString();
}

TEST_F(HandDockTest, AKeyInVainIsAnsweredInTheDock) {
  connectTo(stillHand());
  type("velocity", "5");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp") && isEnabled("openHand"); }));
  actions_.reactiveGrasp->trigger();
  ASSERT_TRUE(bench_->awaitMotion());
  dock_->refresh();
  EXPECT_FALSE(actions_.openHand->isEnabled());
  EXPECT_EQ(whyGreyed(*actions_.openHand), "A reactive grasp runs; Stop (Esc) ends it");
  dock_->answerKey("Can't open the hand: " + whyGreyed(*actions_.openHand), actions_.openHand);
  EXPECT_TRUE(
      state().startsWith("Can't open the hand: A reactive grasp runs; Stop (Esc) ends it.\n"))
      << state().toStdString();
  bench_->control->stop();  // from elsewhere
  EXPECT_TRUE(await([&] { return actions_.openHand->isEnabled(); }));
  EXPECT_EQ(state(), "stopped by the user");
}

// As from the menu and the tool bar.
TEST_F(HandDockTest, TheActionsWorkWhileTheDockIsHidden) {
  EXPECT_FALSE(actions_.graspHand->isEnabled());
  EXPECT_FALSE(actions_.stopHand->isEnabled());
  EXPECT_EQ(actions_.stopHand->toolTip(), "No hand is connected");
  connectTo(stillHand());
  type("velocity", "5");
  dock_->hide();
  EXPECT_TRUE(actions_.stopHand->isEnabled());
  ASSERT_TRUE(await([&] { return actions_.graspHand->isEnabled(); }));
  actions_.graspHand->trigger();
  ASSERT_TRUE(bench_->awaitMotion());
  dock_->setInSight(false);
  actions_.stopHand->trigger();
  EXPECT_TRUE(await([&] { return !bench_->handMoves(); }));
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  EXPECT_FALSE(actions_.graspHand->isEnabled()) << "a recording is shown";
  EXPECT_TRUE(actions_.graspHand->toolTip().contains("F6"));
  EXPECT_TRUE(actions_.stopHand->isEnabled());
  dock_->setInSight(true);
  EXPECT_TRUE(actions_.graspHand->isEnabled());
}

TEST_F(HandDockTest, AHandThatActsByItselfIsNotReady) {
  QString own = "closing";
  connectTo(stillHand());
  dock_->ownMotion = [&] { return own; };
  dock_->refresh();
  EXPECT_EQ(state(),
            "The emulated hand follows the script of its scene: closing. Stop (Esc) or any command "
            "you send ends it.");
  own.clear();
  dock_->refresh();
  EXPECT_EQ(state(), "Ready.");
  // After a stop it doesn't say "ready": something may be held.
  std::vector<std::string> told;
  QObject::connect(
      dock_.get(), &HandDock::conditionChanged, dock_.get(), [&](const ExplainedCondition& now) {
        told.emplace_back(nameOf(now.condition));
      });
  own = "holding an object";
  dock_->refresh();
  click("stopHand");
  own.clear();
  dock_->refresh();
  EXPECT_TRUE(state().startsWith("Stopped. The hand no longer follows a script"))
      << qPrintable(state());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), "stopped");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  click("graspHand");
  ASSERT_TRUE(bench_->awaitMotion());
  dock_->refresh();
  click("stopHand");
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  EXPECT_FALSE(state().startsWith("Stopped. The hand no longer")) << "a motion came after it";
  // Also one that was refused, and began and ended between two refreshes.
  own = "holding an object";
  dock_->refresh();
  click("stopHand");
  own.clear();
  dock_->refresh();
  ASSERT_TRUE(state().startsWith("Stopped. The hand no longer"));
  GraspRequest wrong;
  wrong.velocityDegPerS = -1.0;
  EXPECT_THROW(bench_->control->grasp(wrong), std::exception);
  dock_->refresh();
  EXPECT_TRUE(state().contains("refused")) << qPrintable(state());
  dock_->ownMotion = [] { return QString(); };
}

// L-M10: what was refused is no state.
TEST_F(HandDockTest, ARefusalOfAModeGoesWithTheNextChoice) {
  connectTo(testing::handWith("empty"));
  find<QToolButton>("sensitivityHigh")->click();
  ASSERT_TRUE(await([&] { return state().contains("noise lines"); }));
  find<QToolButton>("sensitivityAdaptive")->click();
  dock_->refresh();
  EXPECT_FALSE(state().contains("noise lines")) << state().toStdString();
  find<QToolButton>("sensitivityHigh")->click();
  dock_->refresh();
  ASSERT_TRUE(state().contains("noise lines"));
  find<QToolButton>("sensitivityManual")->click();
  dock_->refresh();
  EXPECT_FALSE(state().contains("noise lines")) << state().toStdString();
}

TEST_F(HandDockTest, ChoicesAreRemembered) {
  find<QComboBox>("preshape")->setCurrentIndex(find<QComboBox>("preshape")->findData("parallel"));
  type("limit", "450");
  dock_ = newDock();
  EXPECT_EQ(find<QComboBox>("preshape")->currentData().toString(), "parallel");
  EXPECT_EQ(find<ValueSlider>("limit")->value(), 450.0);
}

// The fast motions of one session are not those of the next one, on another hand perhaps.
TEST_F(HandDockTest, ASessionBeginsWithTheSafeVelocity) {
  // As earlier versions stored it.
  settings_.setValue("grasp/velocity_deg_per_s", 60.0);
  settings_.setValue("joints/velocity_deg_per_s", 60.0);
  for (int session = 0; session < 2; ++session) {
    dock_ = newDock();
    for (const char* velocity : {"velocity", "jointVelocity"}) {
      EXPECT_EQ(find<ValueSlider>(velocity)->value(), 10.0) << velocity;
      find<ValueSlider>(velocity)->field()->setValue(33.0);
    }
    for (const QString& key : settings_.allKeys())
      EXPECT_FALSE(key.contains("velocity")) << key.toStdString();
  }
}

TEST_F(HandDockTest, AHandFoundMovingIsSaidUntilTheNextMotion) {
  bench_ = std::make_unique<testing::EmulatedBench>(stillHand());
  bench_->hand->withModel([](HandModel& model) {
    model.joints().setVelocities(std::vector<double>(7, 5.0));
    model.joints().setTargets({0, 7, -7, 7, -7, 7, -7});
    model.joints().startMotion();
  });
  bench_->connect();
  dock_->setHand(bench_->session.get(), bench_->control.get());
  const QString said =
      "The hand was moving unattended when it was connected: it was stopped. Ready.";
  EXPECT_TRUE(await([&] { return state() == said; })) << state().toStdString();
  QSignalSpy shown(dock_.get(), &HandDock::stateShown);
  dock_->refresh();
  ASSERT_FALSE(shown.isEmpty());
  EXPECT_TRUE(shown.back()[1].toBool()) << "it needs attention";
  ASSERT_TRUE(await([&] { return isEnabled("openHand"); }));
  click("openHand");
  ASSERT_TRUE(await([&] { return bench_->control->status().request.has_value(); }));
  click("stopHand");
  ASSERT_TRUE(await([&] { return bench_->control->status().last.has_value(); }));
  dock_->refresh();
  EXPECT_FALSE(state().contains("was moving")) << state().toStdString();
}

TEST_F(HandDockTest, HighSensitivityNeedsNoiseLinesAndEndsByAHandOnTheValues) {
  EXPECT_FALSE(find<QToolButton>("sensitivityHigh")->isEnabled()) << "no hand";
  connectTo(testing::handWith("empty"));
  SensitivityModes& modes = dock_->sensitivity();
  int on = 0, off = 0;
  QObject::connect(&modes, &SensitivityModes::highChanged, [&](bool is) { ++(is ? on : off); });
  const auto settings = [&] { return bench_->session->device().info().matrices; };
  find<QToolButton>("sensitivityHigh")->click();
  EXPECT_EQ(modes.mode(), SensitivityMode::kManual);
  EXPECT_TRUE(find<QToolButton>("sensitivityManual")->isChecked());
  ASSERT_TRUE(await([&] { return state().contains("noise lines"); })) << state().toStdString();
  EXPECT_EQ(settings()[0].sensitivity, 0.5) << "nothing was set";
  modes.noiseLines = [](const std::string& hand) {
    EXPECT_EQ(hand, sdh2().name);
    return std::optional(testing::evenNoise(0.3, 40.0, 2.0));
  };
  find<QToolButton>("sensitivityHigh")->click();
  EXPECT_EQ(on, 1);
  ASSERT_TRUE(await([&] {
    return settings()[5].sensitivity == 1.0 && settings()[5].thresholdCounts < 80;
  })) << modes.statusText().toStdString();
  ASSERT_TRUE(await([&] { return modes.statusText().contains("follow the temperatures"); }));
  // A hand on a value: it holds nothing any more.
  type("threshold1", "123");
  EXPECT_EQ(modes.mode(), SensitivityMode::kManual);
  EXPECT_TRUE(find<QToolButton>("sensitivityManual")->isChecked());
  EXPECT_EQ(off, 1);
  ASSERT_TRUE(await([&] { return settings()[1].thresholdCounts == 123; }));
  EXPECT_EQ(settings()[5].sensitivity, 1.0) << "the others stay";
}

// 1.00 is the largest: no higher one would saturate.
TEST_F(HandDockTest, AdaptiveSensitivityAtTheHighestSaysThatNothingSaturates) {
  auto hand =
      std::make_unique<testing::StillHand>(std::vector<double>{60, -75, 75, -75, 75, -75, 75});
  hand->values[0] = 200;
  connectTo(std::move(hand));
  find<QToolButton>("sensitivityAdaptive")->click();
  EXPECT_TRUE(await([&] {
    return dock_->sensitivity().statusText() ==
           "Sensitivity 1.00: not saturated at the highest value.";
  })) << dock_->sensitivity().statusText().toStdString();
}

TEST_F(HandDockTest, AdaptiveSensitivitySaysWhatItWaitsFor) {
  connectTo(testing::handWith("empty"));
  find<QToolButton>("sensitivityAdaptive")->click();
  EXPECT_TRUE(await([&] {
    return dock_->sensitivity().statusText().contains("waiting for a contact");
  })) << dock_->sensitivity().statusText().toStdString();
  dock_->setHand(nullptr, nullptr);
  EXPECT_EQ(dock_->sensitivity().mode(), SensitivityMode::kManual);
  EXPECT_EQ(dock_->sensitivity().statusText(), "");
}

}  // namespace
}  // namespace palpate::gui::hand_dock_test
