#include "palpate/device/port_list.h"

#include <algorithm>

#include "device/pty_pair.h"
#include "testing/testing.h"

namespace palpate::port_list_test {
namespace {

namespace fs = std::filesystem;
using testing::PtyPair;
using testing::TemporaryFolder;

PortInfo named(const std::string& name, bool usb) {
  PortInfo info;
  info.name = name;
  info.usb = usb;
  return info;
}

TEST(PortList, UsbStandsFirstTheMachinesOwnLastAndNumbersCountAsNumbers) {
  std::vector<PortInfo> ports = {named("/dev/ttyS0", false),
                                 named("/dev/ttyUSB10", true),
                                 named("/dev/ttyAMA0", false),
                                 named("/dev/ttyUSB2", true),
                                 named("/dev/ttyS10", false),
                                 named("/dev/ttyACM0", true),
                                 named("/dev/ttyS2", false)};
  std::sort(ports.begin(), ports.end(), portBefore);
  std::vector<std::string> names;
  for (const PortInfo& port : ports) names.push_back(port.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"/dev/ttyACM0",
                                      "/dev/ttyUSB2",
                                      "/dev/ttyUSB10",
                                      "/dev/ttyAMA0",
                                      "/dev/ttyS0",
                                      "/dev/ttyS2",
                                      "/dev/ttyS10"}));
  EXPECT_FALSE(portBefore(ports[0], ports[0]));
}

TEST(PortList, ListsWhatIsThereAndLeavesNothingOpen) {
  listPorts();
  const std::size_t before = testing::openDescriptors();
  for (const PortInfo& port : listPorts()) {
    EXPECT_TRUE(fs::exists(port.name)) << port.name;
    EXPECT_FALSE(port.stableName.empty());
  }
  EXPECT_EQ(testing::openDescriptors(), before);
}

TEST(PortList, AStableNameLeadsToTheSamePort) {
  const TemporaryFolder folder;
  const PtyPair pty;
  const PtyPair other;
  fs::create_symlink(other.path(), folder / "usb-FTDI_A-port0");
  fs::create_symlink("/nowhere", folder / "usb-FTDI_B-port0");
  EXPECT_EQ(stableNameOf(pty.path(), folder.path()), pty.path());
  fs::create_symlink(pty.path(), folder / "usb-FTDI_D-port0");
  fs::create_symlink(pty.path(), folder / "usb-FTDI_C-port0");
  EXPECT_EQ(stableNameOf(pty.path(), folder.path()), folder / "usb-FTDI_C-port0");
  // A link in another folder leads to the same port.
  const TemporaryFolder elsewhere;
  fs::create_symlink(pty.path(), elsewhere / "hand");
  EXPECT_EQ(stableNameOf(elsewhere / "hand", folder.path()), folder / "usb-FTDI_C-port0");
}

TEST(PortList, WhatHasNoStableNameKeepsItsOwn) {
  const TemporaryFolder folder;
  EXPECT_EQ(stableNameOf("tcp:192.168.1.42:23", folder.path()), "tcp:192.168.1.42:23");
  EXPECT_EQ(stableNameOf("/dev/ttyNONE1", folder.path()), "/dev/ttyNONE1");
  EXPECT_EQ(stableNameOf("/dev/null", "/nowhere/by-id"), "/dev/null");
  EXPECT_EQ(stableNameOf("", folder.path()), "");
}

}  // namespace
}  // namespace palpate::port_list_test
