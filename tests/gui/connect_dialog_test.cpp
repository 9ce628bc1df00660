// The Connect dialog over made-up ports: what is shown, what is filled in, what the keys do.
#include "gui/connect_dialog.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QTest>
#include <functional>
#include <memory>
#include <stdexcept>

#include "fake_ports.h"
#include "gui/replay_page.h"
#include "gui/scene_page.h"
#include "gui/two_line_delegate.h"
#include "testing/testing.h"

namespace palpate::gui {
namespace {

constexpr int kPatienceMs = 10'000;
constexpr const char* kTactileLink = "/dev/serial/by-id/usb-FTDI_tactile-if00";
constexpr const char* kMotionLink = "/dev/serial/by-id/usb-FTDI_motion-if00";
constexpr const char* kTactile = "/dev/palpate-test-1";
constexpr const char* kMotion = "/dev/palpate-test-0";

class ConnectDialogTest : public ::testing::Test {
 protected:
  ConnectDialogTest() : scan_(std::make_unique<PortScan>(fake_.functions())) {}
  ~ConnectDialogTest() override {
    dialog_.reset();
    scan_.reset();
  }

  void plugIn() {
    fake_.list({usbPort(kMotion, kMotionLink), usbPort(kTactile, kTactileLink)});
    fake_.answer(kTactile, tactileAnswer());
    fake_.answer(kMotion, motionAnswer());
  }
  ConnectDialog& open(const Connection& last, const QStringList& recent = {}) {
    dialog_.reset();
    dialog_ = std::make_unique<ConnectDialog>(ConnectChoices{.last = last,
                                                             .scenesFolder = scenesFolder_,
                                                             .recentRecordings = recent,
                                                             .theme = Theme::kDark},
                                              *scan_,
                                              nullptr);
    dialog_->show();
    QApplication::setActiveWindow(dialog_.get());  // without a window manager nobody else does
    return *dialog_;
  }
  ConnectDialog& openPorts(const QString& tactile = {}, const QString& motion = {}) {
    open({.kind = Connection::Kind::kPorts, .dsaPort = tactile, .sdhPort = motion});
    return *dialog_;
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = dialog_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  QString port(const char* name) { return find<QComboBox>(name)->currentText(); }
  QString text(const char* name) { return find<QLabel>(name)->text(); }
  bool canConnect() { return find<QPushButton>("connectNow")->isEnabled(); }
  void click(const char* name) { QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton); }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus ? focus : dialog_.get(), key, modifiers);
  }
  void type(const char* box, const QString& text) {
    QLineEdit* line = find<QComboBox>(box)->lineEdit();
    line->setFocus();
    line->selectAll();
    QTest::keyClick(line, Qt::Key_Delete);
    QTest::keyClicks(line, text);
  }
  // Also what a button's key does: the button is shown pressed for a moment first.
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, kPatienceMs);
  }
  bool awaitAnswers() {
    return await([this] { return !fake_.asked().empty() && !scan_->running(); });
  }
  QString file(const char* name, std::string_view content) {
    testing::writeFile(folder_ / name, content);
    return QString::fromStdString((folder_ / name).string());
  }

  const testing::TemporaryFolder folder_;
  std::filesystem::path scenesFolder_ = testing::dataFolder() / "scenes";
  FakePorts fake_;
  std::unique_ptr<PortScan> scan_;
  std::unique_ptr<ConnectDialog> dialog_;
};

TEST_F(ConnectDialogTest, FillsInWhatAnswers) {
  plugIn();
  openPorts();
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), kTactileLink) << "under the name that stays";
  EXPECT_EQ(port("motionPort"), kMotionLink);
  EXPECT_EQ(text("tactileAnswer"), "Tactile controller, firmware 268, serial 1D9B0057");
  EXPECT_EQ(text("motionAnswer"), "Motion controller, firmware 0.0.3.3, serial 48");
  EXPECT_FALSE(find<QWidget>("swapRow")->isVisible());
  EXPECT_TRUE(canConnect());
  const Connection chosen = dialog_->connection();
  EXPECT_EQ(chosen.kind, Connection::Kind::kPorts);
  EXPECT_EQ(chosen.dsaPort, kTactileLink);
  EXPECT_EQ(chosen.sdhPort, kMotionLink);
  EXPECT_EQ(text("connectIsCalm"), "Connecting never moves the hand.");
}

TEST_F(ConnectDialogTest, EveryChoiceSaysWhatIsThere) {
  plugIn();
  openPorts();
  ASSERT_TRUE(awaitAnswers());
  auto* box = find<QComboBox>("tactilePort");
  ASSERT_EQ(box->count(), 2);
  const QString detail = box->itemData(0, TwoLineDelegate::kDetailRole).toString();
  EXPECT_TRUE(detail.contains("palpate-test-0")) << detail.toStdString();
  EXPECT_TRUE(detail.contains("FT232R USB UART"));
  EXPECT_TRUE(detail.contains("motion controller"));
}

TEST_F(ConnectDialogTest, ShowsThatPortsAreAsked) {
  plugIn();
  fake_.hang(kTactile);
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(await([&] { return text("motionAnswer").startsWith("Motion"); }));
  EXPECT_EQ(text("tactileAnswer"), "Asking…");
  EXPECT_TRUE(find<QProgressBar>("portsProgress")->isVisible());
  EXPECT_EQ(find<QProgressBar>("portsProgress")->value(), 1);
  EXPECT_EQ(find<QProgressBar>("portsProgress")->maximum(), 2);
  EXPECT_FALSE(find<QPushButton>("lookAgain")->isEnabled());
  EXPECT_TRUE(canConnect()) << "who knows his ports need not wait";
  fake_.release(kTactile);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_FALSE(find<QProgressBar>("portsProgress")->isVisible());
  EXPECT_TRUE(find<QPushButton>("lookAgain")->isEnabled());
}

TEST_F(ConnectDialogTest, SwappedPortsAreSaidAndSwapped) {
  plugIn();
  openPorts(kMotionLink, kTactileLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_TRUE(find<QWidget>("swapRow")->isVisible());
  EXPECT_TRUE(text("swapText").contains("swapped")) << text("swapText").toStdString();
  click("swapPorts");
  EXPECT_EQ(port("tactilePort"), kTactileLink);
  EXPECT_EQ(port("motionPort"), kMotionLink);
  EXPECT_FALSE(find<QWidget>("swapRow")->isVisible());
  EXPECT_EQ(fake_.asked().size(), 2u) << "what is known isn't asked again";
}

TEST_F(ConnectDialogTest, OnePortThatIsTheOthersIsSaid) {
  plugIn();
  fake_.answer(kTactile, answering(PortAnswer::kNothing, "nothing answers"));
  openPorts(kMotionLink, kTactileLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_TRUE(text("swapText").startsWith("The motion controller answers"))
      << text("swapText").toStdString();
  press(Qt::Key_S, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return port("motionPort") == kMotionLink; }));
  EXPECT_EQ(port("tactilePort"), kTactileLink);
}

TEST_F(ConnectDialogTest, WhatTheUserChoseStays) {
  plugIn();
  fake_.hang(kTactile);
  openPorts();
  type("tactilePort", "tcp:localhost:4711");
  fake_.release(kTactile);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), "tcp:localhost:4711");
  EXPECT_EQ(port("motionPort"), kMotionLink);
  // An emptied field stays empty, too.
  type("motionPort", "");
  click("lookAgain");
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("motionPort"), "");
  EXPECT_EQ(text("motionAnswer"), "None: pressure is shown and recorded, the hand isn't moved.");
  EXPECT_TRUE(canConnect()) << "one controller is enough";
}

// A box writes its item's text again when anything of the item changes.
TEST_F(ConnectDialogTest, AnAnswerDoesNotDisturbTyping) {
  plugIn();
  fake_.hang(kMotion);
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(await([&] { return text("tactileAnswer").startsWith("Tactile"); }));
  type("motionPort", "tcp:loc");
  fake_.release(kMotion);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("motionPort"), "tcp:loc");
  QTest::keyClicks(find<QComboBox>("motionPort")->lineEdit(), "alhost:1");
  EXPECT_EQ(port("motionPort"), "tcp:localhost:1");
}

TEST_F(ConnectDialogTest, ATypedPortIsAskedWhenItIsWhole) {
  plugIn();
  fake_.answer("tcp:localhost:4711", tactileAnswer());
  openPorts();
  ASSERT_TRUE(awaitAnswers());
  type("tactilePort", " tcp:localhost:4711 ");
  EXPECT_EQ(text("tactileAnswer"), "Not asked yet.");
  press(Qt::Key_Tab);
  ASSERT_TRUE(await([&] { return text("tactileAnswer").startsWith("Tactile"); }));
  EXPECT_EQ(fake_.asked().back(), "tcp:localhost:4711");
  EXPECT_EQ(fake_.asked().size(), 3u);
  EXPECT_EQ(dialog_->connection().dsaPort, "tcp:localhost:4711");
}

TEST_F(ConnectDialogTest, TwoHandsAreNotGuessed) {
  plugIn();
  fake_.list({usbPort(kMotion, kMotionLink), usbPort(kTactile), usbPort("third")});
  fake_.answer("third", tactileAnswer());
  openPorts();
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("motionPort"), kMotionLink);
  // The first to answer may have been filled in before the second one did.
  EXPECT_TRUE(port("tactilePort").isEmpty()) << port("tactilePort").toStdString();
  EXPECT_TRUE(text("portsHelp").contains("2 tactile controllers"));
}

TEST_F(ConnectDialogTest, APortOfLastTimeThatIsGoneIsReplaced) {
  plugIn();
  openPorts("/dev/palpate-gone", kMotion);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), kTactileLink);
  EXPECT_EQ(port("motionPort"), kMotion) << "another name of the same, kept";
  EXPECT_TRUE(text("motionAnswer").startsWith("Motion controller"));
}

TEST_F(ConnectDialogTest, LooksAgain) {
  openPorts();
  ASSERT_TRUE(await([&] { return find<QLabel>("portsHelp")->isVisible(); }));
  const QString help = text("portsHelp");
  for (const char* advice : {"No serial port was found", "Plug in", "dialout", "emulated hand"})
    EXPECT_TRUE(help.contains(advice)) << help.toStdString();
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("Choose the port"));
  plugIn();
  press(Qt::Key_L, Qt::AltModifier);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), kTactileLink);
  EXPECT_FALSE(find<QLabel>("portsHelp")->isVisible());
  EXPECT_TRUE(text("connectProblem").isEmpty());
  EXPECT_TRUE(canConnect());
}

TEST_F(ConnectDialogTest, TwoNamesOfOnePortAreOnePort) {
  plugIn();
  openPorts(kTactile, kTactileLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("same port"));
}

TEST_F(ConnectDialogTest, ASilentPortIsSaidButMayBeTried) {
  plugIn();
  fake_.answer(kTactile, answering(PortAnswer::kNothing, "nothing answers; is the hand on?"));
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(text("tactileAnswer"), "Nothing answers; is the hand on?");
  EXPECT_TRUE(canConnect());
}

TEST_F(ConnectDialogTest, OurOwnPortIsNotAsked) {
  plugIn();
  scan_->setBusy({kTactileLink});
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(fake_.asked(), std::vector<std::string>{kMotion});
  EXPECT_EQ(text("tactileAnswer"), "In use by this window");
  EXPECT_TRUE(canConnect());
}

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
    EXPECT_EQ(fake_.numOpen(), 0);
    EXPECT_FALSE(scan_->running());
  }
}

TEST_F(ConnectDialogTest, EnterConnectsFromWhereverTheKeyboardIs) {
  const std::vector<std::pair<Connection::Kind, const char*>> places = {
      {Connection::Kind::kPorts, "kindPorts"},
      {Connection::Kind::kPorts, "tactilePort"},
      {Connection::Kind::kEmulated, "scenes"},
      {Connection::Kind::kEmulated, "sceneActs"},
      {Connection::Kind::kReplay, "recording"}};
  const QString recording = file("a.dsa", "x");
  for (const auto& [kind, name] : places) {
    open({.kind = kind, .dsaPort = "a", .sdhPort = "b", .recording = recording});
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

TEST_F(ConnectDialogTest, EscapeCancels) {
  open({});
  press(Qt::Key_Escape);
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
  EXPECT_TRUE(await([&] { return dialog_->connection().sceneActs; }));
}

TEST_F(ConnectDialogTest, ASceneWithoutAScriptCannotAct) {
  testing::writeFile(folder_ / "still.json", "{}");
  testing::writeFile(folder_ / "busy.json", R"({"script": [{"at_s": 1, "grasp": {}}]})");
  scenesFolder_ = folder_.path();
  open({.scene = "still"});
  EXPECT_FALSE(find<QCheckBox>("sceneActs")->isEnabled());
  find<QListWidget>("scenes")->setCurrentRow(0);
  EXPECT_EQ(dialog_->connection().scene, "busy");
  EXPECT_TRUE(find<QCheckBox>("sceneActs")->isEnabled());
}

TEST_F(ConnectDialogTest, ABrokenSceneSaysWhatIsWrong) {
  testing::writeFile(folder_ / "broken.json", R"({"objects": 3})");
  testing::writeFile(folder_ / "good.json", R"({"description": "Fine"})");
  scenesFolder_ = folder_.path();
  open({.scene = "broken"});
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("objects is no JSON array"))
      << text("connectProblem").toStdString();
  find<QListWidget>("scenes")->setCurrentRow(1);
  EXPECT_EQ(dialog_->connection().scene, "good");
  EXPECT_TRUE(canConnect());
}

TEST_F(ConnectDialogTest, ASceneOfOnesOwn) {
  const QString mine = file("mine.json", R"({"description": "My own"})");
  open({.scene = mine, .sceneActs = true});
  EXPECT_EQ(dialog_->connection().scene, mine);
  EXPECT_TRUE(dialog_->connection().sceneActs);
  const QString other = file("other.json", "{}");
  dialog_->findChild<ScenePage*>()->askForScene = [&] { return other; };
  click("otherScene");
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
  EXPECT_EQ(text("recordingState"), "There is no such file.");
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
  dialog_->findChild<ReplayPage*>()->askForRecording = [&] { return other; };
  press(Qt::Key_W, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return dialog_->connection().recording == other; }));
}

TEST_F(ConnectDialogTest, BeginsWithTheLastAndKeepsTheOtherKinds) {
  for (const Connection::Kind kind : kAllConnectionKinds) {
    const Connection last = {.kind = kind,
                             .dsaPort = "tcp:a:1",
                             .sdhPort = "tcp:b:2",
                             .scene = "pen",
                             .sceneActs = true,
                             .recording = "/somewhere/a.dsa"};
    EXPECT_EQ(open(last).connection(), last);
  }
}

}  // namespace
}  // namespace palpate::gui
