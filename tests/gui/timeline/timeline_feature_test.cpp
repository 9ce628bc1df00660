// The dock Timeline over the bench: what is plotted of a recording and of what is live.
#include "gui/timeline/timeline_feature.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSignalSpy>

#include <palpate/core/error.h>
#include <palpate/model/profile_builder.h>

#include "gui/testing/sample_profiles.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::timeline_feature_test {
namespace {

class TimelineFeatureTest : public WindowStateTest {
 protected:
  TimelineFeatureTest() : feature_(*windowState_, &actionsOf_) {}
  TimelineFeature feature_;
};

TEST_F(TimelineFeatureTest, BackAtLiveTheChartPlotsWhatIsTickedNow) {
  connectEmulated();
  const std::size_t rows = windowState_->displayed.hand()->layout->numMatrices() + 1;
  const std::vector<bool> all(rows, true);
  std::vector<bool> fewer = all;
  fewer[0] = false;
  windowState_->selection.setPlotted(all);
  const int graphs = feature_.liveChart().numGraphs();
  windowState_->selection.setPlotted(fewer);
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs - 1);
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted(all);
  windowState_->displayed.showLive();
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs);
}

// analyst m22
TEST_F(TimelineFeatureTest, AFormulaKeepsItsColourWhenAnotherOneIsShown) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({false, false});
  windowState_->formulas.keep({"a", "m0_mean", ""});
  windowState_->formulas.keep({"b", "m0_max", ""});
  const auto colorOfB = [&] {
    for (const PlottedCurve& curve : feature_.panel().chart().curves())
      if (curve.name == "b") return curve.pen.color();
    return QColor();
  };
  ASSERT_TRUE(feature_.signalTree().setTicked("b", true));
  const QColor alone = colorOfB();
  EXPECT_TRUE(alone.isValid());
  ASSERT_TRUE(feature_.signalTree().setTicked("a", true));
  EXPECT_EQ(colorOfB(), alone);
}

TEST_F(TimelineFeatureTest, TheSpanIsOneWithTheModel) {
  windowState_->displayed.show(recording("a"));
  feature_.panel().chart().setSelection(TimeSpan{0.1, 0.3});
  EXPECT_EQ(windowState_->selection.span(), (TimeSpan{0.1, 0.3}));
  windowState_->selection.setSpan(std::nullopt);
  EXPECT_EQ(feature_.panel().chart().selection(), std::nullopt);
}

TEST_F(TimelineFeatureTest, WhatIsInSightIsKnownAtOnce) {
  windowState_->displayed.show(recording("a"));
  feature_.panel().chart().setVisibleRange(0.2, 0.4);
  EXPECT_NEAR(windowState_->selection.visibleSpan().fromS, 0.2, 1e-9);
  EXPECT_NEAR(windowState_->selection.visibleSpan().toS, 0.4, 1e-9);
}

TEST_F(TimelineFeatureTest, LiveThereAreTheSameCurvesAsOfARecording) {
  connectEmulated();
  LiveChart& chart = feature_.liveChart();
  const HandDescription& hand = *windowState_->displayed.hand();
  windowState_->selection.setPlotted(std::vector<bool>(hand.layout->numMatrices() + 1, false));
  EXPECT_EQ(chart.numGraphs(), 0);
  EXPECT_TRUE(feature_.signalTree().setTicked("motor 1", true));
  EXPECT_TRUE(feature_.signalTree().setTicked("finger 0 distal", true));
  EXPECT_EQ(chart.numGraphs(), 2);
  EXPECT_FALSE(feature_.signalTree().setTicked("force on", true)) << "no calibration is applied";
  TaxelSelection chosen(*hand.layout);
  chosen.add(1, 5, 1, 8, 4);
  windowState_->selection.setTaxels(chosen);
  EXPECT_EQ(chart.numGraphs(), 3);
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart.graph(2)->data()->size() > 0; }, 20'000));
  EXPECT_EQ(chart.curves()[0].name, "16 chosen taxels");
  EXPECT_GT((chart.graph(2)->data()->constEnd() - 1)->value, 10.0) << "a motor is warm";
}

// Twenty frames, 50 ms apart, of two taxels at 20 and at 3; the first is at 30 in the last ten.
OpenedRecordingPtr padRecording(const TouchRule& rule) {
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = rule;
  const auto layout = std::make_shared<const SensorLayout>(std::vector{matrix});
  ProfileBuilder builder(layout);
  for (int i = 0; i < 20; ++i) {
    TactileFrame frame(layout);
    frame.hostUs = 1'000'000 + 50'000 * i;
    frame.stored() = {i < 10 ? 20.0F : 30.0F, 3.0F};
    builder.addFrame(frame);
  }
  return makeOpenedRecording("pad", builder.finish({}));
}

TEST_F(TimelineFeatureTest, TheBaselineOfTheSelectionIsSeenAtOnceAndUndone) {
  const OpenedRecordingPtr pad = padRecording({.isSigned = true, .threshold = 5.0F});
  windowState_->displayed.show(pad);
  QAction* action = windowState_->actions.at("baselineOfSelection");
  windowState_->actionEnabler.refresh();
  EXPECT_FALSE(action->isEnabled()) << "nothing is selected";
  QAction* take = windowState_->actions.at("takeBaseline");
  EXPECT_FALSE(take->isEnabled()) << "no hand";
  EXPECT_EQ(windowState_->derivedResults.baseline(), "none");
  EXPECT_TRUE(take->toolTip().startsWith("Take the baseline")) << take->toolTip().toStdString();
  EXPECT_TRUE(take->toolTip().endsWith("\nBaseline in force: none"));
  windowState_->selection.setSpan(TimeSpan{0.0, 0.45});
  windowState_->actionEnabler.refresh();
  ASSERT_TRUE(action->isEnabled());
  EXPECT_EQ(windowState_->displayed.filteredRecording()->profile.frame(0).values[0], 20.0F);
  action->trigger();
  feature_.baselines().wait();
  ASSERT_EQ(windowState_->events.editor()->events().size(), 1u)
      << windowState_->messages.flashed().toStdString();
  EXPECT_EQ(windowState_->events.editor()->events()[0].kind, "new_baseline");
  EXPECT_TRUE(windowState_->messages.flashed().startsWith(
      "baseline of 10 frames: 2 readings at rest from 3.0 to 20.0, noise up to 0.0"))
      << windowState_->messages.flashed().toStdString();
  windowState_->activeFilters.wait();
  QCoreApplication::processEvents();
  const auto seen = [this](std::size_t frame) {
    return windowState_->displayed.filteredRecording()->profile.frame(frame).values[0];
  };
  EXPECT_EQ(seen(0), 0.0F);
  EXPECT_EQ(seen(15), 10.0F);
  EXPECT_FALSE(windowState_->activeFilters.applied()) << "that is no filter";
  EXPECT_EQ(windowState_->derivedResults.baseline(), "taken from a selection");
  EXPECT_TRUE(take->toolTip().endsWith("\nBaseline in force: taken from a selection"));
  windowState_->actions.at("undo")->trigger();
  windowState_->activeFilters.wait();
  QCoreApplication::processEvents();
  EXPECT_EQ(seen(15), 30.0F);
  EXPECT_EQ(windowState_->derivedResults.baseline(), "none");
  windowState_->selection.setSpan(TimeSpan{0.0, 0.95});
  QSignalSpy failed(&windowState_->messages, &Messages::failed);
  QSignalSpy withdrawn(&windowState_->messages, &Messages::withdrawn);
  action->trigger();
  feature_.baselines().wait();
  EXPECT_TRUE(windowState_->events.editor()->events().empty()) << "it moved";
  ASSERT_EQ(failed.size(), 1) << "the banner has room for the whole text";
  EXPECT_TRUE(failed[0][1].toString().contains("1 reading moved"))
      << failed[0][1].toString().toStdString();
  withdrawn.clear();
  windowState_->selection.setSpan(TimeSpan{0.0, 0.45});
  action->trigger();
  feature_.baselines().wait();
  ASSERT_EQ(withdrawn.size(), 1) << "one was taken";
  EXPECT_EQ(withdrawn[0][0], failed[0][0]);
  windowState_->displayed.show(recording("a"));
  EXPECT_EQ(windowState_->derivedResults.baseline(), "") << "it has no readings";
  EXPECT_FALSE(take->toolTip().contains("in force"));
}

TEST_F(TimelineFeatureTest, OfAHandThatIsTouchedAbove0TheBaselineIsAFilter) {
  windowState_->displayed.show(padRecording({}));
  windowState_->selection.setSpan(TimeSpan{0.1, 0.45});
  windowState_->actions.at("baselineOfSelection")->trigger();
  windowState_->activeFilters.wait();
  QCoreApplication::processEvents();
  EXPECT_EQ(windowState_->activeFilters.text(), "baseline:from=0.1,to=0.45");
  EXPECT_TRUE(windowState_->activeFilters.on());
  const Profile& seen = windowState_->displayed.filteredRecording()->profile;
  EXPECT_EQ(seen.frame(0).values, (std::vector<float>{0.0F, 0.0F}));
  EXPECT_EQ(seen.frame(15).values, (std::vector<float>{10.0F, 0.0F}));
  EXPECT_TRUE(windowState_->events.editor()->events().empty());
}

TEST_F(TimelineFeatureTest, TheBaselineOfAnSdh2IsAFilterThatIsUndone) {
  connectEmulated();
  const CaptureSession& session = *windowState_->displayed.source()->session;
  const auto framesCame = [&] {
    try {
      return session.restNow().numFrames > 5;
    } catch (const Error&) {
      return false;
    }
  };
  ASSERT_TRUE(QTest::qWaitFor(framesCame, 20'000));
  windowState_->actionEnabler.refresh();
  ActionRegistry& actions = windowState_->actions;
  ASSERT_TRUE(actions.at("takeBaseline")->isEnabled());
  EXPECT_FALSE(actions.at("undoBaseline")->isEnabled());
  actions.at("takeBaseline")->trigger();
  const Recipe& recipe = windowState_->activeFilters.recipe();
  ASSERT_EQ(recipe.steps.size(), 1u) << windowState_->messages.flashed().toStdString();
  ASSERT_TRUE(recipe.steps[0].rest);
  EXPECT_EQ(recipe.steps[0].rest->rest.size(), 486u);
  EXPECT_TRUE(windowState_->activeFilters.applied());
  EXPECT_EQ(windowState_->activeFilters.text(), "baseline:rest=486 values");
  ASSERT_TRUE(actions.at("undoBaseline")->isEnabled());
  actions.at("undoBaseline")->trigger();
  EXPECT_TRUE(windowState_->activeFilters.recipe().steps.empty());
}

TEST_F(TimelineFeatureTest, KeysFreezeScrollAndMeasureLive) {
  connectEmulated();
  LiveChart& chart = feature_.liveChart();
  windowState_->selection.setPlotted(std::vector<bool>(7, true));
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart.graph(0)->data()->size() > 0; }, 20'000));
  windowState_->actionEnabler.refresh();
  ActionRegistry& actions = windowState_->actions;
  EXPECT_FALSE(actions.at("zoomSelection")->isEnabled());
  actions.at("selectFrom")->trigger();
  EXPECT_TRUE(chart.cursors()[0]);
  EXPECT_TRUE(actions.at("dropSelection")->isEnabled());
  actions.at("freezeLive")->trigger();
  EXPECT_FALSE(chart.following());
  EXPECT_EQ(actions.at("freezeLive")->iconText(), "To the newest");
  actions.at("liveNewest")->trigger();
  EXPECT_TRUE(chart.following());
  EXPECT_FALSE(actions.at("freezeLive")->isChecked());
  actions.at("liveOldest")->trigger();
  EXPECT_FALSE(chart.following());
  actions.at("cursorBack")->trigger();
  actions.at("dropSelection")->trigger();
  EXPECT_FALSE(chart.cursors()[0]);
}

TEST_F(TimelineFeatureTest, RangesByHandAreRemembered) {
  feature_.panel().chart().axes().setByHand("counts", AxisRange{0.0, 250.0});
  feature_.liveChart().axes().setByHand("°C", AxisRange{20.0, 60.5});
  const QSettings& settings = windowState_->settings;
  EXPECT_EQ(settings.value("plotted/axes").toStringList(), QStringList{"0 250 counts"});
  EXPECT_EQ(settings.value("live/axes").toStringList(), QStringList{"20 60.5 °C"});
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  EXPECT_EQ(feature_.panel().chart().yAxis->range(), QCPRange(0.0, 250.0));
  feature_.panel().chart().axes().setByHand("counts", std::nullopt);
  EXPECT_TRUE(settings.value("plotted/axes").toStringList().isEmpty());
}

// A range that was set for the values of another recording would leave the chart empty.
TEST_F(TimelineFeatureTest, ARangeByHandWithoutAnyValueOfANewRecordingIsDropped) {
  TimelineChart& chart = feature_.panel().chart();
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  chart.axes().setByHand("counts", AxisRange{5000.0, 6000.0});
  EXPECT_EQ(chart.yAxis->range(), QCPRange(5000.0, 6000.0)) << "of this recording it is a choice";
  windowState_->displayed.show(recording("b"));
  EXPECT_TRUE(chart.axes().byHand().empty());
  EXPECT_LT(chart.yAxis->range().upper, 5000.0);
  EXPECT_TRUE(windowState_->messages.flashed().contains("reset to automatic"))
      << windowState_->messages.flashed().toStdString();
  EXPECT_TRUE(windowState_->messages.flashed().contains("5000 to 6000"));
  EXPECT_TRUE(windowState_->settings.value("plotted/axes").toStringList().isEmpty());
  chart.axes().setByHand("counts", AxisRange{0.0, 250.0});
  windowState_->displayed.show(recording("c"));
  EXPECT_EQ(chart.yAxis->range(), QCPRange(0.0, 250.0)) << "values are in it";
}

TEST_F(TimelineFeatureTest, TheChartSaysWhyAFormulaIsNotShown) {
  ASSERT_TRUE(windowState_->formulas.keep({"far away", "m77_mean * 2", "counts"}));
  ASSERT_TRUE(windowState_->formulas.keep({"twice", "m0_mean * 2", "counts"}));
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({false, false});
  auto* notes = feature_.panel().chart().findChild<QLabel*>("chartNotes");
  ASSERT_NE(notes, nullptr);
  EXPECT_TRUE(notes->isHidden());
  EXPECT_TRUE(feature_.signalTree().setTicked("twice", true));
  EXPECT_TRUE(feature_.signalTree().setTicked("far away", true));
  EXPECT_FALSE(notes->isHidden());
  EXPECT_TRUE(
      notes->text().startsWith("far away can't be computed: there is no signal \"m77_mean\""))
      << notes->text().toStdString();
  EXPECT_EQ(feature_.panel().chart().curves().size(), 1u) << "no axis without a curve";
  feature_.signalTree().setTicked("far away", false);
  EXPECT_TRUE(notes->isHidden());
}

TEST_F(TimelineFeatureTest, TheEndsOfAnAxisAreTyped) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  windowState_->actions.at("verticalAxes")->trigger();
  auto* editor = actionsOf_.findChild<QFrame*>("AxisEditor");
  ASSERT_NE(editor, nullptr);
  EXPECT_TRUE(editor->isVisible());
  // High enough for the title of the axis.
  feature_.panel().chart().resize(900, 400);
  const QCPAxis& axis = *feature_.panel().chart().yAxis;
  auto* automatic = editor->findChild<QCheckBox*>("automaticAxis");
  EXPECT_TRUE(automatic->isChecked());
  const QCPRange before = axis.range();
  editor->findChild<QDoubleSpinBox*>("axisTo")->setValue(1234.5);
  EXPECT_FALSE(automatic->isChecked());
  EXPECT_DOUBLE_EQ(axis.range().upper, 1234.5);
  EXPECT_TRUE(axis.label().contains("by hand")) << axis.label().toStdString();
  editor->findChild<QDoubleSpinBox*>("axisFrom")->setValue(2000.0);
  EXPECT_DOUBLE_EQ(axis.range().upper, 1234.5) << "that is no range";
  automatic->setChecked(true);
  EXPECT_EQ(axis.range(), before);
  editor->hide();
}

TEST_F(TimelineFeatureTest, ABeginAboveTheEndOfAnAxisIsSaidAndNotUsed) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  windowState_->actions.at("verticalAxes")->trigger();
  auto* editor = actionsOf_.findChild<QFrame*>("AxisEditor");
  ASSERT_NE(editor, nullptr);
  auto* automatic = editor->findChild<QCheckBox*>("automaticAxis");
  auto* from = editor->findChild<QDoubleSpinBox*>("axisFrom");
  auto* to = editor->findChild<QDoubleSpinBox*>("axisTo");
  auto* problem = editor->findChild<QLabel*>("axisProblem");
  ASSERT_TRUE(automatic && from && to && problem);
  const QCPAxis& axis = *feature_.panel().chart().yAxis;
  const QCPRange before = axis.range();
  EXPECT_TRUE(problem->isHidden());
  from->setValue(9000.0);
  ASSERT_FALSE(problem->isHidden());
  EXPECT_TRUE(problem->text().contains("the start 9000.00 isn't below the end"))
      << problem->text().toStdString();
  EXPECT_EQ(from->value(), 9000.0) << "what was typed stays";
  EXPECT_EQ(axis.range(), before);
  EXPECT_TRUE(automatic->isChecked());
  automatic->click();
  EXPECT_TRUE(automatic->isChecked()) << "nothing of it is used";
  EXPECT_TRUE(feature_.panel().chart().axes().byHand().empty());
  EXPECT_EQ(axis.range(), before);
  to->setValue(9500.0);
  EXPECT_TRUE(problem->isHidden());
  EXPECT_FALSE(automatic->isChecked());
  EXPECT_EQ(axis.range(), QCPRange(9000.0, 9500.0));
  editor->hide();
}

TEST_F(TimelineFeatureTest, TabGoesThroughALineOfTheAxesAsItIsSeen) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  windowState_->actions.at("verticalAxes")->trigger();
  auto* editor = actionsOf_.findChild<QFrame*>("AxisEditor");
  ASSERT_NE(editor, nullptr);
  QStringList reached;
  auto* first = editor->findChild<QCheckBox*>("automaticAxis");
  for (QWidget* at = first; reached.size() < 4; at = at->nextInFocusChain()) {
    if (at->focusPolicy() & Qt::TabFocus && at->isVisible() && at->focusProxy() == nullptr)
      reached.append(at->objectName());
    if (at->nextInFocusChain() == first) break;
  }
  EXPECT_EQ(reached, (QStringList{"automaticAxis", "axisFrom", "axisTo", "logAxis"}));
  editor->hide();
}

// The label of a gap stands at the top of the chart.
TEST_F(TimelineFeatureTest, TheReasonWhyAFormulaIsNotShownDoesNotCoverTheNameOfAGap) {
  TimelineChart& chart = feature_.panel().chart();
  ASSERT_TRUE(windowState_->formulas.keep({"far away", "m77_mean * 2", "counts"}));
  windowState_->displayed.show(
      makeOpenedRecording("gap.dsa", profileWithStamps({0, 50, 100, 150, 5150, 5200, 5250})));
  windowState_->selection.setPlotted({true, true});
  EXPECT_TRUE(feature_.signalTree().setTicked("far away", true));
  auto* notes = chart.findChild<QLabel*>("chartNotes");
  ASSERT_NE(notes, nullptr);
  for (const int height : {120, 300}) {
    chart.resize(900, height);
    chart.setViewport(chart.rect());
    chart.replot();
    chart.fit();
    chart.replot();
    int numNames = 0;
    for (int i = 0; i < chart.itemCount(); ++i) {
      auto* name = qobject_cast<QCPItemText*>(chart.item(i));
      // Units may stand in the corners.
      if (!name || !name->visible() || !name->text().startsWith("gap ")) continue;
      ++numNames;
      EXPECT_GE(notes->y(), name->bottom->pixelPosition().y()) << height;
    }
    EXPECT_EQ(numNames, 1);
    EXPECT_GE(notes->height(), notes->fontMetrics().height()) << height;
  }
}

TEST_F(TimelineFeatureTest, ComputedSeriesArePlottedOnceTheyAreComputed) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({false, false});
  ASSERT_TRUE(feature_.signalTree().setTicked("centroid x on", true));
  TimelineChart& chart = feature_.panel().chart();
  ASSERT_EQ(chart.curves().size(), 1u);
  EXPECT_EQ(chart.curves()[0].unit, "mm");
  feature_.settle();
  const auto samples = chart.store().samples(chart.curves()[0].choice);
  ASSERT_NE(samples, nullptr);
  EXPECT_EQ(samples->values.size(), 20u);
  EXPECT_EQ(chart.store().computing(), std::nullopt);
  // A formula takes its name.
  windowState_->formulas.keep({"in cm", "m0_centroid_x_mm / 10", "cm"});
  ASSERT_TRUE(feature_.signalTree().setTicked("in cm", true));
  EXPECT_EQ(chart.curves().size(), 2u);
  // Without a calibration there is no force, and a formula says so.
  EXPECT_FALSE(feature_.signalTree().setTicked("force of", true));
  windowState_->formulas.keep({"double", "2 * hand_force_n", "N"});
  ASSERT_TRUE(feature_.signalTree().setTicked("double", true));
  EXPECT_EQ(chart.curves().size(), 2u);
  const auto* notes = chart.findChild<QLabel*>("chartNotes");
  EXPECT_TRUE(notes->text().contains("needs a calibration")) << notes->text().toStdString();
}

TEST_F(TimelineFeatureTest, WithACalibrationThereAreForcesAndMatricesInTheirUnits) {
  const OpenedRecordingPtr shown = recording("a");
  windowState_->displayed.show(shown);
  windowState_->selection.setPlotted({true, false});
  TimelineChart& chart = feature_.panel().chart();
  Calibration calibration;
  for (const double t : {28.0, 36.0, 44.0})
    for (double k = 50.0; k <= 850.0; k += 100.0)
      calibration.samples.push_back({.file = "a",
                                     .sha256 = "",
                                     .pressureKpa = 0.1 * k + (t > 30.0 ? 0.01 : -0.01),
                                     .staticResponseCounts = k,
                                     .driftCountsPerS = 0.0,
                                     .nearestDegC = t,
                                     .activeAreaMm2 = 100.0});
  calibration.pressure = fitPressureModel(calibration.samples, {.indenterAreaMm2 = 50.0});
  windowState_->derivedResults.setForces(
      std::make_shared<const ComputedOptions>(ComputedOptions{.calibration = calibration}),
      shown.get());
  EXPECT_NE(windowState_->derivedResults.forcesOf(shown.get()), nullptr);
  EXPECT_EQ(windowState_->derivedResults.forcesOf(this), nullptr) << "another recording";
  ASSERT_TRUE(feature_.signalTree().setTicked("force of the whole hand", true));
  ASSERT_TRUE(feature_.signalTree().setTicked("matrices in kPa and N", true));
  ASSERT_EQ(chart.curves().size(), 2u);
  EXPECT_EQ(chart.curves()[0].unit, "N") << "of the sum";
  EXPECT_EQ(chart.curves()[1].unit, "N");
  feature_.settle();
  for (const PlottedCurve& curve : chart.curves())
    EXPECT_NE(chart.store().samples(curve.choice), nullptr) << curve.name.toStdString();
  const auto* notes = chart.findChild<QLabel*>("chartNotes");
  EXPECT_TRUE(notes->isHidden()) << notes->text().toStdString();
  // The pressures alone: forces on an unknown area are not known.
  calibration.pressure = fitPressureModel(calibration.samples, {});
  windowState_->derivedResults.setForces(
      std::make_shared<const ComputedOptions>(ComputedOptions{.calibration = calibration}),
      shown.get());
  EXPECT_FALSE(notes->isHidden());
  EXPECT_TRUE(notes->text().contains("no area of its indenter")) << notes->text().toStdString();
  EXPECT_TRUE(feature_.signalTree().setTicked("force of the whole hand", false));
  EXPECT_TRUE(feature_.signalTree().setTicked("matrices in kPa and N", false));
  EXPECT_TRUE(notes->isHidden()) << "no force is plotted";
  EXPECT_TRUE(feature_.signalTree().setTicked("force of the whole hand", true));
  EXPECT_TRUE(feature_.signalTree().setTicked("matrices in kPa and N", true));
  EXPECT_FALSE(notes->isHidden());
  windowState_->derivedResults.setForces(nullptr, shown.get());
  EXPECT_TRUE(notes->isHidden()) << "no calibration is applied";
  ASSERT_EQ(chart.curves().size(), 1u);
  EXPECT_EQ(chart.curves()[0].unit, "counts") << "the calibration is gone";
}

}  // namespace
}  // namespace palpate::gui::timeline_feature_test
