#include "palpate/interop/remote_client.h"

#include <string>
#include <string_view>
#include <thread>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/interop/remote_server.h"

#include "testing/testing.h"

namespace palpate::remote_client_test {
namespace {
using namespace std::chrono_literals;

// Stores the requests and never answers.
class SilentTarget : public RemoteTarget {
 public:
  void carryOut(const RemoteRequest&, Done done) override { kept_ = std::move(done); }

 private:
  Done kept_;
};

TEST(RemoteClient, SaysWhereNobodyListens) {
  const testing::TemporaryFolder folder;
  try {
    RemoteClient client(folder / "none");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("--remote"), std::string::npos) << error.what();
  }
}

TEST(RemoteClient, GivesUpInTime) {
  const testing::TemporaryFolder folder;
  SilentTarget target;
  const RemoteServer server(folder / "s", target);
  RemoteClient client(folder / "s");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(client.ask("status", 100ms), FileError);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 95ms);
}

// A foreign program on the socket: sends its line to every client.
class OtherProgram {
 public:
  OtherProgram(const std::filesystem::path& path, std::string says)
      : listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    thread_ = std::thread([this, says = std::move(says)] {
      const int peer = ::accept(listener_, nullptr, nullptr);
      std::string_view left = says;
      while (!left.empty()) {
        const ssize_t sent = ::send(peer, left.data(), left.size(), MSG_NOSIGNAL);
        if (sent <= 0) break;
        left.remove_prefix(static_cast<std::size_t>(sent));
      }
      char byte = 0;
      while (::recv(peer, &byte, 1, 0) > 0) {  // until the client has gone
      }
      ::close(peer);
    });
  }
  ~OtherProgram() {
    thread_.join();
    ::close(listener_);
  }

 private:
  const int listener_;
  std::thread thread_;
};

TEST(RemoteClient, SaysThatSomebodyElseAnswers) {
  const std::string endless(2u << 20, 'x');
  for (const std::string& says : {std::string("220 mail.example.org ESMTP\n"),
                                  std::string("\x01\xff\x00 garbage\n", 12),
                                  std::string("[1, 2]\n"),
                                  std::string("{\"status\": 7}\n"),
                                  std::string("\n"),
                                  endless}) {
    const testing::TemporaryFolder folder;
    OtherProgram other(folder / "s", says);
    RemoteClient client(folder / "s");
    try {
      client.ask("status", 5000ms);
      FAIL() << says.substr(0, 40);
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("isn't Palpate"), std::string::npos) << error.what();
    }
  }
}

TEST(RemoteClient, NoticesThatTheOtherEndHasGone) {
  const testing::TemporaryFolder folder;
  SilentTarget target;
  auto server = std::make_unique<RemoteServer>(folder / "s", target);
  RemoteClient client(folder / "s");
  EXPECT_NE(client.ask("help", 5000ms).find("\"ok\":true"), std::string::npos);
  server.reset();
  EXPECT_THROW(client.ask("status", 5000ms), FileError);
}

}  // namespace
}  // namespace palpate::remote_client_test
