#include "palpate/core/error.h"

#include "palpate/core/escaped_line.h"

namespace palpate {

Error::Error(const std::string& message) : std::runtime_error(escapedLine(message)) {}

FileError::FileError(const std::filesystem::path& path, const std::string& message)
    : Error(path.string() + ": " + message), path_(path) {}

FormatError::FormatError(const std::filesystem::path& path,
                         const std::string& message,
                         std::optional<std::uint64_t> offset)
    : Error(path.string() + ": " + message +
            (offset ? " (at byte " + std::to_string(*offset) + ")" : std::string())),
      path_(path),
      offset_(offset) {}

DeviceError::DeviceError(DeviceFault fault, const std::string& port, const std::string& message)
    : Error(port + ": " + message), fault_(fault), port_(port) {}

}  // namespace palpate
