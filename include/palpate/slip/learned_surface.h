// Surface of a contact with a resolution finer than the taxels, refined by every registered frame.
//
// One frame samples a contact with edges too coarsely: the interpolation between taxels is wrong by
// some counts, which shifts a registration by some hundredths of a taxel. Frames at other positions
// add the missing samples. The surface is a cubic B-spline with a knot every half taxel. Each
// coefficient has a variance, and each reading F = gain T(source) + noise updates the sixteen
// coefficients around its source as a Kalman filter with a diagonal covariance matrix does. The
// initial surface is the interpolation of one frame (KeyFrame), with a larger variance where its
// curvature is high, where taxels are below the threshold, and outside of the matrix.
// x = column, y = row, in taxels; the surface reaches kMargin taxels beyond the outer taxels.
#pragma once

#include <vector>

#include <palpate/slip/key_frame.h>
#include <palpate/slip/rigid_registration.h>
#include <palpate/slip/surface_grid.h>

namespace palpate {

struct LearnedSurfaceOptions {
  // Initial standard deviation [counts] per count of the second difference of the frame, >= 0.
  double curvatureSd = 0.03;
  // Initial standard deviation of a taxel below the threshold that is next to an active one, as
  // a fraction of the threshold, >= 0.
  double belowThresholdSd = 0.5;
  // Initial standard deviation outside of the matrix, as a fraction of the largest count, > 0.
  double outsideSd = 0.3;
  // Process noise: variance added per frame as a fraction of the measurement noise variance, >=
  // 0. It lets the surface follow a contact whose shape changes.
  double processNoiseRatio = 0.001;
  KeyFrameOptions key = {};

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// The surface of the contact on one matrix, as the slip method `register` learns it.
class LearnedSurface {
 public:
  static constexpr int kMargin = SurfaceGrid::kMargin;  // [taxels]
  using Sample = SurfaceGrid::Sample;

  // Throws std::invalid_argument.
  explicit LearnedSurface(const MatrixLayout& layout, const LearnedSurfaceOptions& options = {});

  // Discards the surface and starts again from a frame, as KeyFrame::set. Allocates nothing.
  bool set(const ConstMatrixMap& frame, double noiseCounts);
  void clear() noexcept { key_.clear(); }
  bool empty() const noexcept { return key_.empty(); }
  // Value of the surface at x within -kMargin .. columns - 1 + kMargin; y alike [taxels].
  Sample at(float x, float y) const noexcept { return grid_.at(x, y); }
  // Updates the surface with a registered frame, weighted by the accuracy of its motion; `options`
  // must be those of the registration.
  void learn(const ConstMatrixMap& frame,
             const RegistrationResult& found,
             const RegistrationOptions& options) noexcept;

  // The frame that the surface was started from.
  const KeyFrame& start() const noexcept { return key_; }
  // The smallest active value of all frames so far [counts].
  float minCounts() const noexcept { return least_; }
  const SurfaceGrid& grid() const noexcept { return grid_; }

 private:
  KeyFrame key_;
  LearnedSurfaceOptions options_;
  SurfaceGrid grid_;
  // Variance at the start, per taxel, with the margin.
  std::vector<float> ofTaxels_;
  float least_ = 0.0F;
};

// Registers a frame to the surface, as registerFrame() does to a key frame without blur.
RegistrationResult registerFrame(const LearnedSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options);

}  // namespace palpate
