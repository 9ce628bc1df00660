// Sequential test of one matrix: does the contact slip? The evidence of every frame is added up
// until it is sufficient (cumulative sum, Page 1954). SlipRule uses it.
//
//   S(n) = max(0, memory S(n-1) + e(n)),  e(n) = clamp(bias + weights . features(n),
//   +-mostPerFrame)
//
// e is the logarithm of the likelihood ratio of slip to no slip, as a logistic regression estimates
// it from the features of a frame. One step is made per stored frame (slip_windows.h): above 50
// frames/s every 20 ms. The default weights were fitted to the recordings that
// docs/notes/load_shift.md names; fitSlipSequence() in slip_evaluation.h fits them. A feature
// depends on lengths in taxels, on load ratios and on residuals per noise, and on no property of
// one hand.
#pragma once

#include <array>
#include <cstddef>

namespace palpate {

struct SlipEvidence;

// Features of a frame, in this order. "Recent": compared with the frame three stored frames before,
// or the first of the contact; "last": with the stored frame before.
//   0, 1  ln of the rise, and of the fall, of the load (recent), at most 1.5
//   2     ln(0.05 + s), s: shift of the centroid [taxels] (recent), at most 2, less the allowance
//   3     difference of ln(1 + residual), load field minus rigid motion (recent), residuals up to
//         200; the rigid motion has 0 where none could be fitted
//   4     ln(1 + residual) of the rigid motion
//   5, 6  as 0 and 1 (last)
//   7     shift of the centroid [taxels] (last), at most 2
//   8, 9  exp(-age / 4), exp(-age / 12), age of the contact in stored frames
inline constexpr std::size_t kSlipFeatures = 10;
using SlipFeatures = std::array<double, kSlipFeatures>;

struct SlipSequenceOptions {
  double bias = 2.230;
  SlipFeatures weights = {
      -1.190, 1.887, 2.394, 1.068, 0.822, -0.308, -0.585, 3.319, -3.901, -3.278};
  // Part of the sum that is kept from one frame to the next, 0..1.
  double memory = 0.9;
  // Largest evidence of a single frame, > 0.
  double mostPerFrame = 6.0;
  // The contact slips if the sum is larger, > 0.
  double threshold = 22.0;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Recent shift of the centroid [taxels] above which the residuals are used, so that the hypotheses
// must be compared.
inline constexpr double kMinComparedShift = 0.05;

// Computes the features. `scale` multiplies the shifts; `allowancePerJointDeg` [taxels per degree]
// is subtracted from the recent shift for the joint that moved most.
SlipFeatures slipFeatures(const SlipEvidence& evidence, double scale, double allowancePerJointDeg);

class SlipSequence {
 public:
  // Throws std::invalid_argument.
  explicit SlipSequence(const SlipSequenceOptions& options = {});

  // Adds the features of a frame and returns the sum.
  double add(const SlipFeatures& features) noexcept;
  double sum() const noexcept { return sum_; }
  bool exceeds() const noexcept { return sum_ > options_.threshold; }
  void reset() noexcept { sum_ = 0.0; }
  const SlipSequenceOptions& options() const noexcept { return options_; }

 private:
  SlipSequenceOptions options_;
  double sum_ = 0.0;
};

}  // namespace palpate
