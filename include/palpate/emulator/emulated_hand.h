// Emulated hand: both controllers on two ports, with a thread of its own that simulates their
// timing. A client sees the same bytes as on the lines of a real hand. Functions that only tests
// need (ground truth, counters, fault injection) are here as well.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/emulator/dsa_server.h>
#include <palpate/emulator/faults.h>
#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/sdh_server.h>

namespace palpate {

enum class EmulationRate {
  kReal,   // bytes at 115200 baud, frames by scan time, commands with 2..3 ms of thinking
  kFixed,  // frames at a given rate, lines and commands without delay
  // Frames as fast as the client takes them; the hand's time runs with the frames, each at its
  // nominal interval, and with the wall clock while nothing streams.
  kMax,
};

enum class EmulatedPort { kTactile, kMotion };
// monotonicUs: of the machine's clock [us]. `bytes` are valid inside of the call.
using ReceiveObserver = std::function<void(
    EmulatedPort port, std::span<const std::byte> bytes, std::int64_t monotonicUs)>;

struct EmulatedHandOptions {
  // Where the ports are: path of a link to be made, "tcp:127.0.0.1:PORT" (0: any), or empty: a pty
  // without a link.
  std::string dsaPort = {};
  std::string sdhPort = {};
  EmulationRate rate = EmulationRate::kReal;
  double hz = 31.7;  // with kFixed: 0.01..1000
  Faults faults = {};
  std::uint64_t seed = 1;     // of faults and think times
  DsaServerOptions dsa = {};  // frameHz and lineByteUs are set by `rate`
  SdhServerOptions sdh = {};  // checksum by the kind of port, think times by `rate`
  // Told of what a client sent, as it arrives and before it is understood; from the hand's thread.
  ReceiveObserver received = {};
};

// A tactile frame as it was scanned and put on the line. Valid inside of the call.
struct EmulatedFrame {
  ScannedFrame scanned;
  std::int64_t hostUs = 0;                // host time of the scan [us since 1970]
  std::span<const std::uint16_t> counts;  // all matrices
  const HandModel& model;                 // its truth() is that of this scan
};
using FrameObserver = std::function<void(const EmulatedFrame&)>;

// A tactile frame that has left the hand.
struct SentFrame {
  std::uint64_t number = 0;  // as in ScannedFrame
  std::uint32_t deviceMs = 0;
  // Host time at which its last byte was handed to the system [us since 1970].
  std::int64_t hostUs = 0;
  bool whole = false;  // every byte, unchanged
};

// Of one port, since the start.
struct EmulatedPortCounts {
  std::uint64_t bytesSent = 0;  // handed to the system
  std::uint64_t bytesLost = 0;  // nobody read, muted, or unplugged
  std::uint64_t bytesReceived = 0;
  std::uint64_t messages = 0;  // packets, records and lines made, frames included
  std::uint64_t pending = 0;   // bytes that wait for their time, or for a client that reads
};

struct EmulatedHandCounts {
  std::uint64_t framesScanned = 0;
  std::uint64_t framesSent = 0;   // all bytes handed to the system
  std::uint64_t framesWhole = 0;  // of those, without a fault in them
  std::uint64_t framesLost = 0;   // some bytes found no reader
  double handTimeS = 0.0;         // the hand's time since the start [s]
  FaultCounts faults;
  EmulatedPortCounts dsa, sdh;
  std::string failure;  // why the hand has stopped by itself; empty: it runs
};

// Every member may be called from any thread; those that change something return when it has
// happened.
class EmulatedHand {
 public:
  // Opens the ports and starts. `observer`: called from the hand's thread for each frame.
  // Throws DeviceError, FileError (ports), std::invalid_argument (options).
  explicit EmulatedHand(std::unique_ptr<HandModel> model,
                        EmulatedHandOptions options = {},
                        FrameObserver observer = {});
  // Stops, closes the ports and removes the links.
  ~EmulatedHand();
  EmulatedHand(const EmulatedHand&) = delete;
  EmulatedHand& operator=(const EmulatedHand&) = delete;

  // Names for a client to open.
  std::string dsaPort() const;
  std::string sdhPort() const;

  // Counts follow what a client has read by a fraction of a millisecond.
  EmulatedHandCounts counts() const;
  // The last few thousand frames that have left, oldest first.
  std::vector<SentFrame> sentFrames() const;

  // Fault injection. Disconnects the ports, also in the middle of a packet: the client sees a
  // hang-up and the link is removed. The emulated controllers continue as if connected.
  void unplug(bool dsa = true, bool sdh = true);
  // Pulls the tactile plug at a certain byte: so many more leave, the client has 5 ms to read them,
  // then it sees the hang-up. Returns at once.
  void unplugAfter(std::uint64_t bytes);
  // Plugs in again what is out: a new pty under the same link. Throws as the constructor.
  void replug();
  // Off and on: settings as stored, stream and power off, deaf for `bootS`.
  void powerCycle(double bootS = 8.0);
  // Silence: nothing leaves the hand, though it listens and acts.
  void mute(bool on);
  // So many random bytes on the chosen ports, as fast as the lines take them.
  void sendRandomBytes(std::uint64_t bytes, bool dsa = true, bool sdh = true);
  // From now on (times of stalls and unplugs count from here). A `bootS` switches the hand off and
  // on.
  void setFaults(const Faults& faults);
  // Calls `visit` with the model, at rest, in the hand's thread.
  void withModel(const std::function<void(HandModel&)>& visit);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace palpate
