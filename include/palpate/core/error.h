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
  // Escapes characters that would break the line or change its direction (core/escaped_line.h).
  explicit Error(const std::string& message);
};

// A file cannot be opened, read or written. what(): "PATH: message".
class FileError : public Error {
 public:
  FileError(const std::filesystem::path& path, const std::string& message);
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

// A file was read, but its content is not as expected. what(): "PATH: message (at byte N)".
class FormatError : public Error {
 public:
  // offset [bytes] counts from the start of the content (of the decompressed text if the file is
  // compressed); empty when the place is not known.
  FormatError(const std::filesystem::path& path,
              const std::string& message,
              std::optional<std::uint64_t> offset = std::nullopt);
  const std::filesystem::path& path() const noexcept { return path_; }
  std::optional<std::uint64_t> offset() const noexcept { return offset_; }

 private:
  std::filesystem::path path_;
  std::optional<std::uint64_t> offset_;
};

// The kind of problem with a device or its port.
enum class DeviceFault {
  kNotFound,      // no such port
  kNoPermission,  // the user may not open the port
  kBusy,          // another program uses the port
  kDisconnected,  // unplugged or hung up
  kSilent,        // no answer in time
  kRefused,       // the device answered with an error code
  kProtocol,      // the answer violates the protocol
  kWrongDevice,   // another device answers (for example, ports swapped)
  kUnsupported,   // the device does not know the command
};

// A device cannot be opened, does not answer, or was disconnected. what(): "PORT: message"; the
// message says what to do.
class DeviceError : public Error {
 public:
  DeviceError(DeviceFault fault, const std::string& port, const std::string& message);
  DeviceFault fault() const noexcept { return fault_; }
  const std::string& port() const noexcept { return port_; }

 private:
  DeviceFault fault_;
  std::string port_;
};

// Long work was cancelled by its caller. No incomplete results remain.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace palpate
