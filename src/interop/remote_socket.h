// Listening Unix domain socket under a path in the file system, and connections to it. Used by
// RemoteServer and RemoteClient.
#pragma once

#include <chrono>
#include <filesystem>
#include <utility>

#include <sys/types.h>

#include "palpate/core/file_descriptor.h"

namespace palpate {

// Non-blocking, mode 600. The destructor removes the path. A path left by a program that no longer
// listens is removed at the start.
class ListeningSocket {
 public:
  explicit ListeningSocket(std::filesystem::path path);  // throws FileError
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }
  FileDescriptor takeListener() noexcept { return std::move(socket_); }

 private:
  std::filesystem::path path_;
  FileDescriptor socket_;
  // Identifies our socket file: one created later at the same path isn't ours.
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

// Whether the program at the other end belongs to this user, or to root.
bool isOfThisUser(int socket) noexcept;

// Throws FileError with advice.
FileDescriptor connectTo(const std::filesystem::path& path);

}  // namespace palpate
