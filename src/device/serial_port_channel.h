// Byte channel over a serial port of the machine or on USB, opened and configured by libserialport.
#pragma once

#include <string>

#include "device/descriptor_channel.h"

struct sp_port;

namespace palpate {

class SerialPortChannel final : public DescriptorChannel {
 public:
  // True where libserialport knows `path` ("/dev/ttyUSB0", no link).
  static bool knows(const std::string& path);
  // Opens `path`; `name` is used in messages.
  static std::unique_ptr<ByteChannel> open(const std::string& path,
                                           const std::string& name,
                                           int baud);
  ~SerialPortChannel() override;

 private:
  struct Closer {
    // True once the port is exclusive to this program; that ends when the port is closed.
    bool ours = false;
    void operator()(sp_port* port) const noexcept;
  };
  using Port = std::unique_ptr<sp_port, Closer>;
  SerialPortChannel(std::string name, int fd, Port port, FileDescriptor lock);
  // Lock on the port, taken before any setting is changed and released after port_; empty where
  // libserialport holds one.
  FileDescriptor lock_;
  Port port_;
};

}  // namespace palpate
