// The window and other programs on this machine: nothing is open until it is asked for, and what is
// acknowledged is so.
#include "gui/link/other_programs.h"

#include <QLabel>
#include <QPlainTextEdit>
#include <QSignalSpy>
#include <chrono>
#include <future>

#include <palpate/core/json.h>
#include <palpate/interop/foxglove_server.h>
#include <palpate/interop/remote_client.h>
#include <palpate/recording/recording.h>

#include "gui/testing/window_fixture.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/status_strip.h"
#include "interop/listening_sockets.h"
#include "interop/udp_receiver.h"
#include "interop/web_socket_client.h"

namespace palpate::gui::other_programs_test {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

class OtherProgramsTest : public WindowTest {
 protected:
  OtherProgramsTest() {
    fs::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
    set("recording/folder", QString::fromStdString((folder_ / "runs").string()));
    set("recording/template", "take_{run}");
    set("recording/operator", "Ada");
    set("recording/ask", false);
  }
  void set(const char* key, const QVariant& value) {
    QSettings(settingsFile(), QSettings::IniFormat).setValue(key, value);
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  void connectEmulated() {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = "ball";
    window().state().connectTo(connection);
    ASSERT_TRUE(await([&] { return !live().stale() && window().state().displayed.isLive(); }));
  }
  LiveController& live() { return window().state().live; }
  std::string socket() const { return folder_ / "s"; }
  void switchRemoteOn() {
    actions().at("remoteControl")->setData(QString::fromStdString(socket()));
    actions().at("remoteControl")->trigger();
    ASSERT_TRUE(actions().at("remoteControl")->isChecked());
  }
  // From another thread, as another program would.
  std::future<std::string> asking(const std::string& request) {
    return std::async(std::launch::async, [path = socket(), request] {
      return RemoteClient(path).ask(request, 20'000ms);
    });
  }
  Json ask(const std::string& request) {
    auto answer = asking(request);
    if (!await([&] { return answer.wait_for(0s) == std::future_status::ready; })) return {};
    return Json::parse(answer.get());
  }
  std::string error(const std::string& request) { return ask(request).at("error").asString(); }
  const std::vector<Fact>& facts() { return find<FactsView>("otherPrograms")->facts(); }
};

TEST_F(OtherProgramsTest, NothingIsOpenByItself) {
  connectEmulated();
  EXPECT_EQ(testing::listeningSocketsOf(::getpid()), std::vector<std::string>());
  for (const StreamKind kind : kAllStreamKinds) EXPECT_FALSE(live().source()->stream->on(kind));
  EXPECT_TRUE(facts().empty());
  EXPECT_FALSE(find<FactsView>("otherPrograms")->isVisibleTo(&window()));
  EXPECT_EQ(OtherPrograms::shortText(actions()), "");
}

TEST_F(OtherProgramsTest, SignalsAreStreamedAsLongAsTheSwitchSays) {
  testing::UdpReceiver receiver;
  set("streams/signals_port", receiver.port());
  start();
  actions().at("streamSignals")->trigger();  // before there is a hand
  ASSERT_EQ(facts().size(), 1u);
  EXPECT_TRUE(facts()[0].value.endsWith("nothing is connected"));
  connectEmulated();
  bool found = false;
  for (int i = 0; i < 20 && !found; ++i) {
    const auto text = receiver.receive();
    ASSERT_TRUE(text);
    found = Json::parse(*text).at("m5").isObject();
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(await([&] { return facts().size() == 1 && facts()[0].value.endsWith(" sent"); }));
  EXPECT_TRUE(await(
      [&] { return find<StatusStrip>("statusStrip")->status().right.startsWith("streaming · "); }));
  receiver.close();
  EXPECT_TRUE(await([&] { return facts()[0].value.endsWith("no receiver"); }));
  actions().at("streamSignals")->trigger();
  EXPECT_FALSE(live().source()->stream->on(StreamKind::kSignals));
  EXPECT_TRUE(facts().empty());
}

TEST_F(OtherProgramsTest, TaxelsAreStreamed) {
  testing::UdpReceiver receiver;
  set("streams/tactile_port", receiver.port());
  start();
  connectEmulated();
  actions().at("streamTactile")->trigger();
  std::size_t matrices = 0;
  while (matrices < 6) {
    const auto text = receiver.receive();
    ASSERT_TRUE(text);
    EXPECT_LE(text->size(), 1400u);
    matrices += Json::parse(*text).at("tactile_matrix").size();
  }
}

// A port that was free a moment ago.
std::uint16_t freeTcpPort() {
  FoxgloveServerOptions options;
  options.port = 0;
  return FoxgloveServer(options, {}).port();
}

TEST_F(OtherProgramsTest, FoxgloveReadsTheHandAsLongAsTheSwitchSays) {
  const std::uint16_t port = freeTcpPort();
  set("streams/foxglove_port", port);
  start();
  actions().at("streamFoxglove")->trigger();  // before there is a hand
  ASSERT_EQ(facts().size(), 1u);
  EXPECT_TRUE(facts()[0].value.endsWith("nothing is connected"));
  EXPECT_EQ(OtherPrograms::shortText(actions()), "streaming");
  connectEmulated();
  ASSERT_TRUE(await([&] { return live().source()->stream->foxgloveStats().has_value(); }));
  testing::WebSocketClient client(port);
  ASSERT_TRUE(client.join());
  EXPECT_EQ(Json::parse(client.frame().value().payload).at("op").asString(), "serverInfo");
  EXPECT_TRUE(await([&] { return facts().size() == 1 && facts()[0].value.endsWith("1 client"); }));
  actions().at("streamFoxglove")->trigger();
  EXPECT_FALSE(live().source()->stream->foxgloveStats());
  EXPECT_TRUE(client.awaitEnd());
  EXPECT_TRUE(facts().empty());
}

TEST_F(OtherProgramsTest, APortThatIsTakenSwitchesFoxgloveOff) {
  FoxgloveServerOptions taken;
  taken.port = 0;
  const FoxgloveServer other(taken, {});
  set("streams/foxglove_port", other.port());
  start();
  connectEmulated();
  actions().at("streamFoxglove")->trigger();
  EXPECT_FALSE(actions().at("streamFoxglove")->isChecked());
  EXPECT_FALSE(live().source()->stream->foxgloveStats());
}

TEST_F(OtherProgramsTest, WebPagesThatAreRefusedByTurnsAreLoggedOnceEach) {
  const std::uint16_t port = freeTcpPort();
  set("streams/foxglove_port", port);
  start();
  connectEmulated();
  actions().at("streamFoxglove")->trigger();
  for (int i = 0; i < 3; ++i)
    for (const std::string page : {"https://one.example", "https://two.example"}) {
      testing::WebSocketClient client(port);
      EXPECT_NE(client
                    .handshake(testing::WebSocketClient::request("foxglove.sdk.v1",
                                                                 "Origin: " + page + "\r\n"))
                    .find(" 403 "),
                std::string::npos);
      QSignalSpy refreshed(&live(), &LiveController::refreshed);
      ASSERT_TRUE(await([&] { return refreshed.size() > 1; }));
    }
  const QString log = find<QPlainTextEdit>("linkLog")->toPlainText();
  EXPECT_EQ(log.count("may not read the hand"), 2) << log.toStdString();
  EXPECT_TRUE(log.contains("https://one.example") && log.contains("https://two.example"));
}

TEST_F(OtherProgramsTest, StreamsAreRememberedRemoteControlIsNot) {
  actions().at("streamSignals")->trigger();
  switchRemoteOn();
  EXPECT_EQ(OtherPrograms::shortText(actions()), "streaming, remote control");
  start();
  EXPECT_TRUE(actions().at("streamSignals")->isChecked());
  EXPECT_FALSE(actions().at("streamTactile")->isChecked());
  EXPECT_FALSE(actions().at("remoteControl")->isChecked());
  EXPECT_FALSE(fs::exists(socket()));
}

TEST_F(OtherProgramsTest, APortThatIsNoneIsReplacedByTheUsualOne) {
  set("streams/signals_port", "70000");
  start();
  actions().at("streamSignals")->trigger();
  EXPECT_TRUE(facts().at(0).value.startsWith("127.0.0.1:9870"));
}

TEST_F(OtherProgramsTest, ASocketThatCantBeMadeIsSaid) {
  testing::writeFile(socket(), "precious");
  actions().at("remoteControl")->setData(QString::fromStdString(socket()));
  actions().at("remoteControl")->trigger();
  EXPECT_FALSE(actions().at("remoteControl")->isChecked());
  EXPECT_TRUE(bannerText().contains("No remote control")) << bannerText().toStdString();
  EXPECT_EQ(testing::readFile(socket()), "precious");
}

TEST_F(OtherProgramsTest, ARecordingFromOutsideIsTheWindowsOwn) {
  switchRemoteOn();
  EXPECT_EQ(error("start a"), "no_hand");
  EXPECT_EQ(ask("status").at("state").asString(), "idle");
  EXPECT_TRUE(ask("status").at("hand").isNull());
  connectEmulated();
  ASSERT_TRUE(await([&] { return live().source()->control->status().cannotMove.empty(); }));
  const Json ready = ask("status");
  EXPECT_EQ(ready.at("hand").asString(), "ready");
  EXPECT_EQ(ready.at("hand_text").asString(), "a motion can begin");
  ask("set object foam ball");
  const Json started = ask("start run 7");
  ASSERT_TRUE(started.at("ok").asBool()) << started.text();
  const fs::path path = folder_ / "runs/run 7.palpate";
  EXPECT_EQ(started.at("file").asString(), path.string());
  EXPECT_GE(openRecording(path).numFrames(), 1u);  // on disk, as it was said
  EXPECT_TRUE(live().recording());
  EXPECT_EQ(error("start b"), "already_recording");
  const Json label = ask("label contact");
  ASSERT_TRUE(label.at("ok").asBool()) << label.text();
  const Json status = ask("status");
  EXPECT_EQ(status.at("state").asString(), "recording");
  EXPECT_EQ(status.at("next_file").asString(), "take_001.palpate");
  EXPECT_EQ(status.at("folder").asString(), (folder_ / "runs").string());
  const Json stopped = ask("stop");
  ASSERT_TRUE(stopped.at("ok").asBool()) << stopped.text();
  EXPECT_FALSE(live().recording());
  const Profile profile = openRecording(path);
  EXPECT_EQ(stopped.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  auto meta = readRecordingMeta(path);
  EXPECT_TRUE(meta.contains("emulated")) << "a recording of the emulated hand says so";
  EXPECT_EQ(meta["operator"], "Ada");
  EXPECT_EQ(meta["object"], "foam ball");
  int labels = 0;
  for (const Event& event : readEvents(path).events)
    labels += event.kind == "label" && event.text == "contact" ? 1 : 0;
  EXPECT_EQ(labels, 1);
  EXPECT_EQ(error("stop"), "not_recording");
  EXPECT_EQ(error("label late"), "not_recording");
}

TEST_F(OtherProgramsTest, NamesStayInTheFolder) {
  switchRemoteOn();
  connectEmulated();
  EXPECT_EQ(error("start ../x"), "file_name");
  EXPECT_EQ(error("file /tmp/{run}"), "file_name");
  EXPECT_EQ(ask("file shake_{run}").at("next_file").asString(), "shake_001.palpate");
  EXPECT_TRUE(ask("start").at("ok").asBool());
  EXPECT_TRUE(ask("stop").at("ok").asBool());
  EXPECT_TRUE(fs::exists(folder_ / "runs/shake_001.palpate"));
  EXPECT_EQ(error("start shake_001"), "file_exists");
  EXPECT_FALSE(live().recording());
}

TEST_F(OtherProgramsTest, BothMayStopWhatEitherStarted) {
  switchRemoteOn();
  connectEmulated();
  actions().at("record")->trigger();
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > 0; }));
  EXPECT_EQ(error("start b"), "already_recording");
  EXPECT_TRUE(ask("mark").at("ok").asBool());
  EXPECT_TRUE(ask("stop").at("ok").asBool());
  EXPECT_FALSE(live().recording());
  EXPECT_TRUE(ask("start").at("ok").asBool());
  actions().at("record")->trigger();
  ASSERT_TRUE(await([&] { return !live().recording(); }));
  EXPECT_EQ(error("stop"), "not_recording");
}

TEST_F(OtherProgramsTest, WhenTheHandGoesWhoeverStoppedIsAnsweredAllTheSame) {
  switchRemoteOn();
  connectEmulated();
  ASSERT_TRUE(ask("start a").at("ok").asBool());
  auto answer = asking("stop");
  live().end();
  ASSERT_TRUE(await([&] { return answer.wait_for(0s) == std::future_status::ready; }));
  const Json stopped = Json::parse(answer.get());
  EXPECT_TRUE(stopped.at("ok").asBool() || stopped.at("error").asString() == "not_recording");
  ASSERT_TRUE(await([&] { return live().state() == LiveController::State::kNone; }));
  EXPECT_EQ(verifyRecording(folder_ / "runs/a.palpate").state, VerifyReport::State::kSound);
  EXPECT_EQ(error("start b"), "no_hand");
}

// Whoever asks a window that closes is told so, and the recording is finished.
TEST_F(OtherProgramsTest, AWindowThatClosesFinishesTheRecording) {
  switchRemoteOn();
  connectEmulated();
  ASSERT_TRUE(ask("start a").at("ok").asBool());
  window().endNow();
  ASSERT_TRUE(await([&] { return !window().isVisible(); }));
  window_.reset();
  EXPECT_FALSE(fs::exists(socket()));
  EXPECT_EQ(verifyRecording(folder_ / "runs/a.palpate").state, VerifyReport::State::kSound);
}

}  // namespace
}  // namespace palpate::gui::other_programs_test
