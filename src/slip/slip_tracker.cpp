#include "palpate/slip/slip_tracker.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "slip/translation_method.h"

namespace palpate {
namespace {

constexpr int kMinTaxels = 2;

std::unique_ptr<TranslationMethod> makeMethod(const MatrixLayout& layout,
                                              const SlipTrackerOptions& options) {
  switch (options.method) {
    case SlipMethod::kCentroid:
      return makeCentroidMethod(false);
    case SlipMethod::kAlcazar:
      return makeCentroidMethod(true);
    case SlipMethod::kNccParaboloid:
      return makeNccMethod(layout, options, true);
    case SlipMethod::kNccGauss3:
      return makeNccMethod(layout, options, false);
    case SlipMethod::kPhase:
      return makePhaseMethod(layout, options, false);
    case SlipMethod::kPhaseNormalized:
      return makePhaseMethod(layout, options, true);
    case SlipMethod::kRegister:
      return makeRegisterMethod(layout, options);
    case SlipMethod::kContest:
      break;
  }
  throw std::invalid_argument("SlipTracker: method is " + std::string(nameOf(options.method)));
}

// The moments with the distance of columns as unit of both directions, so that angles are true.
ContactMoments inColumns(const ContactMoments& moments, const TaxelPitch& pitch) {
  if (pitch.isSquare()) return moments;
  const double ratio = pitch.y / pitch.x;
  ContactMoments scaled = moments;
  scaled.y *= ratio;
  scaled.mu11 *= ratio;
  scaled.mu02 *= ratio * ratio;
  scaled.mu03 *= ratio * ratio * ratio;
  return scaled;
}

}  // namespace

void SlipTrackerOptions::validate() const {
  if (method == SlipMethod::kContest)
    throw std::invalid_argument("SlipTrackerOptions: method is contest");
  if (!(saturationCounts > 0.0))
    throw std::invalid_argument("SlipTrackerOptions: saturationCounts is " +
                                std::to_string(saturationCounts));
  if (maxStepTaxels < 1 || maxStepTaxels > 8)
    throw std::invalid_argument("SlipTrackerOptions: maxStepTaxels is " +
                                std::to_string(maxStepTaxels) + ", not 1..8");
  rotation.validate();
  registration.validate();
  surface.validate();
  probableSurface.validate();
}

SlipTracker::SlipTracker(const MatrixLayout& layout, const SlipTrackerOptions& options)
    : layout_(layout),
      options_(options),
      outline_(layout.rows, layout.columns),
      rotation_(options.rotation) {
  layout_.validate();
  options_.validate();
  reset();
}
SlipTracker::~SlipTracker() = default;
SlipTracker::SlipTracker(SlipTracker&&) noexcept = default;
SlipTracker& SlipTracker::operator=(SlipTracker&&) noexcept = default;

void SlipTracker::reset() {
  method_ = makeMethod(layout_, options_);
  rotation_.reset();
  motion_ = {};
  wantsReference_ = options_.firstContactIsReference;
  if (!wantsReference_) rotation_.clearReference();
}

int SlipTracker::minForReference() const noexcept {
  const bool point =
      options_.method == SlipMethod::kCentroid || options_.method == SlipMethod::kAlcazar;
  return point ? 1 : kMinTaxels;
}

void SlipTracker::setReference() {
  rotation_.setReference();
  motion_.refDx = 0.0;
  motion_.refDy = 0.0;
  wantsReference_ = motion_.active < minForReference();
  if (wantsReference_)
    method_->dropReference();
  else
    method_->takeReference();
  motion_.refValid = motion_.active >= kMinTaxels;
  motion_.rotation.refRotationDeg = 0.0;
}

void SlipTracker::clearReference() {
  method_->dropReference();
  rotation_.clearReference();
  wantsReference_ = false;
  motion_.refValid = false;
  motion_.refDx = 0.0;
  motion_.refDy = 0.0;
  motion_.rotation.refValid = false;
}

const SlipMotion& SlipTracker::update(const ConstMatrixMap& frame, bool afterGap) {
  if (frame.rows() != layout_.rows || frame.cols() != layout_.columns)
    throw std::invalid_argument("SlipTracker: the frame doesn't have the size of the matrix");
  const int activeBefore = motion_.active;
  const ContactMoments moments = contactMoments(frame);
  motion_ = {};
  motion_.active = moments.active;
  motion_.sum = moments.sum;
  motion_.x = moments.x;
  motion_.y = moments.y;
  motion_.afterGap = afterGap;
  motion_.touched = moments.active > 0 && activeBefore == 0;
  if (afterGap) rotation_.skip();
  if (moments.active == 0) {
    method_->lost();
    motion_.rotation = rotation_.update(moments, 0.0);
    return motion_;
  }
  const bool measurable = moments.active >= kMinTaxels;
  const TranslationReading reading =
      method_->update(frame, moments, measurable, activeBefore >= kMinTaxels && !afterGap);
  motion_.valid = reading.valid;
  motion_.dx = reading.dx;
  motion_.dy = reading.dy;
  motion_.sdX = reading.valid ? reading.sdX : 0.0;
  motion_.sdY = reading.valid ? reading.sdY : 0.0;
  motion_.refValid = reading.refValid;
  motion_.refDx = reading.refDx;
  motion_.refDy = reading.refDy;
  motion_.residual = reading.residual;
  motion_.gain = reading.gain;
  motion_.degenerate = reading.degenerate.count;
  motion_.degenerateX = reading.degenerate.x;
  motion_.degenerateY = reading.degenerate.y;
  motion_.newKey = reading.newKey;
  const double unseen = unseenFraction(frame);
  if (measurable)
    motion_.confidence = reading.confidence * (reading.isCentroid ? 1.0 - unseen : 1.0);
  const TaxelPitch& pitch = layout_.pitchMm;
  motion_.rotation = rotation_.update(inColumns(moments, pitch),
                                      outline_.describe(frame).roundness,
                                      pitch.isSquare() && axisIsDetermined(frame, moments));
  if (reading.turns) {
    motion_.rotation.reliable = true;
    motion_.rotation.valid = reading.angleValid;
    motion_.rotation.rotationDeg = reading.angleDeg;
    motion_.rotation.refValid = reading.refAngleValid;
    motion_.rotation.refRotationDeg = reading.refAngleDeg;
  }
  if (wantsReference_ && moments.active >= minForReference()) {
    method_->takeReference();
    wantsReference_ = false;
    motion_.refValid = measurable;
    if (reading.turns) motion_.rotation.refValid = true;
  }
  return motion_;
}

// Fraction of the load that is saturated or at a side of the matrix, where the contact may continue
// outside.
double SlipTracker::unseenFraction(const ConstMatrixMap& frame) {
  const auto saturation = static_cast<float>(options_.saturationCounts);
  const int right = layout_.columns - 1;
  const int bottom = layout_.rows - 1;
  float unseen = 0.0F;
  for (int y = 0; y <= bottom; ++y) {
    const float* row = frame.data() + y * layout_.columns;
    const bool end = y == 0 || y == bottom;
    for (int x = 0; x <= right; ++x) {
      const bool saturated = row[x] >= saturation;
      motion_.saturated += saturated ? 1 : 0;
      if (isTouched(row[x]) && (saturated || end || x == 0 || x == right)) unseen += row[x];
    }
  }
  return std::min(static_cast<double>(unseen) / motion_.sum, 1.0);
}

SensorSlipTracker::SensorSlipTracker(const SensorLayout& layout, const SlipTrackerOptions& options)
    : motions_(layout.numMatrices()) {
  trackers_.reserve(layout.numMatrices());
  for (const MatrixLayout& matrix : layout.matrices()) trackers_.emplace_back(matrix, options);
}

const std::vector<SlipMotion>& SensorSlipTracker::update(const TactileFrame& frame) {
  if (!frame.layout || frame.layout->numMatrices() != trackers_.size())
    throw std::invalid_argument("SensorSlipTracker: the frame has a different layout");
  const bool afterGap = gaps_.afterGap(frame.hostUs);
  for (std::size_t m = 0; m < trackers_.size(); ++m)
    motions_[m] = trackers_[m].update(frame.matrix(m), afterGap);
  return motions_;
}

void SensorSlipTracker::setReference() {
  for (std::size_t m = 0; m < trackers_.size(); ++m) {
    trackers_[m].setReference();
    motions_[m] = trackers_[m].last();
  }
}

void SensorSlipTracker::reset() {
  for (SlipTracker& tracker : trackers_) tracker.reset();
  std::fill(motions_.begin(), motions_.end(), SlipMotion{});
  gaps_.reset();
}

}  // namespace palpate
