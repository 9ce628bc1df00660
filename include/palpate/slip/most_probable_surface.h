// Surface of a contact that lies inside the matrix: the most probable one given all readings so far
// and a prior for contacts with edges (SurfaceInformation).
//
// As LearnedSurface, it is refined by every registered frame. It differs in the estimate of the
// coefficients: all covariances of the readings count, and between the readings the prior says how
// a contact with edges goes on. In the first frames of a contact with sharp edges the errors of
// steps are 0.5 to 0.8 times as large (docs/notes/slip.md); a frame costs more. Beyond the readings
// the prior draws the surface to 0. So it must not be used for a contact that goes on outside of
// the matrix, whose motion would seem to be determined: loadAtTwoSides() (contact_ends.h) tells
// where it may.
//
// How uncertain a value is, for the weights of a registration, is followed per coefficient, as by a
// Kalman filter with a diagonal covariance matrix: it begins larger between taxels, where taxels
// are below the threshold, and outside of the matrix.
// x = column, y = row, in taxels; the surface reaches kMargin taxels beyond the outer taxels.
#pragma once

#include <vector>

#include <palpate/slip/key_frame.h>
#include <palpate/slip/rigid_registration.h>
#include <palpate/slip/surface_grid.h>
#include <palpate/slip/surface_information.h>

namespace palpate {

struct MostProbableSurfaceOptions {
  // Standard deviation of the surface before any reading, as a fraction of the largest count, > 0.
  double priorSd = 0.35;
  // Initial standard deviation of a value between taxels, as a fraction of the largest count, >= 0.
  double interpolationSd = 0.025;
  // Initial standard deviation of a taxel below the threshold that is next to an active one, as
  // a fraction of the threshold, > 0.
  double belowThresholdSd = 0.5;
  // Initial standard deviation outside of the matrix, as a fraction of the largest count, > 0.
  double outsideSd = 0.3;
  // Process noise: variance added per frame as a fraction of the measurement noise variance, >=
  // 0. It lets the surface follow a contact whose shape changes.
  double processNoiseRatio = 0.001;
  // Fraction of the information of earlier readings that is dropped per frame, 0..0.5, for the same
  // reason.
  double forgottenPerFrame = 0.005;
  // Iterations that improve the coefficients when the surface begins, and after each frame, 1..100.
  int startIterations = 20;
  int iterations = 3;
  KeyFrameOptions key = {};

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

class MostProbableSurface {
 public:
  static constexpr int kMargin = SurfaceGrid::kMargin;  // [taxels]
  using Sample = SurfaceGrid::Sample;

  // Throws std::invalid_argument.
  explicit MostProbableSurface(const MatrixLayout& layout,
                               const MostProbableSurfaceOptions& options = {});

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
  // Number of frames that the surface was learned from, with the first one; 0 without a surface.
  int frames() const noexcept { return empty() ? 0 : frames_; }
  const SurfaceGrid& grid() const noexcept { return grid_; }

 private:
  void beginInformation(const ConstMatrixMap& frame, float noise2, float largest);

  KeyFrame key_;
  MostProbableSurfaceOptions options_;
  SurfaceGrid grid_;
  SurfaceInformation information_;
  // Variance at the start, per taxel.
  std::vector<float> ofTaxels_;
  float least_ = 0.0F;
  int frames_ = 0;
};

// Registers a frame to the surface, as registerFrame() does to a key frame without blur.
RegistrationResult registerFrame(const MostProbableSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options);

}  // namespace palpate
