#include "palpate/device/byte_channel.h"

#include <atomic>
#include <functional>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "palpate/core/error.h"

#include "device/pty_pair.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::byte_channel_test {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;
using testing::Bytes;
using testing::PtyPair;
using testing::TemporaryFolder;
using testing::textBytes;

Bytes allBytes() {
  Bytes bytes;
  for (int value = 0; value < 256; ++value) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

Bytes readExactly(ByteChannel& channel, std::size_t count) {
  Bytes all;
  Bytes piece(100);
  const auto deadline = SteadyClock::now() + 5s;
  while (all.size() < count && SteadyClock::now() < deadline) {
    const std::size_t got = channel.read(piece, 100ms);
    all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got));
  }
  return all;
}

// The fault of the DeviceError that `attempt` throws; its message must name the port.
DeviceFault faultOf(const std::string& port,
                    const std::function<void()>& attempt,
                    const std::string& words = "") {
  try {
    attempt();
  } catch (const DeviceError& error) {
    EXPECT_EQ(std::string(error.what()).find(port), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    return error.fault();
  }
  ADD_FAILURE() << "no error for " << port;
  return DeviceFault::kUnsupported;
}

// Listens on a free loopback port for one connection.
class Listener {
 public:
  explicit Listener(int family = AF_INET) {
    fd_ = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    six.sin6_addr = in6addr_loopback;
    sockaddr_in four{};
    four.sin_family = AF_INET;
    four.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool isSix = family == AF_INET6;
    usable_ = fd_ >= 0 &&
              ::bind(fd_,
                     isSix ? reinterpret_cast<sockaddr*>(&six) : reinterpret_cast<sockaddr*>(&four),
                     isSix ? sizeof six : sizeof four) == 0 &&
              ::listen(fd_, 1) == 0;
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&bound), &size);
    port_ = ntohs(isSix ? reinterpret_cast<sockaddr_in6*>(&bound)->sin6_port
                        : reinterpret_cast<sockaddr_in*>(&bound)->sin_port);
  }
  ~Listener() { close(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  void close() {
    hangUp();
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  void accept() { peer_ = ::accept(fd_, nullptr, nullptr); }
  void hangUp() {
    if (peer_ >= 0) ::close(peer_);
    peer_ = -1;
  }
  bool usable() const { return usable_; }
  int peer() const { return peer_; }
  std::string number() const { return std::to_string(port_); }

 private:
  int fd_ = -1;
  int peer_ = -1;
  bool usable_ = false;
  unsigned port_ = 0;
};

TEST(ByteChannel, CarriesEveryByteBothWaysOverAPtyWhateverWasSetBefore) {
  PtyPair pty;
  termios cooked{};
  ::tcgetattr(pty.slave(), &cooked);
  cooked.c_iflag |= ISTRIP | ICRNL | IXON | INLCR;
  cooked.c_oflag |= OPOST | ONLCR;
  cooked.c_lflag |= ICANON | ECHO | ISIG;
  ::tcsetattr(pty.slave(), TCSANOW, &cooked);
  const auto channel = openChannel(pty.path());
  EXPECT_EQ(channel->name(), pty.path());
  EXPECT_FALSE(channel->isNetwork());
  channel->write(allBytes());
  EXPECT_EQ(pty.receive(256, 1000), allBytes());
  pty.send(allBytes());
  EXPECT_EQ(readExactly(*channel, 256), allBytes());
  EXPECT_EQ(pty.receive(0), Bytes{}) << "an echo";
}

TEST(ByteChannel, FollowsLinksAndKeepsTheNameItWasGiven) {
  PtyPair pty;
  const TemporaryFolder folder;
  const std::string link = folder / "hand";
  std::filesystem::create_symlink(pty.path(), link);
  const auto channel = openChannel(link);
  EXPECT_EQ(channel->name(), link);
  channel->write(textBytes("ver\r\n"));
  EXPECT_EQ(pty.receive(5, 1000), textBytes("ver\r\n"));
}

TEST(ByteChannel, DiscardsWhatLayInTheInput) {
  PtyPair pty;
  pty.send(textBytes("left over from somebody else"));
  const auto channel = openChannel(pty.path());
  pty.send(textBytes("new"));
  EXPECT_EQ(readExactly(*channel, 3), textBytes("new"));
}

TEST(ByteChannel, WaitsAsLongAsToldAndTakesOnlyWhatFits) {
  PtyPair pty;
  const auto channel = openChannel(pty.path());
  Bytes buffer(4);
  const auto start = SteadyClock::now();
  EXPECT_EQ(channel->read(buffer, 30ms), 0u);
  EXPECT_GE(SteadyClock::now() - start, 29ms);
  EXPECT_EQ(channel->read(buffer, 0ms), 0u);
  pty.send(textBytes("123456"));
  EXPECT_EQ(readExactly(*channel, 6), textBytes("123456"));
}

TEST(ByteChannel, AnInterruptionEndsAWaitingReadWithinMilliseconds) {
  PtyPair pty;
  const auto channel = openChannel(pty.path());
  Bytes buffer(4);
  SteadyClock::time_point called;
  std::atomic<bool> reading = false;
  std::thread other([&] {
    while (!reading) std::this_thread::yield();
    called = SteadyClock::now();
    channel->interrupt();
  });
  reading = true;
  EXPECT_EQ(channel->read(buffer, 10s), 0u);
  const auto late = SteadyClock::now();
  other.join();
  EXPECT_LT(late - called, testing::timeLimit<std::chrono::nanoseconds>(100ms));
}

TEST(ByteChannel, AnInterruptionEndsTheNextReadOnceOnly) {
  PtyPair pty;
  const auto channel = openChannel(pty.path());
  Bytes buffer(4);
  channel->interrupt();
  channel->interrupt();
  const auto start = SteadyClock::now();
  EXPECT_EQ(channel->read(buffer, 10s), 0u);
  EXPECT_LT(SteadyClock::now() - start, 1s);
  const auto again = SteadyClock::now();
  EXPECT_EQ(channel->read(buffer, 30ms), 0u);
  EXPECT_GE(SteadyClock::now() - again, 29ms);
}

TEST(ByteChannel, NoticesThatTheOtherEndIsGone) {
  PtyPair pty;
  const auto channel = openChannel(pty.path());
  Bytes buffer(4);
  std::thread other([&] { pty.unplug(); });
  const auto start = SteadyClock::now();
  EXPECT_EQ(faultOf(pty.path(), [&] { channel->read(buffer, 10s); }), DeviceFault::kDisconnected);
  EXPECT_LT(SteadyClock::now() - start, testing::timeLimit<std::chrono::nanoseconds>(500ms));
  other.join();
  EXPECT_EQ(faultOf(pty.path(), [&] { channel->read(buffer, 0ms); }), DeviceFault::kDisconnected);
  EXPECT_EQ(faultOf(pty.path(), [&] { channel->write(textBytes("x")); }),
            DeviceFault::kDisconnected);
}

TEST(ByteChannel, AWriteThatNobodyTakesEndsAfterASecond) {
  PtyPair pty;
  const auto channel = openChannel(pty.path());
  const auto start = SteadyClock::now();
  EXPECT_EQ(faultOf(pty.path(), [&] { channel->write(Bytes(1'000'000)); }), DeviceFault::kSilent);
  EXPECT_GE(SteadyClock::now() - start, 900ms);
  EXPECT_LT(SteadyClock::now() - start, 3s);
}

TEST(ByteChannel, TwoProgramsDontShareAPort) {
  PtyPair pty;
  const TemporaryFolder folder;
  const std::string link = folder / "hand";
  std::filesystem::create_symlink(pty.path(), link);
  auto channel = openChannel(pty.path());
  EXPECT_EQ(faultOf(
                link, [&] { openChannel(link); }, "another program"),
            DeviceFault::kBusy);
  channel->write(textBytes("still mine"));
  EXPECT_EQ(pty.receive(10, 1000), textBytes("still mine"));
  channel.reset();
  EXPECT_NO_THROW(openChannel(link));
}

TEST(ByteChannel, RefusesWhatIsNoPort) {
  const TemporaryFolder folder;
  const std::string file = folder / "file";
  testing::writeFile(file, "x");
  const std::string dangling = folder / "dangling";
  std::filesystem::create_symlink("/nowhere/at/all", dangling);
  const std::string here = folder.path();
  const auto fault = [](const std::string& port, const std::string& words) {
    return faultOf(
        port, [&] { openChannel(port); }, words);
  };
  EXPECT_EQ(fault(file, "file"), DeviceFault::kNotFound);
  EXPECT_EQ(fault(here, "folder"), DeviceFault::kNotFound);
  EXPECT_EQ(fault(dangling, "plug in the adapter"), DeviceFault::kNotFound);
  EXPECT_EQ(fault("/dev/null", "isn't a serial line"), DeviceFault::kNotFound);
  EXPECT_EQ(fault("/dev/ttyNONE9", "plug in the adapter"), DeviceFault::kNotFound);
  EXPECT_EQ(fault("", "isn't the name of a port"), DeviceFault::kNotFound);
  EXPECT_EQ(testing::readFile(file), "x");
}

TEST(ByteChannel, RefusesOptionsThatMeanNothing) {
  PtyPair pty;
  for (const int baud : {0, -115'200, 49, 100'000'000})
    EXPECT_THROW(openChannel(pty.path(), {.baud = baud}), std::invalid_argument) << baud;
  EXPECT_THROW(openChannel("tcp:localhost:1", {.connectTimeout = -1ms}), std::invalid_argument);
}

TEST(ByteChannel, SaysWhatToDoWithoutPermission) {
  PtyPair pty;
  ::fchmod(pty.slave(), 0);
  // root may open everything: acts as another user for a moment
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(65'534), 0);
  }
  EXPECT_EQ(faultOf(
                pty.path(), [&] { openChannel(pty.path()); }, "sudo adduser $USER dialout"),
            DeviceFault::kNoPermission);
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
}

TEST(ByteChannel, CarriesEveryByteBothWaysOverTheNetwork) {
  for (const int family : {AF_INET, AF_INET6}) {
    Listener listener(family);
    if (!listener.usable() && family == AF_INET6) continue;  // no IPv6 on this machine
    const std::string name =
        (family == AF_INET ? "tcp:127.0.0.1:" : "tcp:[::1]:") + listener.number();
    const auto channel = openChannel(name);
    listener.accept();
    EXPECT_TRUE(channel->isNetwork());
    EXPECT_EQ(channel->name(), name);
    channel->write(allBytes());
    Bytes got(256);
    ASSERT_EQ(::recv(listener.peer(), got.data(), got.size(), MSG_WAITALL), 256);
    EXPECT_EQ(got, allBytes());
    ASSERT_EQ(::send(listener.peer(), got.data(), got.size(), 0), 256);
    EXPECT_EQ(readExactly(*channel, 256), allBytes());
    listener.hangUp();
    EXPECT_EQ(faultOf(name, [&] { channel->read(got, 5s); }), DeviceFault::kDisconnected);
    EXPECT_EQ(faultOf(name,
                      [&] {
                        channel->write(allBytes());  // the first one may still be accepted
                        channel->write(allBytes());
                        channel->read(got, 5s);
                      }),
              DeviceFault::kDisconnected);
  }
}

// A connection that the other side closed has ended; one that it reset was lost.
TEST(ByteChannel, TellsAnEndFromAReset) {
  for (const bool resets : {false, true}) {
    Listener listener;
    const std::string name = "tcp:127.0.0.1:" + listener.number();
    const auto channel = openChannel(name);
    listener.accept();
    EXPECT_FALSE(channel->atEnd());
    const linger atOnce{1, 0};
    if (resets) ::setsockopt(listener.peer(), SOL_SOCKET, SO_LINGER, &atOnce, sizeof atOnce);
    listener.hangUp();
    Bytes got(1);
    EXPECT_EQ(faultOf(name, [&] { channel->read(got, 5s); }), DeviceFault::kDisconnected);
    EXPECT_EQ(channel->atEnd(), !resets);
  }
}

TEST(ByteChannel, ResolvesHostNames) {
  Listener listener;
  const auto channel = openChannel("tcp:localhost:" + listener.number());
  listener.accept();
  channel->write(textBytes("hello"));
  Bytes got(5);
  EXPECT_EQ(::recv(listener.peer(), got.data(), got.size(), MSG_WAITALL), 5);
}

TEST(ByteChannel, SaysWhatIsWrongWithANetworkName) {
  Listener listener;
  const std::string closed = "tcp:127.0.0.1:" + listener.number();
  listener.close();
  EXPECT_EQ(faultOf(
                closed, [&] { openChannel(closed); }, "is the hand on"),
            DeviceFault::kNotFound);
  for (const char* name : {"tcp:",
                           "tcp:127.0.0.1",
                           "tcp:127.0.0.1:",
                           "tcp::23",
                           "tcp:host:0",
                           "tcp:host:65536",
                           "tcp:host:x",
                           "tcp:host:-1"})
    EXPECT_EQ(faultOf(
                  name, [&] { openChannel(name); }, "tcp:HOST:PORT"),
              DeviceFault::kNotFound);
}

TEST(ByteChannel, LeaksNoDescriptor) {
  PtyPair pty;
  Listener listener;
  { openChannel(pty.path()); }
  const std::size_t before = testing::openDescriptors();
  for (int i = 0; i < 50; ++i) {
    const auto channel = openChannel(pty.path());
    EXPECT_THROW(openChannel(pty.path()), DeviceError);
    EXPECT_THROW(openChannel("/dev/null"), DeviceError);
    const auto network = openChannel("tcp:127.0.0.1:" + listener.number());
    listener.accept();
    listener.hangUp();
  }
  EXPECT_EQ(testing::openDescriptors(), before);
}

}  // namespace
}  // namespace palpate::byte_channel_test
