#include "palpate/emulator/port_server.h"

#include <array>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "emulator/line_client.h"
#include "testing/testing.h"

namespace palpate::port_server_test {
namespace {
namespace fs = std::filesystem;

using namespace std::chrono_literals;
using testing::LineClient;
using testing::TemporaryFolder;

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string readAll(PortServer& port, std::size_t bytes) {
  std::string all;
  const auto end = std::chrono::steady_clock::now() + 2s;
  while (all.size() < bytes && std::chrono::steady_clock::now() < end) {
    std::array<std::byte, 256> buffer{};
    const std::size_t n = port.read(buffer);
    for (std::size_t i = 0; i < n; ++i) all += std::to_integer<char>(buffer[i]);
  }
  return all;
}

std::string text(const testing::Octets& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(PortServer, APtyIsRawBeforeAnybodyOpensIt) {
  const auto port = openPtyPort();
  // Written before a client opens the port: neither echoed back nor changed.
  const std::string all = "\x1B[5n\r\n\x03\x04\x11\x13\xAA\xFF";
  EXPECT_EQ(port->write(bytesOf(all)), all.size());
  LineClient client(port->name());
  EXPECT_EQ(text(client.receiveExactly(all.size())), all);
  std::array<std::byte, 16> echo{};
  EXPECT_EQ(port->read(echo), 0u);
  client.send(all);
  EXPECT_EQ(readAll(*port, all.size()), all);
}

TEST(PortServer, OutlivesItsClients) {
  const auto port = openPtyPort();
  for (int i = 0; i < 3; ++i) {
    LineClient client(port->name());
    client.send("hello");
    EXPECT_EQ(readAll(*port, 5), "hello");
  }
  std::array<std::byte, 16> nothing{};
  EXPECT_EQ(port->read(nothing), 0u);
  EXPECT_TRUE(port->connected());
}

TEST(PortServer, NeverWaitsForAReader) {
  const auto port = openPtyPort();
  const std::string piece(1000, 'x');
  std::size_t taken = 0;
  for (int i = 0; i < 1000; ++i) taken += port->write(bytesOf(piece));
  EXPECT_GT(taken, 1000u);
  EXPECT_LT(taken, 200'000u);
}

TEST(PortServer, LinksAppearAndGoWithThePort) {
  const TemporaryFolder folder;
  const fs::path link = folder / "hand";
  {
    const auto port = openPtyPort(link);
    EXPECT_EQ(port->name(), link);
    EXPECT_TRUE(fs::is_character_file(fs::status(link)));
    LineClient client(link);
    client.send("x");
    EXPECT_EQ(readAll(*port, 1), "x");
  }
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(link)));
}

TEST(PortServer, ReplacesOnlyLinksToPortsAndToNothing) {
  const TemporaryFolder folder;
  fs::create_symlink(folder / "gone", folder / "dangling");
  EXPECT_NO_THROW(openPtyPort(folder / "dangling"));
  const auto first = openPtyPort(folder / "link");
  const fs::path firstTarget = fs::read_symlink(folder / "link");
  {
    const auto second = openPtyPort(folder / "link");
    EXPECT_NE(fs::read_symlink(folder / "link"), firstTarget);
    // The first port does not remove the link of the second one.
    first->unplug();
    EXPECT_TRUE(fs::is_symlink(fs::symlink_status(folder / "link")));
  }
  testing::writeFile(folder / "file", "precious");
  fs::create_symlink(folder / "file", folder / "to_file");
  fs::create_symlink("/dev/null", folder / "to_null");
  fs::create_directory(folder / "folder");
  for (const char* name : {"file", "to_file", "to_null", "folder"})
    EXPECT_THROW(openPtyPort(folder / name), FileError) << name;
  EXPECT_EQ(testing::readFile(folder / "file"), "precious");
  EXPECT_EQ(fs::read_symlink(folder / "to_file"), folder / "file");
  EXPECT_THROW(openPtyPort(folder / "nowhere" / "link"), FileError);
}

TEST(PortServer, UnpluggingIsAHangUpAndPluggingANewPortOfTheSameName) {
  const TemporaryFolder folder;
  const auto port = openPtyPort(folder / "hand");
  LineClient client(folder / "hand");
  port->unplug();
  EXPECT_FALSE(port->connected());
  EXPECT_EQ(port->descriptor(), -1);
  EXPECT_EQ(port->write(bytesOf("lost")), 0u);
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(folder / "hand")));
  client.receive(1000ms);
  EXPECT_TRUE(client.hungUp());
  port->plug();
  LineClient again(folder / "hand");
  EXPECT_EQ(port->write(bytesOf("back")), 4u);
  EXPECT_EQ(text(again.receiveExactly(4)), "back");
}

// TIOCEXCL left by a killed client would lock out every program except root.
TEST(PortServer, LiftsTheClaimOfAClientThatIsGone) {
  const auto port = openPtyPort();
  const int client = ::open(port->name().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(client, 0);
  ASSERT_EQ(::ioctl(client, TIOCEXCL), 0);
  ::close(client);
  port->releaseStaleLock();
  const int next = ::open(port->name().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(next, 0);
  int exclusive = 1;
  EXPECT_EQ(::ioctl(next, TIOCGEXCL, &exclusive), 0);
  EXPECT_EQ(exclusive, 0);
  ::close(next);
}

TEST(PortServer, ListensOnTcpForOneClientAtATime) {
  const auto port = openTcpPort(0);
  EXPECT_TRUE(port->isNetwork());
  EXPECT_TRUE(port->name().starts_with("tcp:127.0.0.1:"));
  EXPECT_FALSE(port->connected());
  EXPECT_EQ(port->write(bytesOf("to nobody")), 0u);
  {
    LineClient client(port->name());
    client.send("hello");
    EXPECT_EQ(readAll(*port, 5), "hello");
    EXPECT_TRUE(port->connected());
    EXPECT_EQ(port->write(bytesOf("hello")), 5u);
    EXPECT_EQ(text(client.receiveExactly(5)), "hello");
    LineClient second(port->name());
    second.send("wait");
    EXPECT_EQ(readAll(*port, 0), "");
    client.send("!");
    EXPECT_EQ(readAll(*port, 1), "!");
  }
  LineClient third(port->name());
  third.send("third");
  EXPECT_EQ(readAll(*port, 9), "waitthird");
}

TEST(PortServer, ATcpPortInUseIsRefused) {
  const auto port = openTcpPort(0);
  try {
    openPortServer(port->name());
    FAIL() << "two listeners on one port";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kBusy);
  }
}

TEST(PortServer, NamesChooseTheKind) {
  const TemporaryFolder folder;
  EXPECT_TRUE(openPortServer("tcp:127.0.0.1:0")->isNetwork());
  EXPECT_TRUE(openPortServer("tcp:localhost:0")->isNetwork());
  EXPECT_FALSE(openPortServer(folder / "x")->isNetwork());
  EXPECT_TRUE(openPortServer("")->name().starts_with("/dev/pts/"));
  for (const char* name : {"tcp:",
                           "tcp:127.0.0.1",
                           "tcp:127.0.0.1:",
                           "tcp:127.0.0.1:70000",
                           "tcp:127.0.0.1:-1",
                           "tcp:0.0.0.0:5000",
                           "tcp:192.168.1.42:23",
                           "tcp:example.org:1",
                           "tcp::5"})
    EXPECT_THROW(openPortServer(name), std::invalid_argument) << name;
}

}  // namespace
}  // namespace palpate::port_server_test
