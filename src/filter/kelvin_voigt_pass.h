// Computes the forward and backward pass of the Kelvin-Voigt Kalman filter over one stretch, with
// all moments that expectation-maximisation needs.
#pragma once

#include <span>
#include <vector>

#include "palpate/filter/kelvin_voigt.h"

namespace palpate {

// Transition and noise for a = E/m, b = eta/m and S/m^2 = 1; intervalS > 0 is not checked.
KelvinVoigtStep unitNoiseStep(double a, double b, double intervalS) noexcept;

// Returns the state at the next sample before its value is known.
KelvinVoigtState predicted(const KelvinVoigtState& state, const KelvinVoigtStep& step) noexcept;
// Returns the state after a value with variance r.
KelvinVoigtState updated(const KelvinVoigtState& state, double value, double r) noexcept;

struct KelvinVoigtMoment {
  KelvinVoigtStep step = {};        // from the previous sample to this one
  KelvinVoigtState predicted = {};  // given the samples before this one
  KelvinVoigtState state = {};      // given also this sample; after smoothing, given all samples
  // Cov(x_k, x_(k-1)) given all samples: row = y and v of this sample, column = those of the
  // previous one.
  double cYy = 0.0, cYv = 0.0, cVy = 0.0, cVv = 0.0;
};

struct KelvinVoigtPass {
  std::vector<KelvinVoigtMoment> moments;  // from the stretch's first finite value on
  std::size_t first = 0;                   // index in the stretch of the first finite value
  double logLikelihood = 0.0;
  std::size_t innovations = 0;
};

// Fills `pass` and reuses its memory. Without a finite value there are no moments.
void forwardPass(std::span<const double> timeS,
                 std::span<const double> values,
                 const KelvinVoigtModel& model,
                 KelvinVoigtPass& pass);
void backwardPass(KelvinVoigtPass& pass);

// Throws std::invalid_argument unless times ascend strictly, one per value.
void validateTimes(std::span<const double> timeS, std::span<const double> values);

}  // namespace palpate
