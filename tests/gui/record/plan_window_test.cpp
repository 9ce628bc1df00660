// What the window says of a plan that is followed, and when it asks whether it still is.
#include <QLabel>
#include <QToolBar>
#include <QToolButton>

#include <palpate/recording/recording.h>

#include "gui/record/countdown_strip.h"
#include "gui/record/record_feature.h"
#include "gui/record/recording_countdown.h"
#include "gui/source/recording_settings.h"
#include "gui/testing/window_fixture.h"
#include "recording/palpate_samples.h"

namespace palpate::gui::plan_window_test {
namespace {
namespace fs = std::filesystem;

class PlanWindowTest : public WindowTest {
 protected:
  PlanWindowTest() {
    QSettings settings(settingsFile(), QSettings::IniFormat);
    RecordingSettings recording;
    recording.folder = QString::fromStdString((folder_ / "runs").string());
    recording.countdownS = 3;  // nothing is recorded before the test has looked
    saveRecordingSettings(recording, settings);
    fs::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
    begin();
  }
  void begin() {
    ask_.choices = {"Follow the plan"};
    window().state().prompts.recording = [this](const RecordingSettings&, const QString&) {
      ++askedForName_;
      return std::optional<RecordingSettings>();
    };
  }
  void connectScene(const QString& scene = "empty") {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = scene;
    connectTo(connection);
  }
  void connectTo(const Connection& connection) {
    window().state().connectTo(connection);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          const LiveSource* source = window().state().live.source();
          return source && !source->session->device().info().serial.empty() &&
                 window().state().displayed.isLive() && !window().state().live.stale();
        },
        20'000));
  }
  PlanController& plan() { return window().feature<RecordFeature>().plan(); }
  QAction* record() { return actions().at("record"); }
  // The countdown runs; it is ended again.
  bool counts() {
    const bool shown = find<CountdownStrip>("CountdownStrip")->isVisible();
    if (shown) record()->trigger();
    return shown;
  }
  void planPen() {
    plan().addRow({.object = "pen", .run = "right", .repetitions = 3});
    plan().setFollowed(true);
  }

  int askedForName_ = 0;
};

TEST_F(PlanWindowTest, TheButtonAndTheCountdownNameTheTake) {
  connectScene();
  EXPECT_EQ(record()->iconText(), " Record");
  planPen();
  EXPECT_EQ(record()->iconText(), " Record: pen, right, 1 of 3");
  EXPECT_TRUE(record()->toolTip().contains("pen, right, 1 of 3"))
      << record()->toolTip().toStdString();
  record()->trigger();
  EXPECT_EQ(find<QLabel>("countdownText")->text(), "pen, right, 1 of 3: recording begins in 3 s");
  EXPECT_TRUE(ask_.choices.asked.isEmpty()) << "it was followed in this session";
  EXPECT_TRUE(counts());
  plan().setFollowed(false);
  EXPECT_EQ(record()->iconText(), " Record");
  EXPECT_FALSE(record()->toolTip().contains("pen"));
}

// The take that is counted down is booked on its row, under the name that the row has when the
// recording begins.
TEST_F(PlanWindowTest, ThePlanMayBeEditedDuringTheCountdown) {
  connectScene();
  plan().addRow({.object = "cup"});
  plan().addRow({.object = "bottle"});
  plan().setFollowed(true);
  record()->trigger();
  plan().setRow(0, {.object = "mug"});
  EXPECT_TRUE(find<QLabel>("countdownText")->text().startsWith("mug: recording begins"));
  auto* countdown = window().feature<RecordFeature>().findChild<RecordingCountdown*>();
  ASSERT_TRUE(countdown);
  for (int s = 0; s < 3; ++s) countdown->tick();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().state().live.recording(); }, 20'000));
  plan().removeRow(1);
  record()->trigger();
  ASSERT_EQ(plan().plan().rows().size(), 1u);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !plan().plan().rows()[0].takes.empty(); }, 20'000));
  plan().settle();
  const std::string name = plan().plan().rows()[0].takes[0].file.filename().string();
  EXPECT_NE(name.find("mug"), std::string::npos) << name;
}

TEST_F(PlanWindowTest, ACancelledCountdownHoldsNothing) {
  connectScene();
  planPen();
  record()->trigger();
  EXPECT_TRUE(plan().holds());
  record()->trigger();
  EXPECT_FALSE(plan().holds());
}

TEST_F(PlanWindowTest, ThatThePlanIsDoneIsOnTheButton) {
  plan().addRow({.object = "pen"});
  plan().setFollowed(true);
  plan().begin(std::nullopt);
  RecordingReport report;
  report.paths = {folder_ / "no_such.palpate"};
  plan().end(report);
  plan().settle();
  EXPECT_EQ(record()->iconText(), " Record") << "to be decided";
  EXPECT_TRUE(record()->toolTip().contains("1 take is to be decided"));
  plan().keep(folder_ / "no_such.palpate");
  EXPECT_EQ(record()->iconText(), " Record: the plan is done");
}

TEST_F(PlanWindowTest, ANewSessionAsksOnce) {
  planPen();
  start();
  begin();
  EXPECT_EQ(record()->iconText(), " Record: pen, right, 1 of 3");
  connectScene();
  EXPECT_TRUE(ask_.choices.asked.isEmpty()) << "only who records is asked";
  record()->trigger();
  ASSERT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_EQ(ask_.choices.asked[0],
            "The plan of recordings was followed in an earlier session. Next in it: pen, right, 1 "
            "of 3. Is it still followed?");
  EXPECT_TRUE(counts());
  record()->trigger();
  EXPECT_TRUE(counts());
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_EQ(askedForName_, 0);
}

TEST_F(PlanWindowTest, NoUnticksThePlanAndCancelRecordsNothing) {
  planPen();
  start();
  begin();
  connectScene();
  ask_.choices = {QString(), "Don't follow it"};
  record()->trigger();
  EXPECT_FALSE(counts());
  EXPECT_TRUE(plan().followed());
  record()->trigger();
  EXPECT_EQ(ask_.choices.asked.size(), 2);
  EXPECT_FALSE(plan().followed());
  EXPECT_EQ(askedForName_, 1) << "as without a plan";
  EXPECT_EQ(record()->iconText(), " Record");
}

TEST_F(PlanWindowTest, AnotherHandAsks) {
  connectScene();
  planPen();
  record()->trigger();
  EXPECT_TRUE(counts());
  // The same hand again: its number is the same.
  window().state().live.end();
  connectScene("ball");
  record()->trigger();
  EXPECT_TRUE(counts());
  EXPECT_TRUE(ask_.choices.asked.isEmpty());
  // A recorded hand with a number of its own.
  testing::writeSamples(folder_ / "other.palpate", 70, true);
  Connection replay;
  replay.kind = Connection::Kind::kReplay;
  replay.recording = QString::fromStdString((folder_ / "other.palpate").string());
  window().state().live.end();
  connectTo(replay);
  record()->trigger();
  ASSERT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_TRUE(ask_.choices.asked[0].contains("with another hand"))
      << ask_.choices.asked[0].toStdString();
}

TEST_F(PlanWindowTest, ALongNameIsElidedToTheRoomInTheBar) {
  connectScene();
  plan().addRow({.object = std::string(300, 'm')});
  plan().setFollowed(true);
  QCoreApplication::processEvents();
  auto* bar = find<QToolBar>("Toolbar");
  const auto* button = find<QToolButton>("recordButton");
  const auto* last = bar->widgetForAction(actions().at("keys"));
  for (const int width : {1440, 1280, 1100}) {
    window().resize(width, 900);
    ASSERT_TRUE(QTest::qWaitFor([&] {
      return last->isVisible() && last->geometry().right() <= bar->width();
    })) << width
        << ": " << button->width();
    EXPECT_GT(button->width(), button->fontMetrics().horizontalAdvance(" Record: mm")) << width;
  }
  EXPECT_TRUE(record()->toolTip().contains(QString(300, 'm')));
}

}  // namespace
}  // namespace palpate::gui::plan_window_test
