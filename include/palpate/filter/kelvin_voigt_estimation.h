// The Kelvin-Voigt model (filter/kelvin_voigt.h) that explains a series best:
// expectation-maximisation (Dempster et al. 1977; for state-space models Shumway and Stoffer 1982;
// study 2.1.2).
//
// E step: filter and Rauch-Tung-Striebel smoother give, for every sample, mean and covariance of
// x_k and Cov(x_k, x_(k-1)) given all values. M step: the expected logarithm of the joint density
// of states and values,
//   -1/2 sum_k [log |q W_k| + tr(W_k^-1 S_k) / q] - 1/2 sum_k [log r + E(z_k - y_k)^2 / r],
//   S_k = E(x_k - F_k x_(k-1))(..)^T,  F_k, W_k from E/m, eta/m and the interval, q = S/m^2,
// is raised: r = mean of E(z_k - y_k)^2 and q = sum tr(W_k^-1 S_k) / 2n in closed form; for the
// parameters in F and W, for which there is none where intervals differ, a Newton step in their
// logarithms is taken as far as it raises the expression (generalised expectation-maximisation). So
// the likelihood of the values never falls from round to round.
//
// A force has no unit here, so that of m, E, eta and S one is free: when nothing but noise of the
// values is given, m = 1. Noises are kept above 1e-9 of the series' mean square (r) and of what
// would make that (S): a perfect fit has no likelihood.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/kelvin_voigt.h>

namespace palpate {

struct KelvinVoigtEstimationOptions {
  // What is known; the rest is sought. Ranges as in KelvinVoigtModel, but what is given must be
  // finite.
  std::optional<double> mass = std::nullopt;
  std::optional<double> stiffness = std::nullopt;
  std::optional<double> viscosity = std::nullopt;
  std::optional<double> forceNoise = std::nullopt;
  std::optional<double> measurementNoise = std::nullopt;
  double tolerance = 1e-6;  // stop when a round raises the log-likelihood per value by less; >= 0
  int maxRounds = 200;      // 1..100,000

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

enum class KelvinVoigtEnd {
  // a round brought less than the tolerance
  kConverged,
  // more rounds might bring more
  kMaxRounds,
  // fewer than 3 finite values in every stretch, or all of them equal: the model is the start
  kNothingToFit
};

struct KelvinVoigtEstimate {
  KelvinVoigtModel model;
  KelvinVoigtEnd end = KelvinVoigtEnd::kNothingToFit;
  // Of all values but the first of each stretch, given that: at the start, and after every round.
  // Never falls (but for rounding, once it stands).
  std::vector<double> logLikelihood;
  std::size_t rounds() const noexcept {
    return logLikelihood.empty() ? 0 : logLikelihood.size() - 1;
  }
};

// Times [s], values and gaps as for kelvinVoigtSmoothed. The start is read off the series: noise
// from its second differences, pace from its slopes, damping 1. Throws std::invalid_argument,
// Cancelled. About 0.2 us per sample and round where intervals repeat (whole milliseconds), 1.5 us
// where all differ.
KelvinVoigtEstimate estimateKelvinVoigt(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtEstimationOptions& options = {},
                                        std::span<const std::size_t> gapSamples = {},
                                        const Progress& progress = {});

}  // namespace palpate
