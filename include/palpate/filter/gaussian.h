// Spatial Gaussian filter of one matrix (study, chapter 2), for the filter "gaussian" and for the
// characteristic signals:
//   g(i) = exp(-i^2 / (2 sigma^2)), normalised over the kernel, separable.
// Borders are replicated. Masked taxels are neither read nor written: the weights of the taxels
// that exist are normalised to 1. Causal (one frame).
#pragma once

#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct GaussianOptions {
  // Kernel width [taxels], odd, 1..31; size = 2 radius + 1.
  int size = 3;
  // Standard deviation [taxels]; 0 means (size + 1) / 2 / 2.3548: the half-width of the kernel is
  // the full width at half maximum.
  double sigma = 0.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
  double effectiveSigma() const;
};

// Returns the `size` weights along one direction, normalised to 1. Throws std::invalid_argument as
// GaussianOptions::validate().
std::vector<float> gaussianWeights(const GaussianOptions& options);

// Filters `values` (rows x columns of `layout`); places without an enabled taxel become 0.
// Throws std::invalid_argument for bad options or a matrix of another size.
MatrixValues gaussianFiltered(const Eigen::Ref<const MatrixValues>& values,
                              const MatrixLayout& layout,
                              const GaussianOptions& options = {});

}  // namespace palpate
