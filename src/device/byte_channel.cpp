#include "palpate/device/byte_channel.h"

#include <cerrno>
#include <filesystem>
#include <stdexcept>

#include <sys/stat.h>

#include "palpate/core/error.h"

#include "device/serial_port_channel.h"
#include "device/tcp_channel.h"
#include "device/tty_channel.h"

namespace palpate {
namespace {

[[noreturn]] void refuseKind(const std::string& port, const std::string& kind) {
  throw DeviceError(DeviceFault::kNotFound,
                    port,
                    "this is " + kind + ", not a port; name a serial port or tcp:HOST:PORT");
}

}  // namespace

std::unique_ptr<ByteChannel> openChannel(const std::string& port, const ChannelOptions& options) {
  if (options.baud < 50 || options.baud > 10'000'000)
    throw std::invalid_argument("baud must be 50..10000000, not " + std::to_string(options.baud));
  if (options.connectTimeout.count() < 0)
    throw std::invalid_argument("connectTimeout must not be negative");
  if (port.starts_with("tcp:")) return TcpChannel::open(port, options.connectTimeout);
  if (port.empty() || port.find('\0') != std::string::npos)
    throw DeviceError(DeviceFault::kNotFound,
                      port,
                      "this isn't the name of a port; name a serial port or tcp:HOST:PORT");
  struct stat info {};
  if (::stat(port.c_str(), &info) != 0) throwOpenError(errno, port);
  if (S_ISDIR(info.st_mode)) refuseKind(port, "a folder");
  if (S_ISREG(info.st_mode)) refuseKind(port, "a file");
  if (!S_ISCHR(info.st_mode)) refuseKind(port, "no serial line");
  // libserialport 0.1.1 only accepts the device's own name, neither links nor ptys.
  std::error_code failed;
  const std::string path = std::filesystem::canonical(port, failed).string();
  if (failed) throwOpenError(failed.value(), port);
  if (SerialPortChannel::knows(path)) return SerialPortChannel::open(path, port, options.baud);
  return TtyChannel::open(path, port);
}

}  // namespace palpate
