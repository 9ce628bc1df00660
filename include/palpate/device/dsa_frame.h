// Payload of a full-frame packet of the DSACON32-M, and the plausibility check for frames whose
// corruption the 16-bit checksum does not detect.
//   time stamp u32 [ms since controller start] | flags u8 (bit 0: run-length) | taxels
// Taxels raw: u16 each. Run-length: u16 units, run << 12 | value, runs across rows and matrices;
// they add up to the number of places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate {

struct DsaFrame {
  std::uint32_t stampMs = 0;
  bool runLength = false;
  std::size_t packetBytes = 0;  // on the line, framing included [bytes]
};

// Decodes a payload into `counts` (layout.numCells() values, 0..4095). Nothing when the payload
// isn't a plausible frame: unknown flags, wrong size, runs of length 0, runs that don't add up, a
// value over 12 bits, or (with `checkMask`) a count where the static mask says that no taxel
// exists. Then `counts` is unspecified. Never throws for bad bytes; std::invalid_argument when
// counts has another size.
std::optional<DsaFrame> decodeDsaFrame(std::span<const std::byte> payload,
                                       const SensorLayout& layout,
                                       bool checkMask,
                                       std::span<float> counts);

// Unwraps the controller's 32-bit clock and holds back frames whose stamp isn't plausible (not
// later than the last, or further ahead than the host's time allows): such a frame is accepted only
// when the next one continues it, which is what a controller does that has started anew.
class DsaClock {
 public:
  enum class FrameAcceptance {
    // deviceMs is good
    kAccept,
    // implausible so far: keep the frame
    kHold,
    // this frame continues the one held: both are good, the controller's clock was reset
    kRestarted,
    // the frame held was wrong; this one is implausible as well: keep this one
    kReplaceHeld,
    // the frame held was wrong; this one is good
    kDropHeld,
  };
  // hostUs: when the frame came [us, monotonic].
  FrameAcceptance checkStamp(std::uint32_t stampMs, std::int64_t hostUs);
  // Unwrapped time of the frame judged last with kAccept, kRestarted or kDropHeld [ms]. After a
  // restart the count goes on behind the last frame, so that it never runs back.
  std::int64_t deviceMs() const noexcept { return deviceMs_; }
  // With kRestarted: the time of the frame that was held [ms].
  std::int64_t heldMs() const noexcept { return heldMs_; }
  // Frames may pause from here on (acquisition was stopped): the next stamp may be any later one.
  void reset() noexcept { held_.reset(); }

 private:
  bool follows(std::uint32_t stampMs,
               std::int64_t hostUs,
               std::uint32_t last,
               std::int64_t lastUs) const noexcept;

  struct Stamp {
    std::uint32_t ms = 0;
    std::int64_t hostUs = 0;
  };
  std::optional<Stamp> last_;
  std::optional<Stamp> held_;
  std::int64_t deviceMs_ = 0;
  std::int64_t heldMs_ = 0;
};

// How many frames are missing between two that came, judged by the device's clock. The period
// follows what the line and the scan allow: max(scan period, bytes x time per byte).
class DsaLossEstimate {
 public:
  // byteUs: time on the line of one byte [us]; 0: the line is no limit (TCP, test rates).
  explicit DsaLossEstimate(double byteUs = 86.8) : byteUs_(byteUs) {}
  // Returns how many frames are missing before this one; 0 for the first ones and after reset().
  std::uint64_t next(std::int64_t deviceMs, std::size_t packetBytes);
  // Enough frames have come since reset() that next() tells what is missing; else its 0 says
  // nothing.
  bool known() const noexcept;
  // The rate may change from here on (masks, thresholds, acquisition stopped).
  void reset() noexcept;
  // Estimated scan period [ms]; 0: not known yet.
  double scanPeriodMs() const noexcept { return scanPeriodMs_; }

 private:
  double byteUs_;
  double scanPeriodMs_ = 0.0;
  std::optional<std::int64_t> lastMs_;
  std::vector<double> recentMs_;  // ring of the last intervals
  std::size_t nextRecent_ = 0;
};

}  // namespace palpate
