// The dock Spectrum by itself.
#include "gui/spectrum/spectrum_panel.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/core/error.h>
#include <palpate/model/profile_builder.h>
#include <palpate/signals/welch.h>

#include "gui/spectrum/spectrum_line_page.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::spectrum_panel_test {
namespace {

constexpr double kRateHz = 50.0;

// Taxel (2, 7) of matrix 1 swings by 400 counts at 6.25 Hz (bin 4 of 32) around 1000, its neighbour
// by 100 at 12.5 Hz around 500. `gapAt`: the frame behind a gap of 3 s; 0: none.
OpenedRecordingPtr tones(std::size_t frames, std::size_t gapAt = 0) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame = emptyFrame();
  for (std::size_t i = 0; i < frames; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i);
    frame.matrix(1)(7, 2) = static_cast<float>(1000.0 + 400.0 * std::cos(turn / 8.0));
    frame.matrix(1)(7, 3) = static_cast<float>(500.0 + 100.0 * std::cos(turn / 4.0));
    const std::int64_t gapUs = gapAt > 0 && i >= gapAt ? 3'000'000 : 0;
    builder.addFrame(1'400'000'000'000'000 + gapUs + static_cast<std::int64_t>(i) * 20'000,
                     frame.values);
  }
  return makeOpenedRecording("tones.dsa", builder.finish({}));
}

class SpectrumPanelTest : public ::testing::Test {
 protected:
  SpectrumPanelTest() {
    panel_->resize(900, 320);
    applyTheme(*qApp, Theme::kDark);
  }
  void show(const OpenedRecordingPtr& recording) {
    panel_->show();
    panel_->setSource(recording, false);
    if (recording) panel_->setVisibleRange(0.0, recording->durationS());
    panel_->settle();
    QCoreApplication::processEvents();
  }
  TaxelSelection taxels(std::initializer_list<int> columns) {
    TaxelSelection chosen(*sdh2().layout);
    for (const int x : columns) chosen.toggle(1, 7, x);
    return chosen;
  }
  const Spectrogram& spectra() { return *panel_->chart().answer().spectrogram; }
  QString title() { return find<QLabel>("spectrumName")->toolTip(); }
  template <class Widget>
  Widget* find(const char* name) {
    return panel_->findChild<Widget*>(name);
  }
  testing::TemporaryFolder folder_;
  QSettings settings_{QString::fromStdString((folder_ / "palpate.ini").string()),
                      QSettings::IniFormat};
  std::unique_ptr<SpectrumPanel> panel_ = std::make_unique<SpectrumPanel>(settings_);
};

// A sine of 6.25 Hz at 50 frames/s that come ten at once: only by the sender's clock it is one
// line.
TEST_F(SpectrumPanelTest, TakesTheSendersClock) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame = emptyFrame();
  for (std::int64_t i = 0; i < 1000; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i);
    frame.matrix(1)(7, 2) = static_cast<float>(1000.0 + 400.0 * std::cos(turn / 8.0));
    builder.addFrame(
        1'400'000'000'000'000 + (i / 10 * 10 + 9) * 20'000 + i % 10, frame.values, i * 20'000);
  }
  show(makeOpenedRecording("bursts.palpate", builder.finish({})));
  EXPECT_LT(spectra().mean.strongestHz(), 5.0);
  auto* times = find<QCheckBox>("spectrumTimes");
  times->setChecked(true);
  panel_->settle();
  EXPECT_NEAR(spectra().mean.strongestHz(), 6.25, 1e-3);
  EXPECT_NEAR(spectra().largestMagnitude, 400.0, 1.0);
  EXPECT_TRUE(times->toolTip().contains("frames: drift 0.0 ppm")) << times->toolTip().toStdString();
  show(tones(400));
  EXPECT_TRUE(panel_->emptyText().contains("no times of the sender's clock"))
      << panel_->emptyText().toStdString();
}

TEST_F(SpectrumPanelTest, ShowsTheStrongestTaxelWhileNoneIsChosen) {
  show(tones(400));
  ASSERT_TRUE(panel_->shown());
  EXPECT_EQ(panel_->name(), "finger 0 distal · x 2, y 7");
  EXPECT_TRUE(title().contains("strongest")) << title().toStdString();
  EXPECT_NEAR(spectra().mean.strongestHz(), 6.25, 1e-6);
  EXPECT_NEAR(spectra().largestMagnitude, 400.0, 1e-3);
  EXPECT_EQ(panel_->chart().notes(),
            "Nyquist 25.0 Hz; intervals vary by 0 %: resampled to 50.0 Hz · window 0.64 s, bins "
            "1.56 Hz apart");
}

TEST_F(SpectrumPanelTest, ShowsChosenTaxelsAndTheirMean) {
  show(tones(400));
  panel_->setTaxels(taxels({3}));
  panel_->settle();
  EXPECT_EQ(title(), "finger 0 distal · x 3, y 7");
  EXPECT_NEAR(spectra().mean.strongestHz(), 12.5, 1e-6);
  panel_->setTaxels(taxels({2, 3}));
  panel_->settle();
  EXPECT_EQ(panel_->name(), "mean of 2 taxels");
  EXPECT_NEAR(spectra().mean.magnitude.at(4), 200.0, 1e-3);
  EXPECT_NEAR(spectra().mean.magnitude.at(8), 50.0, 1e-3);
  panel_->setTaxels(taxels({}));
  panel_->settle();
  EXPECT_EQ(panel_->name(), "finger 0 distal · x 2, y 7");
}

TEST_F(SpectrumPanelTest, TheMapHasTheSpectraInItsCells) {
  show(tones(400));
  auto* colors = panel_->chart().findChild<QCPColorScale*>();
  const auto map = [&] { return qobject_cast<QCPColorMap*>(panel_->chart().plottable(1)); };
  ASSERT_NE(map(), nullptr);
  ASSERT_EQ(map()->data()->keySize(), 369);
  ASSERT_EQ(map()->data()->valueSize(), 17);
  EXPECT_NEAR(map()->keyAxis()->range().lower, 0.0, 1e-9);
  EXPECT_NEAR(map()->data()->keyRange().lower, 16 / kRateHz, 1e-6);
  EXPECT_NEAR(map()->data()->valueRange().upper, 25.0, 1e-6);
  // A tone of 400 counts: A^2/2 over 1.5 bins of 1.5625 Hz.
  const double db = 10.0 * std::log10(400.0 * 400.0 / 2.0 / (1.5 * 50.0 / 32.0));
  EXPECT_NEAR(map()->data()->cell(100, 4), db, 1e-3);
  EXPECT_EQ(colors->dataRange().upper, 50.0) << "the next 5 dB above " << db;
  EXPECT_EQ(colors->dataRange().size(), 60.0);
  EXPECT_EQ(colors->axis()->label(), "dB re 1 counts²/Hz");
  auto* scale = find<QComboBox>("spectrumScale");
  scale->setCurrentIndex(1);
  emit scale->activated(1);
  EXPECT_NEAR(map()->data()->cell(100, 4), 400.0, 1e-3);
  EXPECT_NEAR(colors->dataRange().upper, 400.0, 1e-3);
  EXPECT_EQ(colors->dataRange().lower, 0.0);
  EXPECT_EQ(colors->axis()->label(), "magnitude in counts");
}

TEST_F(SpectrumPanelTest, WindowAndOverlapAreTakenAndRemembered) {
  show(tones(400));
  auto* window = find<QSpinBox>("spectrumWindow");
  auto* overlap = find<QSpinBox>("spectrumOverlap");
  EXPECT_EQ(window->value(), 32);
  EXPECT_EQ(overlap->value(), 31);
  window->setValue(64);
  EXPECT_EQ(overlap->value(), 63) << "all but one stays all but one";
  panel_->settle();
  EXPECT_EQ(spectra().numBins, 33u);
  overlap->setValue(16);
  panel_->settle();
  EXPECT_EQ(spectra().report.hop, 48u);
  window->setValue(8);
  EXPECT_EQ(overlap->value(), 7);
  EXPECT_EQ(overlap->maximum(), 7);
  overlap->setValue(0);
  panel_ = std::make_unique<SpectrumPanel>(settings_);
  EXPECT_EQ(panel_->header().setting(), (SpectrumSetting{.window = 8, .overlap = 0}));
  // A settings file never stops the program.
  settings_.setValue("spectrum/window", "-7");
  settings_.setValue("spectrum/overlap", 900);
  panel_ = std::make_unique<SpectrumPanel>(settings_);
  EXPECT_EQ(panel_->header().setting(), (SpectrumSetting{.window = 2, .overlap = 1}));
}

// As `palpate spectrum` and `palpate spectrum --welch`.
TEST_F(SpectrumPanelTest, EachViewBeginsWithTheDefaultsOfTheCommand) {
  auto* view = find<QComboBox>("spectrumView");
  const auto choose = [&](SpectrumView wanted) {
    view->setCurrentText(nameOf(wanted));
    emit view->activated(view->currentIndex());
  };
  choose(SpectrumView::kLine);
  EXPECT_EQ(panel_->header().setting().window, welchOptions().window);
  EXPECT_EQ(panel_->header().setting().overlap, welchOptions().overlap);
  choose(SpectrumView::kMap);
  EXPECT_EQ(panel_->header().setting().window, SpectrumOptions{}.window);
  EXPECT_EQ(panel_->header().setting().overlap, SpectrumOptions{}.overlap);
  find<QSpinBox>("spectrumWindow")->setValue(64);
  choose(SpectrumView::kCoherence);
  EXPECT_EQ(panel_->header().setting().window, 64) << "what a person has chosen stays";
}

TEST_F(SpectrumPanelTest, OneSegmentIsNoMean) {
  panel_->header().setSetting({.window = 64, .overlap = 32, .view = SpectrumView::kLine});
  const auto note = [&](std::size_t frames) {
    show(tones(frames));
    panel_->settle();
    return panel_->linePage().chart().note();
  };
  EXPECT_TRUE(note(64).startsWith("1 segment of 1.28 s")) << note(64).toStdString();
  EXPECT_TRUE(note(96).startsWith("mean of 2 segments of 1.28 s")) << note(96).toStdString();
}

TEST_F(SpectrumPanelTest, SaysWhyThereIsNothing) {
  panel_->show();
  EXPECT_TRUE(panel_->emptyText().contains("Open a recording"));
  panel_->setSource(nullptr, true);
  EXPECT_TRUE(panel_->emptyText().contains("Record the connected hand"));
  show(makeOpenedRecording("empty.dsa", profileWithStamps({})));
  EXPECT_TRUE(panel_->emptyText().contains("no frame"));
  ProfileBuilder still(sdh2().layout);
  for (int i = 0; i < 60; ++i) still.addFrame(1'000'000 + i * 20'000, emptyFrame().values);
  show(makeOpenedRecording("still.dsa", still.finish({})));
  EXPECT_TRUE(panel_->emptyText().contains("is active"));
  EXPECT_FALSE(panel_->shown());
  EXPECT_TRUE(panel_->tables().empty());
  show(tones(20));
  EXPECT_TRUE(panel_->emptyText().contains("20 samples")) << panel_->emptyText().toStdString();
  EXPECT_TRUE(panel_->emptyText().contains("a window needs 32"));
  find<QSpinBox>("spectrumWindow")->setValue(16);
  panel_->settle();
  EXPECT_EQ(panel_->emptyText(), "");
  // Chosen taxels that feel nothing are a signal: a flat one.
  show(tones(100));
  panel_->setTaxels(taxels({5}));
  panel_->settle();
  EXPECT_TRUE(panel_->shown());
  EXPECT_EQ(spectra().largestPsd, 0.0);
}

// Of a block that is damaged.
class DamagedFrames : public ProfileStorage {
 public:
  std::size_t numFrames() const override { return 100; }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    return static_cast<std::int64_t>(frame) * 20'000;
  }
  void readFrame(std::size_t frame, TactileFrame&) const override {
    if (frame > 50) throw FormatError("a.palpate", "block 7 is damaged");
  }
  std::size_t numSamples(std::size_t) const override { return 0; }
  std::int64_t sampleTimeUs(std::size_t, std::size_t) const override { return 0; }
  Sample sample(std::size_t, std::size_t) const override { return {}; }
};

TEST_F(SpectrumPanelTest, SaysWhatCannotBeRead) {
  const auto recording = std::make_shared<OpenedRecording>(
      OpenedRecording{.path = "a.palpate",
                      .profile = Profile({}, sdh2(), std::make_shared<DamagedFrames>()),
                      .timing = {},
                      .table = {},
                      .whole = {},
                      .timeS = {},
                      .touched = {},
                      .events = {},
                      .eventsFailure = {},
                      .overview = nullptr});
  panel_->show();
  panel_->setSource(recording, false);
  panel_->settle();
  EXPECT_TRUE(panel_->emptyText().contains("block 7 is damaged"));
  EXPECT_EQ(find<QPushButton>("spectrumEmptyButton")->text(), "Try again");
}

TEST_F(SpectrumPanelTest, ComputesOnlyWhileItIsSeen) {
  panel_->setSource(tones(400), false);
  panel_->setVisibleRange(0.0, 8.0);
  EXPECT_FALSE(panel_->busy());
  panel_->show();
  EXPECT_TRUE(panel_->busy());
  panel_->settle();
  EXPECT_TRUE(panel_->shown());
  // Nothing is computed twice.
  panel_->hide();
  panel_->show();
  panel_->setVisibleRange(2.0, 3.0);
  panel_->settle();
  EXPECT_EQ(panel_->chart().answer().series->timeS.size(), 400u) << "short: all of it is there";
}

TEST_F(SpectrumPanelTest, CanBeGivenUpAndBegunAgain) {
  panel_->show();
  panel_->setSource(tones(400), false);
  ASSERT_TRUE(panel_->busy());
  EXPECT_TRUE(panel_->cancel());
  EXPECT_FALSE(panel_->cancel()) << "nothing is left to give up";
  EXPECT_FALSE(panel_->busy());
  QCoreApplication::processEvents();
  EXPECT_EQ(panel_->emptyText(), "Cancelled.");
  auto* button = find<QPushButton>("spectrumEmptyButton");
  EXPECT_EQ(button->text(), "Compute the spectra");
  button->click();
  panel_->settle();
  EXPECT_TRUE(panel_->shown());
}

TEST_F(SpectrumPanelTest, OfALongRecordingWhatIsSeenIsComputed) {
  const auto recording = tones(25'000);
  show(recording);
  EXPECT_FALSE(panel_->chart().answer().whole) << "24969 segments are too many";
  EXPECT_EQ(spectra().report.hop, 2u);
  EXPECT_TRUE(panel_->chart().notes().contains("a segment every 2 samples"))
      << panel_->chart().notes().toStdString();
  panel_->setVisibleRange(100.0, 110.0);
  panel_->settle();
  EXPECT_EQ(spectra().report.hop, 1u) << "closer, every one";
  EXPECT_GE(panel_->chart().answer().series->timeS.front(), 99.9);
  EXPECT_LE(panel_->chart().answer().series->timeS.back(), 110.1);
  panel_->setVisibleRange(100.0, 100.2);
  panel_->settle();
  EXPECT_TRUE(panel_->emptyText().contains("zoom out"));
}

TEST_F(SpectrumPanelTest, NothingIsDrawnOverAGap) {
  show(tones(400, 200));
  EXPECT_EQ(panel_->chart().plottableCount(), 3) << "the signal, and a map for each stretch";
  const auto* second = qobject_cast<QCPColorMap*>(panel_->chart().plottable(2));
  EXPECT_NEAR(second->data()->keyRange().lower, 200 / kRateHz + 3.0 + 16 / kRateHz, 1e-6);
  int breaks = 0;
  for (const QCPGraphData& sample : *panel_->chart().graph(0)->data())
    if (std::isnan(sample.value)) ++breaks;
  EXPECT_EQ(breaks, 1);
  EXPECT_EQ(panel_->tables().at(0).make().numRows, (200u - 31) * 2 * 17);
}

TEST_F(SpectrumPanelTest, TellsValuesUnderTheMouse) {
  show(tones(400));
  SpectrumChart& chart = panel_->chart();
  auto* map = qobject_cast<QCPColorMap*>(chart.plottable(1));
  const QPointF at(map->keyAxis()->coordToPixel(4.0), map->valueAxis()->coordToPixel(6.3));
  EXPECT_EQ(chart.readingAt(at), "4.00 s · 6.25 Hz\nPSD 45.3 dB\nmagnitude 400.00 counts");
  const QPointF early(map->keyAxis()->coordToPixel(0.1), at.y());
  EXPECT_TRUE(chart.readingAt(early).contains("no whole window"));
  const QPointF above(chart.xAxis->coordToPixel(4.01), chart.axisRect()->rect().center().y());
  EXPECT_EQ(chart.readingAt(above), "4.01 s\n1400 counts") << "frame 200 came at 4 s";
}

TEST_F(SpectrumPanelTest, TablesAreThoseOfTheCommand) {
  show(tones(100));
  const auto tables = panel_->tables();
  ASSERT_EQ(tables.size(), 2u);
  const TextTable segments = tables[0].make();
  EXPECT_EQ(segments.header,
            (std::vector<std::string>{"segment", "time_s", "frequency_hz", "psd", "magnitude"}));
  ASSERT_EQ(segments.numRows, 69u * 17u);
  const auto row = segments.row(3 * 17 + 4);
  EXPECT_EQ(row[0], "3");
  EXPECT_NEAR(std::stod(row[1]), (3 + 16) / kRateHz, 1e-9);
  EXPECT_NEAR(std::stod(row[2]), 6.25, 1e-9);
  EXPECT_NEAR(std::stod(row[4]), 400.0, 1e-3);
  const TextTable mean = tables[1].make();
  ASSERT_EQ(mean.numRows, 17u);
  EXPECT_NEAR(std::stod(mean.row(4)[2]), 400.0, 1e-3);
}

TEST_F(SpectrumPanelTest, NotesAreShortenedToTheRoom) {
  show(tones(400));
  const QString longest = panel_->chart().notes();
  panel_->resize(430, 320);
  QCoreApplication::processEvents();
  EXPECT_LT(panel_->chart().notes().size(), longest.size());
  EXPECT_TRUE(panel_->chart().notes().startsWith("Nyquist 25.0 Hz"));
  for (const QString& note : spectrumNotes(spectra().report, panel_->chart().answer().options))
    EXPECT_TRUE(note.startsWith("Nyquist 25.0 Hz"));
}

TEST_F(SpectrumPanelTest, IsSeenInBothThemes) {
  show(tones(400));
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    QCoreApplication::processEvents();
    const QImage image = panel_->chart().grab().toImage();
    EXPECT_EQ(image.pixelColor(2, 2), colorsOf(theme).window);
    EXPECT_EQ(panel_->chart().xAxis->labelColor(), colorsOf(theme).muted);
    // The tone is the brightest place of the map.
    auto* map = qobject_cast<QCPColorMap*>(panel_->chart().plottable(1));
    const QPoint tone(static_cast<int>(map->keyAxis()->coordToPixel(4.0)),
                      static_cast<int>(map->valueAxis()->coordToPixel(6.25)));
    const QPoint rest(tone.x(), static_cast<int>(map->valueAxis()->coordToPixel(22.0)));
    EXPECT_GT(image.pixelColor(tone).lightness(), image.pixelColor(rest).lightness() + 60);
  }
}

TEST_F(SpectrumPanelTest, OneLineOfTheSelectedRangeWithItsPeaks) {
  show(tones(400));
  panel_->header().setSetting({.window = 64, .overlap = 32, .view = SpectrumView::kLine});
  panel_->settle();
  ASSERT_TRUE(panel_->shown());
  EXPECT_TRUE(panel_->linePage().isVisible());
  const SpectrumAnswer& answer = panel_->linePage().chart().answer();
  ASSERT_EQ(answer.peaks.size(), 1u);
  EXPECT_NEAR(answer.peaks[0].frequencyHz, 6.25, 0.01);
  EXPECT_NEAR(answer.peaks[0].amplitude, 400.0, 1.0);
  EXPECT_EQ(answer.mean->mean.segments, 11u);  // (400 - 64) / 32 + 1
  EXPECT_TRUE(title().contains("visible 0.00 to")) << title().toStdString();
  panel_->setSpan(TimeSpan{2.0, 4.0});
  panel_->settle();
  EXPECT_EQ(panel_->linePage().chart().answer().series->values.size(), 101u);
  EXPECT_TRUE(title().contains("selected 2.00 to 4.00 s")) << title().toStdString();
  const auto tables = panel_->tables();
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].name, "mean spectrum");
  EXPECT_EQ(tables[0].make().numRows, 33u);
  EXPECT_EQ(tables[1].make().numRows, 1u);
  panel_->setSpan(TimeSpan{2.0, 2.5});
  panel_->settle();
  EXPECT_TRUE(panel_->emptyText().contains("26 samples, but a window needs 64"))
      << panel_->emptyText().toStdString();
}

TEST_F(SpectrumPanelTest, CoherenceWithTheMeanOfAMatrix) {
  show(tones(400));
  panel_->header().setSetting({.window = 64, .overlap = 32, .view = SpectrumView::kCoherence});
  panel_->settle();
  auto* other = find<QComboBox>("coherenceWith");
  ASSERT_TRUE(other->isVisible());
  EXPECT_EQ(other->count(), 8) << "six matrices, the hand, the taxels chosen now";
  EXPECT_EQ(other->currentText(), "whole hand");
  // The first matrix feels nothing: no power in common.
  other->setCurrentIndex(0);
  emit other->activated(0);
  panel_->settle();
  EXPECT_TRUE(std::isnan(panel_->linePage().chart().answer().coherence->coherence[8]));
  other->setCurrentIndex(1);
  emit other->activated(1);
  panel_->settle();
  const auto coherence = panel_->linePage().chart().answer().coherence;
  ASSERT_EQ(coherence->coherence.size(), 33u);
  EXPECT_NEAR(coherence->coherence[8], 1.0, 1e-6);  // 6.25 Hz
  EXPECT_TRUE(panel_->name().contains(" with mean of finger 0 distal"))
      << panel_->name().toStdString();
  ASSERT_EQ(panel_->tables().size(), 1u);
  EXPECT_EQ(panel_->tables()[0].make().header.size(), 5u);
  panel_->header().setSetting({});
  panel_->settle();
  EXPECT_FALSE(other->isVisible());
  EXPECT_TRUE(panel_->chart().isVisible());
}

TEST_F(SpectrumPanelTest, CoherenceIsWithAnySecondSignal) {
  show(tones(400));
  panel_->header().setSetting({.window = 64, .overlap = 32, .view = SpectrumView::kCoherence});
  panel_->settle();
  auto* other = find<QComboBox>("coherenceWith");
  const auto type = [&](const QString& text) {
    other->setEditText(text);
    emit other->lineEdit()->editingFinished();
    panel_->settle();
  };
  const auto at8 = [&] { return panel_->linePage().chart().answer().coherence->coherence.at(8); };
  // A taxel, a signal, a formula.
  type("m1_max");
  EXPECT_NEAR(at8(), 1.0, 1e-6);
  EXPECT_TRUE(panel_->name().contains(" with m1_max")) << panel_->name().toStdString();
  const SeriesChoice before = panel_->linePage().other();
  type("m1_max+m0_sum*0");
  EXPECT_NEAR(at8(), 1.0, 1e-6);
  type("m1_max-");
  EXPECT_NE(panel_->linePage().problem(), "");
  EXPECT_FALSE(panel_->linePage().problem().contains('\n'));
  EXPECT_EQ(panel_->linePage().other().formula, "m1_max+m0_sum*0") << "the last good one stays";
  type("m9_mean");
  EXPECT_TRUE(panel_->linePage().problem().contains("m9_mean"));
  type("m1_max");
  EXPECT_EQ(panel_->linePage().problem(), "");
  EXPECT_EQ(panel_->linePage().other(), before);
  // The taxels that are chosen now stay the second signal.
  const int keep = other->findText("the taxels chosen now");
  ASSERT_GE(keep, 0);
  const SensorLayout& layout = *sdh2().layout;
  TaxelSelection chosen(layout);
  chosen.toggle(1, 7, 2);
  panel_->setTaxels(chosen);
  other->setCurrentIndex(keep);
  emit other->activated(keep);
  panel_->settle();
  EXPECT_EQ(other->currentText(), "m1_x2_y7");
  EXPECT_EQ(panel_->linePage().other().taxels, chosen);
  TaxelSelection second(layout);
  second.toggle(1, 8, 2);
  panel_->setTaxels(second);
  panel_->settle();
  EXPECT_EQ(panel_->linePage().other().taxels, chosen);
}

TEST_F(SpectrumPanelTest, AFormulaHasSpectraToo) {
  show(tones(400));
  auto* signal = panel_->header().findChild<QComboBox*>("spectrumSignal");
  EXPECT_TRUE(signal->isHidden()) << "there is none yet";
  panel_->setFormulas({{"twice", "2*m1_max", "counts"}, {"foreign", "m40_max", ""}});
  panel_->settle();
  ASSERT_EQ(signal->count(), 3);
  signal->setCurrentIndex(1);
  emit signal->activated(1);
  panel_->settle();
  EXPECT_EQ(panel_->name(), "twice");
  ASSERT_TRUE(panel_->chart().answer().series);
  const double largest = *std::max_element(panel_->chart().answer().series->values.begin(),
                                           panel_->chart().answer().series->values.end());
  EXPECT_GT(largest, 0.0);
  EXPECT_EQ(panel_->chart().answer().unit, "counts");
  signal->setCurrentIndex(2);
  emit signal->activated(2);
  panel_->settle();
  EXPECT_TRUE(panel_->emptyText().contains("\"foreign\" can't be computed"));
  EXPECT_TRUE(signal->toolTip().startsWith("Choose the signal: "));
  EXPECT_TRUE(signal->toolTip().endsWith("\nNow: " + signal->currentText()))
      << "the box may be narrower than the name: " << signal->toolTip().toStdString();
  panel_->setFormulas({});
  panel_->settle();
  EXPECT_EQ(panel_->emptyText(), "");
  EXPECT_NE(panel_->name(), "twice");
}

TEST_F(SpectrumPanelTest, TheViewIsRemembered) {
  show(tones(400));
  panel_->header().setSetting({.view = SpectrumView::kLine});
  panel_ = std::make_unique<SpectrumPanel>(settings_);
  EXPECT_EQ(panel_->header().setting().view, SpectrumView::kLine);
}

TEST_F(SpectrumPanelTest, AColumnOfAFurtherSeriesHasItsOwnTimes) {
  const auto recording =
      makeOpenedRecording("wrist.palpate", testing::withWrist(tones(200)->profile, 70));
  panel_->setFormulas({{"x", "wrist_fx", "N"}, {"torque", "wrist_Torque_Z", "N m"}});
  show(recording);
  for (const auto& [name, first] : {std::pair("x", 0.5), {"torque", 0.0}}) {
    auto* signal = find<QComboBox>("spectrumSignal");
    signal->setCurrentText(name);
    emit signal->activated(signal->currentIndex());
    panel_->settle();
    const Series& series = *panel_->chart().answer().series;
    ASSERT_EQ(series.values.size(), 70u) << "not those of the 200 frames";
    EXPECT_NEAR(series.timeS[1], 0.08, 1e-9);
    EXPECT_EQ(series.values[0], first) << name;
  }
}

}  // namespace
}  // namespace palpate::gui::spectrum_panel_test
