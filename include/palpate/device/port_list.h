// Lists the serial ports of this machine, with the stable names that do not depend on the order of
// plugging in. Used wherever the user chooses a port.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate {

struct PortInfo {
  std::string name;  // as openChannel() takes it: "/dev/ttyUSB0"
  // Name under /dev/serial/by-id; equals `name` where no such link exists.
  std::string stableName;
  // Description by the driver or the USB device; may be empty.
  std::string description;
  bool usb = false;
  // Opening a Bluetooth port may start a connection to the other side.
  bool bluetooth = false;
  bool readable = false;  // readable by this user
  bool writable = false;
};

// Folder of udev's links, which are named after the USB device and not after the order of plugging
// in.
constexpr char kByIdFolder[] = "/dev/serial/by-id";

// Lists the ports whose hardware is present: USB ports first, the machine's own (ttyS) last,
// otherwise by name with numbers in numerical order. Opens no port for use. Returns an empty list
// when the ports can't be read.
std::vector<PortInfo> listPorts(const std::filesystem::path& byIdFolder = kByIdFolder);

// Returns the link in `byIdFolder` that leads to the same device as `port`, or `port` itself if
// there is none (also for tcp: names and ports that don't exist).
std::string stableNameOf(const std::string& port,
                         const std::filesystem::path& byIdFolder = kByIdFolder);

// True when listPorts() lists `a` before `b`.
bool portBefore(const PortInfo& a, const PortInfo& b);

}  // namespace palpate
