// Binds palpate.fit_step(), step_response() and calibrate_step().
#include <string>

#include <pybind11/stl.h>

#include "palpate/calibration/step_report.h"
#include "palpate/signals/characteristic_signals.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

StepFitOptions fitOptions(const std::string& loss, const std::string& damping) {
  StepFitOptions options;
  options.loss = choice<StepLoss>("loss", loss, kStepLossWords);
  options.damping = choice<StepDamping>("damping", damping, kStepDampingWords);
  return options;
}

py::dict stepToPython(const StepFit& fit) {
  const StepParameters& p = fit.parameters;
  py::dict result;
  result["K"] = p.staticResponseCounts;
  result["m"] = p.driftCountsPerS;
  result["T1"] = p.t1S();
  result["T2"] = p.t2S();
  result["T"] = p.timeConstantS;
  result["d"] = p.damping;
  result["rmse"] = fit.rmse;
  result["residual_sd"] = fit.residualSd;
  result["converged"] = fit.converged;
  result["identifiable"] = fit.identifiable;
  result["time_constants_identifiable"] = fit.timesIdentifiable;
  result["gain_reached"] = fit.steadyStateReached;
  result["usable"] = fit.usable();
  result["covariance"] = arrayOf(Eigen::MatrixXd(fit.covariance));
  result["interval95"] =
      column<double>(4, [&](std::size_t i) { return fit.interval95(static_cast<int>(i)); });
  result["samples"] = fit.numSamples;
  result["dropped"] = fit.numDropped;
  result["downweighted"] = fit.numDownweighted;
  result["notes"] = fit.notes;
  const StepCharacteristics c = characteristicsOf(p);
  result["inflection_s"] = c.inflectionS;
  result["inflection_counts"] = c.inflectionCounts;
  result["tangent_per_s"] = c.tangentPerS;
  result["dead_time_s"] = c.deadTimeS;
  result["t_k_s"] = c.tangentAtGainS;
  result["equivalent_tangent_per_s"] = c.equivalentTangentPerS;
  result["steady_s"] = c.steadyS;
  return result;
}

py::dict fit(const Numbers& t,
             const Numbers& y,
             const std::string& loss,
             const std::string& damping,
             double lossScale) {
  StepFitOptions options = fitOptions(loss, damping);
  options.lossScale = lossScale;
  const std::vector<double> times = vectorOf(t, "t"), values = vectorOf(y, "y");
  return stepToPython(unlocked([&](const Progress&) { return fitStep(times, values, options); }));
}

// The parameters of a step, given by T1 and T2 or by T and d.
StepParameters parametersOf(double gain,
                            double drift,
                            std::optional<double> t1S,
                            std::optional<double> t2S,
                            std::optional<double> timeS,
                            std::optional<double> damping) {
  StepParameters parameters;
  if (t1S && t2S && !timeS && !damping) {
    if (!(*t1S > 0.0) || !(*t2S > 0.0)) throw py::value_error("T1 and T2 must be above 0");
    parameters = StepParameters::ofTimes(gain, drift, *t1S, *t2S);
  } else if (timeS && damping && !t1S && !t2S) {
    if (!(*timeS > 0.0) || !(*damping > 0.0)) throw py::value_error("T and d must be above 0");
    parameters = {.staticResponseCounts = gain,
                  .driftCountsPerS = drift,
                  .timeConstantS = *timeS,
                  .damping = *damping};
  } else {
    throw py::value_error("give T1 and T2, or T and d");
  }
  return parameters;
}

DoubleArray response(const Numbers& t,
                     double gain,
                     double drift,
                     std::optional<double> t1S,
                     std::optional<double> t2S,
                     std::optional<double> timeS,
                     std::optional<double> damping) {
  const StepParameters parameters = parametersOf(gain, drift, t1S, t2S, timeS, damping);
  const std::vector<double> times = vectorOf(t, "t");
  return column<double>(times.size(),
                        [&](std::size_t i) { return stepResponse(parameters, times[i]); });
}

py::object calibrateStep(const Profile& profile,
                         std::int64_t matrix,
                         const std::string& signal,
                         const std::string& loss,
                         const std::string& damping,
                         double above,
                         double least) {
  const std::size_t m = checkedIndex("matrix", matrix, profile.layout().numMatrices());
  StepReportOptions options;
  options.steps.signal = named("signal", signal, kAllSignalKinds, signalName);
  options.steps.aboveCounts = above;
  options.steps.minDurationS = least;
  options.fit = fitOptions(loss, damping);
  StepSignal series;
  const StepReport report = unlocked([&](const Progress& progress) {
    series = stepSignal(profile, m, options.steps.signal, progress);
    return reportSteps(profile, m, series, options);
  });
  py::object result = toPython(jsonOf(report));
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const StepSignal samples = samplesOf(series, report.steps[i].step);
    const py::object step = result["steps"][py::int_(i)];
    step["t"] = arrayOf(samples.timeS);
    step["y"] = arrayOf(samples.values);
  }
  return result;
}

}  // namespace

void bindSteps(py::module_& module) {
  module.def("fit_step",
             &fit,
             py::arg("t"),
             py::arg("y"),
             py::kw_only(),
             py::arg("loss") = "squares",
             py::arg("damping") = "over",
             py::arg("loss_scale") = 0.0,
             "Fits the step response of a second order lag with drift (study, 3.1), by least "
             "squares: t (n,) [s] from the beginning of the step, y (n,) [counts]. dict K "
             "[counts], m [counts/s], T1, T2, T [s], d, rmse, residual_sd [counts], converged, "
             "identifiable, time_constants_identifiable, gain_reached, usable, covariance (4, 4) "
             "of K, m, T1, T2 (d < 1: K, m, T, d; NaN: not available), interval95 (4,): half "
             "widths, samples, dropped, downweighted, notes; inflection_s, inflection_counts, "
             "tangent_per_s, dead_time_s, t_k_s, equivalent_tangent_per_s, steady_s: read off the "
             "fitted response. loss: 'squares', 'huber', 'cauchy' (beyond loss_scale sd; 0: the "
             "usual value); damping: 'over' (d >= 1) or 'any'. Data that can't be fitted doesn't "
             "raise: converged is False, unknown values are NaN, and notes say why.");
  module.def("step_response",
             &response,
             py::arg("t"),
             py::arg("K"),
             py::arg("m") = 0.0,
             py::kw_only(),
             py::arg("T1") = py::none(),
             py::arg("T2") = py::none(),
             py::arg("T") = py::none(),
             py::arg("d") = py::none(),
             "The step response at times t (n,) [s]: (n,) [counts]; by its time constants T1, T2 "
             "[s], or by T [s] and damping d.");
  module.def(
      "calibrate_step",
      &calibrateStep,
      py::arg("profile"),
      py::arg("matrix"),
      py::kw_only(),
      py::arg("signal") = "filtered_mean",
      py::arg("loss") = "squares",
      py::arg("damping") = "over",
      py::arg("above") = LoadingStepOptions{}.aboveCounts,
      py::arg("least") = LoadingStepOptions{}.minDurationS,
      "Finds the loading steps of a matrix and fits each: dict matrix, signal, steps, notes, as "
      "`palpate calibrate step` prints it; of each step also t (n,) [s] and y (n,): what was "
      "fitted. above: the matrix is loaded above it; least: shorter contacts are not steps [s].");
}

}  // namespace palpate::python
