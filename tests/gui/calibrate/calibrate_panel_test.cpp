// The dock Calibrate by itself: steps, noise, tare, and what all pages share.
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <fstream>

#include "palpate/device/sdh2.h"

#include "gui/calibrate/calibrate_fixture.h"
#include "gui/calibrate/measure_row.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/step_chart.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/source/file_reading.h"
#include "gui/testing/held_readings.h"
#include "gui/testing/sample_profiles.h"

namespace palpate::gui::calibrate_panel_test {
namespace {

// Every matrix reads 10 + .5 T, by turns one more and one less, while T goes from 20 to 40 deg C.
// Matrix 3 is touched in the last `touched` of the 2000 frames.
Profile warmingUp(ProfileInfo info = {}, int touched = 0) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  for (int i = 0; i < 2000; ++i) {
    const double degC = 20.0 + 0.01 * i;
    TactileFrame frame(hand.layout);
    for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
      frame.matrix(m)(7, 2) = static_cast<float>(10.0 + 0.5 * degC + (i % 2 == 0 ? 1.0 : -1.0));
    if (i >= 2000 - touched) frame.matrix(3)(7, 2) += 500.0F;
    const std::int64_t us = 1'400'000'000'000'000 + i * 100'000LL;
    builder.addFrame(us, frame.values);
    builder.addTemperatures(us, std::vector<double>(hand.temperatureSensors.size(), degC));
  }
  return builder.finish(std::move(info));
}

TEST_F(CalibratePanelTest, FindsTheStepsOfTheLoadedMatrix) {
  show("Steps", opened(loads(3, {900.0, 450.0})));
  StepPage& page = panel_->steps();
  ASSERT_TRUE(page.shown()) << why().toStdString();
  EXPECT_EQ(find<QComboBox>("stepMatrix")->currentIndex(), 3);
  ASSERT_EQ(page.found()->report.steps.size(), 2u);
  EXPECT_EQ(page.chosen(), 0u);
  // The mean over the nine taxels is the response itself.
  auto* signal = find<QComboBox>("stepSignal");
  EXPECT_EQ(signal->currentText(), "filtered mean");
  signal->setCurrentText("mean");
  emit signal->activated(signal->currentIndex());
  settle();
  const auto& steps = page.found()->report.steps;
  EXPECT_NEAR(steps[0].fit.parameters.staticResponseCounts, 900.0, 1.0);
  EXPECT_NEAR(steps[1].fit.parameters.staticResponseCounts, 450.0, 1.0);
  EXPECT_NEAR(steps[0].fit.parameters.driftCountsPerS, kDrift, 0.2);
  EXPECT_NEAR(steps[0].fit.parameters.t1S(), kT1, 0.02);
  EXPECT_NEAR(cell("stepTable", 0, 1).toDouble(), 900.0, 1.0);
  EXPECT_NEAR(cell("stepTable", 1, 0).toDouble(), 11.0, 0.05) << "when the second load came";
  EXPECT_EQ(cell("stepTable", 0, 7), "usable");
}

TEST_F(CalibratePanelTest, AChosenStepIsSaidAndDrawn) {
  show("Steps", opened(loads(3, {900.0, 450.0})));
  StepPage& page = panel_->steps();
  QSignalSpy spans(&page, &StepPage::spanChosen);
  page.choose(1);
  ASSERT_EQ(spans.size(), 1);
  EXPECT_NEAR(spans[0][0].toDouble(), 11.0, 0.05);
  EXPECT_NEAR(spans[0][1].toDouble(), 19.0, 0.15);
  StepChart& chart = page.chart();
  EXPECT_NEAR(chart.xAxis->range().upper, 8.0, 0.15);
  ASSERT_GE(chart.graphCount(), 5);
  EXPECT_GT(chart.graph(0)->dataCount(), 300);
  EXPECT_EQ(chart.graph(4)->dataCount(), chart.graph(0)->dataCount()) << "a residual each";
  // The tangent ends at K.
  const auto tangent = chart.graph(2)->data();
  ASSERT_EQ(tangent->size(), 2);
  EXPECT_NEAR((tangent->constEnd() - 1)->value,
              page.found()->report.steps[1].fit.parameters.staticResponseCounts,
              1e-9);
  QSignalSpy seekRequested(&page, &StepPage::seekRequested);
  QTest::mouseClick(&chart,
                    Qt::LeftButton,
                    {},
                    {static_cast<int>(chart.xAxis->coordToPixel(2.0)), chart.height() / 3});
  ASSERT_EQ(seekRequested.size(), 1);
  EXPECT_NEAR(seekRequested[0][0].toDouble(), 13.0, 0.1);
}

TEST_F(CalibratePanelTest, RobustFitsAreAskedFor) {
  Profile profile = loads(3, {900.0});
  show("Steps", opened(std::move(profile)));
  const double before = panel_->steps().found()->report.steps.at(0).fit.rmse;
  const auto first = panel_->steps().found();
  find<QCheckBox>("stepRobust")->setChecked(true);
  settle();
  EXPECT_NE(panel_->steps().found(), first) << "fitted anew";
  EXPECT_NEAR(panel_->steps().found()->report.steps.at(0).fit.rmse, before, 0.5);
}

TEST_F(CalibratePanelTest, SaysWhatIsMissing) {
  panel_->show();
  panel_->showPage("Steps");
  EXPECT_TRUE(why().contains("Open a recording"));
  panel_->setSource(nullptr, true);
  EXPECT_TRUE(why().contains("Record the connected hand"));
  EXPECT_FALSE(find<QComboBox>("stepMatrix")->isEnabled()) << "it is empty";
  show("Steps", makeOpenedRecording("e.dsa", profileWithStamps({})));
  EXPECT_TRUE(why().contains("no frame"));
  show("Steps", opened(loads(3, {0.0})));
  EXPECT_TRUE(find<QComboBox>("stepMatrix")->isEnabled());
  EXPECT_TRUE(why().contains("stays for at least one second")) << why().toStdString();
  EXPECT_TRUE(panel_->page().tables().empty());
  show("Noise", opened(loads(3, {0.0})));
  EXPECT_TRUE(why().contains("temperature")) << why().toStdString();
  EXPECT_FALSE(find<QPushButton>("noiseSave")->isEnabled());
  show("Force", opened(loads(3, {0.0})));
  EXPECT_TRUE(why().contains("No calibration")) << why().toStdString();
  show("Pressure", nullptr);
  EXPECT_TRUE(why().contains("Open a table"));
  panel_->pressure().open(folder_ / "none.csv");
  settle();
  EXPECT_TRUE(why().contains("can't be opened")) << why().toStdString();
  panel_->pressure().open(folder_ / "none.json");
  settle();
  EXPECT_TRUE(why().contains("can't be opened")) << why().toStdString();
  std::ofstream(folder_ / "empty.csv") << "file,pressure_kpa\n";
  panel_->pressure().open(folder_ / "empty.csv");
  settle();
  EXPECT_TRUE(why().contains("empty.csv")) << why().toStdString();
  std::ofstream(folder_ / "t.csv") << "file,pressure_kpa\nnone.dsa,5\n";
  panel_->pressure().open(folder_ / "t.csv");
  settle();
  EXPECT_TRUE(why().contains("usable step")) << why().toStdString();
  EXPECT_TRUE(why().contains("none.dsa")) << why().toStdString();
}

TEST_F(CalibratePanelTest, NoiseLinesAreShownAndSaved) {
  show("Noise", opened(warmingUp()));
  ASSERT_TRUE(panel_->noise().shown()) << why().toStdString();
  const auto& lines = panel_->noise().found()->floor.lines;
  ASSERT_EQ(lines.size(), 6u);
  for (const NoiseLine& line : lines) EXPECT_NEAR(line.slope, 0.5, 1e-3);
  EXPECT_NEAR(cell("noiseTable", 0, 1).toDouble(), 0.5, 1e-3);
  EXPECT_NEAR(cell("noiseTable", 0, 2).toDouble(), 10.0, 0.05);
  EXPECT_NEAR(cell("noiseTable", 0, 3).toDouble(), 1.0, 0.01) << "one more, one less";
  ask_.newFiles = {pathText(folder_ / "n.xml"), pathText(folder_ / "none" / "n.json")};
  QSignalSpy said(panel_.get(), &CalibratePanel::said);
  find<QPushButton>("noiseSave")->click();
  EXPECT_EQ(ask_.newFiles.began, QStringList("r_noise.json"));
  EXPECT_EQ(said.size(), 1);
  const NoiseFloor read = parseNoiseXml(testing::readFile(folder_ / "n.xml"), "n.xml");
  ASSERT_EQ(read.lines.size(), 6u);
  EXPECT_NEAR(read.lines[5].slope, 0.5, 1e-3);
  panel_->noise().save(folder_ / "n.json");
  const Json json = Json::parse(testing::readFile(folder_ / "n.json"));
  EXPECT_EQ(json.at("kind").asString(), "palpate noise calibration");
  EXPECT_FALSE(json.at("program_version").asString().empty());
  EXPECT_NEAR(noiseFloorFrom(json).lines.at(0).intercept, 10.0, 0.05);
  find<QPushButton>("noiseSave")->click();
  EXPECT_EQ(said.size(), 2);
  EXPECT_TRUE(said[1][0].toString().contains("n.json")) << "said that it can't be written";
}

TEST_F(CalibratePanelTest, LinesOfATouchedHandAreNoNoiseAndNotApplied) {
  show("Noise", opened(warmingUp()));
  EXPECT_TRUE(find<QPushButton>("noiseApply")->isEnabled());
  show("Noise", opened(warmingUp({}, 800)));
  ASSERT_TRUE(panel_->noise().shown()) << why().toStdString();
  EXPECT_FALSE(find<QPushButton>("noiseApply")->isEnabled());
  EXPECT_TRUE(find<QPushButton>("noiseApply")->toolTip().contains("touched or moved in 40 %"));
  EXPECT_TRUE(find<QLabel>("noiseNotes")->text().contains("These lines are not noise"));
  EXPECT_EQ(cell("noiseTable", 3, 7), "not at rest");
  EXPECT_NE(cell("noiseTable", 2, 7), "not at rest");
  panel_->noise().save(folder_ / "touched.json");
  QSignalSpy applied(&panel_->noise(), &NoisePage::applyRequested);
  ask_.files = {pathText(folder_ / "touched.json")};
  find<QPushButton>("noiseOpen")->click();
  FileReading::settleAll(*panel_);
  EXPECT_EQ(applied.size(), 0);
  show("Noise", opened(warmingUp()));
  EXPECT_TRUE(find<QPushButton>("noiseApply")->isEnabled());
}

TEST_F(CalibratePanelTest, LinesThatWereChosenForOneHandAreNotAppliedToAnother) {
  show("Noise", opened(warmingUp()));
  panel_->noise().save(folder_ / "n.json");
  ask_.files = {pathText(folder_ / "n.json")};
  QSignalSpy applied(&panel_->noise(), &NoisePage::applyRequested);
  QSignalSpy said(&panel_->noise(), &NoisePage::said);
  {
    HeldReadings held;
    find<QPushButton>("noiseOpen")->click();
    panel_->setSource(opened(warmingUp()), false);
  }
  FileReading::settleAll(*panel_);
  QCoreApplication::processEvents();
  EXPECT_EQ(applied.size(), 0);
  ASSERT_EQ(said.size(), 1);
  EXPECT_TRUE(said[0][0].toString().startsWith("noise lines not applied"));
  find<QPushButton>("noiseOpen")->click();
  FileReading::settleAll(*panel_);
  EXPECT_EQ(applied.size(), 1);
}

TEST_F(CalibratePanelTest, NoiseThatWasMeasuredLiveIsSavedWithItsOrigin) {
  panel_->show();
  panel_->showPage("Noise");
  panel_->setSource(nullptr, true);
  EXPECT_TRUE(why().contains("Measure now"));
  ProfileInfo info;
  info.format = kLiveMeasurementFormat;
  info.serial = "1D9B0057";
  info.warnings = {"12 frames were lost"};
  panel_->noise().setMeasured(makeOpenedRecording("live_1", warmingUp(info)));
  settle();
  ASSERT_TRUE(panel_->noise().shown()) << why().toStdString();
  for (const NoiseLine& line : panel_->noise().found()->floor.lines)
    EXPECT_NEAR(line.slope, 0.5, 1e-3);
  panel_->noise().save(folder_ / "n.json");
  const Json json = Json::parse(testing::readFile(folder_ / "n.json"));
  EXPECT_EQ(json.at("file").asString(), "live_1");
  EXPECT_EQ(json.at("sha256").asString(), "") << "it is no file";
  const Json measured = json.at("measured");
  EXPECT_EQ(measured.at("serial").asString(), "1D9B0057");
  EXPECT_EQ(measured.at("frames").asInteger(), 2000);
  EXPECT_NEAR(measured.at("seconds").asDouble(), 199.9, 1e-9);
  EXPECT_EQ(measured.at("missing").at(0).asString(), "12 frames were lost");
  EXPECT_EQ(noiseFloorFrom(json).lines.size(), 6u);
  // A recording doesn't show what was measured, and another hand neither.
  show("Noise", nullptr);
  EXPECT_TRUE(why().contains("Open a recording"));
  EXPECT_EQ(panel_->noise().found(), nullptr);
}

TEST_F(CalibratePanelTest, TheTareIsProposed) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  for (int i = 0; i < 400; ++i) {
    TactileFrame frame(hand.layout);
    frame.matrix(1)(7, 2) = 30.0F;                                         // a ghost
    frame.matrix(4).setConstant(static_cast<float>(300 + 200 * (i % 2)));  // never at rest
    builder.addFrame(1'400'000'000'000'000 + i * 25'000, frame.values);
  }
  show("Tare", opened(builder.finish({})));
  ASSERT_TRUE(panel_->tare().shown()) << why().toStdString();
  EXPECT_EQ(cell("tareTable", 1, 2), "30.0");
  EXPECT_EQ(cell("tareTable", 1, 3), "1");
  EXPECT_EQ(cell("tareTable", 4, 4), "never unloaded");
  EXPECT_EQ(cell("tareTable", 0, 3), "0");
  EXPECT_EQ(cell("tareTable", 0, 4), "0 (median)");
  QSignalSpy keep(&panel_->tare(), &TarePage::keepRequested);
  auto* button = find<QPushButton>("tareKeep");
  ASSERT_TRUE(button->isEnabled());
  button->click();
  EXPECT_EQ(keep.size(), 1);
  EXPECT_FALSE(find<QPushButton>("tareRemove")->isVisible());
  panel_->tare().setKept(true);
  EXPECT_TRUE(find<QPushButton>("tareRemove")->isVisible());
  EXPECT_TRUE(find<QLabel>("tareState")->text().contains("has a tare"));
}

TEST_F(CalibratePanelTest, OpensWithWhatAConnectedHandCanDo) {
  panel_->showPage("Steps");
  panel_->setSource(nullptr, true);
  EXPECT_EQ(panel_->pageName(), "Noise");
  panel_->show();
  panel_->showPage("Steps");
  panel_->setSource(nullptr, true);
  EXPECT_EQ(panel_->pageName(), "Steps") << "it is being looked at";
}

TEST_F(CalibratePanelTest, ComputesOnlyWhileItIsSeenAndCanBeGivenUp) {
  panel_->showPage("Steps");
  panel_->setSource(opened(loads(3, {900.0})), false);
  EXPECT_FALSE(panel_->steps().busy());
  panel_->show();
  EXPECT_TRUE(panel_->steps().busy());
  EXPECT_FALSE(panel_->noise().busy()) << "another page";
  EXPECT_TRUE(panel_->cancel());
  EXPECT_EQ(why(), "Cancelled.");
  settle();
  EXPECT_EQ(why(), "Cancelled.") << "what was at work then changes nothing";
  find<QPushButton>("stepsEmptyButton")->click();
  settle();
  EXPECT_TRUE(panel_->steps().shown());
  EXPECT_FALSE(panel_->cancel());
}

TEST_F(CalibratePanelTest, ThePageIsRemembered) {
  panel_->showPage("Noise");
  panel_ = std::make_unique<CalibratePanel>(settings_, ask_);
  EXPECT_EQ(panel_->pageName(), "Noise");
  settings_.setValue("calibrate/page", "nonsense");
  panel_ = std::make_unique<CalibratePanel>(settings_, ask_);
  EXPECT_EQ(panel_->pageName(), "Steps");
}

TEST_F(CalibratePanelTest, TablesHaveAsManyCellsAsTheirHeaders) {
  const OpenedRecordingPtr recording = opened(loads(3, {900.0, 450.0}));
  for (const char* name : {"Steps", "Tare"}) {
    show(name, recording);
    for (const ExportedTable& table : panel_->page().tables()) {
      const TextTable made = table.make();
      ASSERT_GT(made.numRows, 0u) << name;
      EXPECT_EQ(made.row(made.numRows - 1).size(), made.header.size()) << table.name.toStdString();
    }
  }
  show("Noise", opened(warmingUp()));
  for (const ExportedTable& table : panel_->page().tables()) {
    const TextTable made = table.make();
    EXPECT_EQ(made.row(0).size(), made.header.size());
  }
}

TEST_F(CalibratePanelTest, IsSeenInBothThemes) {
  show("Steps", opened(loads(3, {900.0})));
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    applyTheme(*qApp, theme);
    QCoreApplication::processEvents();
    EXPECT_EQ(panel_->steps().chart().xAxis->labelColor(), colorsOf(theme).muted);
    EXPECT_EQ(panel_->steps().chart().grab().toImage().pixelColor(2, 2), colorsOf(theme).window);
  }
}

}  // namespace
}  // namespace palpate::gui::calibrate_panel_test
