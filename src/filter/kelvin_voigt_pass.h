// Forward and backward pass of the Kelvin-Voigt Kalman filter over one stretch, with all that
// expectation-maximisation needs of it.
#pragma once

#include <span>
#include <vector>

#include "palpate/filter/kelvin_voigt.h"

namespace palpate {

// Transition and noise for a = E/m, b = eta/m and S/m^2 = 1. T > 0; no check.
KelvinVoigtStep unitNoiseStep(double a, double b, double intervalS) noexcept;

// State at the next sample before its value is known.
KelvinVoigtState predicted(const KelvinVoigtState& state, const KelvinVoigtStep& step) noexcept;
// With a value of variance r taken in.
KelvinVoigtState updated(const KelvinVoigtState& state, double value, double r) noexcept;

struct KelvinVoigtMoment {
  KelvinVoigtStep step = {};        // from the sample before to this one
  KelvinVoigtState predicted = {};  // given what came before this sample
  KelvinVoigtState state = {};      // given also this sample; after smoothing given all
  // Cov(x_k, x_(k-1)) given all: row = this sample's y and v, column = the one before's.
  double cYy = 0.0, cYv = 0.0, cVy = 0.0, cVv = 0.0;
};

struct KelvinVoigtPass {
  std::vector<KelvinVoigtMoment> moments;  // from the stretch's first finite value on
  std::size_t first = 0;                   // index of that in the stretch
  double logLikelihood = 0.0;
  std::size_t innovations = 0;
};

// Fills `pass` (its memory is used again). No finite value: no moments.
void forwardPass(std::span<const double> timeS,
                 std::span<const double> values,
                 const KelvinVoigtModel& model,
                 KelvinVoigtPass& pass);
void backwardPass(KelvinVoigtPass& pass);

// Throws std::invalid_argument unless times ascend strictly, one per value.
void validateTimes(std::span<const double> timeS, std::span<const double> values);

}  // namespace palpate
