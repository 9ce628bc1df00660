// The device's end of an emulated line: a pseudo-terminal under a chosen name, or a TCP port of
// this machine. The program that opens the name is the client. No function waits for a client or
// for a client to read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace palpate {

// Not thread-safe.
class PortServer {
 public:
  virtual ~PortServer() = default;  // unplugs
  // The name for a client to open: the link, /dev/pts/N, or tcp:127.0.0.1:PORT.
  virtual const std::string& name() const noexcept = 0;
  // True for a network port, where bytes for a slow client wait and are not lost.
  virtual bool isNetwork() const noexcept { return false; }
  // File descriptor to be polled for input; -1 while unplugged. Every call of read(), write() and
  // plug() may change it.
  virtual int descriptor() const noexcept = 0;
  // True if a client can be present: a plugged pty, or a TCP port with a client.
  virtual bool connected() const noexcept = 0;
  // Reads the bytes that arrived, as many as fit. Returns their number, possibly 0.
  virtual std::size_t read(std::span<std::byte> into) = 0;
  // Returns how many bytes the system accepted; 0 when no client is present or reading.
  virtual std::size_t write(std::span<const std::byte> bytes) = 0;
  // Disconnects: the client sees a hang-up, and the link is removed.
  virtual void unplug() noexcept = 0;
  // Connects again: a new pty under the same link, or the same TCP port. Throws DeviceError,
  // FileError.
  virtual void plug() = 0;
  // Removes the lock on a tty that a killed client left. Call this from time to time.
  virtual void releaseStaleLock() noexcept {}
};

// Opens a pseudo-terminal in raw mode. `link` is a symbolic link to create atomically (empty:
// none); an existing one is replaced only when it points to a pty or to nothing. It is removed with
// the port. Throws FileError (another file has that name, no such folder), DeviceError (no pty
// available).
std::unique_ptr<PortServer> openPtyPort(std::filesystem::path link = {});
// Listens on 127.0.0.1 only; 0 chooses any free port. Serves one client at a time, a second one
// waits. Throws DeviceError.
std::unique_ptr<PortServer> openTcpPort(std::uint16_t port);
// `where`: "tcp:127.0.0.1:PORT" (or tcp:localhost:PORT), else the path of a link, or empty for a
// pty without a link. Throws as the two functions above, and std::invalid_argument for another host
// or an invalid port number.
std::unique_ptr<PortServer> openPortServer(const std::string& where);

}  // namespace palpate
