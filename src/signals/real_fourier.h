// The discrete Fourier transform of real samples, X_k = sum x_n e^(-2 pi i k n / N), for any N >= 2
// in O(N log N).
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace palpate {

// Not for several threads at once.
class RealFourier {
 public:
  explicit RealFourier(std::size_t size);  // throws std::invalid_argument below 2
  ~RealFourier();
  RealFourier(const RealFourier&) = delete;
  RealFourier& operator=(const RealFourier&) = delete;
  // X_k for k = 0..size/2; valid until the next call. Throws std::invalid_argument for another
  // number of samples.
  std::span<const std::complex<double>> transform(std::span<const double> samples);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
