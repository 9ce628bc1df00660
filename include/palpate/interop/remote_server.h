// Server of remote control: a Unix domain socket (AF_UNIX) that only its owner can open (mode 600);
// it is not reachable from other machines. It runs on a thread of its own. It reads the next
// request of a client only when the previous one is answered, so that no client delays another
// client or the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <palpate/interop/remote_protocol.h>

namespace palpate {

// Default path of the socket: palpate-remote in $XDG_RUNTIME_DIR. Throws Error if that isn't set.
std::filesystem::path usualRemoteSocket();

struct RemoteServerOptions {
  std::size_t maxClients = 16;  // 1..1000
  // When there are too many clients, one that was silent for this time is replaced by a new one
  // [s].
  double idleS = 60.0;
  // Called with every request except "status" and its answer, on the server's thread. May be empty.
  std::function<void(const RemoteRequest&, const RemoteAnswer&)> onAnswer = {};
};

struct RemoteServerStats {
  std::size_t clients = 0;            // connected now
  std::uint64_t accepted = 0;         // clients since the start
  std::uint64_t rejectedClients = 0;  // too many clients, or another user
  std::uint64_t requests = 0;         // executed or being executed
  std::uint64_t refused = 0;          // lines that were no valid request
};

class RemoteServer {
 public:
  // Starts listening. A socket left at `socket` by a killed program is removed. Throws FileError
  // (another program listens there, another file has that name, no such folder, a name longer than
  // 107 bytes), std::invalid_argument. The target must outlive the server.
  RemoteServer(std::filesystem::path socket,
               RemoteTarget& target,
               RemoteServerOptions options = {});
  // Answers waiting clients with "shutting_down" and removes the socket.
  ~RemoteServer();
  RemoteServer(const RemoteServer&) = delete;
  RemoteServer& operator=(const RemoteServer&) = delete;

  const std::filesystem::path& socket() const noexcept;
  RemoteServerStats stats() const;  // from any thread

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
