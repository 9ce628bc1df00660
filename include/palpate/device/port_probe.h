// Finds out what is behind a port: the hand's motion controller, its tactile controller, or
// neither. The two look alike from outside, and swapped ports are the usual reason why nothing
// works.
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
  kNothing,        // silence
  kMotion,         // the motion controller of an SDH-2
  kTactile,        // a tactile controller DSACON32-M
  kUnknownDevice,  // bytes come, but neither controller's
  kBusy,           // another program holds the port: not asked
  kNoPermission,   // may not be opened
  kNotFound,       // no such port, or no connection
  kDisconnected,   // hung up while it was asked
};

struct PortProbe {
  std::string port;
  PortAnswer answer = PortAnswer::kNothing;
  std::string firmware;  // "0.0.3.3", of a tactile controller "2.9.0.0" or "268"
  std::string serial;    // "48", of a tactile controller "1D9B0057"; empty where it doesn't tell
  // the answer for a person, one line; what to do where there is something to do
  std::string message;

  // "motion", "tactile", "nothing", "something", "busy", "no_permission", "not_found", "gone".
  std::string answerName() const;
};

struct PortProbeOptions {
  std::function<std::unique_ptr<ByteChannel>(const std::string& port)> open;  // openChannel()
  std::function<bool()> isCancelled;  // asked every 20 ms; true: ends early with what is known
};

// Opens the port and asks, at most 2.5 s (and the time to connect). First ` ver`, which a tactile
// controller ignores; only where no motion controller answers within a second, the tactile
// controller's stop and query, which a motion controller would take for the start of a long record.
// Ends a tactile stream that somebody left running. Throws nothing but std::bad_alloc: an error is
// an answer.
PortProbe probePort(const std::string& port,
                    const PortProbeOptions& options = {},
                    const Clock& clock = systemClock());

// What is wrong with a pair of ports, and what to do: swapped, or one of them the other's. Empty:
// nothing.
std::string describeSwap(const PortProbe& tactilePort, const PortProbe& motionPort);

}  // namespace palpate
