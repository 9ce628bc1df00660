#include "palpate/interop/remote_server.h"

#include <cstdlib>
#include <list>
#include <mutex>
#include <random>
#include <stdexcept>
#include <thread>

#include <sys/stat.h>

#include "palpate/core/error.h"
#include "palpate/interop/remote_client.h"

#include "interop/raw_client.h"
#include "testing/process_facts.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::remote_server_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;
using namespace std::chrono_literals;
using Verb = RemoteRequest::Verb;

// Answers at once; a start only when the test requests it.
class FakeTarget : public RemoteTarget {
 public:
  void carryOut(const RemoteRequest& request, Done done) override {
    if (request.verb == Verb::kStart) {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(done));
      return;
    }
    if (request.verb == Verb::kMark) throw std::runtime_error("the pen is dry");
    RemoteAnswer answer;
    answer.fields.set("text", request.text);
    done(answer);
    done(RemoteAnswer::refused("failed", "a second answer"));  // must not reach the client
  }
  std::size_t waiting() {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }
  void answerOne() {
    const std::lock_guard lock(mutex_);
    waiting_.front()({});
    waiting_.pop_front();
  }
  void forgetAll() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
  }

 private:
  std::mutex mutex_;
  std::list<Done> waiting_;
};

class RemoteServerTest : public ::testing::Test {
 protected:
  void serve(RemoteServerOptions options = {}) {
    server_ = std::make_unique<RemoteServer>(socket(), target_, std::move(options));
  }
  fs::path socket() const { return folder_ / "s"; }
  Json ask(const std::string& request) {
    return Json::parse(RemoteClient(socket()).ask(request, 5000ms));
  }

  const TemporaryFolder folder_;
  FakeTarget target_;
  std::unique_ptr<RemoteServer> server_;
};

TEST_F(RemoteServerTest, AsksTheTargetAndAnswers) {
  serve();
  RemoteClient client(socket());
  const Json label = Json::parse(client.ask("label hello there", 5000ms));
  EXPECT_TRUE(label.at("ok").asBool());
  EXPECT_EQ(label.at("command").asString(), "label");
  EXPECT_EQ(label.at("text").asString(), "hello there");
  EXPECT_EQ(Json::parse(client.ask("dance", 5000ms)).at("error").asString(), "unknown");
  EXPECT_EQ(Json::parse(client.ask("mark", 5000ms)).at("message").asString(), "the pen is dry");
  EXPECT_EQ(Json::parse(client.ask("help", 5000ms)).at("requests").size(), 8u);
  EXPECT_EQ(server_->stats().requests, 2u);
  EXPECT_EQ(server_->stats().refused, 1u);
  EXPECT_THROW(client.ask("a\nb", 5000ms), std::invalid_argument);
}

// C-A2: an exception on the server's thread costs one client, not the process.
TEST_F(RemoteServerTest, LivesThroughWhatIsThrownOnItsThread) {
  RemoteServerOptions options;
  options.onAnswer = [](const RemoteRequest& request, const RemoteAnswer&) {
    if (request.text == "throw") throw std::bad_alloc();
  };
  serve(std::move(options));
  RemoteClient other(socket());
  for (int i = 0; i < 3; ++i) {
    try {
      RemoteClient(socket()).ask("label throw", 5000ms);
    } catch (const Error&) {
      // It may have received no answer.
    }
    EXPECT_TRUE(Json::parse(other.ask("label still there", 5000ms)).at("ok").asBool());
  }
}

TEST_F(RemoteServerTest, TheSocketIsItsOwnersAloneAndGoesWithTheServer) {
  serve();
  struct stat found {};
  ASSERT_EQ(::lstat(socket().c_str(), &found), 0);
  EXPECT_TRUE(S_ISSOCK(found.st_mode));
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  server_.reset();
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  EXPECT_THROW(RemoteClient{socket()}, FileError);
}

TEST_F(RemoteServerTest, TwoDoNotShareASocket) {
  serve();
  EXPECT_THROW(RemoteServer(socket(), target_), FileError);
  EXPECT_TRUE(ask("status").at("ok").asBool());  // the first server is not affected
}

TEST_F(RemoteServerTest, WhatAKilledProgramLeftIsTakenAway) {
  {
    const int left = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket().c_str(), sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(left, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(left);
  }
  ASSERT_TRUE(fs::exists(socket()));
  serve();
  EXPECT_TRUE(ask("status").at("ok").asBool());
}

TEST_F(RemoteServerTest, NothingElseIsTakenAway) {
  writeFile(socket(), "precious");
  EXPECT_THROW(serve(), FileError);
  EXPECT_EQ(readFile(socket()), "precious");
  EXPECT_THROW(RemoteServer(folder_ / "no" / "s", target_), FileError);
  EXPECT_THROW(RemoteServer(folder_ / std::string(200, 'x'), target_), FileError);
  EXPECT_THROW(RemoteServer(folder_ / "t", target_, {.maxClients = 0}), std::invalid_argument);
}

TEST_F(RemoteServerTest, OnlyTheOneWhoAskedWaitsForAnAnswer) {
  serve();
  const RawClient first(socket());
  first.send("start a\n");
  ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
  EXPECT_TRUE(ask("status").at("ok").asBool());
  RawClient second(socket());
  second.send("start b\nlabel later\n");
  ASSERT_TRUE(soon([&] { return target_.waiting() == 2; }));
  EXPECT_FALSE(second.line(50));  // answers have the order of the requests
  target_.answerOne();
  target_.answerOne();
  EXPECT_EQ(Json::parse(second.line().value()).at("command").asString(), "start");
  EXPECT_EQ(Json::parse(second.line().value()).at("text").asString(), "later");
}

TEST_F(RemoteServerTest, AClientThatDiesIsForgottenWhateverItWaitedFor) {
  serve();
  for (int i = 0; i < 50; ++i) {
    RawClient client(socket());
    client.send("start a\n");
    ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
    client.close();
    ASSERT_TRUE(soon([&] { return server_->stats().clients == 0; }));
    target_.answerOne();  // the client has gone
  }
  EXPECT_TRUE(ask("status").at("ok").asBool());
}

TEST_F(RemoteServerTest, AClientThatHangsHoldsNobodyUp) {
  serve();
  const RawClient half(socket());
  half.send("stat");  // an incomplete request
  const RawClient deaf(socket());
  std::string flood;
  for (int i = 0; i < 1000; ++i) flood += "status\n";
  // The client never reads an answer: soon the server reads no more from it.
  const std::size_t enough = 64U << 20U;
  std::size_t taken = 0;
  for (std::size_t now = 1; now > 0 && taken < enough; taken += now) now = deaf.send(flood, 50);
  EXPECT_LT(taken, enough);
  EXPECT_TRUE(ask("status").at("ok").asBool());
}

TEST_F(RemoteServerTest, StopIsAnsweredWhileOthersDoNotRead) {
  serve();
  std::string flood;
  for (int i = 0; i < 500; ++i) flood += "help\n";
  std::list<RawClient> deaf;
  for (int i = 0; i < 4; ++i) {
    const RawClient& client = deaf.emplace_back(socket());
    while (client.send(flood, 20) > 0) {
    }
  }
  RemoteClient client(socket());
  for (int i = 0; i < 100; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(Json::parse(client.ask("stop", 5000ms)).at("ok").asBool());
    EXPECT_LT(std::chrono::steady_clock::now() - begin, timeLimit(100ms));
  }
}

// What the sanitizers judge: answers from another thread to clients that leave, and to a server
// that ends.
TEST_F(RemoteServerTest, EndsWhileAnswersAreGiven) {
  for (int round = 0; round < 20; ++round) {
    serve();
    std::list<RawClient> clients;
    for (std::size_t i = 0; i < 10; ++i) {
      clients.emplace_back(socket()).send("start a\nlabel b\nstart c\n");
      ASSERT_TRUE(soon([&] { return target_.waiting() == i + 1; }));
    }
    clients.pop_front();
    std::thread answers([&] {
      for (int i = 0; i < 10; ++i) target_.answerOne();
    });
    server_.reset();
    answers.join();
    for (RawClient& client : clients) EXPECT_TRUE(client.ended());
    target_.forgetAll();
  }
}

// The request of a client that leaves at once is carried out.
TEST_F(RemoteServerTest, WhatAClientAskedBeforeItLeftIsDone) {
  serve();
  for (std::size_t i = 0; i < 50; ++i) {
    RawClient(socket()).send("start a\n");
    ASSERT_TRUE(soon([&] { return target_.waiting() == i + 1; }));
  }
  ASSERT_TRUE(soon([&] { return server_->stats().clients == 0; }));
}

TEST_F(RemoteServerTest, AFarTooLongLineIsSaidAndSkipped) {
  serve();
  RawClient client(socket());
  const std::string piece(4096, 'x');
  for (int i = 0; i < 1000; ++i) {
    std::size_t sent = 0;
    ASSERT_TRUE(soon([&] {
      sent += client.send(std::string_view(piece).substr(sent));
      return sent == piece.size();
    }));
  }
  ASSERT_EQ(client.send("\nstatus\n", 5000), 8u) << "as soon as there is room";
  EXPECT_EQ(Json::parse(client.line().value()).at("error").asString(), "too_long");
  EXPECT_EQ(Json::parse(client.line().value()).at("command").asString(), "status");
}

TEST_F(RemoteServerTest, AClientThatOnlyEndsSendingGetsItsAnswer) {
  serve();
  RawClient client(socket());
  client.send("start a\nlabel b\n");
  client.endSending();
  ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
  target_.answerOne();
  EXPECT_EQ(Json::parse(client.line().value()).at("command").asString(), "start");
  EXPECT_EQ(Json::parse(client.line().value()).at("command").asString(), "label");
  EXPECT_TRUE(client.ended());
}

TEST_F(RemoteServerTest, TooManyClientsAreToldSo) {
  serve({.maxClients = 3});
  std::list<RawClient> clients;
  for (int i = 0; i < 3; ++i) {
    clients.emplace_back(socket());
    clients.back().send("status\n");
    ASSERT_TRUE(clients.back().line());
  }
  RawClient fourth(socket());
  EXPECT_EQ(Json::parse(fourth.line().value()).at("error").asString(), "busy");
  EXPECT_TRUE(fourth.ended());
  EXPECT_EQ(server_->stats().rejectedClients, 1u);
  clients.pop_front();
  ASSERT_TRUE(soon([&] { return server_->stats().clients == 2; }));
  EXPECT_TRUE(ask("status").at("ok").asBool());
}

TEST_F(RemoteServerTest, TheOneSilentForLongestMakesRoom) {
  serve({.maxClients = 2, .idleS = 0.0});
  RawClient old(socket());
  old.send("status\n");
  ASSERT_TRUE(old.line());
  RawClient busy(socket());
  busy.send("start a\n");  // waits for its answer, so it does not count as silent
  ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
  EXPECT_TRUE(ask("status").at("ok").asBool());
  EXPECT_TRUE(old.ended());
  target_.answerOne();
  EXPECT_TRUE(busy.line());
}

TEST_F(RemoteServerTest, ARequestThatNobodyAnswersFails) {
  serve();
  RawClient client(socket());
  client.send("start a\n");
  ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
  target_.forgetAll();
  EXPECT_EQ(Json::parse(client.line().value()).at("error").asString(), "failed");
}

TEST_F(RemoteServerTest, WhoWaitsIsToldThatItEnds) {
  serve();
  RawClient client(socket());
  client.send("start a\n");
  ASSERT_TRUE(soon([&] { return target_.waiting() == 1; }));
  server_.reset();
  EXPECT_EQ(Json::parse(client.line().value()).at("error").asString(), "shutting_down");
  EXPECT_TRUE(client.ended());
  target_.answerOne();  // the client has gone
}

TEST_F(RemoteServerTest, TellsWhatWasAskedButNotEveryStatus) {
  std::mutex mutex;
  std::vector<std::string> told;
  serve({.onAnswer = [&](const RemoteRequest& request, const RemoteAnswer& answer) {
    const std::lock_guard lock(mutex);
    told.push_back(std::string(nameOf(request.verb)) + (answer.ok() ? " ok" : " refused"));
  }});
  ask("status");
  ask("label x");
  ask("mark");
  const std::lock_guard lock(mutex);
  EXPECT_EQ(told, (std::vector<std::string>{"label ok", "mark refused"}));
}

TEST_F(RemoteServerTest, NoiseIsSurvivedAndNothingLeaks) {
  serve();
  EXPECT_TRUE(ask("status").at("ok").asBool());
  const ProcessFacts before = leastProcessFacts();
  std::mt19937 random(11);
  const auto heard = [&] { return server_->stats().accepted + server_->stats().rejectedClients; };
  const std::uint64_t heardBefore = heard();
  for (std::uint64_t i = 0; i < 300; ++i) {
    // No more than the system's queue of waiting connections can hold.
    if (i % 10 == 0) {
      ASSERT_TRUE(soon([&] { return heard() == heardBefore + i; }));
    }
    const RawClient client(socket());
    std::string noise(random() % 6000, '\0');
    for (char& c : noise) c = static_cast<char>(random() % 256);
    client.send(noise);
  }
  ASSERT_TRUE(soon([&] { return server_->stats().clients == 0; }));
  EXPECT_TRUE(ask("status").at("ok").asBool());
  ASSERT_TRUE(soon([&] { return server_->stats().clients == 0; }));
  EXPECT_LE(leastProcessFacts().descriptors, before.descriptors);
  EXPECT_LE(leastProcessFacts().threads, before.threads);
}

TEST(UsualRemoteSocket, LiesInTheRuntimeFolder) {
  const char* before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before ? before : "";
  ::setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
  EXPECT_EQ(usualRemoteSocket(), "/run/user/7/palpate-remote");
  ::unsetenv("XDG_RUNTIME_DIR");
  EXPECT_THROW(usualRemoteSocket(), Error);
  if (before) ::setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace palpate::remote_server_test
