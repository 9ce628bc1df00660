// Base class of the byte channels on a file descriptor: waits for the descriptor and for an
// interruption at the same time.
#pragma once

#include <string>

#include <sys/types.h>

#include "palpate/core/file_descriptor.h"
#include "palpate/device/byte_channel.h"

namespace palpate {

// Reads and writes a non-blocking descriptor that the derived class opened and closes.
class DescriptorChannel : public ByteChannel {
 public:
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override;
  void write(std::span<const std::byte> bytes) override;
  void interrupt() noexcept override;
  const std::string& name() const noexcept override { return name_; }
  bool atEnd() const noexcept override { return atEnd_; }
  int descriptor() const noexcept override { return fd_; }

 protected:
  // `isSocket`: a read of no bytes is the end. Throws DeviceError when the system has no descriptor
  // left.
  DescriptorChannel(std::string name, int fd, bool isSocket);
  // Reads what is there, as ::read() does.
  virtual ssize_t receive(std::span<std::byte> into);

 private:
  std::size_t take(std::span<std::byte> into, short events);
  [[noreturn]] void gone(int error) const;

  std::string name_;
  int fd_;
  bool isSocket_;
  bool atEnd_ = false;
  FileDescriptor wake_;  // eventfd
};

}  // namespace palpate
