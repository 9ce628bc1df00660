// Binds palpate.signals(), spectrum(), strongest_taxel() and first_contact().
#include <cmath>
#include <string>

#include <pybind11/stl.h>

#include "palpate/computed/computed_series.h"
#include "palpate/core/progress.h"
#include "palpate/model/timing.h"
#include "palpate/signals/coherence.h"
#include "palpate/signals/first_contact.h"
#include "palpate/signals/formula.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/signals/spectrum.h"
#include "palpate/signals/strongest_taxel.h"
#include "palpate/signals/welch.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/calibrations.h"
#include "python/interruption.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

Table signals(const Profile& profile, const py::object& matrix) {
  const std::size_t numMatrices = profile.layout().numMatrices();
  SignalRowsOptions options;
  if (py::isinstance<py::str>(matrix))
    options.ofHand = choice<bool>("matrix", matrix.cast<std::string>(), {{"hand", true}});
  else if (!matrix.is_none())
    options.matrix =
        static_cast<std::int64_t>(checkedIndex("matrix", matrix.cast<std::int64_t>(), numMatrices));
  const bool isOne = options.ofHand || options.matrix;
  return gridOf(isOne ? 0 : numMatrices,
                [&](const Progress& progress) { return signalTable(profile, options, progress); });
}

SpectrumOptions optionsOf(int window,
                          std::optional<int> overlap,
                          const std::string& detrend,
                          const std::string& rate) {
  SpectrumOptions options;
  options.window = window;
  options.overlap = overlap.value_or(window - 1);
  options.detrend = choice<Detrend>("detrend", detrend, kDetrendWords);
  options.gridRate = choice<GridRate>("rate", rate, kGridRateWords);
  options.validate();
  return options;
}

struct Segments {
  SpectrumReport report;
  MeanSpectrum mean;
  std::vector<double> timeS, binHz, psd, magnitude;
};

Segments segmentsOf(const std::vector<double>& timeS,
                    const std::vector<double>& values,
                    const SpectrumOptions& options,
                    const Progress& progress) {
  Segments segments;
  MeanSpectrumCollector collector(planSpectra(timeS, values, options));
  segments.report = visitSpectra(
      timeS,
      values,
      options,
      [&](const SpectrumSegment& one) {
        collector.add(one);
        segments.timeS.push_back(one.timeS);
        segments.binHz.push_back(one.binHz);
        segments.psd.insert(segments.psd.end(), one.psd.begin(), one.psd.end());
        segments.magnitude.insert(
            segments.magnitude.end(), one.magnitude.begin(), one.magnitude.end());
      },
      progress);
  segments.mean = collector.result();
  return segments;
}

py::dict spectrum(const Numbers& timeS,
                  const Numbers& values,
                  int window,
                  std::optional<int> overlap,
                  const std::string& detrend,
                  const std::string& rate) {
  const SpectrumOptions options = optionsOf(window, overlap, detrend, rate);
  const std::vector<double> times = vectorOf(timeS, "time_s"), series = vectorOf(values, "values");
  const Segments found = unlocked(
      [&](const Progress& progress) { return segmentsOf(times, series, options, progress); });
  const std::size_t bins = options.numBins(), count = found.timeS.size();
  if (count == 0) {
    std::size_t longest = 0;
    for (const GapFreeSpan& stretch : found.report.stretches)
      longest = std::max(longest, stretch.gridSamples);
    throw py::value_error("the longest span without a gap has " + std::to_string(longest) +
                          " samples, a window takes " + std::to_string(window) +
                          ": take a smaller window");
  }
  const auto table = [&](const std::vector<double>& all) {
    return grid<double>(
        count, bins, [&](std::size_t i, std::size_t k) { return all[i * bins + k]; });
  };
  py::dict result;
  result["time_s"] = arrayOf(found.timeS);
  result["frequency_hz"] = column<double>(
      bins, [&](std::size_t k) { return found.mean.binHz * static_cast<double>(k); });
  result["bin_hz"] = arrayOf(found.binHz);
  result["psd"] = table(found.psd);
  result["magnitude"] = table(found.magnitude);
  result["mean_psd"] = arrayOf(found.mean.psd);
  result["mean_magnitude"] = arrayOf(found.mean.magnitude);
  result["peaks"] = listOf(spectralPeaks(found.mean), [](const SpectralPeak& peak) {
    py::dict one;
    one["frequency_hz"] = peak.frequencyHz;
    one["psd"] = peak.psd;
    one["amplitude"] = peak.amplitude;
    one["width_hz"] = peak.widthHz;
    one["prominence_db"] = peak.prominenceDb;
    return one;
  });
  result["strongest_hz"] = found.mean.strongestHz();
  result["rate_hz"] = found.report.rateHz;
  result["nyquist_hz"] = found.report.nyquistHz;
  result["jitter"] = found.report.jitter;
  result["not_finite"] = found.report.notFinite;
  result["in_no_segment"] = found.report.inNoSegment;
  return result;
}

py::dict coherence(const Numbers& timeS,
                   const Numbers& a,
                   const Numbers& b,
                   int window,
                   std::optional<int> overlap,
                   const std::string& detrend,
                   const std::string& rate) {
  const SpectrumOptions options = optionsOf(window, overlap.value_or(window / 2), detrend, rate);
  const std::vector<double> times = vectorOf(timeS, "time_s"), valuesA = vectorOf(a, "a"),
                            valuesB = vectorOf(b, "b");
  const Coherence found = unlocked([&](const Progress& progress) {
    return coherenceOf(times, valuesA, valuesB, options, progress);
  });
  if (found.coherence.empty())
    throw py::value_error(
        "coherence needs two segments in a span without a gap: take a smaller "
        "window than " +
        std::to_string(window));
  py::dict result;
  result["frequency_hz"] = column<double>(
      found.coherence.size(), [&](std::size_t k) { return found.binHz * static_cast<double>(k); });
  result["coherence"] = arrayOf(found.coherence);
  result["phase_deg"] = arrayOf(found.phaseDeg);
  result["psd_a"] = arrayOf(found.psdA);
  result["psd_b"] = arrayOf(found.psdB);
  result["segments"] = found.segments;
  result["level_95"] = found.level95();
  result["rate_hz"] = found.report.rateHz;
  return result;
}

DoubleArray derive(const Profile& profile,
                   const std::string& text,
                   const std::optional<Calibration>& calibration,
                   std::optional<double> sensitivity,
                   std::optional<double> threshold,
                   bool tare,
                   bool drift) {
  const Formula formula(text);
  const ForceChoice chosen{sensitivity, threshold, tare, drift};
  if (!calibration && (sensitivity || threshold || tare || !drift))
    throw py::value_error("sensitivity, threshold, tare and drift need a calibration");
  const Series series = unlocked([&](const Progress& progress) {
    ComputedOptions options{.calibration = calibration};
    if (calibration) {
      options.pressure = pressureOptionsOf(chosen, *calibration, profile);
      options.tare = tareOf(chosen, profile, progress);
    }
    return formulaSeries(withComputedSeries(profile, options),
                         formula,
                         0.0,
                         static_cast<double>(profile.durationUs()) / kUsPerS + 1.0,
                         progress);
  });
  return arrayOf(series.values);
}

py::object strongest(const Profile& profile) {
  const auto place =
      unlocked([&](const Progress& progress) { return strongestTaxel(profile, 4000, progress); });
  if (!place) return py::none();
  return py::make_tuple(place->matrix, place->x, place->y);
}

std::optional<std::size_t> contactFrame(const Profile& profile, int frames, int taxels) {
  const FirstContactOptions options{.frames = frames, .taxels = taxels};
  return unlocked([&](const Progress& progress) {
    std::vector<std::size_t> gaps;
    for (const Gap& gap : timingOf(profile).gaps) gaps.push_back(gap.frame);
    return firstContact(profile, gaps, options, progress);
  });
}

}  // namespace

void bindSignals(py::module_& module) {
  module.def("signals",
             &signals,
             py::arg("profile"),
             py::arg("matrix") = py::none(),
             "Computes the characteristic signals of each frame: dict time_ms (T,), mean, "
             "filtered_mean (eq. 3.2 of the study), min, max, sum [counts], active (number of "
             "taxels > 0), area_mm2 [mm^2]: (T, matrices); of one matrix, or 'hand' (all taxels of "
             "the whole hand), (T,). 0 where nothing is touched. Where the sensor sends readings "
             "also x, y, z [counts], sums over the taxels of the readings over the baseline, and "
             "norm, the length of that vector; not of the whole hand.");
  module.def(
      "spectrum",
      &spectrum,
      py::arg("time_s"),
      py::arg("values"),
      py::kw_only(),
      py::arg("window") = SpectrumOptions{}.window,
      py::arg("overlap") = py::none(),
      py::arg("detrend") = "mean",
      py::arg("rate") = "mean",
      "Short-time Fourier transform of a series: time_s (n,) [s], ascending; values (n,). "
      "Stretches without a gap are resampled to an even grid first; Hann window. dict time_s (S,) "
      "middles of the segments [s], frequency_hz (B,) [Hz], bin_hz (S,) of each segment [Hz], psd "
      "(S, B) [units^2/Hz], magnitude (S, B) [units], mean_psd, mean_magnitude (B,), peaks of the "
      "mean [{frequency_hz, psd, amplitude, width_hz, prominence_db}], strongest_hz, rate_hz, "
      "nyquist_hz [Hz] (frequencies above it can't be measured), jitter (sd of the intervals / "
      "mean), not_finite, in_no_segment (samples). overlap: default window - 1; detrend: 'mean', "
      "'line', 'none'; rate of the grid: 'mean', 'median'. ValueError for a series without a span "
      "free of gaps as long as the window.");
  module.def("coherence",
             &coherence,
             py::arg("time_s"),
             py::arg("a"),
             py::arg("b"),
             py::kw_only(),
             py::arg("window") = welchOptions().window,
             py::arg("overlap") = py::none(),
             py::arg("detrend") = "mean",
             py::arg("rate") = "mean",
             "Coherence of two series at each frequency: time_s, a, b (n,). dict frequency_hz, "
             "coherence (0..1; NaN without power), phase_deg (of b relative to a), psd_a, psd_b: "
             "(B,); segments, level_95 (independent noise is above it in 5 % of the bins), "
             "rate_hz. overlap: default window / 2. As scipy.signal.coherence after resampling to "
             "an even grid. ValueError with fewer than two segments.");
  module.def(
      "derive",
      &derive,
      py::arg("profile"),
      py::arg("formula"),
      py::kw_only(),
      py::arg("calibration") = py::none(),
      py::arg("sensitivity") = py::none(),
      py::arg("threshold") = py::none(),
      py::arg("tare") = false,
      py::arg("drift") = true,
      "The values of a formula, or of a single signal, at every frame: (T,). Signals have the "
      "names that the command derive knows: 'm1_sum - m3_sum', 'der(hand_sum)', 'abs(m5_x2_y9) / "
      "max(1, m5_max)'; angle3 [deg] and temperature4 [deg C] are interpolated, t [s] is the time "
      "from the first frame. 'm1_centroid_x_mm', 'hand_sphere_diameter_mm', 'm1_slip_mm' and "
      "others are computed from the frames; 'hand_force_n', 'm1_force_n' [N] and 'm1_pressure_kpa' "
      "[kPa] need a Calibration: they are those of its apply() with the same sensitivity, "
      "threshold, tare and drift, which also lists the assumptions, but NaN for a contact that is "
      "out of range, or whose force is not known because the calibration has no area. NaN: not "
      "known. spectrum(profile.time_s, derive(profile, 'm1_slip_mm')) is the spectrum of such a "
      "signal. ValueError for a text that isn't a formula, and for a signal that the recording "
      "doesn't have.");
  module.def("strongest_taxel",
             &strongest,
             py::arg("profile"),
             "The taxel with the largest load: (matrix, x, y); None if nothing is touched.");
  module.def("first_contact",
             &contactFrame,
             py::arg("profile"),
             py::kw_only(),
             py::arg("frames") = 3,
             py::arg("taxels") = 3,
             "The first frame of a lasting contact: the first of `frames` in a row with at least "
             "`taxels` active taxels each; None if there is none.");
}

}  // namespace palpate::python
