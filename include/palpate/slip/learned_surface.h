// A key frame that learns: a contact's surface, finer than the taxels, which every registered frame makes better known.
//
// One frame samples an edged contact too coarsely: between taxels its interpolation is wrong by some counts, which moves a registration by hundredths of a taxel.
// Frames at other places fill that in. The surface is a cubic B-spline with a knot every half taxel; every
// coefficient has a variance, and a reading F = gain T(source) + noise corrects the sixteen around its source as a Kalman
// filter with a diagonal covariance does. It starts as the interpolation of one frame (KeyFrame), unsure where that one bends, where it is silent, and
// outside of the matrix, where nothing was felt yet.
// x = column, y = row, in taxels; the surface reaches kMargin taxels beyond the outer taxels.
#pragma once

#include <vector>

#include <palpate/slip/key_frame.h>
#include <palpate/slip/rigid_registration.h>

namespace palpate {

struct LearnedSurfaceOptions {
  double unsureOfBend = 0.03;  // sd of the start per count of second difference, >= 0
  double unsureOfSilence =
      0.5;  // sd of what a silent taxel beside an active one feels, per threshold, >= 0
  double unsureOutside = 0.3;  // sd outside of the matrix, per largest count, > 0
  double forgetting =
      0.001;  // variance that a frame adds, per variance of the noise, >= 0: follows a shape that changes
  KeyFrameOptions key = {};

  void validate() const;  // throws std::invalid_argument naming the field
};

class LearnedSurface {
 public:
  static constexpr int kMargin = 2;  // [taxels]

  struct Sample {
    float value = 0.0F;
    float alongX = 0.0F;  // [counts per taxel]
    float alongY = 0.0F;
    float variance = 0.0F;  // of the value [counts^2]
  };

  // Throws std::invalid_argument.
  explicit LearnedSurface(const MatrixLayout& layout, const LearnedSurfaceOptions& options = {});

  // Starts anew from a frame, as KeyFrame::set. Allocates nothing.
  bool set(const ConstMatrixMap& frame, double noiseCounts);
  void clear() noexcept { key_.clear(); }
  bool empty() const noexcept { return key_.empty(); }
  // x within -kMargin .. columns - 1 + kMargin, y alike.
  Sample at(float x, float y) const noexcept;
  // Takes what a registered frame says, by as much as its motion is known; the options as they were used.
  void learn(const ConstMatrixMap& frame,
             const RegistrationResult& found,
             const RegistrationOptions& options) noexcept;

  const KeyFrame& start() const noexcept { return key_; }  // the frame it began with
  float leastCounts() const noexcept {
    return least_;
  }  // smallest active value of all frames so far

 private:
  KeyFrame key_;
  LearnedSurfaceOptions options_;
  int columns_ = 0;  // of coefficients
  int rows_ = 0;
  std::vector<float> coefficients_;
  std::vector<float> variances_;
  std::vector<float> ofTaxels_;  // variance at the start, per taxel with margin
  float least_ = 0.0F;
};

// As registerFrame() to a key frame without blur.
RegistrationResult registerFrame(const LearnedSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options);

}  // namespace palpate
