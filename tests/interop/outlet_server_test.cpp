// Written for the sanitizers as well: clients that leave or don't read while others are served, and
// a server that ends while it sends.
#include "interop/outlet_server.h"

#include <atomic>
#include <list>
#include <stdexcept>
#include <string>

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/write.hpp>
#include <fcntl.h>

#include "interop/raw_client.h"
#include "interop/remote_socket.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::outlet_server_test {
namespace {
using namespace testing;

// Sends lines of 1000 bytes for as long as its client takes them.
class Talker : public std::enable_shared_from_this<Talker> {
 public:
  Talker(OutletServer<Talker>& server, FileDescriptor socket, std::atomic<int>& alive)
      : server_(server),
        socket_(server.context(), asio::local::stream_protocol(), socket.release()),
        alive_(alive) {
    ++alive_;
  }
  ~Talker() { --alive_; }
  void talk() {
    asio::async_write(
        socket_, asio::buffer(line_), [self = shared_from_this()](BoostError error, std::size_t) {
          if (error) return self->close();
          self->talk();
        });
  }
  void close() {
    BoostError ignored;
    socket_.close(ignored);
    server_.ended(this);
  }

 private:
  OutletServer<Talker>& server_;
  asio::local::stream_protocol::socket socket_;
  std::atomic<int>& alive_;
  const std::string line_ = std::string(999, 'x') + "\n";
};

class OutletServerTest : public ::testing::Test {
 protected:
  OutletServerTest() { server_->start(); }

  const TemporaryFolder folder_;
  ListeningSocket place_{folder_ / "s"};
  std::atomic<int> alive_ = 0;
  std::atomic<int> refusals_ = 0;  // clients that are refused by an exception from now on
  std::atomic<int> descriptorFlags_ = 0;
  std::unique_ptr<OutletServer<Talker>> server_ =
      std::make_unique<OutletServer<Talker>>(place_.takeListener(), [this](FileDescriptor socket) {
        if (refusals_ > 0) {
          --refusals_;
          throw std::runtime_error("no room");
        }
        descriptorFlags_ = ::fcntl(socket.get(), F_GETFD);
        const auto talker = std::make_shared<Talker>(*server_, std::move(socket), alive_);
        server_->add(talker);
        talker->talk();
      });
};

TEST_F(OutletServerTest, ManyClientsAreServedWhileOthersDoNotRead) {
  std::list<RawClient> deaf, good;
  for (int i = 0; i < 100; ++i) {
    deaf.emplace_back(place_.path());
    ASSERT_TRUE(good.emplace_back(place_.path()).connected());
    ASSERT_TRUE(soon([&] { return alive_ == 2 * (i + 1); }));
  }
  for (RawClient& client : good)
    for (int i = 0; i < 50; ++i) ASSERT_EQ(client.line().value_or(""), std::string(999, 'x'));
  EXPECT_EQ(alive_, 200);
  EXPECT_EQ(descriptorFlags_, FD_CLOEXEC);
}

TEST_F(OutletServerTest, ClientsThatVanishAreForgotten) {
  const ProcessFacts before = leastProcessFacts();
  RawClient stays(place_.path());
  for (int i = 0; i < 200; ++i) {
    RawClient client(place_.path());
    if (i % 2 == 0) {
      EXPECT_TRUE(client.line());
    }
    ASSERT_TRUE(stays.line());
  }
  EXPECT_TRUE(soon([&] { return alive_ == 1; }));
  stays.close();
  EXPECT_TRUE(soon([&] { return alive_ == 0; }));
  EXPECT_LE(leastProcessFacts().descriptors, before.descriptors);
}

TEST_F(OutletServerTest, EndsWhileItSends) {
  std::list<RawClient> clients;
  for (int i = 0; i < 20; ++i) clients.emplace_back(place_.path());
  for (RawClient& client : clients) ASSERT_TRUE(client.line());
  server_.reset();
  EXPECT_EQ(alive_, 0);
  for (RawClient& client : clients) EXPECT_TRUE(client.ended());
  EXPECT_FALSE(RawClient(place_.path()).connected());
}

TEST_F(OutletServerTest, AnExceptionCostsOneClientOnly) {
  refusals_ = 2;
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(RawClient(place_.path()).ended());
  EXPECT_TRUE(RawClient(place_.path()).line());
  RawClient good(place_.path());
  asio::post(server_->context(), [] { throw std::runtime_error("anything"); });
  EXPECT_TRUE(good.line());
  EXPECT_TRUE(RawClient(place_.path()).line());
}

TEST_F(OutletServerTest, StopsOnce) {
  server_->stop();
  server_->stop();
  EXPECT_TRUE(server_->sessions().empty());
}

}  // namespace
}  // namespace palpate::outlet_server_test
