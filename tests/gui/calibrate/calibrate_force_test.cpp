// The dock Calibrate by itself: calibrations, and the forces that follow from them.
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <fstream>

#include "palpate/device/sdh2.h"
#include <palpate/calibration/force_series.h>
#include <palpate/recording/recording.h>

#include "gui/calibrate/calibrate_fixture.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/pressure_chart.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/surface_chart.h"

namespace palpate::gui::calibrate_force_test {
namespace {

class CalibrateForceTest : public CalibratePanelTest {
 protected:
  std::filesystem::path saved(const Calibration& calibration) {
    saveCalibration(calibration, folder_ / "c.json", Overwrite::kReplace);
    return folder_ / "c.json";
  }
};

// P = .1 K, made from samples of 50 to 850 counts and 28 to 44 deg C.
Calibration tenth(double indenterAreaMm2 = 50.0) {
  Calibration calibration;
  calibration.programVersion = "0.1.0";
  calibration.madeAt = "2014-11-27T10:31:05Z";
  calibration.hand = sdh2().name;
  calibration.matrix = 3;
  int i = 0;
  for (const double t : {28.0, 36.0, 44.0})
    for (double k = 50.0; k <= 850.0; k += 100.0)
      calibration.samples.push_back({.file = "a.dsa",
                                     .sha256 = "",
                                     .pressureKpa = 0.1 * k + (i++ % 2 == 0 ? 0.01 : -0.01),
                                     .staticResponseCounts = k,
                                     .driftCountsPerS = 0.0,
                                     .nearestDegC = t,
                                     .activeAreaMm2 = 100.0});
  calibration.pressure =
      fitPressureModel(calibration.samples, {.indenterAreaMm2 = indenterAreaMm2});
  return calibration;
}

TEST_F(CalibrateForceTest, APressureTableBecomesACalibration) {
  // P = K / 10 at 30 deg C, of recordings on disk.
  std::ofstream table(folder_ / "t.csv");
  table << "file,pressure_kpa\n";
  for (const double gain : {200.0, 400.0, 600.0, 800.0}) {
    const std::string name = "g" + std::to_string(static_cast<int>(gain)) + ".palpate";
    saveRecording(loads(3, {gain}, 30.0), {}, folder_ / name);
    table << name << ',' << gain / 10.0 << '\n';
  }
  table << "none.dsa,5\n";
  table.close();
  show("Pressure", nullptr);
  PressurePage& page = panel_->pressure();
  ask_.files = {pathText(folder_ / "t.csv")};
  find<QPushButton>("pressureOpen")->click();
  settle();
  ASSERT_TRUE(page.shown()) << why().toStdString();
  const Calibration& made = page.shownCalibration()->calibration;
  EXPECT_EQ(made.matrix, 3u);
  EXPECT_EQ(made.samples.size(), 5u);
  const QString facts = page.facts().join('\n');
  EXPECT_TRUE(facts.contains("leave-one-out")) << facts.toStdString();
  EXPECT_TRUE(facts.contains("4 of 5 used")) << facts.toStdString();
  EXPECT_TRUE(facts.contains(QString::fromStdString((folder_ / "t.csv").string())));
  EXPECT_TRUE(cell("pressureSamples", 4, 6).startsWith("left out: "));
  // One temperature: no term with it.
  ASSERT_TRUE(made.pressure.valid());
  EXPECT_NEAR(made.pressure.pressureAt(made.samples[1].staticResponseCounts, 30.0).kpa, 40.0, 0.2);
  // From above: the same model, told under the mouse.
  find<QCheckBox>("pressureAbove")->setChecked(true);
  const auto* surface = panel_->findChild<SurfaceChart*>();
  ASSERT_TRUE(surface->isVisible());
  for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  const QPointF at(surface->xAxis->coordToPixel(made.samples[1].staticResponseCounts),
                   surface->yAxis->coordToPixel(30.0));
  EXPECT_TRUE(surface->readingAt(at).contains("30.0 °C: 40."))
      << surface->readingAt(at).toStdString();
  EXPECT_EQ(surface->readingAt({-5.0, -5.0}), "");
  // What was said of the sensor goes with it.
  find<QDoubleSpinBox>("pressureThreshold")->setValue(150.0);
  find<QDoubleSpinBox>("pressureArea")->setValue(50.0);
  settle();
  ask_.newFiles = {pathText(folder_ / "made.json")};
  QSignalSpy applied(&page, &PressurePage::applyRequested);
  find<QPushButton>("pressureApply")->click();
  ASSERT_EQ(applied.size(), 1) << "saved first, then applied";
  EXPECT_EQ(applied[0][0].toString().toStdString(), (folder_ / "made.json").string());
  const Calibration read = loadCalibration(folder_ / "made.json");
  EXPECT_EQ(read.settings.thresholdCounts, 150.0);
  EXPECT_EQ(read.pressure.options.indenterAreaMm2, 50.0);
  EXPECT_EQ(read.samples.at(0).sha256.size(), 64u);
  EXPECT_EQ(read.options.at("table_sha256").asString().size(), 64u);
  const auto tables = page.tables();
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].make().numRows, 5u);
  EXPECT_EQ(tables[0].make().row(0).size(), tables[0].make().header.size());
}

TEST_F(CalibrateForceTest, ASavedCalibrationIsReadAsItIs) {
  show("Pressure", nullptr);
  panel_->pressure().open(saved(tenth()));
  settle();
  ASSERT_TRUE(panel_->pressure().shown()) << why().toStdString();
  EXPECT_FALSE(find<QCheckBox>("pressureStudy")->isEnabled()) << "it is made";
  const QString facts = panel_->pressure().facts().join('\n');
  EXPECT_TRUE(facts.contains("2014-11-27T10:31:05Z by palpate 0.1.0")) << facts.toStdString();
  EXPECT_TRUE(facts.contains("K 50 to 850 counts, 28.0 to 44.0 °C")) << facts.toStdString();
  EXPECT_TRUE(facts.contains("indenter of 50")) << facts.toStdString();
  EXPECT_EQ(sliceTemperatures(tenth().pressure, tenth().samples),
            (std::vector<double>{28.0, 36.0, 44.0}));
  // Applied without saving: it is on disk.
  QSignalSpy applied(&panel_->pressure(), &PressurePage::applyRequested);
  find<QPushButton>("pressureApply")->click();
  EXPECT_EQ(applied.size(), 1);
  std::ofstream(folder_ / "bad.json") << "{}";
  panel_->pressure().open(folder_ / "bad.json");
  settle();
  EXPECT_TRUE(why().contains("isn't a calibration")) << why().toStdString();
  EXPECT_FALSE(find<QPushButton>("pressureSave")->isEnabled());
}

TEST_F(CalibrateForceTest, ForcesAreTheAppliedCalibrations) {
  const OpenedRecordingPtr recording = opened(loads(3, {500.0}));
  applyCalibration(settings_, sdh2().name, QString::fromStdString(saved(tenth()).string()));
  show("Force", recording);
  ForcePage& page = panel_->force();
  ASSERT_TRUE(page.shown()) << why().toStdString();
  page.setPosition(0.5);
  EXPECT_EQ(cell("forceTable", 3, 4), "0") << "before the load";
  page.setPosition(5.0);
  const ForceSeries& found = *page.found();
  const std::size_t frame = found.frameAt(5.0);
  EXPECT_NEAR(cell("forceTable", 3, 3).toDouble(),
              static_cast<double>(found.at(frame, 3).staticResponseCounts) / 10.0,
              0.2);
  EXPECT_NEAR(cell("forceTable", 6, 4).toDouble(), cell("forceTable", 3, 4).toDouble(), 1e-9)
      << "the whole hand";
  EXPECT_GT(cell("forceTable", 6, 4).toDouble(), 0.0);
  const QString notes = find<QLabel>("forceNotes")->text();
  EXPECT_TRUE(notes.contains("35 °C assumed")) << notes.toStdString();
  EXPECT_TRUE(notes.contains("settings of the calibration")) << notes.toStdString();
  EXPECT_TRUE(find<QLabel>("forceNotes")->isVisible());
  EXPECT_LT(find<QLabel>("forceNotes")->y(), find<QWidget>("forceTable")->y());
  EXPECT_TRUE(find<QLabel>("forceAssumed")->isVisible()) << "no fact of the recording";
  // The fields begin with the calibration's own; what is typed is taken.
  EXPECT_EQ(find<QDoubleSpinBox>("forceSensitivity")->value(), 1.0);
  const float before = found.at(frame, 3).staticResponseCounts;
  find<QDoubleSpinBox>("forceSensitivity")->setValue(0.5);
  settle();
  EXPECT_NEAR(page.found()->at(frame, 3).staticResponseCounts, 2.0F * before, 0.02F * before);
  EXPECT_FALSE(find<QDoubleSpinBox>("forceSensitivity")->parentWidget()->isHidden());
  QSignalSpy keep(&page, &ForcePage::keepRequested);
  find<QPushButton>("forceKeep")->click();
  ASSERT_EQ(keep.size(), 1);
  EXPECT_EQ(keep[0][0].toDouble(), 0.5);
  // As the recording has it.
  page.setKept({.settings = SensorSettings{1.0, 100.0, true}});
  settle();
  EXPECT_NEAR(page.found()->at(frame, 3).staticResponseCounts, before, 0.01F * before);
  const auto tables = page.tables();
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].make().numRows, 400u * 6u);
  const TextTable assumptions = tables[1].make();
  ASSERT_GE(assumptions.numRows, 1u);
  EXPECT_EQ(assumptions.row(0).front(),
            "measured on matrix 3; the others are assumed to answer alike");
  find<QPushButton>("forceDrop")->click();
  settle();
  EXPECT_TRUE(why().contains("No calibration"));
  EXPECT_TRUE(find<QDoubleSpinBox>("forceSensitivity")->parentWidget()->isHidden())
      << "settings that nobody told";
  EXPECT_EQ(appliedCalibration(settings_, sdh2().name), "");
}

// analyst M5
TEST_F(CalibrateForceTest, WithoutTheAreaOfTheIndenterForcesAreUpperLimits) {
  const OpenedRecordingPtr recording = opened(loads(3, {500.0}));
  applyCalibration(settings_, sdh2().name, QString::fromStdString(saved(tenth(0.0)).string()));
  show("Force", recording);
  ForcePage& page = panel_->force();
  ASSERT_TRUE(page.shown()) << why().toStdString();
  page.setPosition(5.0);
  for (const int row : {3, 6}) EXPECT_TRUE(cell("forceTable", row, 4).startsWith("≤ ")) << row;
  const QString notes = find<QLabel>("forceNotes")->text();
  EXPECT_TRUE(notes.contains("the area of the indenter is not known")) << notes.toStdString();
  const std::size_t row = 6 * page.found()->frameAt(5.0) + 3;
  const std::vector<std::string> cells = page.tables()[0].make().row(row);
  EXPECT_NE(cells[5], "") << "a pressure";
  EXPECT_EQ(cells[7], "");
  EXPECT_EQ(cells[8], "");
}

TEST_F(CalibrateForceTest, PressuresAreShownInTheChosenUnitAndWrittenInKilopascals) {
  const OpenedRecordingPtr recording = opened(loads(3, {500.0}));
  applyCalibration(settings_, sdh2().name, QString::fromStdString(saved(tenth()).string()));
  show("Force", recording);
  ForcePage& page = panel_->force();
  ASSERT_TRUE(page.shown()) << why().toStdString();
  page.setPosition(5.0);
  auto* table = find<FiguresTable>("forceTable");
  EXPECT_EQ(table->horizontalHeaderItem(3)->text(), "kPa");
  const double kpa = static_cast<double>(page.found()->at(page.found()->frameAt(5.0), 3).kpa);
  ASSERT_GT(kpa, 1.0);
  EXPECT_NEAR(cell("forceTable", 3, 3).toDouble(), kpa, 0.00501);
  const QString newtons = cell("forceTable", 3, 4);
  page.setUnits({.pressure = PressureUnit::kNewtonPerSquareCentimetre});
  EXPECT_EQ(table->horizontalHeaderItem(3)->text(), "N/cm²");
  EXPECT_NEAR(cell("forceTable", 3, 3).toDouble(), kpa / 10.0, 0.000501);
  EXPECT_EQ(cell("forceTable", 3, 4), newtons);
  EXPECT_EQ(page.tables()[0].make().header[5], "pressure_kpa");
}

TEST_F(CalibrateForceTest, AnAppliedFileThatIsGoneIsNamed) {
  applyCalibration(
      settings_, sdh2().name, QString::fromStdString((folder_ / "gone.json").string()));
  show("Force", opened(loads(3, {500.0})));
  EXPECT_TRUE(why().contains("gone.json")) << why().toStdString();
  Calibration without = tenth();
  without.pressure.gain.valid = false;
  saveCalibration(without, folder_ / "gone.json");
  find<QPushButton>("forceEmptyButton")->click();
  settle();
  EXPECT_TRUE(why().contains("no P(K, T)")) << why().toStdString();
}

}  // namespace
}  // namespace palpate::gui::calibrate_force_test
