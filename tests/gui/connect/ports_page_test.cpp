// The page of the ports in the Connect dialog: what is shown, what is filled in, what is asked.
#include "gui/connect/ports_page.h"

#include <QProgressBar>
#include <vector>

#include "gui/connect/connect_fixture.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui::ports_page_test {
namespace {

class PortsPageTest : public ConnectDialogTest {};

TEST_F(PortsPageTest, FillsInWhatAnswers) {
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

TEST_F(PortsPageTest, EveryChoiceSaysWhatIsThere) {
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

TEST_F(PortsPageTest, ShowsThatPortsAreAsked) {
  plugIn();
  fake_.hang(kTactile);
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(await([&] { return text("motionAnswer").startsWith("Motion"); }));
  EXPECT_EQ(text("tactileAnswer"), "Checking…");
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

TEST_F(PortsPageTest, SwappedPortsAreSaidAndSwapped) {
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

TEST_F(PortsPageTest, OnePortThatIsTheOthersIsSaid) {
  plugIn();
  fake_.answer(kTactile, answering(PortAnswer::kNothing, "nothing answers"));
  openPorts(kMotionLink, kTactileLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_TRUE(text("swapText").startsWith("The motion controller is on the port"))
      << text("swapText").toStdString();
  press(Qt::Key_S, Qt::AltModifier);
  EXPECT_TRUE(await([&] { return port("motionPort") == kMotionLink; }));
  EXPECT_EQ(port("tactilePort"), kTactileLink);
}

TEST_F(PortsPageTest, WhatTheUserChoseStays) {
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
  EXPECT_EQ(text("motionAnswer"),
            "None: pressure is shown and recorded, but the hand can't be moved.");
  EXPECT_TRUE(canConnect()) << "one controller is enough";
}

// A box writes its item's text again when anything of the item changes.
TEST_F(PortsPageTest, AnAnswerDoesNotDisturbTyping) {
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

TEST_F(PortsPageTest, ATypedPortIsAskedWhenItIsWhole) {
  plugIn();
  fake_.answer("tcp:localhost:4711", tactileAnswer());
  openPorts();
  ASSERT_TRUE(awaitAnswers());
  type("tactilePort", " tcp:localhost:4711 ");
  EXPECT_EQ(text("tactileAnswer"), "Not checked yet.");
  press(Qt::Key_Tab);
  ASSERT_TRUE(await([&] { return text("tactileAnswer").startsWith("Tactile"); }));
  EXPECT_EQ(fake_.asked().back(), "tcp:localhost:4711");
  EXPECT_EQ(fake_.asked().size(), 3u);
  EXPECT_EQ(dialog_->connection().dsaPort, "tcp:localhost:4711");
}

TEST_F(PortsPageTest, TwoHandsAreNotGuessed) {
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

TEST_F(PortsPageTest, APortOfLastTimeThatIsGoneIsReplaced) {
  plugIn();
  openPorts("/dev/palpate-gone", kMotion);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), kTactileLink);
  EXPECT_EQ(port("motionPort"), kMotion) << "another name of the same, kept";
  EXPECT_TRUE(text("motionAnswer").startsWith("Motion controller"));
}

TEST_F(PortsPageTest, LooksAgain) {
  openPorts();
  ASSERT_TRUE(await([&] { return find<QLabel>("portsHelp")->isVisible(); }));
  const QString help = text("portsHelp");
  for (const char* advice : {"No serial port was found", "Plug in", "dialout", "emulated hand"})
    EXPECT_TRUE(help.contains(advice)) << help.toStdString();
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("Choose the port"));
  plugIn();
  press(Qt::Key_A, Qt::AltModifier);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(port("tactilePort"), kTactileLink);
  EXPECT_FALSE(find<QLabel>("portsHelp")->isVisible());
  EXPECT_TRUE(text("connectProblem").isEmpty());
  EXPECT_TRUE(canConnect());
}

TEST_F(PortsPageTest, TwoNamesOfOnePortAreOnePort) {
  plugIn();
  openPorts(kTactile, kTactileLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("same port"));
}

TEST_F(PortsPageTest, AFileIsNotConnectedTo) {
  plugIn();
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(awaitAnswers());
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "notes.txt", "no port");
  type("motionPort", (folder / "notes.txt").c_str());
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(text("connectProblem").contains("is a file, not a port"));
  // A port that is plugged in later can be waited for.
  type("motionPort", (folder / "none").c_str());
  EXPECT_TRUE(canConnect()) << text("connectProblem").toStdString();
}

TEST_F(PortsPageTest, ASilentPortIsSaidButMayBeTried) {
  plugIn();
  fake_.answer(kTactile, answering(PortAnswer::kNothing, "nothing answers; is the hand on?"));
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(text("tactileAnswer"), "Nothing answers; is the hand on?");
  EXPECT_TRUE(canConnect());
}

TEST_F(PortsPageTest, OurOwnPortIsNotAsked) {
  plugIn();
  scan_->setBusy({kTactileLink});
  openPorts(kTactileLink, kMotionLink);
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(fake_.asked(), std::vector<std::string>{kMotion});
  EXPECT_EQ(text("tactileAnswer"), "This window is connected to it");
  EXPECT_TRUE(canConnect());
}

// L-M15: a port that was typed is in no list; it said "Asking…" for ever.
TEST_F(PortsPageTest, OurOwnTypedPortsAreSaidAndNotAsked) {
  plugIn();
  scan_->setBusy({"tcp:hand:4001", "tcp:hand:4002"});
  openPorts("tcp:hand:4001", "tcp:hand:4002");
  ASSERT_TRUE(awaitAnswers());
  EXPECT_EQ(text("tactileAnswer"), "This window is connected to it");
  EXPECT_EQ(text("motionAnswer"), "This window is connected to it");
  EXPECT_EQ(fake_.asked().size(), 2u) << "only those that are listed";
  EXPECT_TRUE(canConnect());
}

// L-M15: what our own connection has found out is known.
TEST_F(PortsPageTest, SwappedPortsOfOurOwnConnectionAreSaidAndSwapped) {
  plugIn();
  scan_->setBusy({"tcp:hand:4001", "tcp:hand:4002"},
                 {{"tcp:hand:4001", motionAnswer()}, {"tcp:hand:4002", tactileAnswer()}});
  openPorts("tcp:hand:4001", "tcp:hand:4002");
  ASSERT_TRUE(awaitAnswers());
  ASSERT_TRUE(find<QWidget>("swapRow")->isVisible());
  click("swapPorts");
  EXPECT_EQ(port("tactilePort"), "tcp:hand:4002");
  EXPECT_EQ(port("motionPort"), "tcp:hand:4001");
}

}  // namespace
}  // namespace palpate::gui::ports_page_test
