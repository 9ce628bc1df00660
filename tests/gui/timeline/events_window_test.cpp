// The analyst's way through a recording: grasps, labels, notes, undo, saving, cropping, curves of
// anything.
#include <QCheckBox>
#include <QClipboard>
#include <QCloseEvent>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>

#include <palpate/emulator/synthetic_profile.h>
#include <palpate/recording/event_store.h>
#include <palpate/recording/recording.h>

#include "gui/export/export_controller.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/source/file_reading.h"
#include "gui/testing/held_readings.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/cursor_readout.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/offer_strip.h"

namespace palpate::gui::events_window_test {
namespace {

// A real file: three grasps in twelve seconds.
class EventsWindowTest : public WindowTest {
 protected:
  EventsWindowTest() : path_(folder_ / "grasps.palpate") {
    saveRecording(synthesize({.durationS = 12.0, .grasps = 3}, &truth_), {}, path_);
    environment_.read = {};
    ask_.texts = {"touch"};
    ask_.newFiles = {pathText(folder_ / "part.palpate")};
    ask_.choices = {"Save"};
    reopen();
  }
  void reopen() {
    if (window_) window().close();
    start();
    window().state().open({path_});
    waitUntilOpened();
  }
  EventRows& rows() { return window().feature<TimelineFeature>().panel().rows(); }
  TimelineChart& chart() { return window().feature<TimelineFeature>().panel().chart(); }
  int marksIn(EventLane lane) {
    return static_cast<int>(std::count_if(rows().marks().begin(),
                                          rows().marks().end(),
                                          [&](const auto& m) { return m.lane == lane; }));
  }

  std::filesystem::path path_;
  SyntheticTruth truth_;
};

TEST_F(EventsWindowTest, TheThirdGraspIsFoundSelectedAndCropped) {
  ASSERT_EQ(marksIn(EventLane::kGrasps), 3);
  for (int i = 0; i < 3; ++i) press(Qt::Key_N);
  ASSERT_TRUE(chart().selection());
  const auto& third = truth_.grasps[2];
  EXPECT_NEAR(static_cast<double>(playback().frame()), static_cast<double>(third.begin), 3);
  QSignalSpy written(&window().feature<TimelineFeature>().cropJob(), &CropJob::written);
  trigger("crop");
  window().settle();
  ASSERT_EQ(written.size(), 1);
  ASSERT_EQ(ask_.newFiles.began.size(), 1);
  EXPECT_TRUE(ask_.newFiles.began[0].contains("grasps_000"));
  const Profile part = openRecording(folder_ / "part.palpate");
  EXPECT_NEAR(
      static_cast<double>(part.numFrames()), static_cast<double>(third.end - third.begin + 1), 5);
  // The same frames, to the last.
  const Profile all = openRecording(path_);
  const auto first = *all.frameAt(part.frameTimeUs(0));
  for (std::size_t i = 0; i < part.numFrames(); ++i)
    ASSERT_EQ(part.frame(i).values, all.frame(first + i).values);
  waitUntilOpened();
  EXPECT_EQ(window().state().recordings.all().size(), 2u) << "the part is open, too";
  EXPECT_EQ(window().state().displayed.unfilteredRecording()->path, path_)
      << "what is looked at stays";
}

TEST_F(EventsWindowTest, ShiftNGoesBack) {
  press(Qt::Key_N);
  press(Qt::Key_N);
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(rows().chosen(), 0u);
}

TEST_F(EventsWindowTest, NGoesOnFromTheCursor) {
  for (int i = 0; i < 3; ++i) press(Qt::Key_N);
  EXPECT_EQ(rows().chosen(), 2u);
  press(Qt::Key_Home);
  press(Qt::Key_N);
  EXPECT_EQ(rows().chosen(), 0u);
  playback().seekFrame((truth_.grasps[1].begin + truth_.grasps[1].end) / 2);
  press(Qt::Key_N);
  EXPECT_EQ(rows().chosen(), 2u);
  playback().seekFrame((truth_.grasps[1].begin + truth_.grasps[1].end) / 2);
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(rows().chosen(), 1u);
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(rows().chosen(), 0u);
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(rows().chosen(), 0u) << "there is none before";
}

// N, label, N, label: the way of who labels all grasps.
TEST_F(EventsWindowTest, ALabelDoesNotEndTheWayFromGraspToGrasp) {
  for (int grasp = 0; grasp < 3; ++grasp) {
    press(Qt::Key_N);
    const QString text = QString("g%1").arg(grasp);
    ask_.texts = {text};
    press(Qt::Key_B, Qt::ControlModifier);
    ASSERT_TRUE(rows().chosen());
    EXPECT_EQ(rows().marks()[*rows().chosen()].text, text) << "what was made is chosen";
  }
  const auto& events = window().state().events.editor()->events();
  ASSERT_EQ(events.size(), 3u);
  const Profile profile = openRecording(path_);
  for (std::size_t grasp = 0; grasp < 3; ++grasp)
    EXPECT_NEAR(static_cast<double>(events[grasp].tUs),
                static_cast<double>(profile.frameTimeUs(truth_.grasps[grasp].begin)),
                150e3)
        << grasp;
  press(Qt::Key_N, Qt::ShiftModifier);
  ASSERT_TRUE(rows().chosen());
  EXPECT_EQ(rows().marks()[*rows().chosen()].lane, EventLane::kGrasps);
  EXPECT_EQ(rows().marks()[*rows().chosen()].text, "2");
}

TEST_F(EventsWindowTest, AfterAClickOnAnEventTheArrowsStepFrames) {
  const QRectF bar = rows().barOf(0);
  ASSERT_FALSE(bar.isEmpty());
  QTest::mouseClick(&rows(), Qt::LeftButton, {}, bar.center().toPoint());
  ASSERT_EQ(rows().chosen(), 0u);
  EXPECT_FALSE(rows().hasFocus());
  const std::size_t frame = playback().frame();
  press(Qt::Key_Right);
  EXPECT_EQ(playback().frame(), frame + 1);
  EXPECT_EQ(rows().chosen(), 0u);
}

TEST_F(EventsWindowTest, WithoutItsSelectionAnEventIsNotChosen) {
  press(Qt::Key_N);
  ASSERT_TRUE(rows().chosen());
  window().state().selection.setSpan(std::nullopt);
  EXPECT_FALSE(rows().chosen());
  press(Qt::Key_Delete);
  EXPECT_EQ(marksIn(EventLane::kGrasps), 3);
}

TEST_F(EventsWindowTest, CursorZoomAndSelectionAreKeptForEachRecording) {
  const std::filesystem::path other = folder_ / "other.palpate";
  saveRecording(synthesize({.durationS = 12.0, .grasps = 3}), {}, other);
  playback().seekFrame(100);
  window().state().selection.show({2.0, 6.0});
  window().state().selection.setSpan(TimeSpan{3.0, 4.0});
  window().state().open({other});
  waitUntilOpened();
  EXPECT_EQ(playback().frame(), 0u);
  EXPECT_FALSE(chart().selection());
  actions().at("nextRecording")->trigger();
  EXPECT_EQ(playback().frame(), 100u);
  EXPECT_NEAR(chart().seen().lower, 2.0, 1e-6);
  EXPECT_NEAR(chart().seen().upper, 6.0, 1e-6);
  ASSERT_TRUE(chart().selection());
  EXPECT_NEAR(chart().selection()->fromS, 3.0, 1e-9);
}

TEST_F(EventsWindowTest, LabelsGoOutAsATableAndComeBack) {
  playback().seekSeconds(2.0);
  press(Qt::Key_B, Qt::ControlModifier);
  chart().setSelection(TimeSpan{3.0, 4.0});
  ask_.texts = {"slow, \"very\""};
  press(Qt::Key_B, Qt::ControlModifier | Qt::ShiftModifier);
  const QString table = QString::fromStdString((folder_ / "labels.csv").string());
  ask_.newFiles = {table};
  ask_.files = {table};
  actions().at("exportLabels")->trigger();
  EXPECT_TRUE(ask_.newFiles.began.back().endsWith("grasps_labels.csv"));
  EXPECT_EQ(testing::readFile(table.toStdString()),
            "begin_s,end_s,kind,text,matrix\n"
            "2.000000,2.000000,label,touch,\n"
            "3.000000,4.000000,note,\"slow, \"\"very\"\"\",\n");
  actions().at("importLabels")->trigger();
  FileReading::settleAll(window());
  EXPECT_EQ(window().state().events.editor()->events().size(), 2u) << "they are there already";
  const auto before = window().state().events.editor()->events();
  press(Qt::Key_Z, Qt::ControlModifier);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(window().state().events.editor()->events().size(), 0u);
  actions().at("importLabels")->trigger();
  FileReading::settleAll(window());
  EXPECT_EQ(window().state().events.editor()->events(), before);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(window().state().events.editor()->events().size(), 0u) << "undone at once";
  testing::writeFile(table.toStdString(), "begin_s,text\n1,good\nx,bad\n");
  actions().at("importLabels")->trigger();
  FileReading::settleAll(window());
  EXPECT_EQ(window().state().events.editor()->events().size(), 1u);
  EXPECT_TRUE(bannerText().contains("line 3: begin_s 'x' is not a number"))
      << bannerText().toStdString();
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(bannerText(), "") << "nothing of the import is left";
  testing::writeFile(table.toStdString(), "no table");
  actions().at("importLabels")->trigger();
  FileReading::settleAll(window());
  EXPECT_TRUE(bannerText().contains("begin_s and text")) << bannerText().toStdString();
  testing::writeFile(table.toStdString(), "begin_s,text\n1,good\n");
  actions().at("importLabels")->trigger();
  FileReading::settleAll(window());
  EXPECT_EQ(bannerText(), "") << "the next import was right";
}

TEST_F(EventsWindowTest, LabelsComeIntoTheRecordingThatWasShownOrItIsSaid) {
  const QString table = QString::fromStdString((folder_ / "x.csv").string());
  testing::writeFile(table.toStdString(), "begin_s,text\n1,good\n");
  const std::filesystem::path other = folder_ / "other.palpate";
  saveRecording(synthesize({.durationS = 2.0, .grasps = 1}), {}, other);
  ask_.files = {table};
  EventEditor* editor = window().state().events.editor();
  {
    HeldReadings held;
    actions().at("importLabels")->trigger();
    EXPECT_EQ(window().state().messages.flashed(), "reading x.csv…");
    window().state().open({other});
    QSignalSpy finished(&window().state().opener, &RecordingOpener::finished);
    while (window().state().opener.busy()) ASSERT_TRUE(finished.wait(10'000));
    ASSERT_NE(window().state().events.editor(), editor);
  }
  FileReading::settleAll(window());
  EXPECT_EQ(editor->events().size(), 1u);
  EXPECT_TRUE(window().state().events.editor()->events().empty());
  ask_.choices = {"Discard"};
  {
    HeldReadings held;
    actions().at("importLabels")->trigger();
    press(Qt::Key_W, Qt::ControlModifier);
  }
  FileReading::settleAll(window());
  EXPECT_EQ(window().state().messages.flashed(),
            "x.csv: no labels added, the recording was closed");
}

TEST_F(EventsWindowTest, EachGraspIsExportedWithItsLabels) {
  playback().seekFrame((truth_.grasps[1].begin + truth_.grasps[1].end) / 2);
  press(Qt::Key_B, Qt::ControlModifier);
  ask_.newFiles = {pathText(folder_ / "parts/one.palpate")};
  actions().at("exportGrasps")->trigger();
  window().settle();
  EXPECT_EQ(bannerText(), "");
  for (std::size_t i = 0; i < 3; ++i) {
    const auto file = folder_ / ("parts/one_0" + std::to_string(i + 1) + ".palpate");
    const Profile part = openRecording(file);
    const auto& truth = truth_.grasps[i];
    EXPECT_NEAR(
        static_cast<double>(part.numFrames()), static_cast<double>(truth.end - truth.begin + 1), 5);
    EXPECT_EQ(readEvents(file).events.size(), i == 1 ? 1u : 0u);
  }
  actions().at("exportGrasps")->trigger();
  window().settle();
  EXPECT_FALSE(bannerText().isEmpty()) << "nothing is replaced without being asked";
}

TEST_F(EventsWindowTest, StatisticsOfTheSelectionAreATable) {
  EXPECT_FALSE(actions().at("statistics")->isEnabled());
  chart().setSelection(TimeSpan{2.0, 9.0});
  actions().at("statistics")->trigger();
  window().settle();
  auto* table = window().findChild<QTableWidget*>("statisticsTable");
  ASSERT_TRUE(table);
  const OpenedRecordingPtr recording = window().state().displayed.recorded();
  const auto frames = *recording->framesWithin(2.0, 9.0);
  int plotted = 0;
  for (const bool on : window().state().selection.plotted()) plotted += on ? 1 : 0;
  EXPECT_EQ(table->rowCount(), plotted);
  EXPECT_EQ(table->item(0, 2)->text().toULongLong(), frames.second - frames.first + 1);
  QTest::mouseClick(window().findChild<QPushButton*>("copyStatistics"), Qt::LeftButton);
  const QString copied = QGuiApplication::clipboard()->text();
  EXPECT_TRUE(
      copied.startsWith("curve\tunit\tframes\tmean\tsd\tmin\tmax\tslope [unit/s]\tintegral [unit "
                        "s]\tmedian\trms\n"))
      << copied.toStdString();
  EXPECT_EQ(copied.trimmed().split('\n').size(), plotted + 1);
}

TEST_F(EventsWindowTest, StatisticsHaveDifferencesAHistogramAndAnXyPlot) {
  chart().setSelection(TimeSpan{2.0, 9.0});
  actions().at("statistics")->trigger();
  window().settle();
  auto* tabs = window().findChild<QTabWidget*>("statisticsTabs");
  ASSERT_TRUE(tabs);
  ASSERT_EQ(tabs->count(), 4);
  const auto copied = [&](int page) {
    tabs->setCurrentIndex(page);
    QTest::mouseClick(window().findChild<QPushButton*>("copyStatistics"), Qt::LeftButton);
    return QGuiApplication::clipboard()->text().trimmed().split('\n');
  };
  const OpenedRecordingPtr recording = window().state().displayed.recorded();
  const auto frames = *recording->framesWithin(2.0, 9.0);
  const std::size_t count = frames.second - frames.first + 1;
  const QStringList differences = copied(1);
  EXPECT_EQ(differences[0], "curve\tunit\tat begin\tat end\tdy\tdy/dt [unit/s]");
  const QStringList first = differences[1].split('\t');
  EXPECT_NEAR(first[4].toDouble(), first[3].toDouble() - first[2].toDouble(), 1e-9);
  window().findChild<QSpinBox*>("histogramBins")->setValue(10);
  const QStringList histogram = copied(2);
  ASSERT_EQ(histogram.size(), 11);
  std::size_t sum = 0;
  for (int i = 1; i < histogram.size(); ++i) sum += histogram[i].split('\t')[2].toULongLong();
  EXPECT_EQ(sum, count);
  window().findChild<QComboBox*>("relationX")->setCurrentIndex(0);
  window().findChild<QComboBox*>("relationY")->setCurrentIndex(0);
  EXPECT_EQ(static_cast<std::size_t>(copied(3).size()), count + 1);
  EXPECT_TRUE(window().findChild<QLabel*>("relationWords")->text().contains("correlation 1.0000"))
      << window().findChild<QLabel*>("relationWords")->text().toStdString();
}

TEST_F(EventsWindowTest, DifferencesStandBesideTheEndsOfTheSelection) {
  auto& readout = *window().findChild<CursorReadout*>();
  actions().at("differences")->trigger();
  EXPECT_TRUE(readout.isHidden());
  chart().setSelection(TimeSpan{2.0, 4.5});
  ASSERT_FALSE(readout.isHidden());
  EXPECT_EQ(readout.lines()[0], "Δt 2.500 s (0.4 Hz)");
  const PlottedCurve& curve = chart().curves().front();
  const OpenedRecordingPtr recording = window().state().displayed.recorded();
  const auto frames = *recording->framesWithin(2.0, 4.5);
  const double from = *chart().store().valueAt(curve.choice, recording->timeAt(frames.first));
  const double to = *chart().store().valueAt(curve.choice, recording->timeAt(frames.second));
  EXPECT_TRUE(readout.lines()[1].contains("Δ " + QString::number(to - from, 'g', 5)))
      << readout.lines()[1].toStdString();
  EXPECT_TRUE(chart().rect().contains(readout.geometry()));
  chart().setSelection(std::nullopt);
  EXPECT_TRUE(readout.isHidden());
}

// The ends stand between two frames: the frame before the begin isn't in the selection.
TEST_F(EventsWindowTest, TheBoxOfDifferencesAndTheTableHaveTheSameValues) {
  auto& readout = *window().findChild<CursorReadout*>();
  const OpenedRecordingPtr recording = window().state().displayed.recorded();
  const std::size_t begin = truth_.grasps[0].begin;
  const auto between = [&](std::size_t frame) {
    return 0.5 * (recording->timeAt(frame) + recording->timeAt(frame + 1));
  };
  actions().at("differences")->trigger();
  for (std::size_t frame = begin; frame < begin + 40; frame += 4) {
    const TimeSpan span{between(frame), between(frame + 60)};
    chart().setSelection(span);
    const auto frames = *recording->framesWithin(span.fromS, span.toS);
    ASSERT_EQ(frames.first, frame + 1);
    const TextTable table = differenceTable(
        selectedCurves(recording, chart().curves(), FrameSpan{frames.first, frames.second}));
    ASSERT_EQ(static_cast<std::size_t>(readout.lines().size()), table.numRows + 1);
    for (std::size_t row = 0; row < table.numRows; ++row) {
      const std::vector<std::string> cells = table.row(row);
      const auto number = [&](std::size_t cell) {
        return QString::number(std::stod(cells.at(cell)), 'g', 5);
      };
      const QString line = readout.lines()[static_cast<qsizetype>(row) + 1];
      EXPECT_TRUE(line.contains(number(2) + " → " + number(3) + "  Δ " + number(4)))
          << cells[0] << " " << cells[2] << " " << cells[3] << ": " << line.toStdString();
      EXPECT_TRUE(line.endsWith("(" + number(5) + "/s)")) << cells[5] << ": " << line.toStdString();
    }
  }
}

// The curves stay visible: the box takes a third of the height, but at least a line.
TEST_F(EventsWindowTest, TheBoxOfDifferencesIsLowInALowChart) {
  auto& readout = *window().findChild<CursorReadout*>();
  window().setAnimated(false);
  window().resize(1280, 800);
  for (QAction* plot : window().findChildren<QAction*>())
    if (plot->text().startsWith("Plot finger") && !plot->isChecked()) plot->trigger();
  actions().at("differences")->trigger();
  chart().setSelection(TimeSpan{2.0, 4.5});
  for (const int height : {120, 160}) {
    chart().setFixedHeight(height);
    for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
    ASSERT_EQ(chart().height(), height);
    ASSERT_FALSE(readout.isHidden());
    const int plot = chart().axisRect()->rect().height();
    constexpr int kAround = 4;  // [px] margin and frame
    EXPECT_LE(readout.height(), std::max(plot / 3, readout.fontMetrics().height() + kAround))
        << height << ": " << readout.text().toStdString();
    EXPECT_GE(readout.text().count(" → "), 1) << readout.text().toStdString();
  }
}

// In a low chart the curves stand beside each other; those without room are counted, none is cut.
TEST_F(EventsWindowTest, DifferencesOfManyCurvesAreNotCutInALowChart) {
  auto& readout = *window().findChild<CursorReadout*>();
  window().setAnimated(false);
  window().resize(1280, 732);
  for (QAction* plot : window().findChildren<QAction*>())
    if (plot->text().startsWith("Plot finger") && !plot->isChecked()) plot->trigger();
  actions().at("differences")->trigger();
  chart().setSelection(TimeSpan{2.0, 4.5});
  ASSERT_EQ(chart().curves().size(), 6u);
  for (const int height : {90, 110, 140, 300}) {
    window().resizeDocks({window().findChild<QDockWidget*>("Timeline")}, {height}, Qt::Vertical);
    for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
    ASSERT_FALSE(readout.isHidden());
    EXPECT_FALSE(readout.text().contains("…")) << readout.text().toStdString();
    EXPECT_GE(readout.width(), readout.sizeHint().width()) << height;
    EXPECT_GE(readout.height(), readout.sizeHint().height()) << height;
    const auto curves = readout.text().count(" → ");
    EXPECT_GE(curves, height < 300 ? 1 : 6) << readout.text().toStdString();
    if (curves < 6) {
      EXPECT_TRUE(readout.text().endsWith(QString::number(6 - curves) + " more: Statistics"))
          << readout.text().toStdString();
    }
  }
}

TEST_F(EventsWindowTest, RenamingWithoutAChosenEventSaysWhatToDo) {
  ASSERT_FALSE(rows().chosen());
  press(Qt::Key_F2);
  const QString& said = window().state().messages.flashed();
  EXPECT_TRUE(said.startsWith("choose an event first: N, or click")) << said.toStdString();
  press(Qt::Key_N);
  press(Qt::Key_F2);
  auto* field = rows().findChild<QLineEdit*>("eventText");
  ASSERT_TRUE(field);
  EXPECT_TRUE(field->isVisible());
}

TEST_F(EventsWindowTest, ANewLabelIsChosen) {
  playback().seekSeconds(2.0);
  press(Qt::Key_B, Qt::ControlModifier);
  playback().seekSeconds(4.0);
  press(Qt::Key_B, Qt::ControlModifier);
  ASSERT_TRUE(rows().chosen());
  const auto chosen = [&]() -> const EventMark& { return rows().marks().at(*rows().chosen()); };
  EXPECT_EQ(chosen().lane, EventLane::kLabels);
  EXPECT_NEAR(chosen().fromS, 4.0, 1e-6);
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_NEAR(chosen().fromS, 2.0, 1e-6) << "N goes on from it";
  press(Qt::Key_N);
  EXPECT_NEAR(chosen().fromS, 4.0, 1e-6);
  press(Qt::Key_F2);
  auto* field = rows().findChild<QLineEdit*>("eventText");
  ASSERT_TRUE(field);
  ASSERT_TRUE(field->isVisible());
  EXPECT_EQ(field->text(), "touch");
  field->setText("lifted");
  QTest::keyClick(field, Qt::Key_Return);
  ASSERT_EQ(marksIn(EventLane::kLabels), 2);
  EXPECT_EQ(chosen().text, "lifted");
  chart().setSelection(TimeSpan{6.0, 7.0});
  press(Qt::Key_B, Qt::ControlModifier);
  ASSERT_TRUE(rows().chosen());
  EXPECT_NEAR(chosen().toS, 7.0, 1e-6);
  actions().at("removeEvent")->trigger();
  EXPECT_EQ(marksIn(EventLane::kLabels), 2);
}

TEST_F(EventsWindowTest, AVerticalAxisIsLogarithmicAndRemembersIt) {
  UnitAxes& axes = chart().axes();
  const QCPRange before = axes.of("counts")->range();
  actions().at("verticalAxes")->trigger();
  auto* log = window().findChild<QCheckBox*>("logAxis");
  ASSERT_TRUE(log);
  log->setChecked(true);
  EXPECT_EQ(chart().yAxis->scaleType(), QCPAxis::stLogarithmic);
  EXPECT_NEAR(axes.of("counts")->range().lower, before.upper / 1000.0, 1e-9);
  EXPECT_EQ(axes.of("counts")->range().upper, before.upper);
  axes.setByHand("counts", AxisRange{10.0, 1000.0});
  EXPECT_EQ(axes.of("counts")->range().lower, 10.0);
  axes.setByHand("counts", std::nullopt);
  const auto stored = [&] {
    return window().state().settings.value("plotted/axes_logarithmic").toStringList();
  };
  EXPECT_EQ(stored(), QStringList{"counts"});
  log->setChecked(false);
  EXPECT_EQ(chart().yAxis->scaleType(), QCPAxis::stLinear);
  EXPECT_EQ(axes.of("counts")->range().lower, before.lower);
  EXPECT_EQ(axes.of("counts")->range().upper, before.upper);
  EXPECT_TRUE(stored().isEmpty());
}

TEST_F(EventsWindowTest, LabelsAndNotesAreMadeUndoneAndSaved) {
  playback().seekSeconds(2.0);
  press(Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  EXPECT_TRUE(window().windowTitle().contains("*")) << "not saved yet";
  chart().setSelection(TimeSpan{3.0, 4.0});
  ask_.texts = {"slow"};
  press(Qt::Key_B, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(marksIn(EventLane::kNotes), 1);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(marksIn(EventLane::kNotes), 0);
  press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(marksIn(EventLane::kNotes), 1);
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(window().windowTitle().contains("*"));
  const auto events = readEvents(path_).events;
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, "label");
  EXPECT_EQ(events[0].text, "touch");
  EXPECT_EQ(events[0].tUs,
            window().state().displayed.unfilteredRecording()->profile.frameTimeUs(0) + 2'000'000);
  EXPECT_EQ(events[1].kind, "note");
  EXPECT_EQ(events[1].t1Us - events[1].tUs, 1'000'000);
  EXPECT_EQ(verifyRecording(path_).state, VerifyReport::State::kSound);
  reopen();
  EXPECT_EQ(marksIn(EventLane::kLabels), 1) << "there tomorrow, too";
}

TEST_F(EventsWindowTest, ACancelledOrEmptyTextMakesNothing) {
  ask_.texts = {QString(), ""};
  press(Qt::Key_B, Qt::ControlModifier);
  press(Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(marksIn(EventLane::kLabels), 0);
  EXPECT_FALSE(window().state().events.editor()->unsaved());
}

TEST_F(EventsWindowTest, AGraspIsCorrectedAndAllOthersAreKept) {
  press(Qt::Key_N);
  const double from = rows().marks()[0].fromS;
  emit rows().spanChanged(0, from - 0.5, from + 1.0);
  ASSERT_EQ(marksIn(EventLane::kGrasps), 3);
  EXPECT_NEAR(rows().marks()[0].fromS, from - 0.5, 1e-6);
  EXPECT_TRUE(rows().marks()[1].event) << "now they are a person's";
  emit rows().textChanged(1, "pinch");
  EXPECT_EQ(rows().marks()[1].text, "pinch");
  EXPECT_EQ(rows().marks()[2].text, "3");
  press(Qt::Key_Z, Qt::ControlModifier);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(rows().marks()[0].event) << "undone in one go: found again";
  EXPECT_FALSE(window().state().events.editor()->unsaved());
}

TEST_F(EventsWindowTest, AGraspThatWasDraggedIsChosenStill) {
  ASSERT_EQ(marksIn(EventLane::kGrasps), 3);
  press(Qt::Key_N);
  const std::size_t first = rows().chosen().value();
  for (const double byS : {0.2, 0.3}) {  // found automatically, then marked by the user
    const EventMark before = rows().marks().at(rows().chosen().value());
    emit rows().spanChanged(*rows().chosen(), before.fromS, before.toS + byS);
    ASSERT_TRUE(rows().chosen());
    EXPECT_EQ(rows().marks().at(*rows().chosen()).lane, EventLane::kGrasps);
    EXPECT_NEAR(rows().marks().at(*rows().chosen()).toS, before.toS + byS, 1e-5);
  }
  EXPECT_EQ(*rows().chosen(), first);
  press(Qt::Key_Delete);
  EXPECT_EQ(marksIn(EventLane::kGrasps), 2);
}

TEST_F(EventsWindowTest, GraspsAreAddedAndDeletedToTheLast) {
  chart().setSelection(TimeSpan{0.1, 0.4});
  press(Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(marksIn(EventLane::kGrasps), 4);
  for (int left = 3; left >= 0; --left) {
    rows().choose(0);
    press(Qt::Key_Delete);
    EXPECT_EQ(marksIn(EventLane::kGrasps), left);
  }
  press(Qt::Key_S, Qt::ControlModifier);
  reopen();
  EXPECT_EQ(marksIn(EventLane::kGrasps), 0) << "a person said there are none";
  chart().setSelection(TimeSpan{1.0, 2.0});
  press(Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(marksIn(EventLane::kGrasps), 1);
}

TEST_F(EventsWindowTest, UnsavedWorkIsAskedAboutOnce) {
  press(Qt::Key_B, Qt::ControlModifier);
  ask_.choices = {QString()};
  window().close();
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_TRUE(window().isVisible()) << "the user would rather go on";
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(ask_.choices.asked.size(), 2);
  EXPECT_TRUE(window().state().displayed.unfilteredRecording());
  ask_.choices = {"Discard"};
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_FALSE(window().state().displayed.unfilteredRecording());
  EXPECT_TRUE(readEvents(path_).events.empty());
}

TEST_F(EventsWindowTest, AFileIsReadAnewOnlyWhenItsLabelsAreSettled) {
  const auto openAgain = [this] {
    window().state().open({path_});
    waitUntilOpened();
  };
  press(Qt::Key_B, Qt::ControlModifier);
  ask_.choices = {QString()};
  openAgain();
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  EXPECT_TRUE(window().state().events.editor()->unsaved());
  ask_.choices = {"Save"};
  openAgain();
  EXPECT_EQ(ask_.choices.asked.size(), 2);
  EXPECT_EQ(marksIn(EventLane::kLabels), 1) << "read from the file";
  EXPECT_FALSE(window().state().events.editor()->unsaved());
  playback().seekSeconds(3.0);
  press(Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(marksIn(EventLane::kLabels), 2);
  ask_.choices = {"Discard"};
  openAgain();
  EXPECT_EQ(ask_.choices.asked.size(), 3);
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  openAgain();
  EXPECT_EQ(ask_.choices.asked.size(), 3) << "everything is saved";
}

TEST_F(EventsWindowTest, LabelsMadeWhileTheirFileIsReadAnewStay) {
  window().state().open({path_});
  press(Qt::Key_B, Qt::ControlModifier);
  waitUntilOpened();
  EXPECT_EQ(ask_.choices.asked.size(), 0);
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  EXPECT_TRUE(window().state().events.editor()->unsaved());
}

TEST_F(EventsWindowTest, DiscardedLabelsGoOnlyWhenTheirFileWasReadAnew) {
  press(Qt::Key_B, Qt::ControlModifier);
  std::filesystem::remove(path_);
  ask_.choices = {"Discard"};
  window().state().open({path_});
  waitUntilOpened();
  EXPECT_FALSE(bannerText().isEmpty());
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  EXPECT_TRUE(window().state().events.editor()->unsaved());
}

TEST_F(EventsWindowTest, WhatCantBeSavedIsSaidAndStays) {
  press(Qt::Key_B, Qt::ControlModifier);
  std::filesystem::remove(path_);  // deleted while it is open
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(bannerText().contains("not saved")) << bannerText().toStdString();
  EXPECT_TRUE(window().state().events.editor()->unsaved());
  EXPECT_EQ(marksIn(EventLane::kLabels), 1);
  playback().seekFrame(100);
  EXPECT_EQ(playback().frame(), 100u) << "what is open can be looked at further";
}

TEST_F(EventsWindowTest, WhatCouldntBeSavedIsNotSaidAnyMoreOnceItIsSavedElsewhere) {
  press(Qt::Key_B, Qt::ControlModifier);
  std::filesystem::rename(path_, folder_ / "elsewhere.palpate");
  press(Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(bannerText().contains("not saved")) << bannerText().toStdString();
  ask_.newFiles = {pathText(folder_ / "copy.palpate")};
  actions().at("saveAs")->trigger();
  window().settle();
  EXPECT_EQ(bannerText(), "");
  EXPECT_TRUE(window().state().events.editor()->unsaved()) << "in the open recording they are";
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(bannerText().contains("not saved")) << "it can't be saved still";
  std::filesystem::rename(folder_ / "elsewhere.palpate", path_);
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bannerText(), "") << "it is saved";
}

TEST_F(EventsWindowTest, WhatCouldntBeSavedIsNotSaidAnyMoreOnceTheRecordingIsClosed) {
  press(Qt::Key_B, Qt::ControlModifier);
  std::filesystem::remove(path_);
  press(Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(bannerText().contains("not saved")) << bannerText().toStdString();
  ask_.choices = {"Discard"};
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_EQ(bannerText(), "");
}

// After the request of a signal to end, which can't save it, the window asks again when it is
// closed.
TEST_F(EventsWindowTest, WhatCantBeSavedKeepsTheWindowOpenUntilItIsAnswered) {
  press(Qt::Key_B, Qt::ControlModifier);
  std::filesystem::remove(path_);
  window().endNow();
  ASSERT_TRUE(QTest::qWaitFor([this] { return !bannerText().isEmpty(); }));
  ASSERT_TRUE(window().isVisible());
  EXPECT_EQ(ask_.choices.asked.size(), 0);
  EXPECT_TRUE(bannerText().contains("not saved")) << bannerText().toStdString();
  ask_.choices = {"Discard"};
  window().close();
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_FALSE(window().isVisible());
}

TEST_F(EventsWindowTest, ASelectionOfNothingIsSaid) {
  trigger("crop");
  EXPECT_TRUE(ask_.newFiles.asked.isEmpty()) << "nothing selected: the action is off";
  chart().setSelection(TimeSpan{0.001, 0.002});
  EXPECT_TRUE(find<QLabel>("selectionWords")->text().contains("no frame"));
  trigger("crop");
  EXPECT_TRUE(ask_.newFiles.asked.isEmpty());
  EXPECT_TRUE(bannerText().contains("no frames")) << bannerText().toStdString();
}

TEST_F(EventsWindowTest, NothingIsCroppedOntoItself) {
  chart().setSelection(TimeSpan{1.0, 2.0});
  ask_.newFiles = {pathText(path_)};
  trigger("crop");
  window().settle();
  EXPECT_FALSE(bannerText().isEmpty());
  EXPECT_EQ(openRecording(path_).numFrames(),
            window().state().displayed.unfilteredRecording()->profile.numFrames());
}

TEST_F(EventsWindowTest, TheWholeRecordingIsSavedAsAnotherWithItsLabels) {
  playback().seekSeconds(2.0);
  press(Qt::Key_B, Qt::ControlModifier);
  ask_.newFiles = {pathText(folder_ / "copy"),
                   pathText(folder_ / "copy.h5"),
                   pathText(folder_ / "rescued.palpate"),
                   pathText(folder_ / "copy.docx")};
  QAction* saveAs = window().state().actions.at("saveAs");
  ASSERT_TRUE(saveAs->isEnabled());
  saveAs->trigger();
  window().settle();
  ASSERT_EQ(ask_.newFiles.began.size(), 1);
  EXPECT_TRUE(ask_.newFiles.began[0].endsWith("grasps_copy.palpate"));
  for (const std::string& ending : recordingEndings())
    EXPECT_TRUE(ask_.newFiles.filters[0].contains(ending.c_str())) << ending;
  const Profile copy = openRecording(folder_ / "copy.palpate");
  const Profile all = openRecording(path_);
  ASSERT_EQ(copy.numFrames(), all.numFrames());
  for (std::size_t i = 0; i < all.numFrames(); i += 50)
    ASSERT_EQ(copy.frame(i).values, all.frame(i).values);
  ASSERT_EQ(readEvents(folder_ / "copy.palpate").events.size(), 1U);
  EXPECT_TRUE(readEvents(path_).events.empty()) << "the original stays as it was";
  EXPECT_TRUE(window().state().actions.at("saveEvents")->isEnabled())
      << "the open recording doesn't have the label";
  saveAs->trigger();
  window().settle();
  EXPECT_TRUE(window().windowTitle().startsWith("grasps.palpate"));
  OfferStrip& offer = window().feature<TimelineFeature>().cropJob().offer();
  EXPECT_TRUE(offer.isVisible());
  EXPECT_EQ(offer.text(), "Saved as copy.h5. grasps.palpate stays open.");
  EXPECT_EQ(openRecording(folder_ / "copy.h5").numFrames(), all.numFrames());
  // The file may be gone since it was opened: what was read can still be saved.
  std::filesystem::rename(path_, folder_ / "elsewhere.palpate");
  saveAs->trigger();
  window().settle();
  std::filesystem::rename(folder_ / "elsewhere.palpate", path_);
  EXPECT_EQ(openRecording(folder_ / "rescued.palpate").numFrames(), all.numFrames());
  saveAs->trigger();
  window().settle();
  EXPECT_TRUE(bannerText().contains(".docx")) << bannerText().toStdString();
}

TEST_F(EventsWindowTest, WhatWasSavedAsAnotherIsOpenedOnDemand) {
  ask_.newFiles = {pathText(folder_ / "copy.palpate")};
  window().state().actions.at("saveAs")->trigger();
  window().settle();
  waitUntilOpened();
  OfferStrip& offer = window().feature<TimelineFeature>().cropJob().offer();
  ASSERT_TRUE(offer.isVisible());
  offer.findChild<QPushButton*>("openSaved")->click();
  waitUntilOpened();
  EXPECT_TRUE(window().windowTitle().startsWith("copy.palpate"))
      << window().windowTitle().toStdString();
  EXPECT_FALSE(offer.isVisible());
}

TEST_F(EventsWindowTest, TheQuestionForALabelSaysWhatIsLabelled) {
  playback().seekSeconds(2.0);
  const double positionS = playback().positionS();
  press(Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(ask_.texts.asked.back(),
            QString("Label at %1 s in grasps.palpate").arg(positionS, 0, 'f', 2));
  chart().setSelection(TimeSpan{1.5, 2.5});
  press(Qt::Key_B, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(ask_.texts.asked.back(), "Note from 1.50 s to 2.50 s in grasps.palpate");
}

TEST_F(EventsWindowTest, TheLabelsOfAPartGoWithIt) {
  playback().seekSeconds(2.0);
  press(Qt::Key_B, Qt::ControlModifier);
  chart().setSelection(TimeSpan{1.5, 2.5});
  trigger("crop");
  window().settle();
  const auto events = readEvents(folder_ / "part.palpate").events;
  ASSERT_EQ(events.size(), 1u) << "saved or not";
  EXPECT_EQ(events[0].text, "touch");
}

TEST_F(EventsWindowTest, ChosenTaxelsAreACurveAndCanBeNamed) {
  const int before = chart().graphCount();
  TaxelSelection taxels(window().state().displayed.unfilteredRecording()->profile.layout());
  taxels.add(1, 5, 2, 7, 3);
  window().feature<MatricesFeature>().panel().view().select(taxels);
  EXPECT_EQ(chart().graphCount(), before + 1);
  EXPECT_EQ(chart().curves().back().name, "6 chosen taxels");
  ask_.texts = {"tip"};
  trigger("nameTaxels");
  window().feature<MatricesFeature>().panel().view().clearSelection();
  ASSERT_EQ(chart().graphCount(), before + 1);
  EXPECT_EQ(chart().curves().back().name, "tip");
  const auto samples = chart().store().samples(chart().curves().back().choice);
  ASSERT_TRUE(samples);
  const std::size_t frame = 60;
  EXPECT_DOUBLE_EQ(
      samples->values[frame],
      meanOf(window().state().displayed.unfilteredRecording()->profile.frame(frame), taxels));
  reopen();
  EXPECT_EQ(chart().curves().back().name, "tip") << "remembered";
}

TEST_F(EventsWindowTest, JointAnglesAndTemperaturesHaveAxesOfTheirOwn) {
  window().feature<TimelineFeature>().signalTree().setTicked("finger 0 distal", true);
  window().feature<TimelineFeature>().signalTree().setTicked("motor 1", true);
  chart().replot(QCustomPlot::rpImmediateRefresh);
  ASSERT_GE(chart().curves().size(), 3u);
  // Where the chart is low, the name is the unit alone.
  EXPECT_TRUE(chart().graph(chart().graphCount() - 2)->valueAxis()->label().endsWith("°"));
  EXPECT_NE(chart().graph(chart().graphCount() - 1)->valueAxis(),
            chart().graph(chart().graphCount() - 2)->valueAxis());
  EXPECT_FALSE(chart().graph(chart().graphCount() - 2)->data()->isEmpty());
  EXPECT_FALSE(chart().graph(chart().graphCount() - 1)->data()->isEmpty());
}

}  // namespace
}  // namespace palpate::gui::events_window_test
