#include "palpate/interop/foxglove_server.h"

#include <random>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "interop/listening_sockets.h"
#include "interop/web_socket_client.h"
#include "testing/testing.h"

namespace palpate::foxglove_server_test {
namespace {
using testing::WebSocketClient;
using testing::WebSocketFrame;

FoxgloveServerOptions freePort() {
  FoxgloveServerOptions options;
  options.port = 0;
  return options;
}

std::vector<FoxgloveChannel> twoChannels() {
  return {{"/a", "test.A", R"({"type":"object"})"}, {"/b", "test.B", "{}", true}};
}

std::uint64_t littleEndian(const std::string& bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

// Skips the two messages that every client receives first.
void skipGreeting(WebSocketClient& client) {
  client.frame();
  client.frame();
}

// Answers come after all that was sent before: whatever the client said is done then.
void awaitServer(WebSocketClient& client) {
  client.say(R"({"op":"x"})");
  while (const auto frame = client.frame())
    if (frame->opcode == 1) return;
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
                  ": another program listens at this port: choose another port");
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
