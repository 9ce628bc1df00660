// Estimates the Kelvin-Voigt model (filter/kelvin_voigt.h) that fits a series best, by
// expectation-maximisation (Dempster et al. 1977; for state-space models Shumway and Stoffer 1982;
// study 2.1.2).
//
// E step: filter and Rauch-Tung-Striebel smoother give, for every sample, mean and covariance of
// x_k and Cov(x_k, x_(k-1)) given all values. M step: the expected logarithm of the joint density
// of states and values,
//   -1/2 sum_k [log |q W_k| + tr(W_k^-1 S_k) / q] - 1/2 sum_k [log r + E(z_k - y_k)^2 / r],
//   S_k = E(x_k - F_k x_(k-1))(..)^T,  F_k, W_k from E/m, eta/m and the interval, q = S/m^2,
// The M step raises this expression: r = mean of E(z_k - y_k)^2 and q = sum tr(W_k^-1 S_k) / 2n are
// closed forms. The parameters in F and W have no closed form when intervals differ; for them a
// Newton step in their logarithms is taken as far as it raises the expression (generalised
// expectation-maximisation). The likelihood of the values therefore never falls from round to
// round.
//
// The unit of force is arbitrary, so that one of m, E, eta and S is free: when at most the noise of
// the values is given, m = 1. The noises are kept above small limits, since a perfect fit has no
// finite likelihood: r above 1e-9 of the series' mean square, S above 1e-9
// of the S that would produce that mean square.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/kelvin_voigt.h>

namespace palpate {

struct KelvinVoigtEstimationOptions {
  // Known parameters; the others are estimated. Ranges as in KelvinVoigtModel, and given values
  // must be finite.
  std::optional<double> mass = std::nullopt;
  std::optional<double> stiffness = std::nullopt;
  std::optional<double> viscosity = std::nullopt;
  std::optional<double> forceNoise = std::nullopt;
  std::optional<double> measurementNoise = std::nullopt;
  // The estimation stops when a round raises the log-likelihood per value by less than this; >= 0.
  double tolerance = 1e-6;
  int maxRounds = 200;  // 1..100,000

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Why the estimation ended.
enum class KelvinVoigtEnd {
  // A round raised the log-likelihood by less than the tolerance.
  kConverged,
  // The largest number of rounds was reached; more rounds might raise the likelihood further.
  kMaxRounds,
  // No stretch has 3 finite values, or all values are equal: the model is the start.
  kNothingToFit
};

// Result of the estimation.
struct KelvinVoigtEstimate {
  KelvinVoigtModel model;
  KelvinVoigtEnd end = KelvinVoigtEnd::kNothingToFit;
  // Log-likelihood of all values except the first of each stretch, given that first value: at the
  // start, and after every round. It never falls, except by rounding errors after convergence.
  std::vector<double> logLikelihood;
  std::size_t rounds() const noexcept {
    return logLikelihood.empty() ? 0 : logLikelihood.size() - 1;
  }
};

// Times [s], values and gaps are as for kelvinVoigtSmoothed. The start comes from the series: noise
// from its second differences, natural frequency from its slopes, damping 1. Throws
// std::invalid_argument, Cancelled. Takes about 0.2 us per sample and round when intervals repeat
// (whole milliseconds), 1.5 us when all differ.
KelvinVoigtEstimate estimateKelvinVoigt(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtEstimationOptions& options = {},
                                        std::span<const std::size_t> gapSamples = {},
                                        const Progress& progress = {});

}  // namespace palpate
