#include "palpate/calibration/pressure_reader.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "palpate/calibration/drift_compensation.h"
#include "palpate/core/error.h"

namespace palpate {
namespace {

// Creep is compensated for kLongestS at most; this time is a little longer.
constexpr std::int64_t kBeforeUs = 40'000'000;
static_assert(DriftCompensationOptions::kLongestS * 1e6 < static_cast<double>(kBeforeUs));

}  // namespace

PressureReader::PressureReader(Profile profile,
                               const Calibration& calibration,
                               PressureMapOptions options,
                               std::optional<Tare> tare)
    : profile_(std::move(profile)),
      map_(calibration, profile_.hand(), std::move(options)),
      tare_(std::move(tare)) {
  if (profile_.info().valueType != ValueType::kCounts)
    throw Error("the recording holds filtered values: a calibration needs counts");
  if (tare_ && tare_->zero.size() != profile_.layout().numCells())
    throw std::invalid_argument("PressureReader: a tare of another hand");
}

void PressureReader::go(std::size_t frame) {
  profile_.readFrame(frame, frame_);
  const auto sample = profile_.temperatureSampleAt(frame_.hostUs);
  if (sample && sample != sample_) degC_ = profile_.temperatures(*sample).values;
  sample_ = sample;
  if (tare_) applyTare(*tare_, frame_.values);
  map_.apply(frame_, degC_, pressures_);
  now_ = frame;
}

const PressureFrame& PressureReader::at(std::size_t frame) {
  if (frame >= profile_.numFrames())
    throw std::out_of_range("PressureReader: frame " + std::to_string(frame) + " of " +
                            std::to_string(profile_.numFrames()));
  if (now_ == frame) return pressures_;
  const std::size_t from = profile_.frameAt(profile_.frameTimeUs(frame) - kBeforeUs).value_or(0);
  std::size_t next = from;
  if (now_ && *now_ < frame && *now_ >= from) {
    next = *now_ + 1;
  } else {
    now_.reset();
    map_.reset();
  }
  for (; next <= frame; ++next) try {
      go(next);
    } catch (const Error&) {
      // An earlier frame that can't be read is left out.
      if (next == frame) throw;
    }
  return pressures_;
}

}  // namespace palpate
