#include "palpate/device/dsa_frame.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/byte_order.h"

namespace palpate {
namespace {

constexpr std::size_t kDsaFrameHeaderBytes = 5;
constexpr std::size_t kFramingBytes = 8;  // preamble, id, size, checksum
constexpr unsigned kRunLengthFlag = 1;
constexpr unsigned kDsaFrameMaxCounts = 0x0FFF;

// core/byte_order.h is not used here: this runs once per taxel, and a loop over two bytes is
// slower.
unsigned unitAt(const std::byte* at) {
  return std::to_integer<unsigned>(at[0]) | std::to_integer<unsigned>(at[1]) << 8;
}

bool decodeRuns(std::span<const std::byte> units, std::span<float> counts) {
  std::size_t place = 0;
  for (std::size_t i = 0; i + 1 < units.size(); i += 2) {
    const unsigned unit = unitAt(&units[i]);
    const std::size_t run = unit >> 12;
    if (run == 0 || run > counts.size() - place) return false;
    std::fill_n(counts.begin() + static_cast<std::ptrdiff_t>(place),
                run,
                static_cast<float>(unit & kDsaFrameMaxCounts));
    place += run;
  }
  return place == counts.size();
}

bool decodeRaw(std::span<const std::byte> taxels, std::span<float> counts) {
  if (taxels.size() != 2 * counts.size()) return false;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const unsigned value = unitAt(&taxels[2 * i]);
    if (value > kDsaFrameMaxCounts) return false;
    counts[i] = static_cast<float>(value);
  }
  return true;
}

bool emptyWhereNoTaxelIs(const SensorLayout& layout, std::span<const float> counts) {
  std::size_t place = 0;
  for (const MatrixLayout& matrix : layout.matrices())
    for (const std::uint8_t exists : matrix.staticMask) {
      if (exists == 0 && counts[place] != 0.0F) return false;
      ++place;
    }
  return true;
}

}  // namespace

std::optional<DsaFrame> decodeDsaFrame(std::span<const std::byte> payload,
                                       const SensorLayout& layout,
                                       bool checkMask,
                                       std::span<float> counts) {
  if (counts.size() != layout.numCells())
    throw std::invalid_argument("decodeDsaFrame: room for " + std::to_string(counts.size()) +
                                " values, the layout has " + std::to_string(layout.numCells()));
  if (payload.size() < kDsaFrameHeaderBytes || payload.size() % 2 == 0) return std::nullopt;
  const unsigned flags = std::to_integer<unsigned>(payload[4]);
  if ((flags & ~kRunLengthFlag) != 0) return std::nullopt;
  DsaFrame frame;
  frame.stampMs = static_cast<std::uint32_t>(littleEndian(payload.first(4)));
  frame.runLength = flags == kRunLengthFlag;
  frame.packetBytes = payload.size() + kFramingBytes;
  const auto taxels = payload.subspan(kDsaFrameHeaderBytes);
  if (!(frame.runLength ? decodeRuns(taxels, counts) : decodeRaw(taxels, counts)))
    return std::nullopt;
  if (checkMask && !emptyWhereNoTaxelIs(layout, counts)) return std::nullopt;
  return frame;
}

// --- Rates

double dsaScanRateHz(std::size_t enabledTaxels) {
  struct Measured {
    double taxels, scanMs;
  };
  // Of the 78 places of a matrix, 68 are taxels. All taxels of an SDH-2: 456.
  constexpr Measured kMeasured[] = {{2.0, 13.2}, {68.0, 17.7}, {456.0, 31.55}};
  const double taxels =
      std::clamp(static_cast<double>(enabledTaxels), kMeasured[0].taxels, kMeasured[2].taxels);
  const int above = taxels > kMeasured[1].taxels ? 2 : 1;
  const Measured& low = kMeasured[above - 1];
  const Measured& high = kMeasured[above];
  return 1000.0 / (low.scanMs +
                   (high.scanMs - low.scanMs) * (taxels - low.taxels) / (high.taxels - low.taxels));
}

double dsaLineRateHz(double runs) {
  constexpr double kBytesPerS = 115'200.0 / 10.0;
  return kBytesPerS / (static_cast<double>(kFramingBytes + kDsaFrameHeaderBytes) + 2.0 * runs);
}

std::size_t dsaRunsOf(const TactileFrame& frame) {
  constexpr std::size_t kLongest = 15;
  std::size_t runs = 0, length = 0;
  for (std::size_t i = 0; i < frame.values.size(); ++i) {
    if (i > 0 && length < kLongest && frame.values[i] == frame.values[i - 1]) {
      ++length;
      continue;
    }
    ++runs;
    length = 1;
  }
  return runs;
}

// --- Clock

namespace {
// Limit by which the controller's clock may be ahead of the host's between two frames [ms]. A
// delayed controller sends late, never early; emulated controllers may run faster than real time.
constexpr double kAheadMs = 10'000.0;
}  // namespace

bool DsaClock::follows(std::uint32_t stampMs,
                       std::int64_t hostUs,
                       std::uint32_t last,
                       std::int64_t lastUs) const noexcept {
  // also correct across the wrap at 2^32
  const auto ahead = static_cast<std::int32_t>(stampMs - last);
  const double hostMs = static_cast<double>(std::max<std::int64_t>(hostUs - lastUs, 0)) / 1000.0;
  return ahead > 0 && static_cast<double>(ahead) <= hostMs * 1.01 + kAheadMs;
}

DsaClock::FrameAcceptance DsaClock::checkStamp(std::uint32_t stampMs, std::int64_t hostUs) {
  if (!last_) {
    last_ = Stamp{stampMs, hostUs};
    deviceMs_ = stampMs;
    return FrameAcceptance::kAccept;
  }
  if (follows(stampMs, hostUs, last_->ms, last_->hostUs)) {
    deviceMs_ += static_cast<std::int32_t>(stampMs - last_->ms);
    last_ = Stamp{stampMs, hostUs};
    const bool wasHeld = held_.has_value();
    held_.reset();
    return wasHeld ? FrameAcceptance::kDropHeld : FrameAcceptance::kAccept;
  }
  if (held_ && follows(stampMs, hostUs, held_->ms, held_->hostUs)) {
    heldMs_ = deviceMs_ + 1;
    deviceMs_ = heldMs_ + static_cast<std::int32_t>(stampMs - held_->ms);
    last_ = Stamp{stampMs, hostUs};
    held_.reset();
    return FrameAcceptance::kRestarted;
  }
  const bool wasHeld = held_.has_value();
  held_ = Stamp{stampMs, hostUs};
  return wasHeld ? FrameAcceptance::kReplaceHeld : FrameAcceptance::kHold;
}

// --- Loss

namespace {
// Number of intervals used for the estimate.
constexpr std::size_t kRecent = 32;
// Number of intervals needed before a frame counts as lost.
constexpr std::size_t kEnough = 8;
// An interval over this many periods means lost frames; stamps of real hands vary by a quarter
// period.
constexpr double kMissing = 1.75;
}  // namespace

bool DsaLossEstimate::known() const noexcept { return recentMs_.size() >= kEnough; }

void DsaLossEstimate::reset() noexcept {
  lastMs_.reset();
  recentMs_.clear();
  nextRecent_ = 0;
  scanPeriodMs_ = 0.0;
}

std::uint64_t DsaLossEstimate::next(std::int64_t deviceMs, std::size_t packetBytes) {
  if (!lastMs_) {
    lastMs_ = deviceMs;
    return 0;
  }
  const auto interval = static_cast<double>(deviceMs - *lastMs_);
  lastMs_ = deviceMs;
  const double lineMs = static_cast<double>(packetBytes) * byteUs_ / 1000.0;
  const double expected = std::max(scanPeriodMs_, lineMs);
  std::uint64_t missing = 0;
  if (known() && interval > kMissing * expected)
    missing = static_cast<std::uint64_t>(std::llround(interval / expected)) - 1;
  // Frames that were delayed by the line only give an upper limit of the scan period.
  const double scanned = interval / static_cast<double>(missing + 1);
  if (recentMs_.size() < kRecent) {
    recentMs_.push_back(scanned);
  } else {
    recentMs_[nextRecent_] = scanned;
    nextRecent_ = (nextRecent_ + 1) % kRecent;
  }
  // Mean of the middle half: stamps are whole milliseconds, and so would be a median.
  std::vector<double> sorted = recentMs_;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t quarter = sorted.size() / 4;
  double sum = 0.0;
  for (std::size_t i = quarter; i < sorted.size() - quarter; ++i) sum += sorted[i];
  scanPeriodMs_ = sum / static_cast<double>(sorted.size() - 2 * quarter);
  return missing;
}

}  // namespace palpate
