// A terminal line without modem behind it: the pty of an emulated hand, set by termios.
#pragma once

#include <string>

#include "device/descriptor_channel.h"

namespace palpate {

// Takes the line for this program alone (flock); throws DeviceError (kBusy). `name` is for the
// message.
void lockLine(int fd, const std::string& name);
// Raw and 8-bit clean whatever was set before: no translation, no flow control, no signals by
// control characters or modem lines, no DTR drop on close. The speed stays. False: errno says why.
bool makeRaw(int fd) noexcept;

class TtyChannel final : public DescriptorChannel {
 public:
  // `path` is opened, `name` shown.
  static std::unique_ptr<ByteChannel> open(const std::string& path, const std::string& name);

 private:
  TtyChannel(std::string name, FileDescriptor fd);
  FileDescriptor fd_;
};

// What a failed open() of a port means, and what to do. `error` is an errno.
[[noreturn]] void throwOpenError(int error, const std::string& name);

}  // namespace palpate
