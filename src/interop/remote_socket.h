// Listening Unix domain socket under a path in the file system, and connections to it. Used by
// RemoteServer and RemoteClient.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

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
  int descriptor() const noexcept { return socket_.get(); }
  const std::filesystem::path& path() const noexcept { return path_; }
  // The next client, non-blocking; -1: none (errno contains the reason). A client of another user
  // is rejected: -1, errno EACCES.
  FileDescriptor accept() const;

 private:
  std::filesystem::path path_;
  FileDescriptor socket_;
  // Identifies our socket file: one created later at the same path isn't ours.
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

// Throws FileError with advice.
FileDescriptor connectTo(const std::filesystem::path& path);

}  // namespace palpate
