// Finds out which device answers at a port: the hand's motion controller, its tactile controller,
// or neither. The two look alike from outside, and swapped ports are the usual cause of a failed
// connection.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>

namespace palpate {

enum class PortAnswer {
  kNothing,        // no bytes arrive
  kMotion,         // the motion controller of an SDH-2
  kTactile,        // a tactile controller DSACON32-M
  kUnknownDevice,  // bytes arrive, but from neither controller
  kBusy,           // another program holds the port: no request was sent
  kNoPermission,   // the port may not be opened
  kNotFound,       // no such port, or no connection
  kDisconnected,   // disconnected during the probe
};

struct PortProbe {
  std::string port;
  PortAnswer answer = PortAnswer::kNothing;
  // Firmware: "0.0.3.3"; of a tactile controller "2.9.0.0" or "268".
  std::string firmware;
  // Serial number: "48"; of a tactile controller "1D9B0057". Empty where it is not reported.
  std::string serial;
  // The result in one line for the user, with advice where something can be done.
  std::string message;

  // The answer as a word for tables and JSON: "motion", "tactile", "nothing", "something", "busy",
  // "no_permission", "not_found", "gone".
  std::string answerName() const;
};

struct PortProbeOptions {
  // Opens the port; empty means openChannel().
  std::function<std::unique_ptr<ByteChannel>(const std::string& port)> open;
  // Called every 20 ms; when it returns true, the probe ends early with what is known.
  std::function<bool()> isCancelled;
};

// Opens the port and probes it for at most 2.5 s (plus the time to connect). It sends ` ver` first,
// which a tactile controller ignores. Only if no motion controller answers within a second, it
// sends the tactile controller's stop and query, which a motion controller would take for the start
// of a long record. Ends a tactile stream that another program left running. Throws nothing but
// std::bad_alloc: errors are reported as answers.
PortProbe probePort(const std::string& port,
                    const PortProbeOptions& options = {},
                    const Clock& clock = systemClock());

// Describes what is wrong with a pair of ports and what to do: they are swapped, or one of them
// belongs to the other controller. Empty when nothing is wrong.
std::string describeSwap(const PortProbe& tactilePort, const PortProbe& motionPort);

}  // namespace palpate
