// A key frame of one matrix as a smooth surface. Later frames are registered to it
// (rigid_registration.h, slip_hypotheses.h).
//
// A cubic B-spline interpolates the counts, or their Gaussian-smoothed values. A taxel that reads 0
// has a true value between 0 and the sensor's threshold: next to an active taxel it is set to a
// fraction of the threshold and marked as unknown. Masked taxels are unknown as well and are filled
// from their neighbours.
// x = column, y = row, in taxels; the surface reaches from -0.5 to columns - 0.5 and rows - 0.5.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct KeyFrameOptions {
  // Standard deviation [taxels] of the 3 x 3 Gaussian that smooths the key and the frames, 0..2; 0:
  // no smoothing.
  double blurTaxels = 0.0;
  // Value of a taxel below the threshold next to an active one, as a fraction of the threshold,
  // 0..1.
  double fillOfThreshold = 0.4;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Smooths the enabled taxels with a 3 x 3 Gaussian; at borders the weights are renormalised. A
// standard deviation of 0 copies. `out` must have rows x columns values and must not be `in`.
// Masked places become 0.
void smoothMatrix(const MatrixLayout& layout,
                  double blurTaxels,
                  const float* in,
                  float* out) noexcept;

class KeyFrame {
 public:
  // Value of the surface, its gradient, and the fraction of the value that is unknown, 0..1.
  struct Sample {
    float value = 0.0F;
    float alongX = 0.0F;  // [counts per taxel]
    float alongY = 0.0F;
    float unknown = 0.0F;
  };

  // Throws std::invalid_argument.
  explicit KeyFrame(const MatrixLayout& layout, const KeyFrameOptions& options = {});

  // Makes a frame of this matrix the key; allocates nothing. Returns false when fewer than
  // kMinTaxels taxels are active; there is no key then. Throws std::invalid_argument when the frame
  // has another size.
  bool set(const ConstMatrixMap& frame);
  void clear() noexcept { active_ = 0; }
  bool empty() const noexcept { return active_ == 0; }

  // Value of the surface at x within -0.5 .. columns - 0.5 and y within -0.5 .. rows - 0.5
  // [taxels].
  Sample at(float x, float y) const noexcept;

  int active() const noexcept { return active_; }
  // Centroid of the active taxels [taxels].
  double centerX() const noexcept { return centerX_; }
  double centerY() const noexcept { return centerY_; }
  double sum() const noexcept { return sum_; }  // [counts]
  // The smallest active value [counts]; it is at or above the threshold of the sensor.
  float minCounts() const noexcept { return least_; }
  // Sensitivity to rotation: the fraction of the squared gradient that points around the centroid
  // instead of towards it, over the taxels with known neighbours. 0: a round contact, whose angle
  // cannot be estimated; at most 0.5 for a contact without structure.
  // -1: taxels that aren't square, in whose coordinates a turned contact is distorted.
  float rotationSensitivity() const noexcept { return rotationSensitivity_; }
  const MatrixLayout& layout() const noexcept { return layout_; }
  const KeyFrameOptions& options() const noexcept { return options_; }
  // The smoothed values, rows x columns, row by row.
  const std::vector<float>& smoothed() const noexcept { return smoothed_; }

  // One flag per place, row by row: 1 for an enabled taxel.
  const std::uint8_t* enabled() const noexcept { return enabled_.data(); }
  // The values, row by row, with the masked taxels and those below the threshold filled.
  const std::vector<float>& filled() const noexcept { return filled_; }
  // Coefficient of the spline at a taxel. More than two places outside of the matrix the outermost
  // coefficient is returned.
  float coefficient(int y, int x) const noexcept;

  static constexpr int kMinTaxels = 2;

 private:
  void fill();
  void interpolate() noexcept;
  void computeRotationSensitivity() noexcept;

  MatrixLayout layout_;
  KeyFrameOptions options_;
  int stride_ = 0;
  std::vector<std::uint8_t> enabled_;
  std::vector<float> smoothed_;
  std::vector<float> filled_;
  // Spline coefficients, with a border of two places around the matrix.
  std::vector<float> coefficients_;
  // Unknown fraction per taxel, with a border of one place around the matrix.
  std::vector<float> unknown_;
  int active_ = 0;
  double centerX_ = 0.0;
  double centerY_ = 0.0;
  double sum_ = 0.0;
  float least_ = 0.0F;
  float rotationSensitivity_ = 0.0F;
};

}  // namespace palpate
