// The device's end of a line: a pseudo-terminal under a name of one's own, or a TCP port of this
// machine. Whoever opens the name is the client. Never waits: not for a client, not for one that
// doesn't read.
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
  // What a client opens: the link, /dev/pts/N, or tcp:127.0.0.1:PORT.
  virtual const std::string& name() const noexcept = 0;
  // A network port: bytes aren't lost when the client is slow, they wait.
  virtual bool isNetwork() const noexcept { return false; }
  // To be polled for input; -1 while unplugged. May change with each call of read(), write(),
  // plug().
  virtual int descriptor() const noexcept = 0;
  // Whether somebody can be there: a pty that is plugged, a TCP port with a client.
  virtual bool connected() const noexcept = 0;
  // Takes what has come, as far as it fits. Returns the number of bytes; 0: nothing.
  virtual std::size_t read(std::span<std::byte> into) = 0;
  // Returns how many bytes the system took; 0: nobody reads, or there is nobody.
  virtual std::size_t write(std::span<const std::byte> bytes) = 0;
  // Pulls the plug: the client sees a hang-up, the link is gone.
  virtual void unplug() noexcept = 0;
  // Plugs in again: a new pty under the same link, or the same TCP port. Throws DeviceError,
  // FileError.
  virtual void plug() = 0;
  // From time to time: a client that was killed leaves its claim on a tty behind, which is lifted
  // here.
  virtual void releaseStaleLock() noexcept {}
};

// A pseudo-terminal, raw before anybody opens it. `link`: a symbolic link to be made (empty: none),
// atomically; an existing one is replaced only when it points to a pty or to nothing. It is removed
// with the port. Throws FileError (something else has that name, no such folder), DeviceError (no
// pty to be had).
std::unique_ptr<PortServer> openPtyPort(std::filesystem::path link = {});
// Listens on 127.0.0.1 only; 0: any free port. One client at a time, a second one waits. Throws
// DeviceError.
std::unique_ptr<PortServer> openTcpPort(std::uint16_t port);
// "tcp:127.0.0.1:PORT" (or tcp:localhost:PORT), else the path of a link, empty for a pty without
// one. Throws as these two, and std::invalid_argument for another host or a bad port number.
std::unique_ptr<PortServer> openPortServer(const std::string& where);

}  // namespace palpate
