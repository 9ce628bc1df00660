// The units chosen in the dialog Settings, in the views of the window: what is shown follows at
// once, what is computed and written doesn't.
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QTimer>
#include <QTreeWidget>

#include "palpate/device/sdh2.h"

#include "gui/compare/compare_fixture.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/taxel_text.h"
#include "gui/settings/settings_feature.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/cursor_readout.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/timeline/curve_table.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/widgets/facts_view.h"

namespace palpate::gui::units_window_test {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;
constexpr DisplayUnits kOthers{AngleUnit::kRadian,
                               TemperatureUnit::kKelvin,
                               AreaUnit::kSquareCentimetre,
                               PressureUnit::kNewtonPerSquareCentimetre};

class UnitsWindowTest : public WindowTest {
 protected:
  UnitsWindowTest() {
    open({"rich.dsa"});
    timeline().signalTree().setTicked(angleName(), true);
    timeline().signalTree().setTicked(sensorName(), true);
    window().settle();
  }
  TimelineFeature& timeline() { return window().feature<TimelineFeature>(); }
  TimelineChart& chart() { return *window().findChild<TimelineChart*>(); }
  const OpenedRecordingPtr& recording() { return window().state().displayed.unfilteredRecording(); }
  const HandDescription& hand() { return recording()->profile.hand(); }
  QString angleName() { return QString::fromStdString(hand().axes[1].name); }
  QString sensorName() { return QString::fromStdString(hand().temperatureSensors[2].name); }
  void use(const DisplayUnits& units) {
    SettingsFeature& settings = window().feature<SettingsFeature>();
    WindowChoices wanted = settings.choices();
    wanted.units = units;
    settings.apply(wanted);
  }
  // The shown curve of a kind.
  std::size_t curve(SeriesChoice::Kind kind) {
    const auto& curves = chart().curves();
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i].choice.kind == kind) return i;
    throw std::runtime_error("no such curve");
  }
  QCPGraph& graph(SeriesChoice::Kind kind) { return *chart().graph(static_cast<int>(curve(kind))); }
  double firstDrawn(SeriesChoice::Kind kind) { return graph(kind).data()->constBegin()->value; }
  QString axisName(SeriesChoice::Kind kind) { return graph(kind).valueAxis()->label(); }
  QString fact(const char* view, const QString& name) {
    for (const Fact& each : find<FactsView>(view)->facts())
      if (each.name == name) return each.value;
    return "no such fact";
  }
  static constexpr auto kAngle = SeriesChoice::Kind::kAngle;
  static constexpr auto kTemperature = SeriesChoice::Kind::kTemperature;
};

TEST_F(UnitsWindowTest, ChartsFollowAtOnce) {
  ASSERT_TRUE(axisName(kAngle).endsWith("°")) << axisName(kAngle).toStdString();
  ASSERT_TRUE(axisName(kTemperature).endsWith("°C"));
  const double deg = firstDrawn(kAngle), degC = firstDrawn(kTemperature);
  const double pixel = graph(kAngle).valueAxis()->coordToPixel(deg);
  use(kOthers);
  EXPECT_TRUE(axisName(kAngle).endsWith("rad")) << axisName(kAngle).toStdString();
  EXPECT_TRUE(axisName(kTemperature).endsWith("K"));
  EXPECT_NEAR(firstDrawn(kAngle), deg * kRadPerDeg, 1e-9);
  EXPECT_NEAR(firstDrawn(kTemperature), degC + 273.15, 1e-9);
  EXPECT_NEAR(graph(kAngle).valueAxis()->coordToPixel(firstDrawn(kAngle)), pixel, 0.01)
      << "the curve stays where it is";
  const PlottedCurve& angle = chart().curves()[curve(kAngle)];
  EXPECT_EQ(readingOf(angle, 90.0), "1.571 rad");
  EXPECT_EQ(differenceOf(angle, -90.0), "−1.571 rad");
  EXPECT_EQ(differenceOf(chart().curves()[curve(kTemperature)], 2.5), "+2.5 K");
  QStringList sections;
  const auto* list = timeline().signalTree().findChild<QTreeWidget*>("signalList");
  for (int i = 0; i < list->topLevelItemCount(); ++i)
    sections.append(list->topLevelItem(i)->text(0));
  EXPECT_TRUE(sections.contains("Joint angles (rad)"));
  EXPECT_TRUE(sections.contains("Temperatures (K)"));
  window().state().appearance.change(
      [](ViewSettings& view) { view.signal = PlottedSignal::kArea; });
  const PlottedCurve& area = chart().curves()[curve(SeriesChoice::Kind::kMatrix)];
  EXPECT_EQ(area.axis, "active area in cm²");
  EXPECT_EQ(readingOf(area, 1156.0), "11.56 cm²");
}

TEST_F(UnitsWindowTest, InspectFollowsAtOnce) {
  playback().seekFrame(recording()->profile.numFrames() / 2);
  const auto angles = recording()->profile.anglesAtFrame(window().state().currentFrame.index());
  const auto heats =
      recording()->profile.temperaturesAtFrame(window().state().currentFrame.index());
  ASSERT_TRUE(angles && heats);
  use(kOthers);
  const QString angle = fact("angleFacts", angleName());
  ASSERT_TRUE(angle.endsWith(" rad")) << angle.toStdString();
  EXPECT_NEAR(angle.chopped(4).toDouble(), angles->values[1] * kRadPerDeg, 0.000501);
  const QString heat = fact("temperatureFacts", sensorName());
  ASSERT_TRUE(heat.endsWith(" K")) << heat.toStdString();
  EXPECT_NEAR(heat.chopped(2).toDouble(), heats->values[2] + 273.15, 0.0501);
  MatrixTableModel& table = window().findChild<InspectPanel*>()->table();
  EXPECT_EQ(table.headerData(MatrixTableModel::kArea, Qt::Horizontal, Qt::DisplayRole), "cm²");
  const int all = table.rowCount() - 1;
  const double taxels = table.index(all, MatrixTableModel::kActive).data().toDouble();
  ASSERT_GT(taxels, 0.0);
  EXPECT_NEAR(
      table.index(all, MatrixTableModel::kArea).data().toDouble(), taxels * 0.1156, 0.00501);
  use({});
  EXPECT_TRUE(fact("angleFacts", angleName()).endsWith("°"));
  EXPECT_EQ(table.headerData(MatrixTableModel::kArea, Qt::Horizontal, Qt::DisplayRole), "mm²");
}

TEST_F(UnitsWindowTest, TablesForFilesKeepTheBaseUnits) {
  const FrameSpan span{0, 5};
  const auto filed = [&] {
    std::vector<std::vector<std::string>> rows = {
        curveTable(recording(), chart().curves(), span).header,
        curveTable(recording(), chart().curves(), span).row(3)};
    const TextTable statistics = statisticsTable(recording(), chart().curves(), span);
    for (std::size_t i = 0; i < statistics.numRows; ++i) rows.push_back(statistics.row(i));
    return rows;
  };
  const auto before = filed();
  use(kOthers);
  EXPECT_EQ(filed(), before);
  // What the dialog of statistics shows is in the chosen units.
  const SelectedCurves shown = selectedCurves(recording(), chart().curves(), span);
  const std::size_t angle = curve(kAngle);
  EXPECT_EQ(shown.curves[angle].unit, "rad");
  EXPECT_NEAR(shown.curves[angle].values[0],
              recording()->profile.anglesAtFrame(0)->values[1] * kRadPerDeg,
              1e-9);
}

TEST_F(UnitsWindowTest, DifferencesBetweenTheEndsAreInTheUnit) {
  auto* readout = window().findChild<CursorReadout*>();
  readout->setOn(true);
  use(kOthers);
  chart().setSelection(TimeSpan{0.5, 3.0});
  QString line;
  for (const QString& each : readout->lines())
    if (each.contains(" K")) line = each;
  // "motor 2  309.1 → 309.2  Δ 0.1 K  (0.04/s)"
  EXPECT_GT(line.section("  ", 1, 1).section(' ', 0, 0).toDouble(), 273.15) << line.toStdString();
  EXPECT_LT(std::abs(line.section("Δ ", 1).section(' ', 0, 0).toDouble()), 50.0)
      << line.toStdString();
}

TEST_F(UnitsWindowTest, ARangeByHandBelongsToItsUnit) {
  UnitAxes& axes = chart().axes();
  axes.setByHand("°", AxisRange{-100.0, 100.0});
  use(kOthers);
  EXPECT_LT(axes.of("rad")->range().upper, 10.0);
  EXPECT_FALSE(axisName(kAngle).endsWith("by hand"));
  axes.setByHand("rad", AxisRange{-0.0125, 1.5});
  use({});
  EXPECT_EQ(axes.of("°")->range().upper, 100.0);
  use(kOthers);
  EXPECT_EQ(axes.of("rad")->range().upper, 1.5);
  actions().at("verticalAxes")->trigger();
  double least = 0.0;
  for (const QDoubleSpinBox* field : window().findChildren<QDoubleSpinBox*>("axisFrom"))
    least = std::min(least, field->value());
  EXPECT_EQ(least, -0.0125) << "the field has enough decimals for radians";
}

TEST_F(UnitsWindowTest, CancelRestoresThem) {
  QTimer::singleShot(0, [&] {
    auto* dialog = window().findChild<SettingsDialog*>();
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QComboBox*>("settingsAngle")->setCurrentIndex(1);
    dialog->findChild<QComboBox*>("settingsTemperature")->setCurrentIndex(1);
    EXPECT_TRUE(axisName(kAngle).endsWith("rad")) << "at once";
    EXPECT_TRUE(axisName(kTemperature).endsWith("K"));
    dialog->reject();
  });
  press(Qt::Key_Comma, Qt::ControlModifier);
  EXPECT_TRUE(axisName(kAngle).endsWith("°"));
  EXPECT_TRUE(axisName(kTemperature).endsWith("°C"));
  EXPECT_EQ(window().state().appearance.view().units, DisplayUnits());
}

TEST_F(UnitsWindowTest, AreRemembered) {
  use(kOthers);
  window().close();
  start();
  EXPECT_EQ(window().state().appearance.view().units, kOthers);
  open({"rich.dsa"});
  playback().seekFrame(1);
  EXPECT_TRUE(fact("angleFacts", angleName()).endsWith(" rad"));
}

TEST(TaxelTextUnits, AreThoseOfThePressure) {
  const HandDescription& hand = sdh2();
  TactileFrame frame(hand.layout);
  frame.matrix(1)(2, 3) = 500.0F;
  PressureFrame pressure;
  pressure.kpa.assign(hand.layout->numCells(), 0.0F);
  pressure.matrices.resize(hand.layout->numMatrices());
  pressure.kpa[hand.layout->offset(1) +
               static_cast<std::size_t>(2 * hand.layout->matrix(1).columns + 3)] = 50.0F;
  EXPECT_TRUE(taxelText(hand, {1, 2, 3}, frame, &pressure).contains(" · 50.0 kPa · "));
  const QString text = taxelText(hand, {1, 2, 3}, frame, &pressure, kOthers);
  EXPECT_TRUE(text.contains(" · 500 counts · 5.00 N/cm² · ")) << text.toStdString();
}

class UnitsComparedTest : public CompareWindowFixture {};

TEST_F(UnitsComparedTest, AreasFollowAtOnce) {
  open({"early.dsa", "untouched.dsa"});
  compareNow();
  choose("compareSignal", "active area");
  CompareChart& chart = compare().chart();
  const auto last = [&] { return (chart.graph(0)->data()->constEnd() - 1)->value; };
  EXPECT_NEAR(last(), 138.72, 1e-6) << "12 taxels of 11.56 mm²";
  EXPECT_TRUE(compare().figures().contains("largest +138.7 mm² at"))
      << compare().figures().toStdString();
  window().state().appearance.setUnits(kOthers);
  EXPECT_NEAR(last(), 1.3872, 1e-8);
  EXPECT_GT(chart.yAxis->range().upper, 1.3872);
  EXPECT_LT(chart.yAxis->range().upper, 2.0);
  EXPECT_TRUE(chart.yAxis->label().endsWith("cm²"));
  EXPECT_TRUE(compare().figures().contains("largest +1.387 cm² at"))
      << compare().figures().toStdString();
  EXPECT_TRUE(QString::fromStdString(compare().curveTable().header[2]).endsWith("[mm²]"));
}

}  // namespace
}  // namespace palpate::gui::units_window_test
