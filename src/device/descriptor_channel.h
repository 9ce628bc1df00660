// What all channels share: waiting on a file descriptor and on an interruption at the same time.
#pragma once

#include <string>

#include "palpate/device/byte_channel.h"

namespace palpate {

// A descriptor that closes itself.
class OwnedDescriptor {
 public:
  explicit OwnedDescriptor(int fd = -1) noexcept : fd_(fd) {}
  ~OwnedDescriptor();
  OwnedDescriptor(OwnedDescriptor&& other) noexcept : fd_(other.release()) {}
  OwnedDescriptor(const OwnedDescriptor&) = delete;
  OwnedDescriptor& operator=(const OwnedDescriptor&) = delete;
  int get() const noexcept { return fd_; }
  int release() noexcept {
    const int fd = fd_;
    fd_ = -1;
    return fd;
  }

 private:
  int fd_;
};

// Reads and writes a non-blocking descriptor that the derived class opened and closes.
class DescriptorChannel : public ByteChannel {
 public:
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override;
  void write(std::span<const std::byte> bytes) override;
  void interrupt() noexcept override;
  const std::string& name() const noexcept override { return name_; }

 protected:
  // Throws DeviceError when the system has no descriptor left.
  DescriptorChannel(std::string name, int fd, bool isSocket);

 private:
  std::size_t take(std::span<std::byte> into, short events);
  [[noreturn]] void gone(int error) const;

  std::string name_;
  int fd_;
  bool isSocket_;
  OwnedDescriptor wake_;  // eventfd
};

}  // namespace palpate
