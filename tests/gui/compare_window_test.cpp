// Comparing two recordings, in the window: every control with its effect.
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>

#include <palpate/model/profile_builder.h>

#include "gui/compare_chart.h"
#include "gui/compare_panel.h"
#include "gui/compare_strip.h"
#include "gui/compare_view.h"
#include "gui/matrices_view.h"
#include "gui/take_away.h"
#include "window_fixture.h"

namespace palpate::gui {
namespace {

// `count` frames 50 ms apart from `beginMs` on, at rest until `touched`, then `counts` on twelve taxels.
Profile grasped(std::size_t count, std::size_t touched, float counts, std::int64_t beginMs = 0) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < count; ++i) {
    TactileFrame frame = emptyFrame();
    if (i >= touched)
      frame.matrix(1).block(5, 1, 3, 4).setConstant(counts + static_cast<float>(i - touched));
    builder.addFrame(1'400'000'000'000'000 + (beginMs + static_cast<std::int64_t>(i) * 50) * 1000,
                     frame.values);
  }
  return builder.finish({});
}

Profile pad() {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(4, 4, 2.0)});
  ProfileBuilder builder(layout);
  for (int i = 0; i < 10; ++i)
    builder.addFrame(1'400'000'000'000'000 + i * 50'000, std::vector<float>(16, 30.0F));
  return builder.finish({});
}

class CompareWindowTest : public WindowTest {
 protected:
  CompareWindowTest() {
    window_.reset();
    window_ = std::make_unique<MainWindow>(
        WindowSurroundings{.dataFolder = folder_.path(),
                           .settingsPath = settingsFile(),
                           .clock = &clock_,
                           .read = [](const std::filesystem::path& path, const Progress&) {
                             const std::string name = path.stem().string();
                             if (name == "early") return grasped(60, 10, 500.0F);
                             if (name == "late") return grasped(80, 30, 300.0F, 3'600'000);
                             if (name == "third") return grasped(40, 5, 100.0F);
                             if (name == "untouched") return grasped(20, 20, 0.0F);
                             if (name == "one") return grasped(1, 0, 50.0F);
                             if (name == "pad") return pad();
                             if (name == "empty") return profileWithStamps({});
                             return twentyFrames();
                           }});
    window_->show();
    QApplication::setActiveWindow(window_.get());
    QCoreApplication::processEvents();
  }
  ComparePanel& compare() { return window().compare(); }
  void compareNow() {
    press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    settle();
  }
  void settle() {
    QElapsedTimer clock;
    clock.start();
    do {
      QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    } while (compare().hasPair() && window().compareShown() && !compare().complete() &&
             clock.elapsed() < 10'000);
    QCoreApplication::processEvents();
  }
  void choose(const char* name, const QString& text) {
    auto* box = find<QComboBox>(name);
    const int index = box->findText(text);
    ASSERT_GE(index, 0) << name << " " << text.toStdString();
    box->setCurrentIndex(index);
    emit box->activated(index);
    settle();
  }
  QString name(const OpenedRecordingPtr& recording) {
    return recording ? QString::fromStdString(recording->path.stem().string()) : QString();
  }
  float valueIn(CompareGroup group, int y = 6, int x = 2) {
    const auto& frame = compare().view().frames()[static_cast<std::size_t>(group)].frame;
    return frame.values.empty() ? -1.0F : frame.matrix(1)(y, x);
  }
  void drag(QWidget& widget,
            const QPointF& from,
            const QPointF& to,
            Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const auto send = [&](QEvent::Type type, const QPointF& at, Qt::MouseButtons held) {
      QMouseEvent event(type, at, widget.mapToGlobal(at), Qt::LeftButton, held, modifiers);
      QApplication::sendEvent(&widget, &event);
    };
    send(QEvent::MouseButtonPress, from, Qt::LeftButton);
    send(QEvent::MouseMove, (from + to) / 2, Qt::LeftButton);
    send(QEvent::MouseMove, to, Qt::LeftButton);
    send(QEvent::MouseButtonRelease, to, Qt::NoButton);
    settle();
  }
  QDockWidget* dock(const char* name) { return window().findChild<QDockWidget*>(name); }
};

TEST_F(CompareWindowTest, TakesThePlaceOfTheMatricesAndGivesItBack) {
  open({"early.dsa", "late.dsa"});
  ASSERT_TRUE(dock("Timeline")->isVisible());
  compareNow();
  EXPECT_TRUE(compare().isVisible());
  EXPECT_FALSE(window().matricesView().isVisible());
  EXPECT_FALSE(dock("Timeline")->isVisible());
  EXPECT_FALSE(dock("Inspect")->isVisible());
  EXPECT_TRUE(actions().compare->isChecked());
  QTest::mouseClick(find<QToolButton>("compareBack"), Qt::LeftButton);
  EXPECT_FALSE(compare().isVisible());
  EXPECT_TRUE(window().matricesView().isVisible());
  EXPECT_TRUE(dock("Timeline")->isVisible());
  EXPECT_TRUE(dock("Inspect")->isVisible());
}

TEST_F(CompareWindowTest, LaysFirstContactsOnTopOfEachOther) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  EXPECT_EQ(name(compare().a()), "early");
  EXPECT_EQ(name(compare().b()), "late");
  ASSERT_TRUE(compare().offsetS());
  EXPECT_NEAR(*compare().offsetS(), 0.5 - 1.5, 1e-9);
  playback().seekFrame(10);
  EXPECT_EQ(valueIn(CompareGroup::kA), 500.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 300.0F);
  EXPECT_EQ(valueIn(CompareGroup::kDifference), 200.0F);
  playback().seekFrame(9);
  EXPECT_EQ(valueIn(CompareGroup::kA), 0.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 0.0F);
  EXPECT_EQ(compare().notice(), "");
}

TEST_F(CompareWindowTest, TheOtherAlignments) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  choose("compareAlignment", "start of both");
  EXPECT_NEAR(*compare().offsetS(), 0.0, 1e-9);
  playback().seekFrame(30);
  EXPECT_EQ(valueIn(CompareGroup::kA), 520.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 300.0F);
  choose("compareAlignment", "clock time");
  EXPECT_NEAR(*compare().offsetS(), 3600.0, 1e-6);
  EXPECT_EQ(valueIn(CompareGroup::kB), -1.0F) << "B begins an hour later";
  EXPECT_TRUE(compare().notice().contains("Nothing in common: B begins"));
  EXPECT_EQ(compare().figures(), "no common span");
  choose("compareAlignment", "first contact");
  EXPECT_NEAR(*compare().offsetS(), -1.0, 1e-9);
}

TEST_F(CompareWindowTest, AnOffsetByHandIsTypedOrDragged) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  auto* field = find<QDoubleSpinBox>("compareOffset");
  EXPECT_NEAR(field->value(), -1.0, 1e-6);
  field->setValue(0.25);
  settle();
  EXPECT_EQ(compare().alignment(), Alignment::kByHand);
  EXPECT_EQ(find<QComboBox>("compareAlignment")->currentText(), "by hand");
  EXPECT_NEAR(*compare().offsetS(), 0.25, 1e-9);
  // B's bar, a tenth of the chart to the right.
  CompareChart& chart = compare().chart();
  const double pixels = 0.1 * chart.axisRect()->width();
  const double seconds = 0.1 * chart.xAxis->range().size();
  const QPointF grip = compare().strip().barRect(true).center();
  drag(compare().strip(), grip, grip + QPointF(pixels, 0));
  EXPECT_NEAR(*compare().offsetS(), 0.25 + seconds, 0.02);
  EXPECT_NEAR(field->value(), *compare().offsetS(), 1e-3);
  // With Ctrl in the chart, back again.
  const double before = *compare().offsetS();
  const double perPixel = chart.xAxis->range().size() / chart.axisRect()->width();
  const QPointF middle = chart.axisRect()->rect().center();
  drag(chart, middle, middle - QPointF(60, 0), Qt::ControlModifier);
  EXPECT_NEAR(*compare().offsetS(), before - 60 * perPixel, 0.02);
  // A's bar stays where it is.
  const double now = *compare().offsetS();
  const QPointF ofA = compare().strip().barRect(false).center();
  drag(compare().strip(), ofA, ofA + QPointF(50, 0));
  EXPECT_EQ(*compare().offsetS(), now);
}

TEST_F(CompareWindowTest, TheCursorMovesBothAndTheChartSeeks) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  CompareChart& chart = compare().chart();
  const auto click = [&](double seconds) {
    const QPointF at(chart.pixelOf(seconds), chart.axisRect()->rect().center().y());
    drag(chart, at, at);
  };
  click(1.26);
  EXPECT_EQ(playback().frame(), 25u);
  EXPECT_EQ(valueIn(CompareGroup::kA), 515.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 315.0F);
  press(Qt::Key_Right);
  EXPECT_EQ(valueIn(CompareGroup::kA), 516.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 316.0F);
  EXPECT_NEAR(chart.cursorPixel(), chart.pixelOf(1.30), 2.0);
  // Before A begins there is B alone; the playback waits at A's begin.
  click(-0.5);
  EXPECT_EQ(playback().frame(), 0u);
  EXPECT_EQ(valueIn(CompareGroup::kA), -1.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 0.0F);
  EXPECT_EQ(compare().view().frames()[0].notice, "A begins 0.50 s later");
}

TEST_F(CompareWindowTest, PlayingPlaysBoth) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  playback().play();
  clock_.advanceMs(500);
  playback().tick();
  EXPECT_EQ(valueIn(CompareGroup::kA), 510.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 310.0F);
}

TEST_F(CompareWindowTest, SwappingKeepsTheMoment) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(20);
  QTest::mouseClick(find<QToolButton>("compareSwap"), Qt::LeftButton);
  settle();
  EXPECT_EQ(name(compare().a()), "late");
  EXPECT_EQ(name(compare().b()), "early");
  EXPECT_EQ(window().current(), compare().a());
  EXPECT_NEAR(*compare().offsetS(), 1.0, 1e-9);
  EXPECT_EQ(playback().frame(), 40u);
  EXPECT_EQ(valueIn(CompareGroup::kDifference), -200.0F);
}

TEST_F(CompareWindowTest, AnOffsetByHandIsSwappedToo) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  compare().setOffset(0.4);
  settle();
  QTest::mouseClick(find<QToolButton>("compareSwap"), Qt::LeftButton);
  settle();
  EXPECT_EQ(compare().alignment(), Alignment::kByHand);
  EXPECT_NEAR(*compare().offsetS(), -0.4, 1e-9);
}

TEST_F(CompareWindowTest, AAndBAreChosenAmongWhatIsOpen) {
  open({"early.dsa", "late.dsa", "third.dsa"});
  compareNow();
  EXPECT_EQ(name(compare().b()), "late") << "the next one";
  choose("compareB", "third.dsa");
  EXPECT_EQ(name(compare().b()), "third");
  choose("compareB", "late.dsa");
  choose("compareA", "third.dsa");
  EXPECT_EQ(name(window().current()), "third") << "A is what is shown and played";
  EXPECT_EQ(name(compare().b()), "late");
  EXPECT_NEAR(*compare().offsetS(), 0.25 - 1.5, 1e-9);
  // The window shows another one: that is A.
  press(Qt::Key_Tab, Qt::ControlModifier);
  settle();
  EXPECT_EQ(name(compare().a()), "early");
  choose("compareA", "late.dsa");
  EXPECT_EQ(name(compare().a()), "late");
  EXPECT_EQ(name(compare().b()), "early") << "chosen as A, B gives way";
  press(Qt::Key_W, Qt::ControlModifier);
  settle();
  EXPECT_TRUE(compare().hasPair());
  EXPECT_NE(compare().a(), compare().b());
}

TEST_F(CompareWindowTest, OneRecordingOffersToOpenAnotherOrItself) {
  open({"early.dsa"});
  compareNow();
  EXPECT_FALSE(compare().hasPair());
  auto* text = find<QLabel>("compareEmpty");
  EXPECT_TRUE(text->isVisible());
  EXPECT_TRUE(text->text().contains("Only early.dsa is open"));
  QString asked;
  window().askForRecordings = [&] {
    asked = "yes";
    return QStringList{QString::fromStdString(file("late.dsa"))};
  };
  QTest::mouseClick(find<QPushButton>("compareItself"), Qt::LeftButton);
  settle();
  EXPECT_EQ(compare().b(), compare().a());
  EXPECT_TRUE(find<CompareView>("compareView")->isVisible());
  compare().setOffset(0.0);
  settle();
  EXPECT_TRUE(compare().notice().contains("same recording twice"));
  choose("compareB", "open another…");
  EXPECT_EQ(asked, "yes");
  waitUntilOpened();
  settle();
  EXPECT_EQ(name(compare().a()), "early") << "A stays";
  EXPECT_EQ(name(compare().b()), "late");
}

TEST_F(CompareWindowTest, EscapeGoesBack) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  press(Qt::Key_Escape);
  EXPECT_FALSE(window().compareShown());
  EXPECT_FALSE(actions().compare->isChecked());
}

TEST_F(CompareWindowTest, WithNothingOpenItAsksAndComparesWhatComes) {
  window().askForRecordings = [&] {
    return QStringList{QString::fromStdString(file("early.dsa")),
                       QString::fromStdString(file("late.dsa"))};
  };
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  waitUntilOpened();
  settle();
  EXPECT_TRUE(window().compareShown());
  EXPECT_TRUE(compare().hasPair());
}

TEST_F(CompareWindowTest, ClosingEverythingLeavesIt) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_TRUE(window().compareShown());
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_FALSE(window().compareShown());
  open({"early.dsa"});
  EXPECT_TRUE(dock("Timeline")->isVisible()) << "docks are as they were";
}

TEST_F(CompareWindowTest, CurvesFollowSignalAndMatrix) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  const auto& curves = compare().chart().curves();
  ASSERT_TRUE(curves.curveA && curves.curveB);
  EXPECT_EQ(curves.curveA->values.size(), 60u);
  EXPECT_NEAR(curves.curveA->values[20], 510.0, 1e-9);
  EXPECT_NEAR(curves.curveB->values[40], 310.0, 1e-9);
  EXPECT_EQ(compare().chart().graph(0)->pen().style(), Qt::SolidLine);
  EXPECT_EQ(compare().chart().graph(1)->pen().style(), Qt::DashLine);
  // From 0 to 2.95 s 60 moments; B is 200 counts below A in the last 50 of them.
  const QString figures = compare().figures();
  EXPECT_TRUE(figures.contains("mean +166.7, rms 182.6, largest +200.0 counts at 0.50 s"))
      << figures.toStdString();
  EXPECT_TRUE(figures.endsWith("over 2.95 s in common")) << figures.toStdString();
  // 60 pairs (0, 0) x 10, (500 + k, 300 + k), k = 0..49: computed by hand from the sums.
  EXPECT_TRUE(figures.startsWith("correlation 0.999")) << figures.toStdString();
  choose("compareSignal", "active taxels");
  EXPECT_EQ(window().viewSettings().signal, PlottedSignal::kActive);
  EXPECT_NEAR(compare().chart().curves().curveA->values[20], 12.0, 1e-9);
  choose("compareMatrix", "finger 0 proximal");
  EXPECT_NEAR(compare().chart().curves().curveA->values[20], 0.0, 1e-9);
  EXPECT_TRUE(compare().figures().contains("correlation not defined"));
}

TEST_F(CompareWindowTest, RangesAreSharedAndSymmetric) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  const ComparePictureOptions whole = compare().view().options();
  EXPECT_EQ(whole.look.rangeMin, 0.0);
  EXPECT_EQ(whole.look.rangeMax, 549.0);  // A's last frame: 500 + 49
  EXPECT_EQ(whole.largestDifference, 200.0);
  press(Qt::Key_R);
  EXPECT_EQ(compare().view().options().look.rangeMax, 500.0);
  press(Qt::Key_R);
  EXPECT_EQ(compare().view().options().look.rangeMax, 4095.0);
  EXPECT_EQ(compare().view().options().largestDifference, 4095.0);
  press(Qt::Key_V);
  EXPECT_TRUE(compare().view().options().look.values);
  press(Qt::Key_I);
  EXPECT_TRUE(compare().view().options().look.interpolated);
}

TEST_F(CompareWindowTest, HoverTellsAllThree) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  CompareView& view = compare().view();
  for (const CompareGroup group : kAllCompareGroups) {
    const QPointF at = view.geometryOfGroups().group(group).taxelRect(1, 6, 2).center();
    QMouseEvent event(
        QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view, &event);
    EXPECT_EQ(view.hoverText(), "finger 0 distal · x 2, y 6 · A 500 · B 300 · A − B +200 counts");
  }
}

TEST_F(CompareWindowTest, WithoutContactStartsAreUsedAndSaid) {
  open({"early.dsa", "untouched.dsa"});
  compareNow();
  EXPECT_EQ(*compare().offsetS(), 0.0);
  EXPECT_EQ(compare().notice(),
            "No lasting contact (3 taxels in 3 frames) in B: aligned by their starts");
  EXPECT_TRUE(find<QLabel>("compareNotice")->isVisible());
}

TEST_F(CompareWindowTest, AnotherHandIsSaid) {
  open({"early.dsa", "pad.dsa"});
  compareNow();
  EXPECT_TRUE(compare().notice().contains("finger 0 proximal")) << compare().notice().toStdString();
  EXPECT_EQ(compare().view().frames()[2].notice, "nothing to compare: other matrices");
  EXPECT_TRUE(compare().chart().curves().curveB) << "all matrices of either can be compared";
  choose("compareMatrix", "finger 1 distal");
  EXPECT_FALSE(compare().chart().curves().curveB);
  EXPECT_EQ(compare().figures(), "the other recording has no such matrix");
}

TEST_F(CompareWindowTest, OneFrameAndNoneAreRecordingsToo) {
  open({"early.dsa", "one.dsa", "empty.dsa"});
  compareNow();
  choose("compareB", "empty.dsa");
  EXPECT_EQ(compare().view().frames()[1].notice, "B holds no frame");
  choose("compareB", "one.dsa");
  choose("compareAlignment", "start of both");
  playback().seekFrame(0);
  EXPECT_EQ(valueIn(CompareGroup::kB), 50.0F);
  playback().seekFrame(5);
  EXPECT_EQ(compare().view().frames()[1].notice, "B ended 0.25 s ago");
}

TEST_F(CompareWindowTest, TheAlignmentIsRemembered) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  choose("compareAlignment", "start of both");
  window().close();
  start();
  EXPECT_EQ(window().compare().alignment(), Alignment::kStart);
  open({"good.dsa"});
  EXPECT_TRUE(dock("Timeline")->isVisible()) << "its layout isn't that of the window";
}

TEST_F(CompareWindowTest, IsTakenAwayAsPictureAndTables) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  QImage image(1000, 700, QImage::Format_RGB32);
  image.fill(Qt::magenta);
  QPainter painter(&image);
  PictureLook look;
  look.size = image.size();
  look.forPrint = true;
  compare().paint(painter, look);
  painter.end();
  int left = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      left += image.pixelColor(x, y) == QColor(Qt::magenta) ? 1 : 0;
  EXPECT_EQ(left, 0);
  const TextTable differences = compare().differenceTable();
  ASSERT_EQ(differences.numRows, 7u);
  EXPECT_EQ(differences.row(1),
            (std::vector<std::string>{"finger 0 distal", "12", "200", "200", "200", "5", "1"}));
  const TextTable curves = compare().curveTable();
  ASSERT_EQ(curves.numRows, 60u);
  EXPECT_EQ(curves.row(10), (std::vector<std::string>{"0.5", "10", "500", "30", "300"}));
}

TEST_F(CompareWindowTest, MovingTheCursorIsQuick) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) {
    QElapsedTimer clock;
    clock.start();
    playback().seekFrame(static_cast<std::size_t>(i));
    compare().view().repaint();
    times.push_back(static_cast<double>(clock.nsecsElapsed()) / 1e6);
  }
  std::sort(times.begin(), times.end());
  RecordProperty("median_us", static_cast<int>(1000 * times[20]));
  EXPECT_LT(times[20], 16.0) << "ms, the median of 40";
}

}  // namespace
}  // namespace palpate::gui
