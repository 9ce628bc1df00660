// The slip method `register`: rigid registration of a stream of frames to a key frame. The key
// frame is refined by every frame and replaced when it no longer fits; the motion since the
// reference is accumulated over the key frames. A strong contact that ends inside the matrix is
// refined as a MostProbableSurface, every other one as a LearnedSurface.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/slip/contact_ends.h"
#include "palpate/slip/most_probable_surface.h"

#include "slip/translation_method.h"

namespace palpate {
namespace {

constexpr double kRegisterMethodRadians = std::numbers::pi / 180.0;

// Limits beyond which the key frame is replaced: too little overlap, or too large a difference from
// the key.
constexpr double kRegisterMethodLeastOverlap = 0.6;
// Rms residual relative to the mean active taxel.
constexpr double kWorstMisfit = 0.25;
constexpr double kMaxGain = 1.8;
constexpr double kFarthest = 3.0;  // [taxels]
constexpr double kMaxTurnDeg = 40.0;
// Misfit above which a registration is rejected.
constexpr double kNoFit = 0.6;

// Weight of a new frame in the estimated noise.
constexpr double kNoiseMemory = 0.03;
constexpr double kMaxNoise = 100.0;  // [counts]
// Up to this number of frames of a surface its steps are measured again after it learned from them.
constexpr int kYoungSurface = 25;
// Above this shift of the centroid [taxels], it is added to the start value.
constexpr double kSureShift = 0.7;

// Rigid transform p -> R p + t; the angle is accumulated and not wrapped.
struct Transform {
  double angleDeg = 0.0;
  double tx = 0.0;
  double ty = 0.0;

  void apply(double x, double y, double& outX, double& outY) const {
    const double c = std::cos(angleDeg * kRegisterMethodRadians);
    const double s = std::sin(angleDeg * kRegisterMethodRadians);
    outX = c * x - s * y + tx;
    outY = s * x + c * y + ty;
  }
  // Returns the transform that applies `first` and then this one.
  Transform after(const Transform& first) const {
    Transform both{angleDeg + first.angleDeg, 0.0, 0.0};
    apply(first.tx, first.ty, both.tx, both.ty);
    return both;
  }
  Transform inverse() const {
    Transform back{-angleDeg, 0.0, 0.0};
    double x = 0.0;
    double y = 0.0;
    back.apply(tx, ty, x, y);
    back.tx = -x;
    back.ty = -y;
    return back;
  }
};

class RegisterMethod final : public TranslationMethod {
 public:
  RegisterMethod(const MatrixLayout& layout, const SlipTrackerOptions& options)
      : layout_(layout),
        options_(options.registration),
        learned_(layout, options.surface),
        probable_(layout, options.probableSurface),
        previous_(layout.numCells()) {
    options_.saturationCounts = options.saturationCounts;
    noise_ = options_.noiseCounts;
  }

  TranslationReading update(const ConstMatrixMap& frame,
                            const ContactMoments& moments,
                            bool measurable,
                            bool stepPossible) override {
    TranslationReading reading;
    if (!measurable) {
      seen_ = false;
      return reading;
    }
    const bool first = key().empty();
    if (first) {
      beginKey(frame, {});
      reading.newKey = true;
    } else {
      follow(frame, moments, reading, stepPossible && seen_);
    }
    if (hasReference_) {
      const Transform whole = motion().after(keyFromReference_);
      double x = 0.0;
      double y = 0.0;
      whole.apply(referenceX_, referenceY_, x, y);
      reading.refValid = true;
      reading.refDx = x - referenceX_;
      reading.refDy = y - referenceY_;
      reading.refAngleValid = reading.turns;
      reading.refAngleDeg = whole.angleDeg;
    }
    reading.gain = motion_.gain;
    lastX_ = moments.x;
    lastY_ = moments.y;
    std::copy_n(frame.data(), frame.size(), previous_.begin());
    seen_ = true;
    return reading;
  }
  void lost() override { seen_ = false; }
  void takeReference() override {
    keyFromReference_ = motion().inverse();
    referenceX_ = lastX_;
    referenceY_ = lastY_;
    hasReference_ = true;
  }
  void dropReference() override { hasReference_ = false; }

 private:
  const KeyFrame& key() const { return isProbable_ ? probable_.start() : learned_.start(); }
  RegistrationResult registered(const ConstMatrixMap& frame,
                                const RigidMotion& from,
                                const RegistrationOptions& options) const {
    return isProbable_ ? registerFrame(probable_, frame, from, options)
                       : registerFrame(learned_, frame, from, options);
  }

  // Transform from the key frame to the newest frame.
  Transform motion() const {
    Transform transform{motion_.angleDeg, 0.0, 0.0};
    const double cx = key().centerX();
    const double cy = key().centerY();
    double x = 0.0;
    double y = 0.0;
    transform.apply(cx, cy, x, y);
    transform.tx = cx + motion_.dx - x;
    transform.ty = cy + motion_.dy - y;
    return transform;
  }

  // Makes a frame the key frame. `sofar`, the transform from the reference to this frame, is kept
  // in keyFromReference_.
  void beginKey(const ConstMatrixMap& frame, const Transform& sofar) {
    sdX_ = sdY_ = 0.0;
    isProbable_ = loadAtTwoSides(layout_, frame) < 1.0 && isStrongContact(frame, noise_);
    if (isProbable_)
      probable_.set(frame, noise_);
    else
      learned_.set(frame, noise_);
    motion_ = {};
    keyFromReference_ = sofar;
  }

  void follow(const ConstMatrixMap& frame,
              const ContactMoments& moments,
              TranslationReading& reading,
              bool stepPossible) {
    const RigidMotion before = motion_;
    const double shiftX = moments.x - lastX_;
    const double shiftY = moments.y - lastY_;
    RigidMotion start = before;
    if (std::hypot(shiftX, shiftY) > kSureShift) {
      start.dx += shiftX;
      start.dy += shiftY;
    }
    RegistrationOptions options = options_;
    options.noiseCounts = noise_;
    const RegistrationResult result = registered(frame, start, options);
    const double mean = moments.sum / moments.active;
    const double misfit = std::sqrt(result.chi2) * noise_ / mean;
    const double scale = noise_ / options_.noiseCounts;
    reading.residual = result.chi2 * scale * scale;
    reading.turns =
        key().rotationSensitivity() >= static_cast<float>(options_.minRotationSensitivity);

    if (!result.converged || misfit > kNoFit) {
      // The frame does not match the key: the motion of the centroid is used, with low confidence.
      motion_ = before;
      motion_.dx += shiftX;
      motion_.dy += shiftY;
      reading.valid = stepPossible;
      reading.dx = stepPossible ? shiftX : 0.0;
      reading.dy = stepPossible ? shiftY : 0.0;
      reading.confidence = 0.1;
      reading.newKey = true;
      beginKey(frame, motion().after(keyFromReference_));
      return;
    }
    motion_ = result.motion;
    // The variance of the surface is that of the roughest contact; the residuals tell how much of
    // it this contact has.
    const double trust = std::sqrt(std::clamp(result.chi2, 0.05, 4.0));
    reading.degenerate = result.degenerate;
    reading.valid = stepPossible;
    if (stepPossible) {
      reading.sdX = std::hypot(trust * result.sdX, sdX_ > 0.0 ? sdX_ : trust * result.sdX);
      reading.sdY = std::hypot(trust * result.sdY, sdY_ > 0.0 ? sdY_ : trust * result.sdY);
      reading.dx = motion_.dx - before.dx;
      reading.dy = motion_.dy - before.dy;
      reading.angleDeg = motion_.angleDeg - before.angleDeg;
      reading.angleValid = reading.turns;
    }
    reading.confidence = result.overlap / (1.0 + 5.0 * misfit);
    const double noise = noise_ * std::sqrt(std::clamp(result.chi2, 0.1, 10.0));
    noise_ =
        std::clamp(noise_ + kNoiseMemory * (noise - noise_), 0.5 * options_.noiseCounts, kMaxNoise);

    // A contact that grew over two sides would seem to end where its key frame ended. One that
    // moves over one side does end there, and keeps its surface.
    const bool goesOn = isProbable_ && loadAtTwoSides(layout_, frame) > 1.0;
    if (goesOn || result.overlap < kRegisterMethodLeastOverlap || misfit > kWorstMisfit ||
        motion_.gain > kMaxGain || motion_.gain < 1.0 / kMaxGain ||
        std::hypot(motion_.dx, motion_.dy) > kFarthest ||
        std::abs(motion_.angleDeg) > kMaxTurnDeg) {
      beginKey(frame, motion().after(keyFromReference_));
      reading.newKey = true;
    } else if (isProbable_) {
      probable_.learn(frame, result, options);
      if (stepPossible && probable_.frames() <= kYoungSurface)
        measureStepAgain(frame, before, options, reading);
    } else {
      learned_.learn(frame, result, options);
    }
    if (reading.newKey) return;
    sdX_ = trust * result.sdX;
    sdY_ = trust * result.sdY;
  }

  // The first frames teach the surface most: registered again to the surface after this frame, the
  // frame before and this one have smaller errors, and errors of the surface cancel in their
  // difference. The motion from the key stays as it was.
  void measureStepAgain(const ConstMatrixMap& frame,
                        const RigidMotion& before,
                        RegistrationOptions options,
                        TranslationReading& reading) const {
    options.maxIterations = 2;
    const ConstMatrixMap previous(previous_.data(), frame.rows(), frame.cols());
    const RegistrationResult first = registered(previous, before, options);
    const RegistrationResult second = registered(frame, motion_, options);
    if (!first.converged || !second.converged) return;
    reading.dx = second.motion.dx - first.motion.dx;
    reading.dy = second.motion.dy - first.motion.dy;
    reading.angleDeg = second.motion.angleDeg - first.motion.angleDeg;
  }

  MatrixLayout layout_;
  RegistrationOptions options_;
  // The surface of the contact: probable_ if isProbable_, else learned_.
  LearnedSurface learned_;
  MostProbableSurface probable_;
  bool isProbable_ = false;
  // The values of the previous measurable frame, row by row.
  std::vector<float> previous_;
  // Noise estimated from the residuals [counts].
  double noise_ = 0.0;
  // Motion from the key frame to the newest frame.
  RigidMotion motion_;
  Transform keyFromReference_;
  // Standard deviation of this motion; 0 in the first frame of a key.
  double sdX_ = 0.0;
  double sdY_ = 0.0;
  double referenceX_ = 0.0;
  double referenceY_ = 0.0;
  bool hasReference_ = false;
  double lastX_ = 0.0;
  double lastY_ = 0.0;
  // Whether the previous frame was measurable.
  bool seen_ = false;
};

}  // namespace

std::unique_ptr<TranslationMethod> makeRegisterMethod(const MatrixLayout& layout,
                                                      const SlipTrackerOptions& options) {
  return std::make_unique<RegisterMethod>(layout, options);
}

}  // namespace palpate
