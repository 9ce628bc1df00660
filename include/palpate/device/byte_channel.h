// Byte channel to a device: reads and writes raw bytes over a serial port (libserialport), a pty or
// other tty (termios), or a TCP connection. The drivers of both controllers work on this interface.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace palpate {

// One thread reads and writes; only interrupt() may be called from another thread.
class ByteChannel {
 public:
  virtual ~ByteChannel() = default;
  // Waits at most `timeout` (0: does not wait) until at least one byte is available, then copies as
  // many bytes as fit into `into`. Returns the number of bytes; 0 when none arrived or interrupt()
  // was called. Throws DeviceError (kDisconnected) when the other end is gone.
  virtual std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) = 0;
  // Hands all bytes to the system, in one call if the system accepts them all at once. Throws
  // DeviceError (kDisconnected; kSilent when the line accepts no byte for one second).
  virtual void write(std::span<const std::byte> bytes) = 0;
  // Ends the read() that is waiting, or else the next read(), once. Safe from any thread.
  virtual void interrupt() noexcept = 0;
  // The port's name as the caller gave it ("/dev/serial/by-id/usb-FTDI..",
  // "tcp:192.168.1.42:13000").
  virtual const std::string& name() const noexcept = 0;
  // True for a network connection: the SDH-2 then sends and expects binary records without a
  // checksum.
  virtual bool isNetwork() const noexcept { return false; }
  // True when each read() returns one datagram at most, from its beginning; a buffer of 64 KiB
  // takes any.
  virtual bool isDatagrams() const noexcept { return false; }
  // True once read() found that the other side ended the stream in order: a connection that it
  // closed, the end of standard input. Not after an error, and never of datagrams.
  virtual bool atEnd() const noexcept { return false; }
  // The descriptor of the port, for who writes to it when this process has died (LastStop); -1:
  // none. The channel owns it; a duplicate does not hold the lock on the port.
  virtual int descriptor() const noexcept { return -1; }
};

struct ChannelOptions {
  // Speed of a serial port [baud], 50..10,000,000; always 8 data bits, no parity, 1 stop bit, no
  // flow control. A pty has no speed.
  int baud = 115'200;
  // Time limit for a TCP connection, including the lookup of the host name.
  std::chrono::milliseconds connectTimeout{2000};
};

// Opens a port by name: a serial device, a /dev/serial/by-id name, a pty path (links are followed),
// or tcp:HOST:PORT (an IPv6 address may be in brackets; there is no default TCP port). The port is
// opened exclusively: a second program is refused (by flock; on serial ports by TIOCEXCL, too).
// Bytes that wait in the input are discarded. Throws DeviceError: kNotFound (also when no
// connection is possible), kNoPermission (with a hint at the group dialout), kBusy, kUnsupported
// (the port does not support this speed); throws std::invalid_argument for options out of range.
std::unique_ptr<ByteChannel> openChannel(const std::string& port,
                                         const ChannelOptions& options = {});

}  // namespace palpate
