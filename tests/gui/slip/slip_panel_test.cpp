// The dock Slip by itself.
#include "gui/slip/slip_panel.h"

#include <QApplication>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QFontInfo>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/core/number_text.h>
#include <palpate/slip/slip_segments.h>

#include "gui/appearance/text_size.h"
#include "gui/slip/slip_chart.h"
#include "gui/slip/slip_controls.h"
#include "gui/slip/slip_fixture.h"
#include "gui/slip/slip_indicator.h"
#include "gui/widgets/figures_table.h"
#include "testing/testing.h"

namespace palpate::gui::slip_panel_test {
namespace {

constexpr double kIntervalS = 0.032;
enum Column { kName, kVerdict, kStep, kWhole, kTurned };

class SlipPanelTest : public ::testing::Test {
 protected:
  SlipPanelTest() { make(); }
  void make() {
    panel_.reset();
    settings_ = std::make_unique<QSettings>(QString::fromStdString((folder_ / "s.ini").string()),
                                            QSettings::IniFormat);
    panel_ = std::make_unique<SlipPanel>(*settings_);
    panel_->resize(640, 700);
    applyTheme(*qApp, Theme::kDark);
    panel_->show();
  }
  void show(const OpenedRecordingPtr& recording) {
    panel_->setSource(recording, false);
    settle();
  }
  void settle() {
    panel_->settle();
    QCoreApplication::processEvents();
  }
  OpenedRecordingPtr slip() {
    if (!slip_) slip_ = makeOpenedRecording("slip.dsa", movingContact());
    return slip_;
  }
  void goTo(std::size_t frame) {
    panel_->setPosition(static_cast<double>(frame) * kIntervalS + 1e-4);
  }
  template <class Widget>
  Widget* find(const char* name) {
    return panel_->findChild<Widget*>(name);
  }
  QString cell(std::size_t row, Column column) {
    return find<FiguresTable>("slipList")->item(static_cast<int>(row), column)->text();
  }
  void chooseMethod(const char* name) {
    auto* box = find<QComboBox>("slipMethod");
    box->setCurrentText(name);
    emit box->activated(box->currentIndex());
    settle();
  }

  testing::TemporaryFolder folder_;
  std::unique_ptr<QSettings> settings_;
  OpenedRecordingPtr slip_;
  std::unique_ptr<SlipPanel> panel_;
};

TEST_F(SlipPanelTest, SaysWhatToDoWhereThereIsNothing) {
  show(nullptr);
  EXPECT_TRUE(panel_->emptyText().contains("Open a recording, or connect a hand"));
  EXPECT_FALSE(find<QPushButton>("slipSetReference")->isEnabled());
  ProfileBuilder untouched(sdh2().layout);
  for (int i = 0; i < 5; ++i) untouched.addFrame(i * 32'000, TactileFrame(sdh2().layout).values);
  show(makeOpenedRecording("untouched.dsa", untouched.finish({})));
  EXPECT_TRUE(panel_->emptyText().contains("No contact in this recording"));
  ProfileBuilder empty(sdh2().layout);
  show(makeOpenedRecording("empty.dsa", empty.finish({})));
  EXPECT_TRUE(panel_->emptyText().contains("has no frames"));
}

TEST_F(SlipPanelTest, ShowsWhatSlipsAndWhatRests) {
  show(slip());
  ASSERT_TRUE(panel_->shown()) << panel_->emptyText().toStdString();
  EXPECT_EQ(panel_->chosen(), kMoving) << "what slips most";
  goTo(kRests + 10);
  EXPECT_EQ(cell(kMoving, kVerdict), "slip");
  EXPECT_EQ(cell(kStill, kVerdict), "still");
  EXPECT_EQ(cell(0, kVerdict), "no contact");
  EXPECT_EQ(cell(0, kStep), "–");
  EXPECT_NEAR(cell(kMoving, kStep).toDouble(), kStepTaxels, 0.06);
  EXPECT_NEAR(cell(kMoving, kWhole).toDouble(), 11 * kStepTaxels, 0.15);
  EXPECT_NEAR(cell(kStill, kWhole).toDouble(), 0.0, 0.1);
  // Lamps: told apart by their pictures, not by their colour alone.
  const auto indicator = [&](std::size_t row) {
    return find<FiguresTable>("slipList")
        ->item(static_cast<int>(row), kName)
        ->icon()
        .pixmap(16)
        .toImage();
  };
  EXPECT_EQ(indicator(kMoving),
            indicatorIcon(IndicatorLook::kSlipping, Theme::kDark).pixmap(16).toImage());
  EXPECT_EQ(indicator(kStill),
            indicatorIcon(IndicatorLook::kReady, Theme::kDark).pixmap(16).toImage());
  EXPECT_EQ(indicator(0), indicatorIcon(IndicatorLook::kOff, Theme::kDark).pixmap(16).toImage());
  goTo(2 * kRests + kMoves - 1);
  EXPECT_EQ(cell(kMoving, kVerdict), "still");
}

TEST_F(SlipPanelTest, DrawsTheWayOfTheContact) {
  show(slip());
  chooseMethod("register");
  goTo(kRests + kMoves - 1);
  const auto& scene = panel_->drawing().scene();
  ASSERT_TRUE(scene && scene->sample);
  EXPECT_EQ(scene->name, "finger 0 distal");
  ASSERT_FALSE(scene->path.empty());
  EXPECT_NEAR(scene->path.front().y(), kBeginsAt, 0.1);
  EXPECT_NEAR(scene->path.back().y(), kEndsAt, 0.15);
  for (const QPointF& point : scene->path) EXPECT_NEAR(point.x(), 2.5, 0.1);
  // It is seen: halfway the line has the colour of the accent.
  const QImage image = panel_->drawing().grab().toImage();
  const QPointF half = panel_->drawing().pixelOf(2.5, 0.5 * (kBeginsAt + kEndsAt));
  const QColor accent = colorsOf(Theme::kDark).accent;
  bool found = false;
  for (int x = -4; x <= 4; ++x) {
    const QColor seen =
        image.pixelColor(static_cast<int>(half.x()) + x, static_cast<int>(half.y()));
    found = found || (std::abs(seen.red() - accent.red()) < 40 &&
                      std::abs(seen.green() - accent.green()) < 40 &&
                      std::abs(seen.blue() - accent.blue()) < 40);
  }
  EXPECT_TRUE(found);
}

TEST_F(SlipPanelTest, AnotherMatrixCanBeChosen) {
  show(slip());
  goTo(10);
  find<FiguresTable>("slipList")->selectRow(static_cast<int>(kStill));
  EXPECT_EQ(panel_->chosen(), kStill);
  EXPECT_EQ(panel_->drawing().scene()->name, "finger 1 distal");
  ASSERT_TRUE(panel_->drawing().scene()->sample);
  // A bar that was turned by 30 degrees: long along y at 0.
  EXPECT_NEAR(static_cast<double>(panel_->drawing().scene()->sample->orientationDeg), 120.0, 4.0);
  EXPECT_EQ(panel_->chart().numShades(), 0U);
  panel_->choose(kMoving);
  EXPECT_EQ(panel_->chart().numShades(), 1U);
}

TEST_F(SlipPanelTest, TheFrameThatIsShownBecomesTheReference) {
  show(slip());
  chooseMethod("centroid");
  goTo(kRests + 7);
  find<QPushButton>("slipSetReference")->click();
  settle();
  EXPECT_EQ(find<QComboBox>("slipReference")->currentText(), "frame 47");
  EXPECT_EQ(cell(kMoving, kWhole).toDouble(), 0.0);
  goTo(2 * kRests + kMoves - 1);
  EXPECT_NEAR(cell(kMoving, kWhole).toDouble(), (kMoves - 8) * kStepTaxels, 0.1);
  goTo(5);
  EXPECT_EQ(cell(kMoving, kWhole), "–") << "before it nothing is known";
  // Back to the one of rest: the entry of the frame goes.
  auto* box = find<QComboBox>("slipReference");
  box->setCurrentIndex(0);
  emit box->activated(0);
  settle();
  EXPECT_EQ(box->count(), 2);
  EXPECT_FALSE(panel_->found()->options.referenceFrame);
}

TEST_F(SlipPanelTest, ThresholdsDecideAndAreRemembered) {
  show(slip());
  chooseMethod("centroid");
  EXPECT_FALSE(panel_->found()->slips.empty());
  find<QDoubleSpinBox>("slipStep")->setValue(1.5);
  find<QDoubleSpinBox>("slipWhole")->setValue(20.0);
  find<QDoubleSpinBox>("slipRotation")->setValue(12.0);
  settle();
  EXPECT_TRUE(panel_->found()->slips.empty());
  make();
  EXPECT_EQ(find<QComboBox>("slipMethod")->currentText(), "centroid");
  const SlipSeriesOptions options = panel_->controls().options();
  EXPECT_EQ(options.stepTaxels, 1.5);
  EXPECT_EQ(options.referenceTaxels, 20.0);
  EXPECT_EQ(options.rotationDeg, 12.0);
}

TEST_F(SlipPanelTest, SettingsThatMakeNoSenseAreTheUsualOnes) {
  settings_->setValue("slip/method", "magic");
  settings_->setValue("slip/step_taxels", "-4");
  settings_->setValue("slip/reference", 17);
  make();
  const SlipSeriesOptions options = panel_->controls().options(), usual;
  EXPECT_EQ(options, usual);
}

TEST_F(SlipPanelTest, WhatWasComputedIsKept) {
  show(slip());
  const SlipSeries* hypotheses = panel_->found();
  chooseMethod("register");
  EXPECT_NE(panel_->found(), hypotheses);
  EXPECT_EQ(panel_->found()->options.method, SlipMethod::kRegister);
  chooseMethod("contest");
  EXPECT_EQ(panel_->found(), hypotheses);
}

TEST_F(SlipPanelTest, IsGivenUpAndBegunAgain) {
  panel_->setSource(slip(), false);
  if (panel_->cancel()) {
    EXPECT_TRUE(panel_->emptyText().contains("Cancelled"));
    panel_->findChild<QPushButton*>("slipEmptyButton")->click();
    settle();
  }
  settle();
  EXPECT_TRUE(panel_->shown());
}

TEST_F(SlipPanelTest, TablesAreThoseOfTheCommand) {
  show(slip());
  chooseMethod("register");
  const auto tables = panel_->tables();
  ASSERT_EQ(tables.size(), 2U);
  const TextTable frames = tables[0].make();
  EXPECT_EQ(frames.header[5], "dx");
  ASSERT_EQ(frames.numRows, 2 * (2 * kRests + kMoves)) << "two matrices are touched";
  const auto row = frames.row(2 * (kRests + 10));
  ASSERT_EQ(row.size(), frames.header.size());
  EXPECT_EQ(row[0], std::to_string(kRests + 10));
  EXPECT_EQ(row[2], std::to_string(kMoving));
  EXPECT_NEAR(parseDouble(row[6]).value_or(0.0), kStepTaxels, 0.06);
  EXPECT_EQ(row[18], "slip");
  const TextTable slips = tables[1].make();
  ASSERT_GE(slips.numRows, 1U);
  EXPECT_EQ(slips.row(0)[4], std::to_string(kMoving));
}

TEST_F(SlipPanelTest, AClickInTheChartSeeks) {
  show(slip());
  panel_->setVisibleRange(0.0, 3.0);
  QSignalSpy seekRequested(panel_.get(), &SlipPanel::seekRequested);
  SlipChart& chart = panel_->chart();
  const int x = static_cast<int>(chart.xAxis->coordToPixel(1.5));
  QTest::mouseClick(&chart, Qt::LeftButton, {}, QPoint(x, chart.height() / 4));
  ASSERT_EQ(seekRequested.size(), 1);
  EXPECT_NEAR(seekRequested.front().front().toDouble(), 1.5, 0.02);
}

TEST_F(SlipPanelTest, OfWhatIsLiveTheNewestIsShown) {
  panel_->setSource(nullptr, true);
  EXPECT_TRUE(panel_->emptyText().contains("Waiting"));
  panel_->setLiveHand(sdh2());
  const Profile profile = movingContact();
  SlipRun run(profile, {.detector = {.method = SlipMethod::kCentroid, .hypothesisAlarm = false}});
  while (run.next() && run.frame() < kRests + 10)
    panel_->showLive(profile.frame(run.frame()), run.detections());
  ASSERT_TRUE(panel_->shown());
  panel_->choose(kMoving);
  EXPECT_EQ(cell(kMoving, kVerdict), "slip");
  EXPECT_NEAR(panel_->drawing().scene()->path.back().y(), kBeginsAt + 10 * kStepTaxels, 0.15);
  QSignalSpy asked(panel_.get(), &SlipPanel::liveReferenceRequested);
  find<QPushButton>("slipSetReference")->click();
  EXPECT_EQ(asked.size(), 1);
  EXPECT_EQ(find<QComboBox>("slipMethod")->currentText(), "centroid") << "live has its own";
}

TEST_F(SlipPanelTest, LargerTextHasShortNamesOfTheMatricesEarlier) {
  show(slip());
  auto* list = panel_->findChild<FiguresTable*>("slipList");
  panel_->resize(panel_->width() + 500 - list->width(), panel_->height());
  QCoreApplication::processEvents();
  ASSERT_GT(list->width(), 440);
  goTo(1);
  EXPECT_EQ(list->item(kMoving, kName)->text(), QString::fromStdString(sdh2().matrixName(kMoving)));
  const double usualPt = QFontInfo(QApplication::font()).pointSizeF() / textScale();
  applyTextPt(static_cast<int>(std::ceil(1.5 * usualPt)));
  goTo(2);
  EXPECT_EQ(list->item(kMoving, kName)->text(),
            QString::fromStdString(sdh2().matrices.at(kMoving).shortName));
  applyTextPt(0);
}

TEST_F(SlipPanelTest, WithContestTheLimitsSayThatTheyDoNotDecide) {
  auto* method = panel_->findChild<QComboBox*>("slipMethod");
  const auto* step = panel_->findChild<QDoubleSpinBox*>("slipStep");
  method->setCurrentText("contest");
  emit method->activated(method->currentIndex());
  EXPECT_TRUE(step->toolTip().contains("the comparison decides"));
  method->setCurrentText("centroid");
  emit method->activated(method->currentIndex());
  EXPECT_FALSE(step->toolTip().contains("the comparison decides"));
}

}  // namespace
}  // namespace palpate::gui::slip_panel_test
