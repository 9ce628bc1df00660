// The tactile controller (DSACON32-M) as it looks from its line: takes bytes, answers packets,
// streams frames. Written from the protocol alone, without the driver's code, so that each checks
// the other. Knows neither line nor clock: the caller hands in bytes and times, and takes the
// messages.
//
// Packet: AA AA AA | id u8 | length u16 | payload | checksum u16 (only with a payload),
// little-endian. A request that can't be carried out is answered by its id and a bare error code.
// Not answered at all: what is no packet, and settings with the persistent flag (as the real one).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/paced_line.h>

namespace palpate {

struct DsaServerOptions {
  std::uint32_t serial = 0x1D9B0057;  // of controller and sensor
  // Below 0x1000: a release number (218..288), with what those can't: thresholds before 268;
  // sensitivities read as 0.5 up to 218; a single frame starts a stream up to 288, except 269.
  std::uint16_t firmware = 0x2900;
  std::uint16_t generatedBy = 105;
  std::uint32_t startMs = 0;  // controller's clock when it is switched on [ms]; wraps at 2^32
  double bootS = 0.0;         // deaf for so long after the start [s]
  // A frame takes at least so long per byte [us], though the caller's line is faster; not for
  // recorded intervals.
  double lineByteUs = 0.0;
  // Frames at this rate [1/s], 0.01..1000, instead of scan time and recorded intervals.
  std::optional<double> frameHz = {};
};

// Time of one scan [us], by the number of taxels that the dynamic masks enable: 13.2 ms for up to
// 2, 17.7 ms for 78, 31.5 ms from 456 on, straight lines between (measured on a real hand: 76, 56
// and 31.7 frames/s).
double dsaScanUs(std::size_t enabledTaxels);

// A frame as it went out.
struct ScannedFrame {
  std::uint64_t number = 0;    // since the server was made
  std::uint32_t deviceMs = 0;  // as sent
  std::int64_t timeUs = 0;     // of the scan, in the caller's time [us]
  std::size_t bytes = 0;       // of its packet
};

// Not thread-safe. Times [us] are the caller's, since the start of the hand, and never go back.
class DsaServer {
 public:
  // The model must outlive it. Throws std::invalid_argument for a rate out of range.
  DsaServer(HandModel& model, const DsaServerOptions& options = {});

  // Bytes of the client.
  void receive(std::span<const std::byte> bytes, std::int64_t nowUs);
  // The client has been silent for a while: a request that isn't complete by now never will be.
  void onReceiveTimeout();
  bool hasPartialRequest() const noexcept { return !input_.empty(); }
  // Does what is due: noise of booting, at most one frame. `lineFreeUs`: when the line will have
  // sent all that was taken; a frame isn't scanned before.
  void advance(std::int64_t nowUs, std::int64_t lineFreeUs);
  // When advance() has something to do again; nothing: not before the client speaks.
  std::optional<std::int64_t> nextUs(std::int64_t lineFreeUs) const;
  // When the next frame is due (also in nextUs).
  std::optional<std::int64_t> nextFrameUs(std::int64_t lineFreeUs) const;
  // The messages since the last call, in order.
  std::vector<LineMessage> take();
  // The frame that the last advance() scanned, if it did.
  const std::optional<ScannedFrame>& scanned() const noexcept { return scanned_; }
  // What the last scan gave, matrix after matrix.
  std::span<const std::uint16_t> counts() const noexcept { return counts_; }

  // Switched off and on: settings as stored, clock from the start, deaf for `bootS`.
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
  unsigned bootQueries_ = 0;  // ESC [ 5 n sent so far
  std::optional<std::uint32_t> lastMs_;
  bool push_ = false;
  bool runLength_ = true;
  unsigned singles_ = 0;  // single frames asked for
  double nextFrameUs_ = 0.0;
};

}  // namespace palpate
