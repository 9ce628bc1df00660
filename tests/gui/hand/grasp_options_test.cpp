// Limits of single fingers and in newtons, and the options of holding, chosen in the dock Hand.
#include "gui/hand/grasp_options.h"

#include <QCheckBox>
#include <QComboBox>
#include <QToolButton>

#include "calibration/sample_calibrations.h"
#include "gui/hand/grasp_panel.h"
#include "gui/hand/hand_dock_bench.h"

namespace palpate::gui::grasp_options_test {
namespace {
using testing::stillHand;

class GraspOptionsTest : public HandDockBench {
 protected:
  void open() {
    dock_->resize(455, 900);
    if (!find<QToolButton>("moreGraspOptions")->isChecked())
      find<QToolButton>("moreGraspOptions")->click();
  }
  void enter(const char* name, const QString& text) {
    auto* field = find<QDoubleSpinBox>(name);
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    field->clearFocus();
  }
  GraspRequest running() { return bench_->control->status().request.value_or(GraspRequest{}); }
};

TEST_F(GraspOptionsTest, FitsIntoTheColumnOfTheHand) {
  connectTo(stillHand());
  open();
  const auto* options = dock_->findChild<GraspOptions*>();
  const auto fits = [&] {
    constexpr int kColumnEm = 24;  // the widest column, with margins and a scroll bar
    constexpr int kAroundEm = 4;
    return options->minimumSizeHint().width() <=
           (kColumnEm - kAroundEm) * QFontInfo(options->font()).pixelSize();
  };
  EXPECT_TRUE(fits()) << options->minimumSizeHint().width();
  dock_->calibrationOf = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  dock_->renewCalibration();
  ASSERT_TRUE(await([&] { return find<QComboBox>("limitUnit")->isEnabled(); }));
  find<QComboBox>("limitUnit")->setCurrentIndex(1);
  EXPECT_TRUE(fits()) << "in newtons: " << options->minimumSizeHint().width();
}

TEST_F(GraspOptionsTest, ASlipAwareGraspGetsWhatIsChosen) {
  connectTo(stillHand());
  open();
  enter("mostLimit", "1500");
  enter("calmTime", "2.5");
  enter("holdTime", "7");
  find<QCheckBox>("loosenHand")->click();
  enter("objectMass", "0.2");
  enter("newtonsPerCount", "0.0005");
  ASSERT_TRUE(await([&] { return isEnabled("slipAwareGrasp"); }));
  click("slipAwareGrasp");
  ASSERT_TRUE(bench_->awaitMotion());
  const HoldingOptions holding = running().holding;
  EXPECT_EQ(holding.maxLimitCounts, 1500);
  EXPECT_EQ(holding.noSlipS, 2.5);
  EXPECT_EQ(holding.holdS, 7.0);
  EXPECT_TRUE(holding.loosen);
  EXPECT_NEAR(holding.weightN, 0.2 * 9.81, 1e-9);
  EXPECT_EQ(holding.newtonsPerCount, 0.0005);
  click("stopHand");
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  // The next session: what opens the hand is off again.
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  EXPECT_EQ(find<QDoubleSpinBox>("mostLimit")->value(), 1500.0);
  EXPECT_FALSE(find<QCheckBox>("loosenHand")->isChecked());
  EXPECT_EQ(find<QDoubleSpinBox>("objectMass")->value(), 0.0);
}

TEST_F(GraspOptionsTest, EachFingerHasItsOwnLimit) {
  connectTo(stillHand());
  open();
  EXPECT_FALSE(find<QDoubleSpinBox>("fingerLimit1")->isEnabled());
  find<QCheckBox>("eachFinger")->click();
  EXPECT_FALSE(find<ValueSlider>("limit")->isEnabled());
  enter("fingerLimit0", "400");
  enter("fingerLimit1", "150");
  enter("fingerLimit2", "300");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  ASSERT_TRUE(bench_->awaitMotion());
  EXPECT_EQ(running().fingerLimitCounts, (std::vector<int>{400, 150, 300}));
  EXPECT_EQ(running().limitCounts, 400);
}

TEST_F(GraspOptionsTest, NewtonsNeedACalibrationAndSayWhy) {
  connectTo(stillHand());
  open();
  auto* unit = find<QComboBox>("limitUnit");
  EXPECT_FALSE(unit->isEnabled());
  EXPECT_TRUE(unit->toolTip().contains("need a calibration")) << unit->toolTip().toStdString();
  dock_->calibrationOf = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  dock_->renewCalibration();
  ASSERT_TRUE(await([&] { return unit->isEnabled(); }));
  EXPECT_TRUE(find<ValueSlider>("limit")->isVisible());
  unit->setCurrentIndex(1);
  EXPECT_FALSE(find<ValueSlider>("limit")->isVisible());
  EXPECT_TRUE(find<ValueSlider>("forceLimit")->isVisible());
  type("forceLimit", "3.5");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  ASSERT_TRUE(bench_->awaitMotion()) << state().toStdString();
  EXPECT_EQ(running().forceLimitsN, std::vector<double>{3.5});
  EXPECT_GT(running().limitCounts, 2000) << "the limit in counts is no tighter than it must be";
  click("stopHand");
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  // The calibration is removed: counts again.
  dock_->calibrationOf = [](const std::string&) { return std::optional<Calibration>(); };
  dock_->renewCalibration();
  ASSERT_TRUE(await([&] { return !unit->isEnabled(); }));
  EXPECT_EQ(unit->currentIndex(), 0);
  EXPECT_TRUE(find<ValueSlider>("limit")->isVisible());
}

TEST_F(GraspOptionsTest, NewtonsAreRememberedForAHandWithACalibration) {
  const auto calibrated = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  dock_->calibrationOf = calibrated;
  connectTo(stillHand());
  open();
  EXPECT_FALSE(find<QLabel>("whyCounts")->isVisible());
  auto* unit = find<QComboBox>("limitUnit");
  ASSERT_TRUE(await([&] { return unit->isEnabled(); }));
  unit->setCurrentIndex(1);
  dock_->setHand(nullptr, nullptr);
  EXPECT_EQ(unit->currentIndex(), 0);
  // A hand without a calibration: it says why newtons don't return.
  dock_->calibrationOf = [](const std::string&) { return std::optional<Calibration>(); };
  dock_->setHand(bench_->session.get(), bench_->control.get());
  EXPECT_EQ(unit->currentIndex(), 0);
  EXPECT_TRUE(find<QLabel>("whyCounts")->isVisible());
  find<QToolButton>("moreGraspOptions")->click();
  EXPECT_EQ(find<QLabel>("graspOptionsSummary")->text(),
            "limit in counts: newtons need a calibration of this hand");
  // In the next session, with one.
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  dock_->show();
  dock_->calibrationOf = calibrated;
  dock_->setHand(bench_->session.get(), bench_->control.get());
  unit = find<QComboBox>("limitUnit");
  EXPECT_TRUE(await([&] { return unit->currentIndex() == 1; }));
  EXPECT_TRUE(find<ValueSlider>("forceLimit")->isVisible());
  // Counts are remembered, too.
  unit->setCurrentIndex(0);
  dock_->setHand(nullptr, nullptr);
  dock_->setHand(bench_->session.get(), bench_->control.get());
  ASSERT_TRUE(await([&] { return unit->isEnabled(); }));
  EXPECT_EQ(unit->currentIndex(), 0);
}

TEST_F(GraspOptionsTest, WhileTheCalibrationIsReadALimitInNewtonsIsNoneInCounts) {
  settings_.setValue("grasp/limit_in_newtons", true);
  settings_.setValue("grasp/limit_n", 2.0);
  bool beingRead = true;
  dock_->calibrationBeingRead = [&](const std::string&) { return beingRead; };
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return isEnabled("graspHand"); }));
  for (const char* each : {"reactiveGrasp", "slipAwareGrasp"}) {
    EXPECT_FALSE(isEnabled(each)) << each;
    EXPECT_EQ(find<QPushButton>(each)->toolTip(), "The calibration is being read");
  }
  EXPECT_TRUE(find<ValueSlider>("forceLimit")->isVisible());
  EXPECT_FALSE(find<ValueSlider>("limit")->isVisible());
  const GraspRequest request = dock_->findChild<GraspPanel*>()->request(GraspMode::kReactive);
  EXPECT_EQ(request.forceLimitsN, std::vector<double>{2.0}) << "also of a step that is added";
  EXPECT_THROW(bench_->control->grasp(request), std::exception);
  // It was read.
  beingRead = false;
  dock_->calibrationOf = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  dock_->renewCalibration();
  EXPECT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  EXPECT_TRUE(find<ValueSlider>("forceLimit")->isVisible());
  // It is read anew: at once, and not at the next refresh.
  beingRead = true;
  dock_->calibrationOf = [](const std::string&) { return std::optional<Calibration>(); };
  dock_->renewCalibration();
  EXPECT_FALSE(isEnabled("reactiveGrasp"));
}

// The buttons that move a hand stay where they are when the options unfold.
TEST_F(GraspOptionsTest, UnfoldingMovesNoButton) {
  connectTo(stillHand());
  dock_->resize(455, 900);
  const auto place = [&] {
    QCoreApplication::processEvents();
    return find<QPushButton>("graspHand")->mapTo(dock_.get(), QPoint());
  };
  const QPoint before = place();
  open();
  EXPECT_EQ(place(), before);
  EXPECT_TRUE(find<QDoubleSpinBox>("mostLimit")->isVisible());
  EXPECT_TRUE(bench_->log.deeds().empty());
}

}  // namespace
}  // namespace palpate::gui::grasp_options_test
