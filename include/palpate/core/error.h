// Exceptions of the project. A violated precondition throws std::invalid_argument or
// std::out_of_range. A failure of the environment (file, port) throws a class derived from Error,
// whose text says what failed, where, and what to do. Expected defects of data (a wrong checksum, a
// saturated taxel) are counted and never thrown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace palpate {

// Base class of all failures of the environment. what() is one line for the user.
class Error : public std::runtime_error {
 public:
  // What would break or bend the line is escaped (core/escaped_line.h).
  explicit Error(const std::string& message);
};

// A file can't be opened, read or written. what(): "PATH: message".
class FileError : public Error {
 public:
  FileError(const std::filesystem::path& path, const std::string& message);
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

// A file was read, but its content is not what it should be. what(): "PATH: message (at byte N)".
class FormatError : public Error {
 public:
  // offset [bytes] counts from the start of the content (of the decompressed text, where the file
  // is compressed); absent where no place can be named.
  FormatError(const std::filesystem::path& path,
              const std::string& message,
              std::optional<std::uint64_t> offset = std::nullopt);
  const std::filesystem::path& path() const noexcept { return path_; }
  std::optional<std::uint64_t> offset() const noexcept { return offset_; }

 private:
  std::filesystem::path path_;
  std::optional<std::uint64_t> offset_;
};

// What is wrong with a device or its port.
enum class DeviceFault {
  kNotFound,      // no such port
  kNoPermission,  // the port may not be opened
  kBusy,          // another program holds the port
  kDisconnected,  // unplugged, hung up
  kSilent,        // no answer in time
  kRefused,       // the device answered with an error code
  kProtocol,      // the answer is not what the protocol says
  kWrongDevice,   // something else answers there (ports swapped)
  kUnsupported,   // this device takes no such command
};

// A device can't be opened, doesn't answer, or is gone. what(): "PORT: message", which says what to
// do.
class DeviceError : public Error {
 public:
  DeviceError(DeviceFault fault, const std::string& port, const std::string& message);
  DeviceFault fault() const noexcept { return fault_; }
  const std::string& port() const noexcept { return port_; }

 private:
  DeviceFault fault_;
  std::string port_;
};

// A long piece of work was cancelled by its caller: nothing was left half-done.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace palpate
