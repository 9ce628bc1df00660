#include "palpate/filter/gaussian.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr int kGaussianLargestSize = 31;
constexpr double kFwhmPerSigma = 2.3548;  // full width at half maximum of a Gaussian, in sigmas

// Weighted sum along one direction of a rows x columns array; the border is replicated.
void convolve(const float* in,
              float* out,
              int rows,
              int columns,
              bool alongX,
              std::span<const float> kernel) {
  const int radius = static_cast<int>(kernel.size()) / 2;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      float sum = 0.0F;
      for (int k = -radius; k <= radius; ++k) {
        const int fromY = alongX ? y : std::clamp(y + k, 0, rows - 1);
        const int fromX = alongX ? std::clamp(x + k, 0, columns - 1) : x;
        sum += kernel[static_cast<std::size_t>(k + radius)] * in[fromY * columns + fromX];
      }
      out[y * columns + x] = sum;
    }
  }
}

MatrixValues convolvedBothWays(const MatrixValues& in, std::span<const float> kernel) {
  const int rows = static_cast<int>(in.rows());
  const int columns = static_cast<int>(in.cols());
  MatrixValues alongX(rows, columns);
  MatrixValues out(rows, columns);
  convolve(in.data(), alongX.data(), rows, columns, true, kernel);
  convolve(alongX.data(), out.data(), rows, columns, false, kernel);
  return out;
}

}  // namespace

void GaussianOptions::validate() const {
  if (size < 1 || size > kGaussianLargestSize || size % 2 == 0)
    throw std::invalid_argument("gaussian: size must be odd, 1..31, is " + std::to_string(size));
  if (!std::isfinite(sigma) || sigma < 0.0)
    throw std::invalid_argument("gaussian: sigma must be 0 (automatic) or above, is " +
                                std::to_string(sigma));
}

std::vector<float> gaussianWeights(const GaussianOptions& options) {
  options.validate();
  const double sigma = options.effectiveSigma();
  const int radius = options.size / 2;
  std::vector<float> weights;
  double sum = 0.0;
  for (int i = 0; i < options.size; ++i) {
    const double t = (i - radius) / sigma;
    weights.push_back(static_cast<float>(std::exp(-0.5 * t * t)));
    sum += static_cast<double>(weights.back());
  }
  for (float& weight : weights) weight = static_cast<float>(static_cast<double>(weight) / sum);
  return weights;
}

double GaussianOptions::effectiveSigma() const {
  return sigma > 0.0 ? sigma : (size + 1) / 2.0 / kFwhmPerSigma;
}

MatrixValues gaussianFiltered(const Eigen::Ref<const MatrixValues>& values,
                              const MatrixLayout& layout,
                              const GaussianOptions& options) {
  options.validate();
  if (values.rows() != layout.rows || values.cols() != layout.columns)
    throw std::invalid_argument("gaussian: the matrix doesn't have the size of its layout");
  const std::vector<float> kernel = gaussianWeights(options);
  if (layout.numEnabled() == layout.numCells()) return convolvedBothWays(values, kernel);

  // Normalised convolution: the weights of masked taxels are distributed to the others.
  MatrixValues read(layout.rows, layout.columns);
  MatrixValues weight(layout.rows, layout.columns);
  for (int y = 0; y < layout.rows; ++y) {
    for (int x = 0; x < layout.columns; ++x) {
      const bool on = layout.enabled(y, x);
      read(y, x) = on ? values(y, x) : 0.0F;
      weight(y, x) = on ? 1.0F : 0.0F;
    }
  }
  const MatrixValues sum = convolvedBothWays(read, kernel);
  const MatrixValues total = convolvedBothWays(weight, kernel);
  MatrixValues out(layout.rows, layout.columns);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x)
      out(y, x) = layout.enabled(y, x) ? sum(y, x) / total(y, x) : 0.0F;
  return out;
}

}  // namespace palpate
