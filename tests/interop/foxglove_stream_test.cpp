// Foxglove as LiveStream serves it.
#include <set>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/interop/live_stream.h"
#include "palpate/model/hand_file.h"

#include "interop/listening_sockets.h"
#include "interop/sample_results.h"
#include "interop/web_socket_client.h"
#include "testing/testing.h"

namespace palpate::foxglove_stream_test {
namespace {
using testing::sampleResults;
using testing::WebSocketClient;

FoxgloveOptions anyPort() {
  FoxgloveOptions options;
  options.server.port = 0;
  return options;
}

std::uint16_t portOf(const LiveStream& stream) {
  const std::string url = stream.foxgloveUrl();
  return static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
}

std::int64_t channelOf(const Json& channels, const std::string& topic) {
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels.at(i).at("topic").asString() == topic) return channels.at(i).at("id").asInteger();
  return -1;
}

// Subscribes and waits until the server has done so.
void subscribe(WebSocketClient& client, const std::vector<std::string>& topics) {
  client.frame();  // serverInfo
  const Json channels = Json::parse(client.frame().value().payload).at("channels");
  Json list = Json::array();
  for (std::size_t i = 0; i < topics.size(); ++i)
    list.push(Json::object().set("id", i).set("channelId", channelOf(channels, topics[i])));
  client.say(Json::object().set("op", "subscribe").set("subscriptions", list).text(-1));
  client.say("{}");
  while (client.frame().value().opcode != 1) {
  }
}

TEST(FoxgloveStream, IsOffUntilItIsSwitchedOn) {
  LiveStream stream(sdh2());
  EXPECT_FALSE(stream.foxgloveStats());
  EXPECT_EQ(stream.foxgloveUrl(), "");
  stream.send(sampleResults());
  EXPECT_EQ(testing::listeningSocketsOf(::getpid()), std::vector<std::string>());
  stream.switchOn(anyPort());
  EXPECT_TRUE(stream.foxgloveStats());
  EXPECT_EQ(testing::listeningSocketsOf(::getpid()).size(), 1u);
  stream.switchOffFoxglove();
  EXPECT_EQ(testing::listeningSocketsOf(::getpid()), std::vector<std::string>());
}

TEST(FoxgloveStream, SendsWhatAFrameHolds) {
  int asked = 0;
  LiveStream stream(sdh2(), [&asked] {
    ++asked;
    return LinkHealth();
  });
  stream.switchOn(anyPort());
  WebSocketClient client(portOf(stream));
  ASSERT_TRUE(client.join());
  const std::vector<std::string> topics = {
      "/signals", "/tactile/finger_0_distal/image", "/joint_states", "/tf", "/hand/taxels"};
  subscribe(client, topics);
  LiveResults results = sampleResults();
  results.angles = Sample{results.frame->hostUs, std::vector<double>(7, 0.0)};
  stream.send(results);
  std::set<std::size_t> seen;
  while (seen.size() < topics.size()) {
    const std::string payload = client.frame().value().payload;
    EXPECT_TRUE(Json::parse(payload.substr(13)).isObject());
    seen.insert(static_cast<unsigned char>(payload[1]));
  }
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(stream.foxgloveStats()->published, topics.size());
  stream.send(results);  // the same sample of the angles is not sent twice
  EXPECT_EQ(stream.foxgloveStats()->published, 2 * topics.size() - 1);
}

TEST(FoxgloveStream, EventsAreALog) {
  LiveStream stream(sdh2());
  stream.switchOn(anyPort());
  WebSocketClient client(portOf(stream));
  ASSERT_TRUE(client.join());
  subscribe(client, {"/events"});
  stream.send(Event{7'000'000, 7'000'000, "slip", 1, "begins", ""});
  const Json log = Json::parse(client.frame().value().payload.substr(13));
  EXPECT_EQ(log.at("name").asString(), "slip");
  EXPECT_EQ(log.at("message").asString(), "finger 0 distal: begins");
}

TEST(FoxgloveStream, AnIntervalWithoutFramesIsAnEvent) {
  LiveStream stream(sdh2());
  stream.switchOn(anyPort());
  WebSocketClient client(portOf(stream));
  ASSERT_TRUE(client.join());
  subscribe(client, {"/events"});
  const auto sendAt = [&](std::int64_t us) {
    TactileFrame frame(sdh2().layout);
    frame.hostUs = us;
    LiveResults results;
    results.frame = std::make_shared<const TactileFrame>(frame);
    stream.send(results);
  };
  for (int i = 0; i < 20; ++i) sendAt(1'000'000 + i * 33'000);
  EXPECT_EQ(stream.foxgloveStats()->published, 0u);
  sendAt(1'000'000 + 19 * 33'000 + 2'300'000);
  const Json log = Json::parse(client.frame().value().payload.substr(13));
  EXPECT_EQ(log.at("name").asString(), "gap");
  EXPECT_EQ(log.at("message").asString(), "no frame for 2.3 s");
  EXPECT_EQ(log.at("timestamp").at("sec").asInteger(), 1);
  EXPECT_EQ(log.at("timestamp").at("nsec").asInteger(), 627'000'000);
  sendAt(500'000);  // a recording that is played again
  EXPECT_EQ(stream.foxgloveStats()->published, 1u);
}

TEST(FoxgloveStream, NothingIsMadeThatNobodyReads) {
  const HandDescription hand = builtInHand("parallel_gripper");
  LiveStream stream(hand, []() -> LinkHealth {
    ADD_FAILURE() << "nobody reads the signals";
    return {};
  });
  stream.switchOn(anyPort());
  LiveResults results;
  results.frame = std::make_shared<const TactileFrame>(hand.layout);
  for (int i = 0; i < 5; ++i) stream.send(results);
  EXPECT_EQ(stream.foxgloveStats()->published, 1u);  // the shapes, for whoever comes later
}

TEST(FoxgloveStream, CanBeSwitchedOnAgainAtItsPort) {
  LiveStream stream(sdh2());
  stream.switchOn(anyPort());
  FoxgloveOptions same;
  same.server.port = portOf(stream);
  stream.switchOn(same);
  EXPECT_EQ(portOf(stream), same.server.port);
  LiveStream other(sdh2());
  EXPECT_THROW(other.switchOn(same), Error);
  EXPECT_FALSE(other.foxgloveStats());
}

}  // namespace
}  // namespace palpate::foxglove_stream_test
