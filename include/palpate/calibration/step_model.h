// Step response of the sensor: a second order lag (PT2 element) with linear drift, as the study
// models a taxel under a load that appears at t = 0 and stays (3.1; misprints corrected):
//   a(t) = K phi(t) + m t
//   d > 1:  phi = 1 - (T1 e^(-t/T1) - T2 e^(-t/T2)) / (T1 - T2),
//           T1,2 = T / (d -+ sqrt(d^2 - 1)),   T1 >= T2
//   d = 1:  phi = 1 - (1 + t/T) e^(-t/T)
//   d < 1:  phi = 1 - e^(-d t/T) (cos wt + d/(w T) sin wt),         w = sqrt(1 - d^2) / T
// T and d alone are badly determined when T2 is far below the frame period: compare fits by K, m,
// T1, T2.
#pragma once

namespace palpate {

struct StepParameters {
  double staticResponseCounts = 0.0;  // K: what the signal reaches, without the drift [counts]
  double driftCountsPerS = 0.0;       // m: creep afterwards [counts/s]
  double timeConstantS = 1.0;         // T [s], > 0
  double damping = 1.0;               // d, > 0
  // From the time constants of d >= 1 [s], in any order; both > 0.
  static StepParameters ofTimes(double staticResponseCounts,
                                double driftCountsPerS,
                                double t1S,
                                double t2S);
  // T1 >= T2 [s]; both T where d is 1 within rounding, NaN where d < 1.
  double t1S() const;
  double t2S() const;
};

// phi and its derivatives at one time; t < 0 counts as 0.
struct StepShape {
  double phi = 0.0;   // 0 at t = 0, 1 at infinity
  double rate = 0.0;  // d phi / dt [1/s]
  // d >= 1: d phi / d log T2 at fixed T1/T2; d < 1: d phi / d log T at fixed d
  double derivativeByFirst = 0.0;
  // d >= 1: d phi / d log(T1/T2 - 1) at fixed T2; d < 1: d phi / d d at fixed T
  double derivativeBySecond = 0.0;
};
// d >= 1, through its time constants; exact for T1 = T2 as well. t1S >= t2S > 0.
StepShape overdampedShape(double tS, double t1S, double t2S);
// By T and d, 0 < d < 2; exact for d = 1 as well.
StepShape oscillatingShape(double tS, double timeConstantS, double damping);

// a(t) [counts] and da/dt [counts/s].
double stepResponse(const StepParameters& parameters, double tS);
double stepResponseRate(const StepParameters& parameters, double tS);

// What control engineering reads off a step response (study, 3.1).
struct StepCharacteristics {
  double inflectionS = 0.0;            // t_i: a'' = 0 [s]; of an oscillating one the first
  double inflectionCounts = 0.0;       // a(t_i)
  double tangentPerS = 0.0;            // a'(t_i): slope of the inflectional tangent [counts/s]
  double deadTimeS = 0.0;              // where that tangent meets 0: t_i - a(t_i) / a'(t_i)
  double tangentAtGainS = 0.0;         // t_k, where it meets K: t_i + (K - a(t_i)) / a'(t_i)
  double equivalentTangentPerS = 0.0;  // a(t_k) / t_k, slope of the study's equivalent time tangent
  // From here on the drift rules: a(t) = K for the first time; where the drift never brings it
  // there, 1 - phi = 1 %.
  double steadyS = 0.0;
};
// NaN where the tangent is flat or a parameter makes no sense.
StepCharacteristics characteristicsOf(const StepParameters& parameters);

}  // namespace palpate
