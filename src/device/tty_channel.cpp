#include "device/tty_channel.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr char kBusyText[] =
    "another program holds this port; close it there, or name another port";

}  // namespace

void throwOpenError(int error, const std::string& name) {
  switch (error) {
    case EACCES:
    case EPERM:
      throw DeviceError(DeviceFault::kNoPermission,
                        name,
                        "no permission to open this port; add yourself to the group dialout: "
                        "sudo adduser $USER dialout, then log in again");
    case EBUSY:
      throw DeviceError(DeviceFault::kBusy, name, kBusyText);
    case ENOENT:
    case ENOTDIR:
    case ELOOP:
      throw DeviceError(DeviceFault::kNotFound,
                        name,
                        "no such port: plug in the adapter, or check the name of the port");
    case ENXIO:
    case ENODEV:
    case EIO:
      throw DeviceError(
          DeviceFault::kNotFound,
          name,
          "nothing is plugged into this port; plug the adapter in, or name another port");
    default:
      throw DeviceError(
          DeviceFault::kNotFound,
          name,
          "can't be opened (" + std::generic_category().message(error) + "); name another port");
  }
}

void lockLine(int fd, const std::string& name) {
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) throw DeviceError(DeviceFault::kBusy, name, kBusyText);
    throwOpenError(errno, name);
  }
}

bool makeRaw(int fd) noexcept {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return false;
  ::cfmakeraw(
      &settings);  // no ISTRIP, IXON, ICRNL, OPOST, ECHO, ICANON, ISIG, IEXTEN; CS8, no PARENB
  settings.c_iflag &= ~static_cast<tcflag_t>(INPCK | IXOFF | IXANY | IUCLC | IMAXBEL);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  return ::tcsetattr(fd, TCSANOW, &settings) == 0;
}

TtyChannel::TtyChannel(std::string name, FileDescriptor fd, FileDescriptor lock)
    : DescriptorChannel(std::move(name), fd.get(), false),
      lock_(std::move(lock)),
      fd_(std::move(fd)) {}

std::unique_ptr<ByteChannel> TtyChannel::open(const std::string& path, const std::string& name) {
  FileDescriptor fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (fd.get() < 0) throwOpenError(errno, name);
  if (::isatty(fd.get()) != 1)
    throw DeviceError(DeviceFault::kNotFound,
                      name,
                      "this isn't a serial line; name a serial port or tcp:HOST:PORT");
  if (::tcgetsid(fd.get()) == ::getsid(0))
    throw DeviceError(
        DeviceFault::kBusy, name, "this is the terminal the program runs in; name another port");
  // Uses flock only: TIOCEXCL persists on a pty as long as its other end is open, so that a killed
  // program would lock out its own successor.
  FileDescriptor lock(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (lock.get() < 0) throwOpenError(errno, name);
  struct stat used {
  }, locked{};
  if (::fstat(fd.get(), &used) != 0 || ::fstat(lock.get(), &locked) != 0 ||
      used.st_rdev != locked.st_rdev || used.st_ino != locked.st_ino)
    throw DeviceError(DeviceFault::kNotFound, name, "the port changed while it was opened");
  lockLine(lock.get(), name);
  if (!makeRaw(fd.get())) throwOpenError(errno, name);
  ::tcflush(fd.get(), TCIFLUSH);
  return std::unique_ptr<ByteChannel>(new TtyChannel(name, std::move(fd), std::move(lock)));
}

}  // namespace palpate
