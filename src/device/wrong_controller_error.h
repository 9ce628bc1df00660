// What is thrown where the hand's other controller answers at a port: the two are swapped. Private
// to this module.
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
