// The Foxglove server under back pressure: many clients that pause at random times.
#include <cstdint>
#include <future>
#include <list>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "interop/foxglove_frames.h"

namespace palpate::foxglove_server_slow_test {
namespace {
using namespace testing;

struct PausingClient {
  explicit PausingClient(std::uint16_t port) : socket(port, 4096) {}
  // Reads what has arrived, at most `limit` messages; false when one is not whole or not newer.
  bool read(int limit, int waitMs) {
    for (int i = 0; i < limit; ++i) {
      const auto frame = socket.frame(waitMs);
      if (!frame) return true;
      const auto number = numberOfWhole(*frame, id);
      if (!number || (last && *number <= *last)) return false;
      last = number;
      ++received;
    }
    return true;
  }
  WebSocketClient socket;
  std::uint64_t id = 0;
  std::optional<std::uint64_t> last;
  std::uint64_t received = 0;
};

// Every message reaches every client whole and in order, or is counted as dropped.
TEST(FoxgloveServerSlow, EachMessageIsWholeOrCountedAsDropped) {
  FoxgloveServerOptions options = freePort();
  options.maxWaitingBytes = 16U << 10;
  FoxgloveServer server(options, {{"/a", "test.A", "{}"}});
  std::list<PausingClient> clients;
  for (std::uint64_t i = 0; i < 12; ++i) {
    PausingClient& client = clients.emplace_back(server.port());
    ASSERT_TRUE(client.socket.join());
    skipGreeting(client.socket);
    client.id = 0x01020304 * (i + 1);
    client.socket.say(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(client.id) +
                      R"(,"channelId":0}]})");
    awaitServer(client.socket);
  }
  PausingClient& good = clients.front();
  std::mt19937 random(49);
  std::uint64_t published = 0;
  for (int round = 0; round < 10'000; ++round) {
    for (std::uint64_t i = random() % 60; i > 0; --i, ++published)
      server.publish(0, static_cast<std::int64_t>(published), numberedPayload(published));
    if (published == 0) continue;
    while (good.last != published - 1) {
      const std::uint64_t before = good.received;
      ASSERT_TRUE(good.read(1, 20'000));
      ASSERT_GT(good.received, before);
    }
    for (PausingClient& client : clients)
      if (random() % 100 == 0) {
        ASSERT_TRUE(client.read(static_cast<int>(random() % 3000), 0));
      }
  }
  std::uint64_t received = 0;
  for (PausingClient& client : clients) {
    while (client.last != published - 1) {
      const std::uint64_t before = client.received;
      ASSERT_TRUE(client.read(1, 20'000));
      ASSERT_GT(client.received, before);
    }
    received += client.received;
  }
  for (PausingClient& client : clients) awaitServer(client.socket);
  const FoxgloveServerStats stats = server.stats();
  EXPECT_EQ(stats.published, published);
  EXPECT_EQ(stats.sent, received);
  EXPECT_EQ(stats.sent + stats.dropped, clients.size() * published);
  EXPECT_GT(stats.dropped, 10'000u);
}

// While the server's thread is held up, here by a callback, the source goes on and 16 MB wait at
// most: 255 messages of 64 KB. What is published once is not among those dropped.
TEST(FoxgloveServerSlow, AServerThatIsHeldUpNeitherStopsTheSourceNorGrows) {
  std::promise<void> held, goesOn;
  FoxgloveServerOptions options = freePort();
  options.onRefusedOrigin = [&](const std::string&) {
    held.set_value();
    goesOn.get_future().wait();
  };
  FoxgloveServer server(options, {{"/a", "test.A", "{}"}, {"/b", "test.B", "{}", true}});
  WebSocketClient client(server.port()), page(server.port());
  ASSERT_TRUE(client.join());
  skipGreeting(client);
  client.say(
      R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0},{"id":2,"channelId":1}]})");
  awaitServer(client);
  page.send(WebSocketClient::request("foxglove.sdk.v1", "Origin: https://evil.example\r\n"));
  held.get_future().wait();
  server.publish(1, 1, "\"scene\"");
  const std::string large = "\"" + std::string(64U << 10, ' ') + "\"";
  for (int i = 0; i < 1000; ++i) server.publish(0, i, large);
  EXPECT_EQ(server.stats().dropped, 745u);
  goesOn.set_value();
  const auto first = client.frame();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->payload.substr(13), "\"scene\"");
  for (std::uint64_t last = 0; last != 999;) {
    const auto frame = client.frame();
    ASSERT_TRUE(frame);
    last = littleEndian(frame->payload, 5, 8) / 1000;
  }
  awaitServer(client);
  const FoxgloveServerStats stats = server.stats();
  EXPECT_EQ(stats.published, 1001u);
  EXPECT_EQ(stats.sent + stats.dropped, 1001u);
}

}  // namespace
}  // namespace palpate::foxglove_server_slow_test
