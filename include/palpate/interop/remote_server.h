// Server of the remote control: a Unix domain socket (AF_UNIX) that only its owner can open (mode
// 600); it is not reachable from other machines. It has a thread of its own. One request at a time
// is taken from each client and no more is read until it is answered, so that no client delays
// another client or the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <palpate/interop/remote_protocol.h>

namespace palpate {

// Where remote control stands unless another place is named: palpate-remote in $XDG_RUNTIME_DIR.
// Throws Error where that isn't set.
std::filesystem::path usualRemoteSocket();

struct RemoteServerOptions {
  std::size_t maxClients = 16;  // 1..1000
  // A client that has been silent for so long makes room for a new one when there are too many [s].
  double idleS = 60.0;
  // Told of every request but "status" and how it ended; on the server's thread. May be empty.
  std::function<void(const RemoteRequest&, const RemoteAnswer&)> onAnswer = {};
};

struct RemoteServerStats {
  std::size_t clients = 0;            // now
  std::uint64_t accepted = 0;         // clients, ever
  std::uint64_t rejectedClients = 0;  // too many, or another user
  std::uint64_t requests = 0;         // carried out, or being so
  std::uint64_t refused = 0;          // lines that were no request
};

class RemoteServer {
 public:
  // Listens from now on. What a program that was killed left at `socket` is taken away. Throws
  // FileError: another program listens there, something else has that name, no such folder, a name
  // longer than 107 bytes; std::invalid_argument. The target must outlive the server.
  RemoteServer(std::filesystem::path socket,
               RemoteTarget& target,
               RemoteServerOptions options = {});
  // Clients that wait are told "shutting_down"; the socket is gone.
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
