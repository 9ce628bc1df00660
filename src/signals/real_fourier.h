// The discrete Fourier transform of real samples, X_k = sum x_n e^(-2 pi i k n / N), for any N >= 2
// in O(N log N).
//
// Eigen (kissfft) computes the transform. Lengths with a large prime factor are computed by
// Bluestein's convolution instead, since a window may have any length up to 65,536, and the
// libraries take N^2 steps there. Time of one transform [us] by this class, by Eigen alone and by
// cv::dft:
//   N = 251: 13, 116, 34
//   N = 1021: 66, 1948, 549
//   N = 4093: 283, 34,031, 8707
//   N = 65,521: 10,301, 12,154,544, 2,935,605
// Padding is not possible, since it would move the bins, which are rate / N apart. cv::dft is also
// less exact: for white noise of variance 1 and N = 65,536 its errors are 1.5e-9, those of this
// class 1.2e-13.
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace palpate {

// One object must not be used by several threads at once.
class RealFourier {
 public:
  explicit RealFourier(std::size_t size);  // throws std::invalid_argument below 2
  ~RealFourier();
  RealFourier(const RealFourier&) = delete;
  RealFourier& operator=(const RealFourier&) = delete;
  // Returns X_k for k = 0..size/2, valid until the next call. Throws std::invalid_argument for
  // another number of samples.
  std::span<const std::complex<double>> transform(std::span<const double> samples);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
