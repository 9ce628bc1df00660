// Byte channel over a TCP connection to a hand with a network port, or to an emulated hand. Never
// listens.
#pragma once

#include <string>

#include "device/descriptor_channel.h"

namespace palpate {

class TcpChannel final : public DescriptorChannel {
 public:
  // `name` is "tcp:HOST:PORT"; HOST is a name, an IPv4 address, or an IPv6 address (brackets
  // allowed).
  static std::unique_ptr<ByteChannel> open(const std::string& name,
                                           std::chrono::milliseconds connectTimeout);
  // Makes a channel of a connection that the other side opened.
  static std::unique_ptr<ByteChannel> accepted(const std::string& name, FileDescriptor connection);
  bool isNetwork() const noexcept override { return true; }

 private:
  TcpChannel(std::string name, FileDescriptor fd);
  FileDescriptor fd_;
};

}  // namespace palpate
