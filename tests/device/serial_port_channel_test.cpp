// Tests the code path with libserialport without a serial port: a pty under a name that passes its
// check of sysfs (a link reached by "/dev/../"), an ioctl() of this test that provides the modem
// lines a pty lacks, and a realpath() that leaves this name alone.
#include "device/serial_port_channel.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <string_view>

#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>

#include "palpate/core/error.h"

#include "device/pty_pair.h"
#include "testing/testing.h"

namespace {
std::atomic<int> exclusiveCalls = 0;
std::atomic<int> endedExclusive = 0;  // TIOCNXCL
std::atomic<int> changedLines = 0;    // changes of line settings and modem lines
std::atomic<bool> modemLines = true;

bool changesALine(unsigned long request) {
  constexpr unsigned long kTcsets2 = 0x402C542B;  // <asm/termbits.h> clashes with <termios.h>
  constexpr unsigned long kChanges[] = {
      TCSETS, TCSETSW, TCSETSF, TCSETA, TIOCMSET, TIOCMBIS, TIOCMBIC, TCFLSH, kTcsets2};
  return std::find(std::begin(kChanges), std::end(kChanges), request) != std::end(kChanges);
}
}  // namespace

// Replaces the C library's function in this program. Signature as in sys/ioctl.h.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (request == TIOCEXCL) ++exclusiveCalls;
  if (request == TIOCNXCL) ++endedExclusive;
  if (changesALine(request)) ++changedLines;
  const long result = ::syscall(SYS_ioctl, fd, request, argument);
  if (result == 0 || errno != ENOTTY || !modemLines) return static_cast<int>(result);
  if (request == TIOCMGET) {
    *static_cast<int*>(argument) = 0;
    return 0;
  }
  if (request == TIOCMSET || request == TIOCMBIS || request == TIOCMBIC) return 0;
  return static_cast<int>(result);
}

// What realpath() is for libserialport 0.1.2, which would follow the link to the pty; 0.1.1 follows
// none. NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" char* __realpath_chk(const char* path, char* resolved, std::size_t size) noexcept {
  const std::string_view name = path;
  if (!name.starts_with("/dev/../") || name.size() >= size) return ::realpath(path, resolved);
  name.copy(resolved, name.size());
  resolved[name.size()] = '\0';
  return resolved;
}

namespace palpate::serial_port_channel_test {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::PtyPair;
using testing::TemporaryFolder;
using testing::textBytes;

class SerialPortChannelTest : public ::testing::Test {
 protected:
  PtyPair pty;
  const TemporaryFolder folder;
  const std::string link = folder / "port";
  std::string path;  // as libserialport accepts it

  void SetUp() override {
    std::filesystem::create_symlink(pty.path(), link);
    path = "/dev/../../.." + link;
  }
  void TearDown() override { modemLines = true; }
  // The pty keeps its settings while this test holds its other end.
  termios settings() const {
    termios now{};
    ::tcgetattr(pty.slave(), &now);
    return now;
  }
};

TEST_F(SerialPortChannelTest, CarriesEveryByteBothWaysAtAnySpeed) {
  termios cooked = settings();
  cooked.c_iflag |= ISTRIP | IXON | IXOFF | ICRNL | PARMRK;
  cooked.c_cflag |= HUPCL | CRTSCTS | CSTOPB;
  cooked.c_lflag |= ICANON | ECHO | ISIG;
  ::tcsetattr(pty.slave(), TCSANOW, &cooked);
  Bytes all;
  for (int value = 0; value < 256; ++value) all.push_back(static_cast<std::byte>(value));
  for (const int baud : {115'200, 460'800, 921'600, 250'000, 9'600}) {
    const auto channel = SerialPortChannel::open(path, "hand", baud);
    EXPECT_EQ(channel->name(), "hand");
    channel->write(all);
    EXPECT_EQ(pty.receive(256, 1000), all) << baud;
    pty.send(all);
    Bytes got(256);
    std::size_t count = 0;
    while (count < 256) {
      const std::size_t piece = channel->read(std::span(got).subspan(count), 1000ms);
      ASSERT_GT(piece, 0u) << baud;
      count += piece;
    }
    EXPECT_EQ(got, all) << baud;
    EXPECT_EQ(pty.receive(0), Bytes{}) << "an echo";
  }
}

TEST_F(SerialPortChannelTest, SetsTheLineToEightBitsAndNothingElse) {
  termios before = settings();
  before.c_iflag |= ISTRIP | IXON | IXOFF;
  before.c_cflag |= HUPCL | CSTOPB | CRTSCTS;
  ::tcsetattr(pty.slave(), TCSANOW, &before);
  const auto channel = SerialPortChannel::open(path, "hand", 115'200);
  const termios now = settings();
  EXPECT_EQ(now.c_iflag & (ISTRIP | IXON | IXOFF | ICRNL | INLCR | IGNCR | INPCK | PARMRK), 0u);
  EXPECT_EQ(now.c_lflag & (ICANON | ECHO | ISIG | IEXTEN), 0u);
  EXPECT_EQ(now.c_oflag & OPOST, 0u);
  EXPECT_EQ(now.c_cflag & (HUPCL | CSTOPB | CRTSCTS | PARENB), 0u);
  EXPECT_EQ(now.c_cflag & (CS8 | CLOCAL | CREAD), tcflag_t{CS8 | CLOCAL | CREAD});
  EXPECT_EQ(::cfgetospeed(&now), speed_t{B115200});
}

TEST_F(SerialPortChannelTest, IsForOneProgramOnly) {
  const int calls = exclusiveCalls;
  auto channel = SerialPortChannel::open(path, "hand", 115'200);
  EXPECT_GT(exclusiveCalls, calls);  // libserialport 0.1.2 makes it exclusive, too
  try {
    SerialPortChannel::open(path, "other", 115'200);
    ADD_FAILURE() << "opened twice";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kBusy) << error.what();
  }
  channel->write(textBytes("mine"));
  EXPECT_EQ(pty.receive(4, 1000), textBytes("mine"));
  channel.reset();
  // No lock remains: any program may open the port, also one without flock.
  const int fd = ::open(pty.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  EXPECT_GE(fd, 0);
  EXPECT_EQ(::flock(fd, LOCK_EX | LOCK_NB), 0);
  ::close(fd);
  EXPECT_NO_THROW(SerialPortChannel::open(path, "hand", 115'200));
}

// C-A9: a port held by another program is left unchanged, including that program's lock.
TEST_F(SerialPortChannelTest, APortThatAnotherHoldsIsNotTouched) {
  const int fd = ::open(pty.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_GE(fd, 0);
  ASSERT_EQ(::flock(fd, LOCK_EX | LOCK_NB), 0);
  const int ended = endedExclusive;
  const int changed = changedLines;
  for (int i = 0; i < 3; ++i) {
    try {
      SerialPortChannel::open(path, "other", 9'600);
      ADD_FAILURE() << "opened twice";
    } catch (const DeviceError& error) {
      EXPECT_EQ(error.fault(), DeviceFault::kBusy) << error.what();
    }
  }
  EXPECT_EQ(endedExclusive, ended) << "the other program's exclusive lock was lifted";
  EXPECT_EQ(changedLines, changed) << "its line was changed";
  ::close(fd);
  { SerialPortChannel::open(path, "hand", 115'200); }
  EXPECT_GT(endedExclusive, ended) << "its own lock ends with it";
}

TEST_F(SerialPortChannelTest, NoticesThatTheAdapterWasPulled) {
  const auto channel = SerialPortChannel::open(path, "hand", 115'200);
  Bytes got(10);
  EXPECT_EQ(channel->read(got, 10ms), 0u);  // silence does not mean unplugged
  pty.unplug();
  for (int i = 0; i < 2; ++i) {
    try {
      channel->read(got, 5000ms);
      ADD_FAILURE() << "not noticed";
    } catch (const DeviceError& error) {
      EXPECT_EQ(error.fault(), DeviceFault::kDisconnected);
    }
  }
}

TEST_F(SerialPortChannelTest, KnowsOnlyWhatTheSystemLists) {
  EXPECT_FALSE(SerialPortChannel::knows(pty.path()));
  EXPECT_FALSE(SerialPortChannel::knows("/dev/null"));
  EXPECT_FALSE(SerialPortChannel::knows("/dev/serial/by-id/usb-none"));
}

TEST_F(SerialPortChannelTest, LeaksNothingWhenOpeningFails) {
  { SerialPortChannel::open(path, "hand", 115'200); }
  const std::size_t before = testing::openDescriptors();
  EXPECT_THROW(SerialPortChannel::open("/dev/ttyNONE7", "x", 115'200), DeviceError);
  modemLines = false;  // as on a device that is no serial port: libserialport fails half-way
  EXPECT_THROW(SerialPortChannel::open(path, "x", 115'200), DeviceError);
  modemLines = true;
  const auto holder = SerialPortChannel::open(path, "x", 115'200);
  const std::size_t held = testing::openDescriptors();
  for (int i = 0; i < 20; ++i)
    EXPECT_THROW(SerialPortChannel::open(path, "x", 115'200), DeviceError);
  EXPECT_EQ(testing::openDescriptors(), held);
  EXPECT_LE(held, before + 3);  // the port, its lock, the wake-up descriptor
}

}  // namespace
}  // namespace palpate::serial_port_channel_test
