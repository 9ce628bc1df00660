// Emulates the protocol side of the tactile controller (DSACON32-M): receives bytes, answers
// packets, streams frames. EmulatedHand connects it to a port. It is written from the protocol
// alone, without the driver's code, so that each checks the other. It knows neither port nor clock:
// the caller passes bytes and times, and collects the messages.
//
// Packet: AA AA AA | id u8 | length u16 | payload | checksum u16 (only with a payload),
// little-endian. A request that can't be executed is answered by its id and an error code alone. As
// on the real controller, there is no answer to bytes that are no packet, or to settings with the
// persistent flag.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/paced_line.h>

namespace palpate {

struct DsaServerOptions {
  std::uint32_t serial = 0x1D9B0057;  // of controller and sensor
  // Values below 0x1000 are release numbers (218..288) with the limitations of those releases:
  // thresholds only since 268; sensitivities read as 0.5 up to 218; a request for a single frame
  // starts a stream up to 288, except 269.
  static constexpr OptionRange kFirmware{1, 0xFFFF};
  std::uint16_t firmware = 0x2900;
  std::uint16_t generatedBy = 105;
  // Controller's clock when it is switched on [ms]; wraps at 2^32.
  std::uint32_t startMs = 0;
  // Time after the start in which the controller ignores all input [s].
  double bootS = 0.0;
  // Minimum time per byte of a frame [us], even if the caller's line is faster. Not applied to
  // recorded intervals.
  double lineByteUs = 0.0;
  // If set, frames are sent at this rate [1/s], 0.01..1000, instead of by scan time and recorded
  // intervals.
  std::optional<double> frameHz = {};
};

// Time of one scan [us] as a function of the number of taxels that the dynamic masks enable: 13.2
// ms for up to 2, 17.7 ms for 78, 31.5 ms from 456 on, linear in between (measured on a real hand:
// 76, 56 and 31.7 frames/s).
double dsaScanUs(std::size_t enabledTaxels);

// A frame as it was sent.
struct ScannedFrame {
  std::uint64_t number = 0;    // counted from the construction of the server
  std::uint32_t deviceMs = 0;  // time stamp as sent [ms]
  // Time of the scan in the caller's time [us].
  std::int64_t timeUs = 0;
  std::size_t bytes = 0;  // size of its packet
};

// Not thread-safe. Times [us] are the caller's, counted from the start of the hand, and never
// decrease.
class DsaServer {
 public:
  // The model must outlive the server. Throws std::invalid_argument for a rate out of range.
  DsaServer(HandModel& model, const DsaServerOptions& options = {});

  // Processes bytes from the client.
  void receive(std::span<const std::byte> bytes, std::int64_t nowUs);
  // Call this when the client has been silent for a while: discards an incomplete request.
  void onReceiveTimeout();
  bool hasPartialRequest() const noexcept { return !input_.empty(); }
  // Executes what is due: bytes of the boot phase and at most one frame. `lineFreeUs` is the time
  // at which all collected messages have been sent; no frame is scanned before it.
  void advance(std::int64_t nowUs, std::int64_t lineFreeUs);
  // Next time at which advance() has something to do; empty when it only waits for the client.
  std::optional<std::int64_t> nextUs(std::int64_t lineFreeUs) const;
  // Time at which the next frame is due (also contained in nextUs()).
  std::optional<std::int64_t> nextFrameUs(std::int64_t lineFreeUs) const;
  // Returns the messages since the last call, in order.
  std::vector<LineMessage> take();
  // The frame scanned by the last advance(); empty if it scanned none.
  const std::optional<ScannedFrame>& scanned() const noexcept { return scanned_; }
  // Counts of the last scan, matrix after matrix.
  std::span<const std::uint16_t> counts() const noexcept { return counts_; }

  // Switches the controller off and on: it has the stored settings, restarts its clock and ignores
  // all input for `bootS`.
  void powerCycle(std::int64_t nowUs, double bootS);
  bool streaming() const noexcept { return push_; }

 private:
  using Payload = std::span<const std::byte>;
  bool booting(std::int64_t nowUs) const noexcept { return nowUs < bootEndUs_; }
  void parse();
  void execute(unsigned id, Payload payload);
  void answer(unsigned id, std::vector<std::byte> payload);
  void answerError(unsigned id, unsigned code);
  void describeController();
  void describeSensor();
  void describeMatrix(Payload payload);
  void acquire(Payload payload);
  void readMask(Payload payload);
  void writeMask(Payload payload);
  void sendDescriptorText(Payload payload);
  void setSensitivity(Payload payload);
  void getSensitivity(Payload payload);
  void setThreshold(Payload payload);
  void getThreshold(Payload payload);
  bool wantsFrame() const { return (push_ || singles_ > 0) && !model_.finished(); }
  double periodUs() const;
  void sendFrame(std::int64_t atUs);

  HandModel& model_;
  DsaServerOptions options_;
  std::vector<MatrixSetting> stored_;  // in the controller's configuration memory
  std::vector<std::byte> input_;
  std::vector<LineMessage> output_;
  std::vector<std::uint16_t> counts_;
  std::optional<ScannedFrame> scanned_;
  std::uint64_t numFrames_ = 0;
  std::int64_t nowUs_ = 0;
  std::int64_t switchedOnUs_ = 0;
  std::int64_t bootEndUs_ = 0;
  // Number of queries ESC [ 5 n sent so far.
  unsigned bootQueries_ = 0;
  std::optional<std::uint32_t> lastMs_;
  bool push_ = false;
  bool runLength_ = true;
  unsigned singles_ = 0;  // requested single frames
  double nextFrameUs_ = 0.0;
};

}  // namespace palpate
