// A serial port of the machine or on USB, opened and set by libserialport.
#pragma once

#include <string>

#include "device/descriptor_channel.h"

struct sp_port;

namespace palpate {

class SerialPortChannel final : public DescriptorChannel {
 public:
  // True where libserialport knows `path` ("/dev/ttyUSB0", no link).
  static bool knows(const std::string& path);
  // `path` is opened, `name` shown.
  static std::unique_ptr<ByteChannel> open(const std::string& path,
                                           const std::string& name,
                                           int baud);
  ~SerialPortChannel() override;

 private:
  struct Closer {
    bool ours = false;  // the line is for this program alone: that ends with the port
    void operator()(sp_port* port) const noexcept;
  };
  using Port = std::unique_ptr<sp_port, Closer>;
  SerialPortChannel(std::string name, int fd, Port port, FileDescriptor lock);
  FileDescriptor lock_;  // on the line, taken before anything was changed; let go after port_
  Port port_;
};

}  // namespace palpate
