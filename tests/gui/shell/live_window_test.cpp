// The window on a hand that isn't there: connect, watch, record, mark, stop, accidents, leaving.
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QSlider>
#include <QToolButton>
#include <fstream>
#include <set>

#include "palpate/device/sdh2.h"
#include <palpate/recording/recording.h>

#include "control/emulated_bench.h"
#include "gui/appearance/captions.h"
#include "gui/connect/connect_feature.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/inspect/matrix_table.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/slip/slip_panel.h"
#include "gui/slip/slip_view.h"
#include "gui/testing/make_active.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/status_strip.h"
#include "testing/time_limit.h"

namespace palpate::gui::live_window_test {
namespace {
namespace fs = std::filesystem;
using State = LiveController::State;

class LiveWindowTest : public WindowTest {
 protected:
  LiveWindowTest() {
    fs::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
    ready();
  }
  void ready() {
    // Not the safe velocity of a new session, with which everything takes longer.
    find<QWidget>("velocity")->findChild<QDoubleSpinBox*>()->setValue(40.0);
    window().state().prompts.recording = [this](RecordingSettings settings, const QString&) {
      ++asked_;
      settings.folder = QString::fromStdString((folder_ / "runs").string());
      settings.nameTemplate = "{object}_{run}";
      settings.object = "ball";
      settings.markLabels[2] = "slip";
      return std::optional(settings);
    };
    window().state().prompts.endRecording = [this](UserPrompts::Ending) {
      ++askedToEnd_;
      return mayEnd_;
    };
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  void connectTo(const Connection& connection) {
    window().state().connectTo(connection);
    ASSERT_TRUE(await([&] { return !live().stale() && window().state().displayed.isLive(); }));
  }
  void connectEmulated(const QString& scene = "ball") {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = scene;
    connectTo(connection);
  }
  void connectEmulatedHand() {
    bench_ = std::make_unique<testing::EmulatedBench>(testing::handWith("ball"));
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(bench_->hand->dsaPort());
    connection.sdhPort = QString::fromStdString(bench_->hand->sdhPort());
    connectTo(connection);
    ASSERT_TRUE(await([&] { return live().source()->control->status().cannotReact.empty(); }));
  }
  LiveController& live() { return window().state().live; }
  MatricesView& view() { return window().feature<MatricesFeature>().panel().view(); }
  LiveChart& chart() { return *window().findChild<LiveChart*>(); }
  QString offered() {
    const auto* strip = window().findChild<OfferStrip*>();
    return strip->isVisible() ? strip->text() : QString();
  }
  // As soon as it may be clicked.
  void click(const char* name) {
    auto* button = find<QPushButton>(name);
    ASSERT_TRUE(await([&] { return button->isEnabled() && button->isVisible(); })) << name;
    QTest::mouseClick(button, Qt::LeftButton);
  }

  std::unique_ptr<testing::EmulatedBench> bench_;
  int asked_ = 0, askedToEnd_ = 0;
  bool mayEnd_ = true;
};

TEST_F(LiveWindowTest, ASavedConnectionIsNamed) {
  Connection connection;
  connection.name = "bench 2";
  connection.scene = "ball";
  saveNamedConnection(window().state().settings, connection.name, connection);
  window().state().connectTo(connection);
  ASSERT_TRUE(await([&] { return window().state().live.source() != nullptr; }));
  const QString named = "bench 2: emulated hand · ball";
  EXPECT_TRUE(await([&] { return window().windowTitle() == named + " – Palpate"; }))
      << window().windowTitle().toStdString();
  EXPECT_TRUE(await([&] { return find<StatusStrip>("statusStrip")->status().right == named; }))
      << find<StatusStrip>("statusStrip")->status().right.toStdString();
  EXPECT_EQ(loadConnection(window().state().settings).name, "bench 2") << "for Again";
}

TEST_F(LiveWindowTest, ShowsWhatIsConnected) {
  connectEmulated();
  EXPECT_EQ(window().windowTitle(), "emulated hand · ball – Palpate");
  EXPECT_TRUE(find<QDockWidget>("Hand")->isVisible());
  EXPECT_TRUE(find<QDockWidget>("Timeline")->isVisible());
  EXPECT_TRUE(chart().isVisible());
  EXPECT_FALSE(window().findChild<TimelineChart*>()->isVisible());
  EXPECT_TRUE(await([&] { return find<StatusStrip>("statusStrip")->status().state == "live"; }));
  EXPECT_TRUE(await([&] { return find<QLabel>("LinkPill")->text() == "emulated hand · ball"; }));
  EXPECT_TRUE(view().notice().isEmpty());
  EXPECT_TRUE(actions().at("record")->isEnabled());
  EXPECT_FALSE(actions().at("play")->isEnabled());
}

TEST_F(LiveWindowTest, NoKeyMeansTwoThingsAtOnce) {
  connectEmulated("empty");
  std::set<QString> seen;
  for (const QAction* action : window().actions())
    for (const QKeySequence& key :
         action->isEnabled() ? action->shortcuts() : QList<QKeySequence>())
      EXPECT_TRUE(seen.insert(key.toString()).second) << key.toString().toStdString();
  EXPECT_TRUE(seen.contains("Space"));
  EXPECT_TRUE(seen.contains("0"));
}

TEST_F(LiveWindowTest, NothingIsConnectedWithoutBeingAsked) {
  EXPECT_EQ(live().state(), State::kNone);
  EXPECT_FALSE(actions().at("record")->isEnabled());
  EXPECT_FALSE(actions().at("live")->isEnabled());
  EXPECT_FALSE(actions().at("disconnectHand")->isEnabled());
  EXPECT_FALSE(actions().at("mark")->isEnabled());
}

// A recording that is opened meanwhile takes the dock Hand away, with its Stop.
TEST_F(LiveWindowTest, StopStaysInSightAndNoKeyMovesAHandThatIsNotShown) {
  auto* stop = find<QPushButton>("toolBarStop");
  EXPECT_FALSE(stop->isVisible()) << "there is nothing to stop";
  connectEmulatedHand();
  ASSERT_TRUE(await([&] { return stop->isVisible(); }));
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  open({"good.dsa"});
  ASSERT_TRUE(window().state().displayed.isRecording());
  EXPECT_TRUE(stop->isVisible());
  for (const char* action :
       {"graspHand", "reactiveGrasp", "slipAwareGrasp", "openHand", "relaxHand"}) {
    EXPECT_FALSE(actions().at(action)->isEnabled()) << action;
    EXPECT_TRUE(actions().at(action)->toolTip().contains("F6")) << action;
  }
  QTest::mouseClick(stop, Qt::LeftButton);
  EXPECT_TRUE(await([&] { return !bench_->handMoves(); }));
  // The hand stands before its answer to the stop arrives.
  const GraspControl& control = *live().source()->control;
  ASSERT_TRUE(await([&] { return control.status().last.has_value(); }));
  const auto ended = control.status().last;
  EXPECT_EQ(ended->outcome, GraspOutcome::kStopped);
  window().state().displayed.showLive();
  EXPECT_TRUE(await([&] { return actions().at("graspHand")->isEnabled(); }));
}

TEST_F(LiveWindowTest, AReactiveGraspIsFeltSeenAndStopped) {
  connectEmulatedHand();
  EXPECT_FALSE(bench_->handMoves()) << "connecting moves nothing";
  // With the limit kept an unknown object is touched after minutes.
  find<QCheckBox>("keepLimit")->setChecked(false);
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  auto* table = window().findChild<MatrixTableModel*>();
  const auto active = [&] {
    return table->index(static_cast<int>(table->numMatrices()), MatrixTableModel::kActive)
        .data()
        .toInt();
  };
  ASSERT_TRUE(await([&] { return active() > 0; })) << "the ball is felt";
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  EXPECT_TRUE(find<QLabel>("handState")->text().contains("limit"));
}

// What an emulated hand touches is in a file of its own.
TEST_F(LiveWindowTest, ADamagedFileOfTouchesIsSaidWhenItsHandIsConnected) {
  const fs::path file = touchesFile(TouchedBy::kEmulatedHand);
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "no touches";
  QSignalSpy failed(&window().state().messages, &Messages::failed);
  connectEmulatedHand();
  EXPECT_EQ(failed.count(), 0) << "a hand at ports has another file";
  connectEmulated();
  ASSERT_TRUE(await([&] { return failed.count() == 1; }));
  EXPECT_TRUE(failed[0][1].toString().contains(pathText(file)))
      << failed[0][1].toString().toStdString();
  fs::remove(file);
}

TEST_F(LiveWindowTest, EscapeStopsTheHandWhateverIsShown) {
  connectEmulatedHand();
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  open({"good.dsa"});
  EXPECT_FALSE(window().state().displayed.isLive());
  press(Qt::Key_Escape);
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  EXPECT_NE(window().state().displayed.unfilteredRecording(), nullptr)
      << "Escape stopped the hand and did nothing else";
}

TEST_F(LiveWindowTest, RecordsWithMarksAndOpensWhatWasRecorded) {
  connectEmulated();
  press(Qt::Key_R, Qt::ControlModifier);
  EXPECT_EQ(asked_, 1);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 5; }));
  EXPECT_TRUE(await([&] { return actions().at("record")->iconText().contains("MB"); }))
      << actions().at("record")->iconText().toStdString();
  EXPECT_TRUE(find<QToolButton>("recordButton")->property("recording").toBool());
  press(Qt::Key_Space);
  press(Qt::Key_2);
  ASSERT_TRUE(await([&] { return chart().numEvents() == 2; }));
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return offered().contains("ball_001.palpate"); }));
  EXPECT_TRUE(offered().contains("nothing lost"));
  EXPECT_EQ(chart().numRecordingEnds(), 2u) << "begin and end are marked";
  const auto events = readEvents(folder_ / "runs" / "ball_001.palpate").events;
  const auto count = [&](const std::string& kind, const std::string& text) {
    return std::count_if(events.begin(), events.end(), [&](const Event& event) {
      return event.kind == kind && event.text == text;
    });
  };
  EXPECT_EQ(count("mark", ""), 1);
  EXPECT_EQ(count("label", "slip"), 1);
  const Profile profile = openRecording(folder_ / "runs" / "ball_001.palpate");
  EXPECT_GT(profile.numFrames(), 5u);
  EXPECT_GT(profile.numAngles(), 0u);

  click("offerAccept");
  EXPECT_TRUE(await([&] { return window().state().opener.numWaiting() == 0 && reads_ > 0; }));
  press(Qt::Key_F6);
  EXPECT_TRUE(window().state().displayed.isLive());
}

TEST_F(LiveWindowTest, ARecordingGoesOnWhileAnotherIsLookedAt) {
  connectEmulated();
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 0; }));
  open({"good.dsa"});
  EXPECT_FALSE(window().state().displayed.isLive());
  EXPECT_TRUE(actions().at("play")->isEnabled()) << "the space bar plays now";
  EXPECT_FALSE(actions().at("mark")->isEnabled());
  const auto before = live().health().recorder.framesOnDisk;
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > before + 5; }));
  press(Qt::Key_F6);
  EXPECT_TRUE(window().state().displayed.isLive());
  EXPECT_TRUE(actions().at("mark")->isEnabled());
  press(Qt::Key_Space);
  ASSERT_TRUE(await([&] { return chart().numEvents() == 1; }));
  open({"good2.dsa"});
  press(Qt::Key_F6);
  EXPECT_EQ(chart().numEvents(), 1u) << "marks stay in the chart";
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(window().state().recordings.all().size(), 2u)
      << "none of them is shown: none is closed";
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_FALSE(window().state().displayed.isLive());
  for (int i = 0; i < 2; ++i) press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_TRUE(window().state().recordings.all().empty());
  EXPECT_TRUE(window().state().displayed.isLive()) << "recordings are closed, the hand stays";
}

TEST_F(LiveWindowTest, ClosingAsksOnceAndFinishesTheRecording) {
  connectEmulated();
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 5; }));
  mayEnd_ = false;
  window().close();
  EXPECT_EQ(askedToEnd_, 1);
  EXPECT_TRUE(window().isVisible());
  EXPECT_TRUE(live().recording());
  mayEnd_ = true;
  window().close();
  EXPECT_EQ(askedToEnd_, 2);
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  EXPECT_EQ(verifyRecording(folder_ / "runs" / "ball_001.palpate").state,
            VerifyReport::State::kSound);
}

TEST_F(LiveWindowTest, DiscardedLabelsStayWhenTheWindowStays) {
  open({"good.dsa"});
  ask_.texts = {"touch"};
  ask_.choices = {"Discard"};
  press(Qt::Key_B, Qt::ControlModifier);
  ASSERT_TRUE(window().state().events.editor()->unsaved());
  connectEmulated("empty");
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().recording(); }));
  mayEnd_ = false;
  window().close();
  EXPECT_EQ(askedToEnd_, 1);
  EXPECT_TRUE(window().isVisible());
  emit find<QComboBox>("recordingsBox")->activated(0);
  ASSERT_FALSE(window().state().displayed.isLive());
  EXPECT_TRUE(window().state().events.editor()->unsaved());
  EXPECT_EQ(window().state().events.editor()->events().size(), 1u);
  mayEnd_ = true;
}

TEST_F(LiveWindowTest, ARecordingIsFoundWhereItWasLeftForTheHand) {
  open({"good.dsa"});
  playback().seekFrame(7);
  connectEmulated("empty");
  emit find<QComboBox>("recordingsBox")->activated(0);
  ASSERT_FALSE(window().state().displayed.isLive());
  EXPECT_EQ(playback().frame(), 7u);
  playback().seekFrame(9);
  press(Qt::Key_F6);
  ASSERT_TRUE(window().state().displayed.isLive());
  actions().at("disconnectHand")->trigger();
  ASSERT_TRUE(await([&] { return !window().state().displayed.isLive(); }));
  EXPECT_EQ(playback().frame(), 9u);
}

TEST_F(LiveWindowTest, ClosingWhileTheHandMovesStopsIt) {
  connectEmulatedHand();
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  window().close();
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  EXPECT_FALSE(bench_->handMoves());
  EXPECT_EQ(askedToEnd_, 0) << "no recording, no question";
}

TEST_F(LiveWindowTest, AskedToEndByASignalItStopsAndFinishesWithoutAsking) {
  connectEmulatedHand();
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 5; }));
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  mayEnd_ = false;
  window().endNow();
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  EXPECT_EQ(askedToEnd_, 0);
  EXPECT_FALSE(bench_->handMoves());
  EXPECT_EQ(verifyRecording(folder_ / "runs" / "ball_001.palpate").state,
            VerifyReport::State::kSound);
}

// The window stays open with what can't be saved, but the hand doesn't go on.
TEST_F(LiveWindowTest, AskedToEndByASignalItStopsTheHandAlsoWhenLabelsCannotBeSaved) {
  open({"good.dsa"});
  ask_.texts = {"touch"};
  press(Qt::Key_B, Qt::ControlModifier);
  ASSERT_TRUE(window().state().events.editor()->unsaved());
  std::filesystem::remove(folder_ / "good.dsa");
  connectEmulatedHand();
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  window().endNow();
  EXPECT_TRUE(await([&] { return !bench_->handMoves(); }));
  EXPECT_TRUE(live().source()) << "still connected";
  ASSERT_TRUE(await([&] { return bannerText().contains("not saved"); }));
  EXPECT_TRUE(window().isVisible());
  ask_.choices = {"Discard"};
}

TEST_F(LiveWindowTest, AskedToEndByASignalWhileItAsksItEnds) {
  connectEmulated();
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 5; }));
  window().state().prompts.endRecording = [this](UserPrompts::Ending) {
    ++askedToEnd_;
    QDialog question(&window());
    QTimer::singleShot(0, &question, [this] { window().endNow(); });
    return question.exec() == QDialog::Accepted;
  };
  window().close();
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  EXPECT_EQ(askedToEnd_, 1);
  EXPECT_EQ(verifyRecording(folder_ / "runs" / "ball_001.palpate").state,
            VerifyReport::State::kSound);
}

TEST_F(LiveWindowTest, AMotionPortThatGoesAwayInAGraspIsSaidAndStoppedOnReturn) {
  connectEmulatedHand();
  click("graspHand");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  bench_->hand->unplug(false, true);
  ASSERT_TRUE(await(
      [&] { return find<QLabel>("handState")->text().contains("still moving to its target"); }));
  EXPECT_FALSE(find<QPushButton>("graspHand")->isEnabled());
  EXPECT_TRUE(find<QPushButton>("stopHand")->isEnabled()) << "Stop is always there";
  EXPECT_TRUE(view().notice().isEmpty()) << "the tactile stream goes on";
  bench_->log.restart();
  bench_->hand->replug();
  ASSERT_TRUE(await([&] { return !bench_->log.named("stop").empty(); }));
  ASSERT_TRUE(await([&] { return find<QPushButton>("graspHand")->isEnabled(); }));
  EXPECT_FALSE(bench_->handMoves());
}

TEST_F(LiveWindowTest, ATactileStreamThatDiesInAReactiveGraspStopsTheHand) {
  connectEmulatedHand();
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  bench_->hand->mute(true);
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  ASSERT_TRUE(await([&] { return !view().notice().isEmpty(); }))
      << "and the picture says it is old";
  bench_->hand->mute(false);
  ASSERT_TRUE(await([&] { return view().notice().isEmpty(); }));
}

TEST_F(LiveWindowTest, APulledPlugIsSaidAndTheHandIsFoundAgain) {
  connectEmulatedHand();
  bench_->hand->unplug();
  ASSERT_TRUE(await([&] { return !view().notice().isEmpty(); }));
  ASSERT_TRUE(await(
      [&] { return find<StatusStrip>("statusStrip")->status().lamp == Status::Lamp::kWarning; }));
  EXPECT_TRUE(await([&] { return find<QWidget>("AlarmStrip")->isVisible(); }));
  bench_->hand->replug();
  ASSERT_TRUE(await([&] { return view().notice().isEmpty(); }));
  ASSERT_TRUE(await([&] { return !find<QWidget>("AlarmStrip")->isVisible(); }));
  EXPECT_TRUE(await([&] { return live().health().device.tactile.reconnects == 1; }));
}

TEST_F(LiveWindowTest, ThePictureIsHeldAndGoesOn) {
  connectEmulated("ball");
  ASSERT_TRUE(await([&] { return view().paintedUs() > 0; }));
  press(Qt::Key_P);
  QCoreApplication::processEvents();  // the newest frame, with the line that it is held
  const auto held = view().paintedUs();
  const auto frames = live().health().frames.frames;
  ASSERT_TRUE(await([&] { return live().health().frames.frames > frames + 10; }));
  EXPECT_EQ(view().paintedUs(), held);
  press(Qt::Key_P);
  find<QCheckBox>("keepLimit")->setChecked(false);  // it touches soon
  click("reactiveGrasp");
  EXPECT_TRUE(await([&] { return view().paintedUs() > held; }));
}

// As a picture of the screen has it.
QImage pictureOf(QWidget& widget) { return widget.grab().toImage(); }

// L-M4
TEST_F(LiveWindowTest, TheHandInSpaceIsMarkedWhenItsPictureIsOld) {
  connectEmulatedHand();
  HandView& hand = window().feature<Hand3dFeature>().panel().view();
  ASSERT_TRUE(await([&] { return hand.isVisible() && hand.drawing().handState().frame; }));
  const QImage live = pictureOf(hand);
  bench_->hand->unplug();
  ASSERT_TRUE(await([&] { return !view().notice().isEmpty(); }));
  EXPECT_NE(pictureOf(hand), live) << "a hand that is gone looks like one that is there";
  bench_->hand->replug();
  ASSERT_TRUE(await([&] { return view().notice().isEmpty(); }));
  EXPECT_TRUE(await([&] { return pictureOf(hand) == live; }));
}

TEST_F(LiveWindowTest, OfARecordingNothingIsHeld) {
  connectEmulated("empty");
  ASSERT_TRUE(await([&] { return view().paintedUs() > 0; }));
  press(Qt::Key_P);
  ASSERT_TRUE(view().notice().contains("on hold"));
  open({"empty.dsa"});
  EXPECT_FALSE(window().state().displayed.isLive());
  EXPECT_EQ(view().notice(), "");
}

// L-M4
TEST_F(LiveWindowTest, APictureThatIsHeldSaysSoInEveryView) {
  connectEmulated("empty");
  HandView& hand = window().feature<Hand3dFeature>().panel().view();
  ASSERT_TRUE(await([&] { return hand.drawing().handState().frame && view().paintedUs() > 0; }));
  const auto corner = [](QWidget& widget) {
    const QImage whole = pictureOf(widget);
    return whole.copy(0, 0, whole.width(), whole.height() / 4);
  };
  const QImage matricesBefore = corner(view()), handBefore = corner(hand);
  press(Qt::Key_P);
  EXPECT_TRUE(view().notice().contains("on hold")) << view().notice().toStdString();
  EXPECT_NE(corner(view()), matricesBefore);
  EXPECT_NE(corner(hand), handBefore);
  const QImage chartHeld = pictureOf(chart());
  EXPECT_EQ(find<StatusStrip>("statusStrip")->status().lamp, Status::Lamp::kWarning);
  press(Qt::Key_P);
  EXPECT_TRUE(view().notice().isEmpty());
  EXPECT_EQ(corner(view()), matricesBefore);
  EXPECT_NE(pictureOf(chart()), chartHeld);
}

// L-M10
TEST_F(LiveWindowTest, WhyNothingWasRecordedGoesAsSoonAsItRecords) {
  connectEmulated("empty");
  const auto mended = window().state().prompts.recording;
  window().state().prompts.recording = [&](RecordingSettings settings, const QString& button) {
    settings = *mended(settings, button);
    settings.folder = "/proc/no_such_folder";
    return std::optional(settings);
  };
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return bannerText().contains("Not recording"); }));
  window().state().prompts.recording = mended;
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 0; }));
  // The window looks after it some ten times a second.
  EXPECT_TRUE(await([&] { return bannerText().isEmpty(); })) << bannerText().toStdString();
}

// L-M1: in every field, slider and box that can be seen, of every dock.
TEST_F(LiveWindowTest, TheWheelChangesNothingThatHasNoFocus) {
  connectEmulated("empty");
  ASSERT_TRUE(await([&] { return live().source()->control->status().cannotReact.empty(); }));
  int tried = 0;
  const auto turn = [&](QWidget* widget, const std::function<double()>& value) {
    if (!widget->isVisible() || !widget->isEnabled()) return;
    if (QWidget* focused = QApplication::focusWidget()) focused->clearFocus();
    const double before = value();
    for (const int notch : {120, -120, -120}) {
      const QPointF middle = QRectF(widget->rect()).center();
      QWheelEvent wheel(middle,
                        widget->mapToGlobal(middle),
                        {},
                        {0, notch},
                        Qt::NoButton,
                        Qt::NoModifier,
                        Qt::NoScrollPhase,
                        false);
      QCoreApplication::sendEvent(widget, &wheel);
      EXPECT_EQ(value(), before) << widget->metaObject()->className() << " "
                                 << widget->objectName().toStdString() << " "
                                 << widget->accessibleName().toStdString();
    }
    EXPECT_FALSE(widget->hasFocus()) << widget->objectName().toStdString();
    ++tried;
  };
  for (const QString& dock : window().docks().names()) {
    window().docks().show(dock);
    QCoreApplication::processEvents();
    for (auto* field : window().findChildren<QSpinBox*>())
      turn(field, [field] { return field->value(); });
    for (auto* field : window().findChildren<QDoubleSpinBox*>())
      turn(field, [field] { return field->value(); });
    for (auto* slider : window().findChildren<QSlider*>())
      turn(slider, [slider] { return slider->value(); });
    for (auto* box : window().findChildren<QComboBox*>())
      turn(box, [box] { return box->currentIndex(); });
  }
  EXPECT_GT(tried, 40);
  const auto settings = live().source()->session->device().info().matrices;
  EXPECT_EQ(settings.at(1).thresholdCounts, 300);
}

// L-M1: with the focus it is the field's.
TEST_F(LiveWindowTest, TheWheelTurnsAFieldThatHasTheFocus) {
  connectEmulated("empty");
  auto* velocity = find<QWidget>("velocity")->findChild<QDoubleSpinBox*>();
  velocity->setFocus();
  const double before = velocity->value();
  QWheelEvent wheel({5, 5},
                    velocity->mapToGlobal(QPointF(5, 5)),
                    {},
                    {0, 120},
                    Qt::NoButton,
                    Qt::NoModifier,
                    Qt::NoScrollPhase,
                    false);
  QCoreApplication::sendEvent(velocity, &wheel);
  EXPECT_EQ(velocity->value(), before + 1.0);
}

// L-M8
TEST_F(LiveWindowTest, TheHandIsMovedByKeysOfItsMenu) {
  connectEmulatedHand();
  const auto action = [&](const QString& text) -> QAction* {
    for (QAction* each : window().actions())
      if (plainText(*each) == text) return each;
    return nullptr;
  };
  for (const char* text :
       {"Grasp", "Reactive grasp", "Slip-aware grasp", "Open the hand", "Relax"}) {
    QAction* each = action(text);
    ASSERT_NE(each, nullptr) << text;
    EXPECT_FALSE(each->shortcut().isEmpty()) << text;
    EXPECT_TRUE(await([&] { return each->isEnabled(); })) << text;
  }
  press(Qt::Key_G, Qt::ControlModifier | Qt::AltModifier);
  ASSERT_TRUE(await([&] { return bench_->handMoves(); }));
  ASSERT_TRUE(await([&] { return !action("Open the hand")->isEnabled(); })) << "it moves";
  press(Qt::Key_Escape);
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  const std::vector<QString> texts{"Grasp", "Reactive grasp", "Slip-aware grasp", "Open the hand"};
  trigger("disconnectHand");
  ASSERT_TRUE(await([&] { return live().state() == State::kNone; }));
  for (const QString& text : texts) EXPECT_FALSE(action(text)->isEnabled()) << text.toStdString();
}

// L-M2
TEST_F(LiveWindowTest, ABlindMatrixIsMarkedInTheHeatMaps) {
  connectEmulatedHand();
  ASSERT_TRUE(await([&] { return view().paintedUs() > 0; }));
  const QImage seeing = pictureOf(view());
  live().source()->control->change(SetThreshold{1, 4095});
  ASSERT_TRUE(await([&] { return view().unmeasurable().size() == 2; }));
  EXPECT_TRUE(view().unmeasurable()[0].isEmpty());
  EXPECT_TRUE(view().unmeasurable()[1].contains("finger 0 distal"))
      << view().unmeasurable()[1].toStdString();
  EXPECT_NE(pictureOf(view()), seeing);
  open({"good.dsa"});
  EXPECT_TRUE(view().unmeasurable().empty()) << "of a recording nothing is to be grasped";
  press(Qt::Key_F6);
  EXPECT_EQ(view().unmeasurable().size(), 2u);
}

// L-M13: what the chart marks and the log says.
TEST_F(LiveWindowTest, OpeningAndRefusalsAreNamedInTheLog) {
  connectEmulatedHand();
  QStringList logged;
  QObject::connect(
      &live(), &LiveController::eventsReceived, &window(), [&](const std::vector<Event>& came) {
        for (const Event& event : came)
          if (event.kind == "grasp") logged.append(QString::fromStdString(event.text));
      });
  click("openHand");
  ASSERT_TRUE(await([&] { return !logged.isEmpty(); }));
  EXPECT_TRUE(logged.front().startsWith("opening")) << logged.front().toStdString();
  ASSERT_TRUE(await([&] { return live().source()->control->status().phase == GraspPhase::kIdle; }));
  GraspRequest wrong;
  wrong.mode = GraspMode::kReactive;
  wrong.limitCounts = 1;
  EXPECT_THROW(live().source()->control->grasp(wrong), std::invalid_argument);
  // The end of the opening may be told meanwhile.
  EXPECT_TRUE(await([&] {
    return !logged.filter(QRegularExpression("^reactive grasp refused")).isEmpty();
  })) << logged.join("; ").toStdString();
}

TEST_F(LiveWindowTest, ChosenTaxelsAreScannedAlone) {
  connectEmulatedHand();
  TaxelSelection chosen(*sdh2().layout);
  chosen.add(1, 5, 1, 8, 4);
  view().select(chosen);
  EXPECT_TRUE(find<StatusStrip>("statusStrip")->status().notice.contains("16 taxels chosen"));
  window().docks().show("Slip");
  window().findChild<SlipPanel*>()->choose(1);
  MatrixTableModel& table = window().findChild<InspectPanel*>()->table();
  table.setPlotted(2, false);
  const std::vector<bool> plotted = table.plotted();
  QElapsedTimer sinceAsked;
  sinceAsked.start();
  actions().at("scanOnlyInTheirMatrices")->trigger();
  const QString changing = "changing which taxels are scanned: no frames until this is done";
  EXPECT_EQ(window().state().messages.flashed(), changing);
  const auto enabled = [&](std::size_t matrix) {
    return live().source()->session->device().hand().layout->matrix(matrix).numEnabled();
  };
  ASSERT_TRUE(await([&] { return enabled(1) == 16; }));
  ASSERT_TRUE(await([&] { return window().state().messages.flashed() != changing; }));
  EXPECT_LT(sinceAsked.elapsed(), testing::timeLimit<qint64>(4500))
      << "not after the 5 s of a notice, but when it is done";
  EXPECT_EQ(enabled(0), sdh2().layout->matrix(0).numTaxels());
  EXPECT_EQ(view().selection().count(), 16u) << "what is chosen stays chosen";
  // What is shown knows it, too, and what was plotted stays so.
  SlipPanel& slip = *window().findChild<SlipPanel*>();
  EXPECT_TRUE(await([&] {
    const auto& scene = slip.drawing().scene();
    return scene && scene->layout.numEnabled() == 16u && scene->values.size() > 0;
  }));
  EXPECT_EQ(table.hand().layout->matrix(1).numEnabled(), 16u);
  EXPECT_EQ(table.plotted(), plotted);
  actions().at("scanOnly")->trigger();
  EXPECT_TRUE(await([&] { return enabled(0) == 0; })) << "the rest of the hand";
  EXPECT_EQ(enabled(1), 16);
  actions().at("scanAll")->trigger();
  ASSERT_TRUE(await([&] { return enabled(1) == sdh2().layout->matrix(1).numTaxels(); }));
}

TEST_F(LiveWindowTest, DisconnectingComesBackToWhatWasOpen) {
  open({"good.dsa"});
  connectEmulated();
  EXPECT_TRUE(window().state().displayed.isLive());
  trigger("disconnectHand");
  ASSERT_TRUE(await([&] { return live().state() == State::kNone; }));
  EXPECT_FALSE(window().state().displayed.isLive());
  ASSERT_NE(window().state().displayed.unfilteredRecording(), nullptr);
  EXPECT_TRUE(window().findChild<TimelineChart*>()->isVisible());
  EXPECT_TRUE(view().notice().isEmpty());
}

TEST_F(LiveWindowTest, AConnectionThatFailsSaysWhyAndRemembersNothing) {
  Connection wrong;
  wrong.scene = "no_such_scene";
  window().state().connectTo(wrong);
  ASSERT_TRUE(await([&] { return bannerText().contains("no_such_scene"); }));
  EXPECT_EQ(live().state(), State::kNone);
  QSettings settings(settingsFile(), QSettings::IniFormat);
  EXPECT_EQ(loadConnection(settings), Connection{});
}

TEST_F(LiveWindowTest, TheConnectButtonOffersScenesAndTheLastConnection) {
  connectEmulated("pen");
  window().close();
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  start();
  ready();
  auto* menu = find<QToolButton>("connectButton")->menu();
  emit menu->aboutToShow();
  QStringList texts;
  for (const QAction* action : menu->actions()) texts.append(action->text());
  EXPECT_TRUE(texts.contains("Again: emulated hand · pen")) << texts.join("|").toStdString();
  EXPECT_TRUE(texts.contains("&Emulated hand"));
  EXPECT_TRUE(texts.contains("&Replay of a recording"));
  menu->actions().front()->trigger();
  ASSERT_TRUE(await([&] { return window().state().displayed.isLive(); }));
}

TEST_F(LiveWindowTest, AReplayThatEndsIsNoAlarm) {
  connectEmulated("empty");
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 5; }));
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return offered().contains("ball_001.palpate"); }));
  Connection replay;
  replay.kind = Connection::Kind::kReplay;
  replay.recording = QString::fromStdString((folder_ / "runs/ball_001.palpate").string());
  window().state().connectTo(replay);
  ASSERT_TRUE(await([&] { return live().source() && live().source()->finished(); }));
  ASSERT_TRUE(await([&] { return view().notice() == "the replay has ended"; }));
  // A second without a frame is an alarm elsewhere.
  ASSERT_TRUE(await([&] { return live().silentS() > 1.6; }));
  live().refreshHealth();
  EXPECT_FALSE(find<QWidget>("AlarmStrip")->isVisible());
}

TEST_F(LiveWindowTest, TheDemoGraspsByItself) {
  window().state().connectTo(emulatedBallConnection());
  auto* table = window().findChild<MatrixTableModel*>();
  ASSERT_TRUE(await([&] {
    return table->numMatrices() > 0 &&
           table->index(static_cast<int>(table->numMatrices()), MatrixTableModel::kActive)
                   .data()
                   .toInt() > 10;
  }));
}

// The first button of the window has the focus when nothing was clicked: a menu of a view.
TEST_F(LiveWindowTest, AClickOnGraspTakesTheKeyboardFromTheMenusOfTheViews) {
  connectEmulatedHand();
  window().docks().show("Calibrate");
  makeActive(window());
  auto* show = find<QToolButton>("handShowButton");
  show->setFocus();
  ASSERT_EQ(window().focusWidget(), show);
  auto* dock = window().findChild<HandDock*>();
  click("graspHand");
  ASSERT_TRUE(await([&] { return !find<QPushButton>("graspHand")->isEnabled(); }));
  EXPECT_EQ(window().focusWidget(), dock);
  QTest::keyClick(window().focusWidget(), Qt::Key_Return);
  EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
  click("stopHand");
  ASSERT_TRUE(await([&] { return find<QPushButton>("graspHand")->isEnabled(); }));
  EXPECT_EQ(window().focusWidget(), dock);
  // By the keyboard: Grasp gives the focus away while it is disabled, and gets it back.
  auto* grasp = find<QPushButton>("graspHand");
  grasp->setFocus();
  QTest::keyClick(grasp, Qt::Key_Return);
  ASSERT_TRUE(await([&] { return !grasp->isEnabled(); }));
  EXPECT_EQ(window().focusWidget(), dock);
  QTest::keyClick(window().focusWidget(), Qt::Key_Escape);
  ASSERT_TRUE(await([&] { return grasp->isEnabled(); }));
  EXPECT_EQ(window().focusWidget(), grasp);
}

TEST_F(LiveWindowTest, ADialogueAndTheAnglesSayAtOnceThatTheMotionPortIsGone) {
  connectEmulatedHand();
  bench_->hand->unplug(false, true);
  ASSERT_TRUE(await([&] { return live().motionGone(); }));
  const auto* angles = window().findChild<InspectPanel*>()->findChild<FactsView*>("angleFacts");
  ASSERT_NE(angles, nullptr);
  EXPECT_TRUE(angles->isOld());
  ASSERT_TRUE(await([&] { return !find<QPushButton>("graspHand")->isEnabled(); }));
  QMessageBox question(QMessageBox::Question, "Palpate", "Go on?", QMessageBox::Yes, &window());
  question.open();
  QCoreApplication::processEvents();
  const auto* state = question.findChild<QLabel*>("dialogStopState");
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->text(), "The hand can't be stopped from here.");
  bench_->hand->replug();
  EXPECT_TRUE(await([&] { return state->text() == "A hand is connected."; }));
  EXPECT_TRUE(await([&] { return !angles->isOld(); }));
  question.close();
}

// L-m29: a scene that moves the hand again and again does so until the first order.
TEST_F(LiveWindowTest, ConnectingIsNoOrderToTheEmulatedHandAndAStopAtRestIsOne) {
  connectEmulated("empty");
  ASSERT_TRUE(await([&] { return live().source()->control->status().cannotReact.empty(); }));
  const auto orders = [&] {
    std::uint64_t count = 0;
    live().source()->emulated->withModel(
        [&](HandModel& model) { count = model.joints().orderCount(); });
    return count;
  };
  EXPECT_EQ(orders(), 0u);
  click("stopHand");
  EXPECT_TRUE(await([&] { return orders() > 0; }));
}

}  // namespace
}  // namespace palpate::gui::live_window_test
