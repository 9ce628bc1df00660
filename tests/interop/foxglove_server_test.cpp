#include "palpate/interop/foxglove_server.h"

#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <random>
#include <stdexcept>
#include <thread>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "interop/foxglove_frames.h"
#include "interop/listening_sockets.h"
#include "testing/testing.h"

namespace palpate::foxglove_server_test {
namespace {
using namespace testing;

std::vector<FoxgloveChannel> twoChannels() {
  return {{"/a", "test.A", R"({"type":"object"})"}, {"/b", "test.B", "{}", true}};
}

TEST(FoxgloveServer, GreetsAndAdvertises) {
  FoxgloveServer server(freePort(), twoChannels());
  EXPECT_EQ(server.url(), "ws://127.0.0.1:" + std::to_string(server.port()));
  WebSocketClient client(server.port());
  const std::string head = client.handshake(WebSocketClient::request("foxglove.websocket.v1"));
  EXPECT_NE(head.find("HTTP/1.1 101 "), std::string::npos) << head;
  // The example of RFC 6455, section 1.3.
  EXPECT_NE(head.find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos);
  EXPECT_NE(head.find("Sec-WebSocket-Protocol: foxglove.websocket.v1"), std::string::npos);
  const Json info = Json::parse(client.frame().value().payload);
  EXPECT_EQ(info.at("op").asString(), "serverInfo");
  EXPECT_EQ(info.at("name").asString(), "Palpate");
  EXPECT_EQ(info.at("capabilities").size(), 0u);
  const Json advertise = Json::parse(client.frame().value().payload);
  EXPECT_EQ(advertise.at("op").asString(), "advertise");
  ASSERT_EQ(advertise.at("channels").size(), 2u);
  const Json channel = advertise.at("channels").at(std::size_t{0});
  EXPECT_EQ(channel.at("id").asInteger(), 0);
  EXPECT_EQ(channel.at("topic").asString(), "/a");
  EXPECT_EQ(channel.at("encoding").asString(), "json");
  EXPECT_EQ(channel.at("schemaName").asString(), "test.A");
  EXPECT_EQ(channel.at("schema").asString(), R"({"type":"object"})");
  EXPECT_EQ(channel.at("schemaEncoding").asString(), "jsonschema");
}

// Which protocol a client offers, and which is chosen; empty: refused.
TEST(FoxgloveServer, ChoosesTheNewestProtocolThatIsOffered) {
  FoxgloveServer server(freePort(), twoChannels());
  const auto chosen = [&](const std::string& offered) {
    WebSocketClient client(server.port());
    const std::string head = client.handshake(WebSocketClient::request(offered));
    const std::string key = "Sec-WebSocket-Protocol: ";
    const std::size_t at = head.find(key);
    return at == std::string::npos
               ? std::string()
               : head.substr(at + key.size(), head.find('\r', at) - at - key.size());
  };
  EXPECT_EQ(chosen("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(chosen("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(chosen("foxglove.sdk.v1,other"), "foxglove.sdk.v1");
  EXPECT_EQ(chosen("foxglove.websocket.v2"), "");
  EXPECT_EQ(chosen(""), "");
}

TEST(FoxgloveServer, SendsWhatIsSubscribedTo) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient client(server.port());
  ASSERT_TRUE(client.join());
  skipGreeting(client);
  EXPECT_FALSE(server.wanted(0));
  server.publish(0, 1, "{\"lost\":1}");  // nobody reads it
  client.say(R"({"op":"subscribe","subscriptions":[{"id":77,"channelId":0}]})");
  awaitServer(client);
  EXPECT_TRUE(server.wanted(0));
  server.publish(0, 1'416'996'123'250'007, "{\"v\":1}");
  const WebSocketFrame message = client.frame().value();
  EXPECT_EQ(message.opcode, 2);
  ASSERT_EQ(message.payload.size(), 13u + 7u);
  EXPECT_EQ(message.payload[0], 1);
  EXPECT_EQ(littleEndian(message.payload, 1, 4), 77u);
  EXPECT_EQ(littleEndian(message.payload, 5, 8), 1'416'996'123'250'007'000u);
  EXPECT_EQ(message.payload.substr(13), "{\"v\":1}");
  client.say(R"({"op":"unsubscribe","subscriptionIds":[77]})");
  awaitServer(client);
  EXPECT_FALSE(server.wanted(0));
  EXPECT_EQ(server.stats().published, 1u);
  EXPECT_EQ(server.stats().clients, 1u);
}

TEST(FoxgloveServer, ALatchedMessageAwaitsItsReaders) {
  FoxgloveServer server(freePort(), twoChannels());
  server.publish(1, 5, "\"scene\"");
  for (int i = 0; i < 2; ++i) {
    WebSocketClient client(server.port());
    ASSERT_TRUE(client.join("foxglove.sdk.v1"));
    skipGreeting(client);
    client.say(R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":1}]})");
    EXPECT_EQ(client.frame().value().payload.substr(13), "\"scene\"");
  }
}

TEST(FoxgloveServer, AWebPageThatNobodyAllowedReadsNothing) {
  FoxgloveServerOptions options = freePort();
  options.origins = {"http://localhost:8080"};
  std::mutex mutex;
  std::vector<std::string> told;
  options.onRefusedOrigin = [&](const std::string& why) {
    const std::lock_guard lock(mutex);
    told.push_back(why);
  };
  FoxgloveServer server(options, twoChannels());
  const auto status = [&](const std::string& origins) {
    WebSocketClient client(server.port());
    return client.handshake(WebSocketClient::request("foxglove.sdk.v1", origins)).substr(9, 3);
  };
  EXPECT_EQ(status(""), "101");
  EXPECT_EQ(status("Origin: https://app.foxglove.dev\r\n"), "101");
  EXPECT_EQ(status("Origin: http://localhost:8080\r\n"), "101");
  for (const char* other : {"https://evil.example",
                            "null",
                            "https://app.foxglove.dev.evil.example",
                            "http://app.foxglove.dev",
                            "https://app.foxglove.dev:81",
                            "http://localhost",
                            "file://"})
    EXPECT_EQ(status(std::string("Origin: ") + other + "\r\n"), "403") << other;
  EXPECT_EQ(status("Origin: https://app.foxglove.dev\r\nOrigin: https://evil.example\r\n"), "403");
  EXPECT_NE(server.stats().lastRefusal.find("may not read the hand"), std::string::npos);
  EXPECT_EQ(server.stats().refused, 8u);
  // One line per origin, however often a page tries.
  EXPECT_EQ(status("Origin: file://\r\n"), "403");
  const std::lock_guard lock(mutex);
  EXPECT_EQ(told.size(), 8u);
  EXPECT_NE(told[6].find("file://"), std::string::npos) << told[6];
  EXPECT_NE(told[6].find("--origin"), std::string::npos) << told[6];
}

TEST(FoxgloveServer, WhatIsNoWebSocketGetsASentence) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient browser(server.port());
  const std::string page = browser.handshake("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_NE(page.find(" 426 "), std::string::npos) << page;
  EXPECT_NE(page.find("This port is a WebSocket for Foxglove"), std::string::npos) << page;
  WebSocketClient other(server.port());
  const std::string text = other.handshake(WebSocketClient::request("chat"));
  EXPECT_NE(text.find(" 400 "), std::string::npos) << text;
  EXPECT_NE(text.find("offers 'chat'"), std::string::npos) << text;
}

TEST(FoxgloveServer, AHandshakeThatIsNotFinishedEnds) {
  FoxgloveServerOptions options = freePort();
  options.handshakeS = 0.05;
  FoxgloveServer server(options, twoChannels());
  WebSocketClient half(server.port());
  half.send("GET / HTTP/1.1\r\nHost: loc");
  EXPECT_TRUE(half.awaitEnd());
  WebSocketClient silent(server.port());
  EXPECT_TRUE(silent.awaitEnd());
  WebSocketClient endless(server.port());
  endless.send("GET / HTTP/1.1\r\nX: " + std::string(100'000, 'x'));
  EXPECT_TRUE(endless.awaitEnd());
  WebSocketClient good(server.port());
  EXPECT_TRUE(good.join());
}

TEST(FoxgloveServer, BadRequestsAreAnsweredAndTheClientGoesOn) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient client(server.port());
  ASSERT_TRUE(client.join());
  skipGreeting(client);
  const auto answerTo = [&](const std::string& frame) {
    client.send(frame);
    const Json status = Json::parse(client.frame().value().payload);
    EXPECT_EQ(status.at("op").asString(), "status");
    return status.at("message").asString();
  };
  const auto text = [](const std::string& payload) {
    return WebSocketClient::masked(0x81, payload);
  };
  EXPECT_NE(answerTo(text("nonsense")).find("not JSON"), std::string::npos);
  EXPECT_NE(answerTo(text("[]")).find("op"), std::string::npos);
  EXPECT_NE(answerTo(text(R"({"op":"subscribe"})")).find("subscriptions"), std::string::npos);
  EXPECT_NE(answerTo(text(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})"))
                .find("no channel 2"),
            std::string::npos);
  EXPECT_NE(answerTo(text(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]})"))
                .find("numbers"),
            std::string::npos);
  EXPECT_NE(answerTo(text(R"({"op":"advertise","channels":[]})")).find("only sends"),
            std::string::npos);
  EXPECT_NE(
      answerTo(WebSocketClient::masked(0x82, std::string("\x01\0\0\0\0x", 6))).find("only sends"),
      std::string::npos);
  // One message in three frames.
  client.send(WebSocketClient::masked(0x01, R"({"op":"subscribe","subscri)"));
  client.send(WebSocketClient::masked(0x00, R"(ptions":[{"id":5,"chan)"));
  client.send(WebSocketClient::masked(0x80, R"(nelId":0}]})"));
  EXPECT_NE(answerTo(text(R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":0}]})"))
                .find("subscription 5 exists already"),
            std::string::npos);
  server.publish(0, 1, "1");
  EXPECT_EQ(client.frame().value().payload.substr(13), "1");
}

TEST(FoxgloveServer, AMessageThatIsTooLongEndsOnlyThisClient) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient good(server.port());
  ASSERT_TRUE(good.join());
  skipGreeting(good);
  WebSocketClient bad(server.port());
  ASSERT_TRUE(bad.join());
  bad.send(WebSocketClient::masked(0x81, std::string(1 << 20, 'x')));
  EXPECT_TRUE(bad.awaitEnd());
  // A frame that claims 2^62 bytes, and one that is not masked.
  WebSocketClient huge(server.port());
  ASSERT_TRUE(huge.join());
  huge.send(std::string("\x81\xFF\x40\0\0\0\0\0\0\0", 10) + "abcd");
  EXPECT_TRUE(huge.awaitEnd());
  WebSocketClient bare(server.port());
  ASSERT_TRUE(bare.join());
  bare.send(std::string("\x81\x02{}", 4));
  EXPECT_TRUE(bare.awaitEnd());
  for (WebSocketClient* gone : {&bad, &huge, &bare}) gone->close();
  for (int i = 0; i < 1000 && server.stats().clients > 1; ++i) awaitServer(good);
  EXPECT_EQ(server.stats().clients, 1u);
}

TEST(FoxgloveServer, RandomBytesHarmNobody) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient good(server.port());
  ASSERT_TRUE(good.join());
  skipGreeting(good);
  std::mt19937 random(1);
  const auto junk = [&] {
    std::string bytes(random() % 400, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
  };
  for (int i = 0; i < 300; ++i) {
    WebSocketClient client(server.port());
    if (i % 3 == 0) {
      client.send(junk());
    } else if (i % 3 == 1) {  // a handshake with one wrong byte
      std::string request = WebSocketClient::request("foxglove.sdk.v1");
      request[random() % request.size()] = static_cast<char>(random());
      client.send(request);
    } else if (client.join()) {
      client.send(junk());
    }
  }
  awaitServer(good);
  good.say(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":0}]})");
  awaitServer(good);
  server.publish(0, 1, "\"alive\"");
  EXPECT_EQ(good.frame().value().payload.substr(13), "\"alive\"");
}

TEST(FoxgloveServer, AThousandConnectionsLeaveRoomForOne) {
  FoxgloveServer server(freePort(), twoChannels());
  for (int i = 0; i < 1000; ++i) {
    WebSocketClient client(server.port());
    if (i % 2 == 0) client.send("GET ");
  }
  bool joined = false;
  for (int i = 0; i < 200 && !joined; ++i) {
    WebSocketClient client(server.port());
    joined = client.join();
  }
  EXPECT_TRUE(joined);
}

TEST(FoxgloveServer, TooManyClientsAreToldSo) {
  FoxgloveServerOptions options = freePort();
  options.maxClients = 2;
  FoxgloveServer server(options, twoChannels());
  WebSocketClient a(server.port()), b(server.port()), c(server.port());
  ASSERT_TRUE(a.join() && b.join());
  const std::string text = c.handshake(WebSocketClient::request("foxglove.sdk.v1"));
  EXPECT_NE(text.find(" 503 "), std::string::npos) << text;
  EXPECT_NE(text.find("2 clients already"), std::string::npos) << text;
}

// What the kernel takes for a client that does not read is a few MB at most: 64 MB can't fit.
TEST(FoxgloveServer, AClientThatNeverReadsLosesMessagesAndNobodyWaits) {
  FoxgloveServerOptions options = freePort();
  options.maxWaitingBytes = 1 << 20;
  FoxgloveServer server(options, twoChannels());
  WebSocketClient good(server.port()), lazy(server.port());
  ASSERT_TRUE(good.join() && lazy.join());
  skipGreeting(good);
  const std::string subscribe = R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})";
  lazy.say(subscribe);
  skipGreeting(lazy);
  awaitServer(lazy);
  good.say(subscribe);
  awaitServer(good);
  for (int i = 0; i < 256; ++i) {
    server.publish(0, i, "\"" + std::to_string(i) + std::string(1 << 18, ' ') + "\"");
    const auto frame = good.frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(littleEndian(frame->payload, 5, 8), static_cast<std::uint64_t>(i) * 1000);
  }
  EXPECT_GT(server.stats().dropped, 100u);
  EXPECT_EQ(server.stats().clients, 2u);
  // The last message is not lost: older ones are dropped for it.
  std::uint64_t last = 0;
  while (last < 255'000) {
    const auto frame = lazy.frame();
    ASSERT_TRUE(frame);
    last = littleEndian(frame->payload, 5, 8);
  }
}

// The message that waits for a client to read again must stay whole while later ones are dropped.
TEST(FoxgloveServer, AClientThatPausesReadsWholeMessages) {
  FoxgloveServerOptions options = freePort();
  options.maxWaitingBytes = 64U << 10;
  FoxgloveServer server(options, twoChannels());
  WebSocketClient good(server.port()), pausing(server.port(), 4096);
  ASSERT_TRUE(good.join() && pausing.join());
  skipGreeting(good);
  skipGreeting(pausing);
  pausing.say(R"({"op":"subscribe","subscriptions":[{"id":16909060,"channelId":0}]})");
  awaitServer(pausing);
  good.say(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})");
  awaitServer(good);
  std::uint64_t published = 0;
  std::optional<std::uint64_t> last;
  for (int pause = 0; pause < 3; ++pause) {
    const std::uint64_t droppedBefore = server.stats().dropped;
    // More than 16 of them, so that the queue has given memory back.
    for (int batch = 0; batch < 1000 && server.stats().dropped < droppedBefore + 200; ++batch) {
      for (int i = 0; i < 500; ++i, ++published)
        server.publish(0, static_cast<std::int64_t>(published), numberedPayload(published));
      for (std::optional<std::uint64_t> read; read != published - 1;) {
        const auto frame = good.frame();
        ASSERT_TRUE(frame);
        read = numberOfWhole(*frame, 1);
        ASSERT_TRUE(read);
      }
    }
    ASSERT_GE(server.stats().dropped, droppedBefore + 200);
    while (last != published - 1) {
      const auto frame = pausing.frame();
      ASSERT_TRUE(frame);
      const auto number = numberOfWhole(*frame, 16'909'060);
      ASSERT_TRUE(number) << ::testing::PrintToString(frame->payload);
      ASSERT_TRUE(!last || *number > *last) << *number << " after " << *last;
      last = number;
    }
  }
  EXPECT_EQ(server.stats().clients, 2u);
}

// What one client asks for must not keep the server from its other clients.
TEST(FoxgloveServer, GreedyClientsTakeNothingFromAnother) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient good(server.port());
  ASSERT_TRUE(good.join());
  skipGreeting(good);
  good.say(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})");
  awaitServer(good);
  std::list<WebSocketClient> greedy;
  for (int i = 0; i < 15; ++i) {
    WebSocketClient& client = greedy.emplace_back(server.port());
    ASSERT_TRUE(client.join());
    std::string list;
    for (int id = 0; id < 4096; ++id)
      list += (id > 0 ? "," : "") + ("{\"id\":" + std::to_string(id)) + ",\"channelId\":0}";
    client.say(R"({"op":"subscribe","subscriptions":[)" + list + "]}");
    awaitServer(client);
  }
  std::atomic<bool> ends = false;
  std::thread publisher([&] {  // faster than any client reads
    for (std::uint64_t n = 0; !ends; ++n)
      server.publish(0, static_cast<std::int64_t>(n), numberedPayload(n));
  });
  std::optional<std::uint64_t> last;
  const auto readsAHundred = [&] {
    for (int i = 0; i < 100; ++i) {
      const auto frame = good.frame();
      const auto number = frame ? numberOfWhole(*frame, 1) : std::nullopt;
      if (!number || (last && *number <= *last)) return false;
      last = number;
    }
    return true;
  };
  EXPECT_TRUE(readsAHundred());
  WebSocketClient late(server.port());  // there are 16 clients already
  EXPECT_NE(late.handshake(WebSocketClient::request("foxglove.sdk.v1")).find(" 503 "),
            std::string::npos);
  greedy.clear();
  EXPECT_TRUE(readsAHundred());
  ends = true;
  publisher.join();
  for (int i = 0; i < 1000 && server.stats().clients > 1; ++i) awaitServer(good);
  EXPECT_EQ(server.stats().clients, 1u);
  awaitServer(good);
  // Nothing is left to do: what a further message causes is one message.
  const FoxgloveServerStats before = server.stats();
  server.publish(0, INT64_C(1) << 50, numberedPayload(UINT64_C(1) << 50));
  awaitServer(good);
  awaitServer(good);
  EXPECT_EQ(server.stats().published, before.published + 1);
  EXPECT_EQ(server.stats().sent, before.sent + 1);
  EXPECT_EQ(server.stats().dropped, before.dropped);
}

// As the protocol says: "A client may only have one subscription for each channel at a time."
TEST(FoxgloveServer, AClientHasOneSubscriptionOfAChannel) {
  FoxgloveServer server(freePort(), twoChannels());
  WebSocketClient client(server.port());
  ASSERT_TRUE(client.join());
  skipGreeting(client);
  client.say(
      R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0},{"id":2,"channelId":0}]})");
  const Json status = Json::parse(client.frame().value().payload);
  EXPECT_EQ(status.at("message").asString(), "channel 0 has the subscription 1 already");
  server.publish(0, 1, "1");
  server.publish(0, 2, "2");
  for (const char* payload : {"1", "2"}) {
    const WebSocketFrame frame = client.frame().value();
    EXPECT_EQ(littleEndian(frame.payload, 1, 4), 1u);
    EXPECT_EQ(frame.payload.substr(13), payload);
  }
  // After its end the channel may have another one.
  client.say(R"({"op":"unsubscribe","subscriptionIds":[1,2]})");
  client.say(R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":0}]})");
  awaitServer(client);
  server.publish(0, 3, "3");
  EXPECT_EQ(littleEndian(client.frame().value().payload, 1, 4), 2u);
}

// The oldest unfinished handshake gives way to a new connection: nobody waits for their limit.
TEST(FoxgloveServer, HalfHandshakesKeepNobodyOut) {
  FoxgloveServerOptions options = freePort();
  options.handshakeS = 3600.0;
  FoxgloveServer server(options, twoChannels());
  std::list<WebSocketClient> half;
  for (int i = 0; i < 64; ++i) half.emplace_back(server.port()).send("GET ");
  WebSocketClient good(server.port());
  EXPECT_TRUE(good.join());
  EXPECT_TRUE(half.front().awaitEnd());
  EXPECT_EQ(server.stats().refused, 1u);
  EXPECT_NE(server.stats().lastRefusal.find("gave way"), std::string::npos);
  half.back().send(WebSocketClient::request("foxglove.sdk.v1").substr(4));
  EXPECT_NE(half.back().handshake("").find(" 101 "), std::string::npos);
}

TEST(FoxgloveServer, SaysGoodbye) {
  auto server = std::make_unique<FoxgloveServer>(freePort(), twoChannels());
  WebSocketClient client(server->port());
  ASSERT_TRUE(client.join());
  skipGreeting(client);
  WebSocketClient half(server->port());
  half.send("GET ");
  server.reset();
  const WebSocketFrame frame = client.frame().value();
  EXPECT_EQ(frame.opcode, 8);
  EXPECT_EQ(frame.payload.substr(0, 2), "\x03\xE9");  // 1001, going away
  EXPECT_TRUE(half.awaitEnd());
}

TEST(FoxgloveServer, APortThatIsTakenIsSaid) {
  FoxgloveServer first(freePort(), twoChannels());
  FoxgloveServerOptions options;
  options.port = first.port();
  try {
    FoxgloveServer second(options, twoChannels());
    FAIL() << "two servers at one port";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "127.0.0.1:" + std::to_string(first.port()) +
                  ": another program uses this port; name another one");
  }
  options.address = "localhost";
  EXPECT_THROW(FoxgloveServer(options, twoChannels()), Error);
  options.address = "203.0.113.1";  // none of this machine
  EXPECT_THROW(FoxgloveServer(options, twoChannels()), Error);
  options.maxClients = 0;
  EXPECT_THROW(FoxgloveServer(options, twoChannels()), std::invalid_argument);
}

TEST(FoxgloveServer, ListensOnThisMachineOnly) {
  FoxgloveServer server(freePort(), twoChannels());
  const auto sockets = testing::listeningSocketsOf(::getpid());
  ASSERT_EQ(sockets.size(), 1u);
  EXPECT_TRUE(sockets[0].starts_with("tcp 0100007F:")) << sockets[0];  // 127.0.0.1
}

}  // namespace
}  // namespace palpate::foxglove_server_test
