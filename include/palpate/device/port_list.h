// The serial ports of this machine, and their names that stay the same when plugs change places.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate {

struct PortInfo {
  std::string name;         // as openChannel() takes it: "/dev/ttyUSB0"
  std::string stableName;   // under /dev/serial/by-id; equals `name` where it has none there
  std::string description;  // as the driver or the plug says; may be empty
  bool usb = false;
  bool bluetooth = false;  // opening it may call the other side
  bool readable = false;   // by this user
  bool writable = false;
};

// Where udev keeps links named after the plug, not after the order of plugging in.
constexpr char kByIdFolder[] = "/dev/serial/by-id";

// Ports whose hardware is there: USB first, the machine's own (ttyS) last, else by name with
// numbers in their order. No port is opened for use. An unreadable list is an empty one.
std::vector<PortInfo> listPorts(const std::filesystem::path& byIdFolder = kByIdFolder);

// The link in `byIdFolder` that leads to the same device as `port`; `port` itself where there is
// none (also for tcp: names and ports that don't exist).
std::string stableNameOf(const std::string& port,
                         const std::filesystem::path& byIdFolder = kByIdFolder);

// The order of listPorts().
bool portBefore(const PortInfo& a, const PortInfo& b);

}  // namespace palpate
