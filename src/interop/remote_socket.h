// A listening socket under a name in the file system, and connections to it.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include <sys/types.h>

#include "palpate/core/file_descriptor.h"

namespace palpate {

// Non-blocking, mode 600, listening; the name goes with it. What nobody listens at any more is
// taken away.
class ListeningSocket {
 public:
  explicit ListeningSocket(std::filesystem::path path);  // throws FileError
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  int descriptor() const noexcept { return socket_.get(); }
  const std::filesystem::path& path() const noexcept { return path_; }
  // The next client, non-blocking; -1: none (errno says why). One of another user is turned away:
  // -1, errno EACCES.
  FileDescriptor accept() const;

 private:
  std::filesystem::path path_;
  FileDescriptor socket_;
  dev_t device_ = 0;  // of the name: another one that came in its place isn't ours
  ino_t inode_ = 0;
};

// Throws FileError with what to do.
FileDescriptor connectTo(const std::filesystem::path& path);

}  // namespace palpate
