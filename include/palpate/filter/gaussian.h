// Spatial Gaussian filter of one matrix (study, chapter 2; methods.md section 1):
//   g(i) = exp(-i^2 / (2 sigma^2)), normalised over the kernel, separable.
// Borders are replicated. Masked taxels are neither read nor written: the weights of the taxels
// that exist are normalised to 1. Causal (one frame).
#pragma once

#include <vector>

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct GaussianOptions {
  int size = 3;        // kernel width [taxels], odd, 1..31; size = 2 radius + 1
  double sigma = 0.0;  // [taxels]; 0: (size + 1) / 2 / 2.3548, the kernel's half-width as FWHM

  // Throws std::invalid_argument with the field's name.
  void validate() const;
  double effectiveSigma() const;
};

// The weights along one direction, normalised to 1; `size` of them. Throws std::invalid_argument.
std::vector<float> gaussianWeights(const GaussianOptions& options);

// Filters `values` (rows x columns of `layout`); places without an enabled taxel become 0.
// Throws std::invalid_argument for bad options or a matrix of another size.
MatrixValues gaussianFiltered(const Eigen::Ref<const MatrixValues>& values,
                              const MatrixLayout& layout,
                              const GaussianOptions& options = {});

}  // namespace palpate
