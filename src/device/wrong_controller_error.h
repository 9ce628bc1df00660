// Exception for a port where the hand's other controller answers, because the two ports are
// swapped. Used inside this module only.
#pragma once

#include <string>

#include "palpate/core/error.h"
#include "palpate/device/port_probe.h"

namespace palpate {

class WrongControllerError : public DeviceError {
 public:
  WrongControllerError(PortAnswer found, const std::string& port, const std::string& message)
      : DeviceError(DeviceFault::kWrongDevice, port, message), found_(found) {}
  PortAnswer found() const noexcept { return found_; }

 private:
  PortAnswer found_;
};

}  // namespace palpate
