// Byte channel over a terminal device without modem lines, that is, the pty of an emulated hand;
// configured by termios.
#pragma once

#include <string>

#include "device/descriptor_channel.h"

namespace palpate {

// Locks the device for this program (flock); throws DeviceError (kBusy). `name` is used in the
// message.
void lockLine(int fd, const std::string& name);
// Sets raw 8-bit mode, whatever was set before: no translation, no flow control, no signals from
// control characters or modem lines, no DTR drop on close. The speed is unchanged. Returns false on
// failure, with errno set.
bool makeRaw(int fd) noexcept;

class TtyChannel final : public DescriptorChannel {
 public:
  // Opens `path`; `name` is used in messages.
  static std::unique_ptr<ByteChannel> open(const std::string& path, const std::string& name);

 private:
  TtyChannel(std::string name, FileDescriptor fd, FileDescriptor lock);
  // Lock on the device, apart from fd_: a duplicate of a locked descriptor holds the lock, too.
  FileDescriptor lock_;
  FileDescriptor fd_;
};

// Throws the DeviceError for a failed open() of a port, with advice. `error` is an errno.
[[noreturn]] void throwOpenError(int error, const std::string& name);

}  // namespace palpate
