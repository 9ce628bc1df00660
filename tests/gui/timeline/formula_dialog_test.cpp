#include "gui/timeline/formula_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <palpate/emulator/synthetic_profile.h>

#include "gui/timeline/curve_table.h"
#include "gui/timeline/signal_tree.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/window_state/window_state_fixture.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::formula_dialog_test {
namespace {

class FormulaDialogTest : public WindowStateTest {
 protected:
  FormulaDialogTest() { makeFeature(); }
  void makeFeature() {
    feature_.reset();
    feature_ = std::make_unique<TimelineFeature>(*windowState_, &actionsOf_);
    windowState_->appearance.change([](ViewSettings& view) { view.signal = PlottedSignal::kMean; });
  }
  FormulaDialog& open() {
    windowState_->actions.at("newFormula")->trigger();
    auto* dialog = actionsOf_.findChild<FormulaDialog*>("FormulaDialog");
    if (!dialog) throw std::runtime_error("the dialog didn't open");
    return *dialog;
  }
  template <class T>
  static T& in(FormulaDialog& dialog, const char* name) {
    return *dialog.findChild<T*>(name);
  }
  static void choose(FormulaDialog& dialog, const char* name, const QString& text) {
    auto& box = in<QComboBox>(dialog, name);
    const int index = box.findText(text);
    ASSERT_GE(index, 0) << text.toStdString();
    box.setCurrentIndex(index);
    emit box.activated(index);
  }
  static void accept(FormulaDialog& dialog) {
    dialog.accept();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  TimelineChart& chart() { return feature_->panel().chart(); }
  const PlottedCurve* curve(const QString& name) {
    for (const PlottedCurve& each : chart().curves())
      if (each.name == name) return &each;
    return nullptr;
  }
  std::unique_ptr<TimelineFeature> feature_;
};

TEST_F(FormulaDialogTest, WritesTheFormulaOfWhatIsChosen) {
  windowState_->displayed.show(recording("a"));
  FormulaDialog& dialog = open();
  choose(dialog, "formulaOf", "finger 0 distal mean");
  EXPECT_EQ(dialog.curve(), (FormulaCurve{"finger 0 distal mean", "m1_mean", "counts"}));
  EXPECT_FALSE(in<QComboBox>(dialog, "formulaOther").isEnabled());
  choose(dialog, "formulaOperation", "its derivative");
  EXPECT_EQ(dialog.curve(),
            (FormulaCurve{"finger 0 distal mean · slope", "der(m1_mean)", "counts/s"}));
  choose(dialog, "formulaOperation", "minus another");
  EXPECT_TRUE(in<QComboBox>(dialog, "formulaOther").isEnabled());
  choose(dialog, "formulaOther", "finger 1 distal mean");
  EXPECT_EQ(dialog.curve().formula, "m1_mean - m3_mean");
  choose(dialog, "formulaOperation", "low-pass");
  EXPECT_EQ(dialog.curve().formula, "lowpass(m1_mean, 5)");
  EXPECT_EQ(dialog.curve().name, "finger 0 distal mean · low-pass 5 Hz");
  // A name of one's own stays.
  QTest::keyClicks(&in<QLineEdit>(dialog, "formulaName"), "!");
  choose(dialog, "formulaOperation", "running median");
  EXPECT_EQ(dialog.curve().name, "finger 0 distal mean · low-pass 5 Hz!");
  EXPECT_EQ(dialog.problem(), "");
  dialog.reject();
}

TEST_F(FormulaDialogTest, AFormulaOfOnesOwnIsItsName) {
  windowState_->displayed.show(recording("a"));
  FormulaDialog& dialog = open();
  choose(dialog, "formulaOf", "finger 0 distal mean");
  QTest::keyClicks(&in<QLineEdit>(dialog, "formulaText"), "/20");
  EXPECT_EQ(dialog.curve(), (FormulaCurve{"m1_mean/20", "m1_mean/20", ""}));
  EXPECT_EQ(in<QComboBox>(dialog, "formulaOperation").currentIndex(), -1) << "not \"itself\"";
  EXPECT_TRUE(in<QLabel>(dialog, "formulaProblem").text().contains("unit isn't known"));
  QTest::keyClicks(&in<QLineEdit>(dialog, "formulaUnit"), "N");
  EXPECT_FALSE(in<QLabel>(dialog, "formulaProblem").text().contains("unit"));
  QTest::keyClicks(&in<QLineEdit>(dialog, "formulaText"), "0");
  EXPECT_EQ(dialog.curve().unit, "N");
}

TEST_F(FormulaDialogTest, AnotherSignalIsProposedAndNotTheSame) {
  windowState_->displayed.show(recording("a"));
  FormulaDialog& dialog = open();
  choose(dialog, "formulaOf", "finger 0 distal mean");
  choose(dialog, "formulaOperation", "minus another");
  EXPECT_EQ(dialog.curve().formula, "m1_mean - m0_mean") << "the first one is another one already";
  choose(dialog, "formulaOther", "finger 0 distal mean");
  EXPECT_EQ(dialog.curve().formula, "m1_mean - m1_mean") << "what was chosen stays";
  choose(dialog, "formulaOperation", "divided by another");
  EXPECT_EQ(dialog.curve().formula, "m1_mean / m2_mean");
  dialog.reject();
}

TEST_F(FormulaDialogTest, SaysInOneLineWhatIsWrongWhileTyping) {
  windowState_->displayed.show(recording("a"));
  FormulaDialog& dialog = open();
  auto& field = in<QLineEdit>(dialog, "formulaText");
  const auto* good = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
  auto& said = in<QLabel>(dialog, "formulaProblem");
  // Frames are 50 ms apart: filters need less than 10 Hz.
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {"m1_mean +", "nexpected"},
      {"m9_mean", "m9_mean"},
      {"thumb", "thumb"},
      {"", "Type a formula"},
      {"der(m1_mean", "isn't closed"},
      {"lowpass(m1_mean)", "lowpass(x, Hz)"},
      {"lowpass(m1_mean, 12)", "10"},
      {"smooth(m1_mean, 4)", "odd"},
      {"a = 3", "=="}};
  for (const auto& [text, words] : wrong) {
    field.setText(text);
    EXPECT_TRUE(said.text().contains(words)) << text << ": " << said.text().toStdString();
    EXPECT_FALSE(said.text().contains('\n')) << text;
    EXPECT_FALSE(good->isEnabled()) << text;
  }
  field.setText("m1_mean/2");
  EXPECT_TRUE(good->isEnabled());
  in<QLineEdit>(dialog, "formulaName").clear();
  EXPECT_TRUE(said.text().contains("name"));
  EXPECT_FALSE(good->isEnabled());
  dialog.reject();
}

TEST_F(FormulaDialogTest, TheCurveIsPlottedKeptAndForgotten) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({false, true});
  FormulaDialog& dialog = open();
  in<QLineEdit>(dialog, "formulaText").setText("2*m1_max + 1");
  in<QLineEdit>(dialog, "formulaName").setText("twice");
  in<QLineEdit>(dialog, "formulaUnit").setText("counts");
  accept(dialog);
  ASSERT_TRUE(curve("twice"));
  EXPECT_EQ(curve("twice")->unit, "counts");
  chart().store().waitUntilRead();
  const OpenedRecordingPtr shown = windowState_->displayed.filteredRecording();
  const double expected = 2.0 * shown->at(5, 1).maximum + 1.0;
  EXPECT_EQ(chart().store().valueAt(curve("twice")->choice, shown->timeAt(5)), expected);
  // As the other curves it is in the table for export, and in the statistics that are made of it.
  const TextTable table = curveTable(shown, chart().curves(), {2, 9});
  EXPECT_EQ(table.header.back(), "twice [counts]");
  EXPECT_EQ(std::stod(table.row(3).back()), expected);
  // In the next session, too.
  feature_->remember();
  EXPECT_EQ(FormulaCurves(windowState_->settings).all().size(), 1u);
  EXPECT_TRUE(loadPlottedExtras(windowState_->settings).formulas.contains("twice"));
  // Unticked it is not drawn.
  EXPECT_TRUE(feature_->signalTree().setTicked("twice", false));
  EXPECT_FALSE(curve("twice"));
  windowState_->formulas.forget("twice");
  EXPECT_FALSE(feature_->signalTree().setTicked("twice", true));
}

TEST_F(FormulaDialogTest, ACurveIsChangedAndRenamed) {
  windowState_->displayed.show(recording("a"));
  windowState_->formulas.keep({"first", "m1_max", ""});
  emit feature_->signalTree().formulaRequested("first");
  auto* dialog = actionsOf_.findChild<FormulaDialog*>("FormulaDialog");
  ASSERT_TRUE(dialog);
  EXPECT_EQ(dialog->curve(), (FormulaCurve{"first", "m1_max", ""}));
  in<QLineEdit>(*dialog, "formulaName").setText("second");
  accept(*dialog);
  ASSERT_EQ(windowState_->formulas.all().size(), 1u);
  EXPECT_EQ(windowState_->formulas.all()[0].name, "second");
  EXPECT_TRUE(curve("second"));
}

TEST_F(FormulaDialogTest, WithoutARecordingThereIsNone) {
  windowState_->actionEnabler.refresh();
  EXPECT_FALSE(windowState_->actions.at("newFormula")->isEnabled());
  EXPECT_EQ(actionsOf_.findChild<FormulaDialog*>("FormulaDialog"), nullptr);
}

TEST(FormulaSignals, TheWholeHandHasNoComponents) {
  const Profile profile = synthesize({.durationS = 1.0, .grasps = 0});
  for (const FormulaSignal& each : formulaSignals(profile, SignalKind::kZ, {}))
    EXPECT_NE(each.name, "hand_z");
}

TEST(FormulaSignals, ColumnsOfFurtherSeriesAreSome) {
  const Profile profile = testing::withWrist(synthesize({.durationS = 1.0, .grasps = 0}), 10);
  const auto found = formulaSignals(profile, SignalKind::kMean, {});
  ASSERT_GT(found.size(), 3u);
  const FormulaSignal& torque = found.back();
  EXPECT_EQ(torque.caption, "wrist Torque Z");
  EXPECT_EQ(torque.name, "wrist_Torque_Z");
  EXPECT_EQ(torque.unit, "N m");
  EXPECT_EQ(problemOf("wrist_fz - m0_sum", &profile), "");
  EXPECT_NE(problemOf("wrist_fq", &profile), "");
}

}  // namespace
}  // namespace palpate::gui::formula_dialog_test
