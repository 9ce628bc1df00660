// Computes the step response of the sensor: a second-order lag (PT2 element) with linear drift. The
// study models a taxel in this way under a load that appears at t = 0 and remains (3.1; misprints
// corrected):
//   a(t) = K phi(t) + m t
//   d > 1:  phi = 1 - (T1 e^(-t/T1) - T2 e^(-t/T2)) / (T1 - T2),
//           T1,2 = T / (d -+ sqrt(d^2 - 1)),   T1 >= T2
//   d = 1:  phi = 1 - (1 + t/T) e^(-t/T)
//   d < 1:  phi = 1 - e^(-d t/T) (cos wt + d/(w T) sin wt),         w = sqrt(1 - d^2) / T
// T and d alone are badly determined when T2 is far below the frame period, so compare fits by K,
// m, T1 and T2.
#pragma once

namespace palpate {

// The parameters of a step response.
struct StepParameters {
  // K: final value of the signal without drift [counts].
  double staticResponseCounts = 0.0;
  double driftCountsPerS = 0.0;  // m: creep after the lag [counts/s]
  double timeConstantS = 1.0;    // T [s], > 0
  double damping = 1.0;          // d, > 0
  // Makes the parameters from the time constants [s] of d >= 1, in any order; both > 0.
  static StepParameters ofTimes(double staticResponseCounts,
                                double driftCountsPerS,
                                double t1S,
                                double t2S);
  // T1 >= T2 [s]; both are T when d is 1 within rounding, and NaN when d < 1.
  double t1S() const;
  double t2S() const;
};

// phi and its derivatives at one time; t < 0 is treated as 0.
struct StepShape {
  double phi = 0.0;   // 0 at t = 0, 1 at infinity
  double rate = 0.0;  // d phi / dt [1/s]
  // For d >= 1: d phi / d log T2 at fixed T1/T2; for d < 1: d phi / d log T at fixed d.
  double derivativeByFirst = 0.0;
  // For d >= 1: d phi / d log(T1/T2 - 1) at fixed T2; for d < 1: d phi / d d at fixed T.
  double derivativeBySecond = 0.0;
};
// The shape for d >= 1 from its time constants t1S >= t2S > 0; also exact for T1 = T2.
StepShape overdampedShape(double tS, double t1S, double t2S);
// The shape from T and d, 0 < d < 2; also exact for d = 1.
StepShape oscillatingShape(double tS, double timeConstantS, double damping);

// a(t) [counts] and da/dt [counts/s].
double stepResponse(const StepParameters& parameters, double tS);
double stepResponseRate(const StepParameters& parameters, double tS);

// Characteristic times and slopes that control engineering reads from a step response (study, 3.1).
struct StepCharacteristics {
  // t_i: a'' = 0 [s]; for an oscillating response the first such time.
  double inflectionS = 0.0;
  double inflectionCounts = 0.0;  // a(t_i)
  double tangentPerS = 0.0;       // a'(t_i): slope of the inflectional tangent [counts/s]
  // Time at which the inflectional tangent meets 0 [s]: t_i - a(t_i) / a'(t_i).
  double deadTimeS = 0.0;
  // t_k: time at which that tangent meets K [s]: t_i + (K - a(t_i)) / a'(t_i).
  double tangentAtGainS = 0.0;
  double equivalentTangentPerS =
      // a(t_k) / t_k: slope of the study's equivalent time tangent [counts/s].
      0.0;
  // Time after which the drift dominates [s]: a(t) = K for the first time; if the drift never
  // brings the signal to K, 1 - phi = 1 %.
  double steadyS = 0.0;
};
// NaN when the tangent is flat or a parameter is out of range.
StepCharacteristics characteristicsOf(const StepParameters& parameters);

}  // namespace palpate
