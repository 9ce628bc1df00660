// Weights of Savitzky-Golay filters (Savitzky and Golay 1964; study 2.2), for the filters of that
// name. Such a filter fits a polynomial of a given order to a window of evenly spaced samples
// (least squares) and evaluates the polynomial, or a derivative of it, at any position in the
// window. The result is a weighted sum of the samples.
//
// Position 0 is the window's oldest sample, window - 1 the newest. At the middle, (window - 1) / 2,
// the filter is centred (window 5: smoothing [-3 12 17 12 -3]/35, cubic first derivative [1 -8 0 8
// -1]/12, quadratic one [-2 -1 0 1 2]/10, second derivative [2 -1 -2 -1 2]/7). At the newest sample
// it is causal. At the edges of a recording, the polynomial of the first or last whole window is
// evaluated at the position of the sample.
#pragma once

#include <vector>

namespace palpate {

inline constexpr int kMaxSavitzkyGolayWindow = 101;

// Weights, oldest sample first: value = sum weights[i] * sample[i] reproduces every polynomial up
// to `order` (with derivative 0), or its derivative [per sample^derivative; times rate^derivative
// it is per second].
//   window      samples, 1..101; an even one has no sample in the middle, but serves at other
//               positions
//   order       of the polynomial, 0..window-1
//   derivative  0..order
//   position    0..window-1, fractions allowed
// Throws std::invalid_argument naming what is out of range. Exact to about 1e-12 of the largest
// weight for the orders that smooth (up to 10), and to 1e-9 for any (orthogonal polynomials, no
// normal equations).
std::vector<double> savitzkyGolayWeights(int window, int order, int derivative, double position);

}  // namespace palpate
