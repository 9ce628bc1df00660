// The Connect dialog over made-up ports: kinds, keys, scenes, recordings.
#include "gui/connect/connect_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <utility>
#include <vector>

#include "gui/connect/connect_fixture.h"
#include "gui/connect/replay_page.h"
#include "gui/connect/scene_page.h"
#include "gui/source/file_reading.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui::connect_dialog_test {
namespace {

TEST_F(ConnectDialogTest, NoPortIsTouchedUnlessThePageOfThePortsIsShown) {
  plugIn();
  open({});
  QTest::qWait(0);
  EXPECT_FALSE(scan_->running());
  EXPECT_TRUE(fake_.asked().empty());
  press(Qt::Key_P, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return find<QRadioButton>("kindPorts")->isChecked(); }));
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(dialog_->connection().dsaPort, kTactileLink);
}

TEST_F(ConnectDialogTest, ThePortsAreFreeWhenItCloses) {
  for (const bool accepted : {true, false}) {
    plugIn();
    fake_.hang(kTactile);
    openPorts(kTactileLink, kMotionLink);
    ASSERT_TRUE(await([&] { return fake_.numOpen() == 1; }));
    accepted ? dialog_->accept() : dialog_->reject();
    EXPECT_TRUE(await([&] { return fake_.numOpen() == 0; }));
    EXPECT_FALSE(scan_->running());
  }
}

TEST_F(ConnectDialogTest, EnterConnectsFromWhereverTheKeyboardIs) {
  const std::vector<std::pair<Connection::Kind, const char*>> places = {
      {Connection::Kind::kPorts, "kindPorts"},
      {Connection::Kind::kPorts, "tactilePort"},
      {Connection::Kind::kStream, "streamHand"},
      {Connection::Kind::kEmulated, "scenes"},
      {Connection::Kind::kEmulated, "sceneScriptRuns"},
      {Connection::Kind::kReplay, "recording"}};
  const QString recording = file("a.dsa", "x");
  for (const auto& [kind, name] : places) {
    open({.kind = kind,
          .dsaPort = "a",
          .sdhPort = "b",
          .recording = recording,
          .stream = {.source = "udp:9871", .hand = "sole"}});
    find<QWidget>(name)->setFocus();
    press(Qt::Key_Return);
    EXPECT_EQ(dialog_->result(), QDialog::Accepted) << name;
    EXPECT_FALSE(dialog_->isVisible()) << name;
  }
}

TEST_F(ConnectDialogTest, EnterDoesNothingWhileSomethingIsMissing) {
  open({.kind = Connection::Kind::kReplay});
  find<QWidget>("recording")->setFocus();
  press(Qt::Key_Return);
  EXPECT_TRUE(dialog_->isVisible());
}

TEST_F(ConnectDialogTest, AConnectionIsSavedUnderANameChosenAndForgotten) {
  QSettings settings(QString::fromStdString((folder_ / "named.ini").string()),
                     QSettings::IniFormat);
  openWith(settings, {.kind = Connection::Kind::kEmulated, .scene = "ball"});
  auto* saved = find<QComboBox>("savedConnections");
  EXPECT_FALSE(saved->isEnabled()) << "none yet";
  ask_.texts = {"the ball"};
  find<QPushButton>("saveConnection")->click();
  EXPECT_EQ(ask_.texts.began, QStringList("emulated hand · ball"));
  EXPECT_EQ(saved->currentText(), "the ball");
  const QString recording = file("a.dsa", "x");
  openWith(settings, {.kind = Connection::Kind::kReplay, .recording = recording});
  saved = find<QComboBox>("savedConnections");
  saved->setCurrentIndex(saved->findText("the ball"));
  emit saved->activated(saved->currentIndex());
  EXPECT_EQ(dialog_->connection().kind, Connection::Kind::kEmulated);
  EXPECT_EQ(dialog_->connection().scene, "ball");
  EXPECT_EQ(dialog_->connection().name, "the ball");
  EXPECT_TRUE(find<QRadioButton>("kindEmulated")->isChecked());
  // With another source it is no longer the saved connection; the next time it is chosen again.
  find<QRadioButton>("kindReplay")->setChecked(true);
  EXPECT_EQ(dialog_->connection().name, "");
  find<QRadioButton>("kindEmulated")->setChecked(true);
  openWith(settings, dialog_->connection());
  saved = find<QComboBox>("savedConnections");
  EXPECT_EQ(saved->currentText(), "the ball");
  EXPECT_EQ(dialog_->connection().name, "the ball");
  find<QPushButton>("forgetConnection")->click();
  EXPECT_TRUE(connectionNames(settings).isEmpty());
  EXPECT_FALSE(find<QPushButton>("forgetConnection")->isEnabled());
}

TEST_F(ConnectDialogTest, EscapeCancels) {
  open({});
  press(Qt::Key_Escape);
  EXPECT_FALSE(dialog_->isVisible());
  EXPECT_EQ(dialog_->result(), QDialog::Rejected);
}

TEST_F(ConnectDialogTest, ReturnPressesTheButtonThatHasTheFocus) {
  open({});
  auto* cancel = find<QPushButton>("connectCancel");
  cancel->setFocus();
  QTest::keyClick(cancel, Qt::Key_Return);
  EXPECT_FALSE(dialog_->isVisible());
  EXPECT_EQ(dialog_->result(), QDialog::Rejected);
}

TEST_F(ConnectDialogTest, TheArrowKeysChooseTheKind) {
  open({});
  EXPECT_EQ(QApplication::focusWidget(), find<QRadioButton>("kindEmulated"));
  press(Qt::Key_Down);
  EXPECT_EQ(dialog_->connection().kind, Connection::Kind::kReplay);
  EXPECT_TRUE(find<QWidget>("recording")->isVisible());
  press(Qt::Key_Up);
  press(Qt::Key_Up);
  EXPECT_EQ(dialog_->connection().kind, Connection::Kind::kStream);
  EXPECT_TRUE(find<QWidget>("streamPlace")->isVisible());
  press(Qt::Key_Up);
  EXPECT_EQ(dialog_->connection().kind, Connection::Kind::kPorts);
  EXPECT_TRUE(find<QWidget>("tactilePort")->isVisible());
  EXPECT_FALSE(find<QWidget>("recording")->isVisible());
}

TEST_F(ConnectDialogTest, ScenesAreChosenByNameAndSayWhatTheyAre) {
  open({});
  EXPECT_EQ(dialog_->connection().scene, "ball");
  EXPECT_TRUE(canConnect());
  auto* scenes = find<QListWidget>("scenes");
  EXPECT_EQ(scenes->currentItem()->data(TwoLineDelegate::kDetailRole).toString(),
            "A hard ball in the middle, grasped centrically, held, released");
  press(Qt::Key_H, Qt::AltModifier);
  EXPECT_EQ(QApplication::focusWidget(), scenes);
  press(Qt::Key_Down);
  EXPECT_EQ(dialog_->connection().scene, "bottle");
  press(Qt::Key_B, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return dialog_->connection().sceneScriptRuns; }));
}

TEST_F(ConnectDialogTest, ASceneWithoutAScriptCannotAct) {
  testing::writeFile(folder_ / "still.json", "{}");
  testing::writeFile(folder_ / "busy.json", R"({"script": [{"at_s": 1, "grasp": {}}]})");
  scenesFolder_ = folder_.path();
  open({.scene = "still"});
  EXPECT_FALSE(find<QCheckBox>("sceneScriptRuns")->isEnabled());
  find<QListWidget>("scenes")->setCurrentRow(0);
  EXPECT_EQ(dialog_->connection().scene, "busy");
  EXPECT_TRUE(find<QCheckBox>("sceneScriptRuns")->isEnabled());
}

// The handle of such a scene was never pulled, and nothing said why.
TEST_F(ConnectDialogTest, ASceneWhoseScriptPullsSaysThatItPullsOnlyWhenTicked) {
  testing::writeFile(folder_ / "pulled.json",
                     R"({"objects": [{"shape": "sphere", "size_mm": 60}],
                         "script": [{"at_s": 1, "load": {"object": 0, "force_n": [0, 0, 9],
                                                         "duration_s": 1}}]})");
  testing::writeFile(folder_ / "grasped.json", R"({"script": [{"at_s": 1, "grasp": {}}]})");
  scenesFolder_ = folder_.path();
  open({.scene = "pulled"});
  ASSERT_TRUE(canConnect()) << text("connectProblem").toStdString();
  const auto* note = find<QLabel>("sceneNote");
  EXPECT_TRUE(note->isVisible());
  EXPECT_TRUE(note->text().contains("nothing pulls or turns the object"));
  EXPECT_EQ(text("connectIsCalm"), "Connecting never moves the hand.");
  find<QCheckBox>("sceneScriptRuns")->click();
  EXPECT_FALSE(note->isVisible());
  EXPECT_EQ(text("connectIsCalm"), "The scene starts as soon as it is connected.");
  find<QCheckBox>("sceneScriptRuns")->click();
  EXPECT_TRUE(note->isVisible());
  EXPECT_EQ(text("connectIsCalm"), "Connecting never moves the hand.");
  find<QListWidget>("scenes")->setCurrentRow(0);
  ASSERT_EQ(dialog_->connection().scene, "grasped");
  EXPECT_FALSE(note->isVisible());
}

TEST_F(ConnectDialogTest, ABrokenSceneSaysWhatIsWrong) {
  testing::writeFile(folder_ / "broken.json", R"({"objects": 3})");
  testing::writeFile(folder_ / "good.json", R"({"description": "Fine"})");
  scenesFolder_ = folder_.path();
  open({.scene = "broken"});
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("objects isn't a JSON array"))
      << text("connectProblem").toStdString();
  find<QListWidget>("scenes")->setCurrentRow(1);
  EXPECT_EQ(dialog_->connection().scene, "good");
  EXPECT_TRUE(canConnect());
}

TEST_F(ConnectDialogTest, ASceneOfOnesOwn) {
  const QString mine = file("mine.json", R"({"description": "My own"})");
  open({.scene = mine, .sceneScriptRuns = true});
  EXPECT_EQ(dialog_->connection().scene, mine);
  EXPECT_TRUE(dialog_->connection().sceneScriptRuns);
  const QString other = file("other.json", "{}");
  ask_.files = {other};
  click("otherScene");
  FileReading::settleAll(*dialog_);
  EXPECT_EQ(dialog_->connection().scene, other);
  EXPECT_TRUE(canConnect());
  // One that was deleted since.
  open({.scene = "/nowhere/at all.json"});
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("no such file"));
}

TEST_F(ConnectDialogTest, WithoutScenesItSaysSo) {
  scenesFolder_ = folder_ / "nothing here";
  open({.scene = ""});
  EXPECT_TRUE(find<QLabel>("noScenes")->isVisible());
  EXPECT_FALSE(canConnect());
  EXPECT_EQ(text("connectProblem"), "Choose a scene.");
}

TEST_F(ConnectDialogTest, ARecordingThatIsMissingIsSaidAtOnce) {
  const QString there = file("there.palpate", "something");
  open({.kind = Connection::Kind::kReplay}, {there, "/gone/before.dsa"});
  EXPECT_FALSE(canConnect());
  EXPECT_EQ(text("connectProblem"), "Choose a recording.");
  type("recording", there);
  EXPECT_TRUE(canConnect());
  EXPECT_TRUE(text("recordingState").startsWith("there.palpate"));
  QTest::keyClicks(find<QComboBox>("recording")->lineEdit(), "x");
  EXPECT_FALSE(canConnect());
  EXPECT_EQ(text("recordingState"), "This file doesn't exist.");
  type("recording", QString::fromStdString(folder_.path().string()));
  EXPECT_TRUE(text("recordingState").contains("folder"));
  type("recording", file("empty.dsa", ""));
  EXPECT_FALSE(canConnect());
  EXPECT_EQ(text("recordingState"), "This file is empty.");
}

TEST_F(ConnectDialogTest, TheLastRecordingsAreChoices) {
  const QString there = file("there.palpate", "something");
  open({.kind = Connection::Kind::kReplay}, {"/gone/before.dsa", there});
  auto* box = find<QComboBox>("recording");
  ASSERT_EQ(box->count(), 2);
  EXPECT_TRUE(box->itemData(0, TwoLineDelegate::kDetailRole).toString().endsWith("missing"));
  box->setCurrentIndex(1);
  EXPECT_EQ(dialog_->connection().recording, there);
  EXPECT_TRUE(canConnect());
  const QString other = file("other.dsa", "x");
  ask_.files = {other};
  press(Qt::Key_W, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return dialog_->connection().recording == other; }));
}

TEST_F(ConnectDialogTest, BeginsWithTheLastAndKeepsTheOtherKinds) {
  for (const Connection::Kind kind : kAllConnectionKinds) {
    const Connection last = {.kind = kind,
                             .dsaPort = "tcp:a:1",
                             .sdhPort = "tcp:b:2",
                             .scene = "pen",
                             .sceneScriptRuns = true,
                             .recording = "/somewhere/a.dsa",
                             .stream = {.source = "udp:0.0.0.0:9000",
                                        .hand = "sole",
                                        .format = StreamFormat::kLines,
                                        .time = StreamTime::kMicroseconds,
                                        .baud = 921'600}};
    EXPECT_EQ(open(last).connection(), last);
  }
}

}  // namespace
}  // namespace palpate::gui::connect_dialog_test
