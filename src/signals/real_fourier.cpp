#include "signals/real_fourier.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <stdexcept>
#include <string>

#include <unsupported/Eigen/FFT>

namespace palpate {
namespace {

using Complex = std::complex<double>;

// The library (kissfft) takes n^2 steps for a large prime factor; above this factor the convolution
// is faster.
constexpr std::size_t kLargestPrimeFactor = 64;

std::size_t largestPrimeFactor(std::size_t n) {
  std::size_t largest = 1;
  for (std::size_t p = 2; p * p <= n; ++p)
    for (; n % p == 0; n /= p) largest = p;
  return std::max(largest, n);
}

}  // namespace

// Sizes with a large prime factor use Bluestein's identity k n = (k^2 + n^2 - (k - n)^2) / 2. With
// the chirp c_n = e^(-pi i n^2 / N) it gives X_k = c_k sum (x_n c_n) conj(c_(k-n)): a convolution,
// which is computed by transforms whose size is a power of two.
struct RealFourier::Impl {
  explicit Impl(std::size_t n) : size(n), spectrum(n / 2 + 1) {
    fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    if (largestPrimeFactor(n) <= kLargestPrimeFactor) return;
    const std::size_t length = std::bit_ceil(2 * n - 1);
    chirp.resize(n);
    std::vector<Complex> back(length);
    for (std::size_t i = 0; i < n; ++i) {
      // i^2 modulo 2 N is computed first, so that the angle keeps all its digits.
      const auto square = static_cast<double>(i * i % (2 * n));
      chirp[i] = std::polar(1.0, -std::numbers::pi * square / static_cast<double>(n));
      back[i] = std::conj(chirp[i]);
      if (i > 0) back[length - i] = back[i];
    }
    kernel.resize(length);
    padded.resize(length);
    product.resize(length);
    fft.fwd(kernel.data(), back.data(), static_cast<Eigen::Index>(length));
  }

  std::size_t size;
  Eigen::FFT<double> fft;
  std::vector<Complex> spectrum;
  std::vector<Complex> chirp, kernel, padded,
      product;  // empty when the library computes the transform
};

RealFourier::RealFourier(std::size_t size) {
  if (size < 2)
    throw std::invalid_argument("fourier: the size must be 2 or more, is " + std::to_string(size));
  impl_ = std::make_unique<Impl>(size);
}
RealFourier::~RealFourier() = default;

std::span<const Complex> RealFourier::transform(std::span<const double> samples) {
  Impl& my = *impl_;
  if (samples.size() != my.size)
    throw std::invalid_argument("fourier: " + std::to_string(samples.size()) + " samples for " +
                                std::to_string(my.size));
  if (my.chirp.empty()) {
    my.fft.fwd(my.spectrum.data(), samples.data(), static_cast<Eigen::Index>(my.size));
    return my.spectrum;
  }
  const auto length = static_cast<Eigen::Index>(my.kernel.size());
  std::fill(my.padded.begin(), my.padded.end(), Complex{});
  for (std::size_t i = 0; i < my.size; ++i) my.padded[i] = samples[i] * my.chirp[i];
  my.fft.fwd(my.product.data(), my.padded.data(), length);
  for (std::size_t i = 0; i < my.kernel.size(); ++i) my.product[i] *= my.kernel[i];
  my.fft.inv(my.padded.data(), my.product.data(), length);
  for (std::size_t k = 0; k < my.spectrum.size(); ++k) my.spectrum[k] = my.padded[k] * my.chirp[k];
  return my.spectrum;
}

}  // namespace palpate
