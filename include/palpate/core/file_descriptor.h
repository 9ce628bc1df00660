// Owns a file descriptor of the operating system and closes it in its destructor.
#pragma once

#include <filesystem>
#include <utility>

namespace palpate {

// Movable owner of one descriptor.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) noexcept : fd_(fd) {}  // -1: none
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
  // Swaps the descriptors: `other` closes the one that this object owned.
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  int get() const noexcept { return fd_; }
  // Returns the descriptor and gives up its ownership: the caller closes it.
  int release() noexcept { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

// Opens a file for reading. A FIFO, on which opening might wait for ever, a device, which may have
// no end, and a folder are refused. Throws FileError (cannot be opened, with the reason; is a
// folder; is not a regular file).
FileDescriptor openRegularFile(const std::filesystem::path& path);

}  // namespace palpate
