#include "palpate/device/port_list.h"

#include <algorithm>
#include <memory>
#include <system_error>

#include <libserialport.h>
#include <unistd.h>

#include "palpate/core/file_name.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::string textOf(const char* text) { return text ? text : ""; }

PortInfo infoOf(sp_port* port, const fs::path& byIdFolder) {
  PortInfo info;
  info.name = textOf(sp_get_port_name(port));
  info.stableName = stableNameOf(info.name, byIdFolder);
  info.description = textOf(sp_get_port_description(port));
  info.usb = sp_get_port_transport(port) == SP_TRANSPORT_USB;
  info.bluetooth = sp_get_port_transport(port) == SP_TRANSPORT_BLUETOOTH;
  info.readable = ::access(info.name.c_str(), R_OK) == 0;
  info.writable = ::access(info.name.c_str(), W_OK) == 0;
  return info;
}

}  // namespace

bool portBefore(const PortInfo& a, const PortInfo& b) {
  const auto rank = [](const PortInfo& port) {
    if (port.usb) return 0;
    return port.name.find("/ttyS") == std::string::npos ? 1 : 2;
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  return naturalOrder(a.name, b.name) < 0;  // "ttyUSB2" before "ttyUSB10"
}

std::vector<PortInfo> listPorts(const fs::path& byIdFolder) {
  std::vector<PortInfo> ports;
  sp_port** found = nullptr;
  if (sp_list_ports(&found) != SP_OK) return ports;
  const std::unique_ptr<sp_port*, void (*)(sp_port**)> owner(found, sp_free_port_list);
  for (sp_port** port = found; *port; ++port) ports.push_back(infoOf(*port, byIdFolder));
  // The kernel may list ports whose device file doesn't exist, for instance in a container; they
  // can't be opened.
  std::erase_if(ports, [](const PortInfo& port) {
    std::error_code failed;
    return !fs::exists(port.name, failed);
  });
  std::sort(ports.begin(), ports.end(), portBefore);
  return ports;
}

std::string stableNameOf(const std::string& port, const fs::path& byIdFolder) {
  std::error_code failed;
  const fs::path device = fs::canonical(port, failed);
  if (failed) return port;
  std::string best;
  for (fs::directory_iterator at(byIdFolder, failed), end; !failed && at != end;
       at.increment(failed)) {
    std::error_code dangling;
    if (fs::canonical(at->path(), dangling) != device || dangling) continue;
    const std::string link = at->path().string();
    if (best.empty() || link < best) best = link;
  }
  return best.empty() ? port : best;
}

}  // namespace palpate
