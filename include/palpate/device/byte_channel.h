// A line to a device: bytes in, bytes out. Behind it lies a serial port (libserialport), a pty or
// other tty (termios), or a TCP connection.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace palpate {

// One thread reads and writes; only interrupt() may be called from another one.
class ByteChannel {
 public:
  virtual ~ByteChannel() = default;
  // Waits until at least one byte is there, at most `timeout` (0: doesn't wait), and takes what is
  // there as far as it fits. Returns the number of bytes; 0: nothing came, or interrupt() was
  // called. Throws DeviceError (kDisconnected) when the other end is gone.
  virtual std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) = 0;
  // Hands all bytes to the system, in one piece where it takes them so. Throws DeviceError
  // (kDisconnected; kSilent: the line took no byte for a second).
  virtual void write(std::span<const std::byte> bytes) = 0;
  // Ends a read() that waits, or the next one, once. Safe from any thread.
  virtual void interrupt() noexcept = 0;
  // As the caller named it ("/dev/serial/by-id/usb-FTDI..", "tcp:192.168.1.42:13000").
  virtual const std::string& name() const noexcept = 0;
  // A network connection: the SDH-2 then sends and expects binary records without a checksum.
  virtual bool isNetwork() const noexcept { return false; }
};

struct ChannelOptions {
  // Serial ports, 50..10,000,000: 8 data bits, no parity, 1 stop bit, no flow control. Ptys have
  // none.
  int baud = 115'200;
  std::chrono::milliseconds connectTimeout{2000};  // TCP, resolving the name included
};

// Opens a port by name: a serial device, a /dev/serial/by-id name, a pty path (links are followed),
// or tcp:HOST:PORT (an IPv6 address may stand in brackets; default ports: none). Exclusive: a
// second program is refused (flock; serial ports TIOCEXCL, too). What lies in the input is
// discarded. Throws DeviceError: kNotFound (also: no connection), kNoPermission (hint: group
// dialout), kBusy, kUnsupported (the port knows no such speed); std::invalid_argument: options out
// of range.
std::unique_ptr<ByteChannel> openChannel(const std::string& port,
                                         const ChannelOptions& options = {});

}  // namespace palpate
