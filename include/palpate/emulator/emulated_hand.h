// Emulated hand: both controllers on two ports, with a thread of its own that simulates their
// timing. A client receives the same bytes as from a real hand. The class also contains the
// functions that only tests need (ground truth, counters, fault injection).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/emulator/dsa_server.h>
#include <palpate/emulator/faults.h>
#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/sdh_server.h>

namespace palpate {

enum class EmulationRate {
  // Bytes at 115200 baud, frames by scan time, commands answered after 2..3 ms.
  kReal,
  // Frames at a given rate, bytes and commands without delay.
  kFixed,
  // Frames as fast as the client reads them. The hand's time advances with the frames, each at its
  // nominal interval, and with the wall clock while no stream runs.
  kMax,
};

enum class EmulatedPort { kTactile, kMotion };
// monotonicUs: monotonic time of the machine [us]. `bytes` are valid inside the call.
using ReceiveObserver = std::function<void(
    EmulatedPort port, std::span<const std::byte> bytes, std::int64_t monotonicUs)>;

struct EmulatedHandOptions {
  // Where to open the ports: path of a symbolic link to create, "tcp:127.0.0.1:PORT" (0: any port),
  // or empty for a pty without a link.
  std::string dsaPort = {};
  std::string sdhPort = {};
  EmulationRate rate = EmulationRate::kReal;
  double hz = 31.7;  // with kFixed: 0.01..1000
  Faults faults = {};
  // Seed of the faults and of the response delays.
  std::uint64_t seed = 1;
  // Serial number of the tactile controller; that of the motion controller follows from it. Empty:
  // that of the model, where it has one, else emulatedSerial(seed).
  std::optional<std::uint32_t> serial = {};
  DsaServerOptions dsa = {};  // frameHz and lineByteUs are set by `rate`, serial by `serial`
  // `checksum` is set by the kind of port, the response delays by `rate`, serial by `serial`.
  SdhServerOptions sdh = {};
  // Called from the hand's thread with the bytes that a client sent, before they are parsed.
  ReceiveObserver received = {};
};

// The serial number of an emulated hand: the same for the same seed, others for other seeds (of
// 2^28). Its first hexadecimal digit is E.
std::uint32_t emulatedSerial(std::uint64_t seed);

// A tactile frame as it was scanned and sent. Valid inside the call.
struct EmulatedFrame {
  ScannedFrame scanned;
  std::int64_t hostUs = 0;                // host time of the scan [us since 1970]
  std::span<const std::uint16_t> counts;  // all matrices
  const HandModel& model;                 // its truth() belongs to this scan
};
using FrameObserver = std::function<void(const EmulatedFrame&)>;

// A tactile frame that has left the hand.
struct SentFrame {
  std::uint64_t number = 0;  // as in ScannedFrame
  std::uint32_t deviceMs = 0;
  // Host time at which its last byte was handed to the system [us since 1970].
  std::int64_t hostUs = 0;
  bool whole = false;  // true when every byte was sent unchanged
};

// Counts of one port since the start.
struct EmulatedPortCounts {
  std::uint64_t bytesSent = 0;  // handed to the system
  // Bytes that were lost because no client read them, or while muted or unplugged.
  std::uint64_t bytesLost = 0;
  std::uint64_t bytesReceived = 0;
  // Packets, records and lines created, frames included.
  std::uint64_t messages = 0;
  // Bytes that wait for their time or for a client that reads.
  std::uint64_t pending = 0;
};

struct EmulatedHandCounts {
  std::uint64_t framesScanned = 0;
  std::uint64_t framesSent = 0;   // all bytes handed to the system
  std::uint64_t framesWhole = 0;  // frames sent without a fault in them
  std::uint64_t framesLost = 0;   // frames of which some bytes were lost
  double handTimeS = 0.0;         // the hand's time since the start [s]
  std::string_view ownMotion;     // HandModel::ownMotion(), a text that stays valid
  FaultCounts faults;
  EmulatedPortCounts dsa, sdh;
  // Reason why the hand stopped because of an error; empty while it runs.
  std::string failure;
};

// Every function may be called from any thread; those that change something return after the
// change.
class EmulatedHand {
 public:
  // Opens the ports and starts. `observer` is called from the hand's thread for each frame. Throws
  // DeviceError, FileError (ports), std::invalid_argument (options).
  explicit EmulatedHand(std::unique_ptr<HandModel> model,
                        EmulatedHandOptions options = {},
                        FrameObserver observer = {});
  // Stops, closes the ports and removes the links.
  ~EmulatedHand();
  EmulatedHand(const EmulatedHand&) = delete;
  EmulatedHand& operator=(const EmulatedHand&) = delete;

  // Names of the ports, for a client to open.
  std::string dsaPort() const;
  std::string sdhPort() const;
  // Serial numbers as clients show them: "E910A2DE" of the tactile controller, "181598" of the
  // motion controller. They stay while the hand lives, also when it is unplugged.
  std::string dsaSerial() const;
  std::string sdhSerial() const;

  // The counts lag by a fraction of a millisecond behind what a client has read.
  EmulatedHandCounts counts() const;
  // The last few thousand frames sent, oldest first.
  std::vector<SentFrame> sentFrames() const;

  // Fault injection. Disconnects the ports, also in the middle of a packet: the client sees a
  // hang-up and the link is removed. The emulated controllers continue as if connected.
  void unplug(bool dsa = true, bool sdh = true);
  // Disconnects the tactile port after the given number of further bytes: they are sent, the client
  // has 5 ms to read them, then it sees the hang-up. Returns at once.
  void unplugAfter(std::uint64_t bytes);
  // Reconnects all disconnected ports: a new pty under the same link. Throws as the constructor.
  void replug();
  // Switches the hand off and on: it has the stored settings, stream and power are off, and it
  // ignores all input for `bootS`.
  void powerCycle(double bootS = 8.0);
  // While on, the hand sends nothing, although it receives and executes commands.
  void mute(bool on);
  // Sends this number of random bytes on the chosen ports, as fast as the lines allow.
  void sendRandomBytes(std::uint64_t bytes, bool dsa = true, bool sdh = true);
  // Replaces the faults; times of stalls and unplugs count from this call. A `bootS` switches the
  // hand off and on.
  void setFaults(const Faults& faults);
  // Calls `visit` with the model in the hand's thread, while nothing else uses it.
  void withModel(const std::function<void(HandModel&)>& visit);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace palpate
