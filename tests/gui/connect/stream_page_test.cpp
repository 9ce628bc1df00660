// The page "Stream of frames" of the Connect dialog: sources, hands, what is refused before trying.
#include "gui/connect/stream_page.h"

#include <QSpinBox>

#include "gui/connect/connect_fixture.h"
#include "gui/source/file_reading.h"
#include "gui/testing/held_readings.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui::stream_page_test {
namespace {

constexpr const char* kPad = R"({"format": "palpate-hand", "version": 1, "name": "My pad",
  "full_scale": 1023, "unit": "N",
  "matrices": [{"name": "pad", "rows": 4, "columns": 5, "pitch_mm": 5.0}]})";

enum Place { kSerial, kConnect, kListen, kUdp };

class StreamPageTest : public ConnectDialogTest {
 protected:
  void openStream(const StreamConnection& last) {
    Connection connection;
    connection.kind = Connection::Kind::kStream;
    connection.stream = last;
    open(connection);
  }
  StreamConnection chosen() { return dialog_->connection().stream; }
  void choosePlace(Place place) { find<QComboBox>("streamPlace")->setCurrentIndex(place); }
  QString problem() { return text("connectProblem"); }
  QString addFolder(const std::string& name, const std::string& json) {
    std::filesystem::create_directories(folder_ / name);
    testing::writeFile(folder_ / name / "hand.json", json);
    return QString::fromStdString((folder_ / name).string());
  }
};

TEST_F(StreamPageTest, NothingIsChosenAtFirst) {
  openStream({});
  EXPECT_EQ(problem(), "Choose where the stream comes from.");
  type("streamPort", "/dev/pts/3");
  EXPECT_EQ(problem(), "Choose the hand whose frames are sent.");
  auto* hands = find<QComboBox>("streamHand");
  hands->setCurrentIndex(hands->findText("flat_pad_16x16"));
  EXPECT_TRUE(canConnect());
  EXPECT_EQ(chosen(), (StreamConnection{.source = "/dev/pts/3", .hand = "flat_pad_16x16"}));
}

TEST_F(StreamPageTest, AHandSaysWhatItHas) {
  openStream({.source = "udp:9871", .hand = "flat_pad_16x16"});
  EXPECT_EQ(text("streamHandText"), "matrix 16x16, 256 taxels; no joints; 0 to 1023 counts");
  auto* hands = find<QComboBox>("streamHand");
  hands->setCurrentIndex(hands->findText("sdh2"));
  EXPECT_EQ(text("streamHandText"),
            "matrices 3 x 14x6, 3 x 13x6, 456 taxels; 7 joints, 9 temperatures; 0 to 4095 counts");
  EXPECT_EQ(hands->currentData(TwoLineDelegate::kDetailRole).toString(), text("streamHandText"));
}

TEST_F(StreamPageTest, HandsOfTheUsersFolderAreListed) {
  addFolder("hands/my_pad", kPad);
  handFolders_ = {folder_ / "hands"};
  openStream({.source = "udp:9871"});
  auto* hands = find<QComboBox>("streamHand");
  hands->setCurrentIndex(hands->findText("my_pad"));
  EXPECT_EQ(text("streamHandText"), "matrix 4x5, 20 taxels; no joints; 0 to 1023 N");
  EXPECT_TRUE(canConnect());
}

TEST_F(StreamPageTest, AHandSaysWhatItsReadingsAre) {
  std::string skin = kPad;
  skin.replace(skin.find("\"pitch_mm\": 5.0"), 15, "\"pitch_mm\": 5.0, \"components\": 3");
  addFolder("hands/my_skin", skin);
  handFolders_ = {folder_ / "hands"};
  openStream({.source = "udp:9871"});
  auto* hands = find<QComboBox>("streamHand");
  hands->setCurrentIndex(hands->findText("my_skin"));
  EXPECT_EQ(text("streamHandText"),
            "matrix 4x5, 20 taxels; no joints; 3 components, signed; -1023 to 1023 N");
}

TEST_F(StreamPageTest, AFolderThatCannotBeUsedSaysWhyInOneLine) {
  openStream({.source = "udp:9871", .hand = "sole"});
  std::string wrong = kPad;
  wrong.replace(wrong.find("\"rows\": 4"), 9, "\"rows\": 0");
  const QString folder = addFolder("mine", wrong);
  ask_.folders = {folder};
  click("streamHandFolder");
  FileReading::settleAll(*dialog_);
  EXPECT_EQ(chosen().hand, folder);
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(problem().contains("matrices[0].rows is 0, not in 1..256"))
      << problem().toStdString();
  EXPECT_FALSE(problem().contains('\n'));
  // The file is read anew when the folder is chosen again.
  addFolder("mine", kPad);
  click("streamHandFolder");
  FileReading::settleAll(*dialog_);
  EXPECT_TRUE(canConnect());
  EXPECT_EQ(find<QComboBox>("streamHand")->currentText(), "mine");
  // Cancelled: nothing changes.
  ask_.folders = {QString()};
  click("streamHandFolder");
  FileReading::settleAll(*dialog_);
  EXPECT_EQ(chosen().hand, folder);
  // Without a hand.json.
  ask_.folders = {QString::fromStdString(folder_.path().string())};
  click("streamHandFolder");
  FileReading::settleAll(*dialog_);
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(problem().contains("hand.json")) << problem().toStdString();
}

TEST_F(StreamPageTest, AnAnswerFromBeforeTheFolderWasChosenAgainIsDropped) {
  openStream({.source = "udp:9871", .hand = "sole"});
  auto* page = dialog_->findChild<StreamPage*>();
  const QString folder = addFolder("mine", kPad);
  ask_.folders = {folder};
  HeldReadings held(1);
  click("streamHandFolder");
  held.await(1);
  EXPECT_EQ(page->problem(), "The hand is being read.");
  EXPECT_FALSE(canConnect());
  click("streamHandFolder");
  FileReading::settleAll(*page);
  EXPECT_TRUE(canConnect());
  addFolder("mine", "{");
  held.release();
  FileReading::settleAll(*page);
  QCoreApplication::processEvents();
  EXPECT_TRUE(canConnect()) << "what the first one reads is no answer any more";
}

TEST_F(StreamPageTest, ALastHandThatIsGoneIsSaid) {
  openStream({.source = "udp:9871", .hand = "/gone/since/then"});
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(problem().startsWith("This hand can't be used: "));
}

TEST_F(StreamPageTest, EverySourceIsWrittenAsItIsRead) {
  for (const char* source : {"/dev/serial/by-id/usb-Arduino-if00",
                             "tcp:sensor.local:9871",
                             "tcp:[fe80::1]:80",
                             "listen:9871",
                             "listen:0",
                             "listen:0.0.0.0:9871",
                             "listen:[::1]:9871",
                             "udp:9871",
                             "udp:[::]:1"}) {
    openStream({.source = source, .hand = "sole"});
    EXPECT_EQ(chosen().source, source);
    EXPECT_TRUE(canConnect()) << source << ": " << problem().toStdString();
  }
}

TEST_F(StreamPageTest, SaysFromWhichMachinesCanBeSent) {
  openStream({.source = "listen:9871", .hand = "sole"});
  EXPECT_EQ(text("streamPlaceText"),
            "Listening for a sender on port 9871. Only programs of this machine can send.");
  find<QLineEdit>("streamListenAddress")->setText("0.0.0.0");
  EXPECT_TRUE(text("streamPlaceText").contains("Any machine that reaches this address can send"));
  EXPECT_TRUE(canConnect());
  find<QLineEdit>("streamListenAddress")->setText("127.0.0.1");
  EXPECT_TRUE(text("streamPlaceText").contains("Only programs of this machine"));
  // An address of version 6 needs no brackets.
  find<QLineEdit>("streamListenAddress")->setText("::");
  EXPECT_EQ(chosen().source, "listen:[::]:9871");
  EXPECT_TRUE(text("streamPlaceText").contains("Any machine"));
  choosePlace(kUdp);
  EXPECT_EQ(chosen().source, "udp:9871");
  EXPECT_TRUE(text("streamPlaceText").startsWith("Listening for datagrams on port 9871."));
}

TEST_F(StreamPageTest, RefusesWhatMakesNoSenseBeforeTrying) {
  openStream({.source = "listen:9871", .hand = "sole"});
  find<QLineEdit>("streamListenAddress")->setText("my-machine");
  EXPECT_FALSE(canConnect());
  EXPECT_TRUE(problem().contains("ADDRESS is numeric")) << problem().toStdString();
  choosePlace(kConnect);
  EXPECT_EQ(problem(), "Choose where the stream comes from.");
  choosePlace(kSerial);
  type("streamPort", "-");
  EXPECT_TRUE(problem().contains("tandard input")) << problem().toStdString();
  type("streamPort", "udp:9871");
  EXPECT_EQ(problem(), "This is a network name: choose TCP or UDP as source.");
  type("streamPort", "/dev/ttyACM0");
  EXPECT_TRUE(canConnect());
  find<QComboBox>("streamBaud")->setEditText("20");
  EXPECT_EQ(problem(), "The baud rate must be between 50 and 10000000.");
  find<QComboBox>("streamBaud")->setEditText("250000");
  EXPECT_EQ(chosen().baud, 250'000);
  EXPECT_TRUE(canConnect());
}

TEST_F(StreamPageTest, AUnitOfTimeIsForLinesAndABaudRateForPorts) {
  openStream({.source = "/dev/ttyACM0", .hand = "sole", .time = StreamTime::kMilliseconds});
  auto* format = find<QComboBox>("streamFormat");
  auto* time = find<QComboBox>("streamTime");
  EXPECT_TRUE(time->isEnabled());
  EXPECT_TRUE(find<QWidget>("streamBaud")->isVisible());
  format->setCurrentIndex(format->findText("packets"));
  EXPECT_EQ(chosen().format, StreamFormat::kBinary);
  EXPECT_FALSE(time->isEnabled());
  EXPECT_EQ(chosen().time, StreamTime::kAuto);
  format->setCurrentIndex(format->findText("lines of numbers"));
  EXPECT_EQ(chosen().time, StreamTime::kMilliseconds);
  for (const Place place : {kConnect, kListen, kUdp}) {
    choosePlace(place);
    EXPECT_FALSE(find<QWidget>("streamBaud")->isVisible()) << place;
  }
}

// A request for the hand's firmware may disturb another device.
TEST_F(StreamPageTest, PortsAreListedButNotAsked) {
  plugIn();
  openStream({});
  auto* ports = find<QComboBox>("streamPort");
  ASSERT_TRUE(await([&] { return ports->count() == 2; }));
  EXPECT_TRUE(fake_.asked().empty());
  ports->setCurrentIndex(1);
  EXPECT_EQ(chosen().source, kTactileLink);
  EXPECT_TRUE(
      ports->itemData(1, TwoLineDelegate::kDetailRole).toString().startsWith("FT232R USB UART"));
  EXPECT_FALSE(scan_->running());
}

}  // namespace
}  // namespace palpate::gui::stream_page_test
