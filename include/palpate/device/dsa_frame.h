// Payload of a full-frame packet of the DSACON32-M, and the plausibility check for frames whose
// corruption the 16-bit checksum does not detect.
//   time stamp u32 [ms since controller start] | flags u8 (bit 0: run-length) | taxels
// Raw taxels are one u16 each. Run-length coded taxels are u16 units, run << 12 | value; runs
// continue across rows and matrices, and their lengths add up to the number of places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct DsaFrame {
  std::uint32_t stampMs = 0;
  bool runLength = false;
  // Size on the line, including the framing [bytes].
  std::size_t packetBytes = 0;
};

// Decodes a payload into `counts` (layout.numCells() values, 0..4095). Returns nothing when the
// payload isn't a plausible frame: unknown flags, wrong size, runs of length 0, runs that don't add
// up to the number of places, a value over 12 bits, or (with `checkMask`) a count where no taxel
// exists according to the static mask. `counts` is unspecified then. Never throws for bad bytes;
// throws std::invalid_argument when `counts` has another size.
std::optional<DsaFrame> decodeDsaFrame(std::span<const std::byte> payload,
                                       const SensorLayout& layout,
                                       bool checkMask,
                                       std::span<float> counts);

// Frames per second that a DSACON32-M scans, as a function of the number of enabled taxels.
// Measured on a real hand (recordings of 2014): 2 taxels 13.2 ms, a matrix of 78 places 17.7 ms,
// all taxels of an SDH-2 31.55 ms; linear in between.
double dsaScanRateHz(std::size_t enabledTaxels);
// Frames per second that 115200 baud can carry, for frames with this number of runs of equal counts
// (a run has at most 15 taxels): 13 bytes per packet and 2 per run, 10 bits per byte.
double dsaLineRateHz(double runs);
// Number of runs in a frame as the controller codes it.
std::size_t dsaRunsOf(const TactileFrame& frame);

// Unwraps the controller's 32-bit clock and holds back frames whose time stamp isn't plausible (not
// later than the last one, or further ahead than the elapsed host time allows). Such a frame is
// accepted only when the next frame continues it, as it does after a restart of the controller.
class DsaClock {
 public:
  enum class FrameAcceptance {
    // The frame is plausible; deviceMs() is its time.
    kAccept,
    // The frame is implausible so far: the caller must hold it back.
    kHold,
    // This frame continues the one held back: both are good, the controller's clock was reset.
    kRestarted,
    // The frame held back was wrong; this one is implausible as well and must be held back instead.
    kReplaceHeld,
    // The frame held back was wrong; this one is good.
    kDropHeld,
  };
  // hostUs: arrival time of the frame [us, monotonic].
  FrameAcceptance checkStamp(std::uint32_t stampMs, std::int64_t hostUs);
  // Unwrapped time of the last frame checked with kAccept, kRestarted or kDropHeld [ms]. After a
  // restart of the controller the time continues after the last frame, so that it never decreases.
  std::int64_t deviceMs() const noexcept { return deviceMs_; }
  // After kRestarted: the time of the frame that was held back [ms].
  std::int64_t heldMs() const noexcept { return heldMs_; }
  // Call this when acquisition stops. Frames may pause from here on: any later stamp is accepted
  // next.
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

// Counts the frames missing between two received frames by the device's clock. The expected period
// depends on the scan and on the line: max(scan period, bytes x time per byte).
class DsaLossEstimate {
 public:
  // byteUs: time on the line of one byte [us]; 0 when the line is no limit (TCP, test rates).
  explicit DsaLossEstimate(double byteUs = 86.8) : byteUs_(byteUs) {}
  // Returns how many frames are missing before this one; 0 for the first ones and after reset().
  std::uint64_t next(std::int64_t deviceMs, std::size_t packetBytes);
  // True when enough frames have arrived since reset() for next() to be reliable; before that, its
  // result 0 does not mean that no frame is missing.
  bool known() const noexcept;
  // Call this when the rate may change (masks, thresholds, acquisition stopped).
  void reset() noexcept;
  // Estimated scan period [ms]; 0: not known yet.
  double scanPeriodMs() const noexcept { return scanPeriodMs_; }

 private:
  double byteUs_;
  double scanPeriodMs_ = 0.0;
  std::optional<std::int64_t> lastMs_;
  std::vector<double> recentMs_;  // ring buffer of the last intervals [ms]
  std::size_t nextRecent_ = 0;
};

}  // namespace palpate
