// The command `palpate spectrum FILE` prints the short-time Fourier transform of a taxel or a
// matrix signal as CSV.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/coherence.h"
#include "palpate/signals/curve_comparison.h"
#include "palpate/signals/formula.h"
#include "palpate/signals/profile_series.h"
#include "palpate/signals/resampled_series.h"
#include "palpate/signals/signal_name.h"
#include "palpate/signals/spectrum.h"
#include "palpate/signals/spectrum_rows.h"
#include "palpate/signals/welch.h"

#include "commands/calibrated_frames.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"
#include "commands/signal_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

constexpr double kPercent = 100.0;

TypedSignal choiceOf(const CommandLine& given, const Profile& profile) {
  const SensorLayout& layout = profile.layout();
  const std::string& file = given.words().front();
  const auto matrix = given.integer("matrix", kMatrixOption);
  const auto numMatrices = static_cast<std::int64_t>(layout.numMatrices());
  requireMatrix(file, layout, matrix);
  const auto x = given.integer("x", kMatrixOption), y = given.integer("y", kMatrixOption);
  if (const auto text = given.text("signal")) {
    if (x || y) throw UsageError("give --signal, or --x and --y, not both");
    if (const auto signal = signalKindNamed(*text))
      return {.choice =
                  SeriesChoice{.index = static_cast<std::size_t>(matrix.value_or(numMatrices)),
                               .signal = *signal}};
    // A plain word is one of the signals of a matrix, and refused with their names.
    if (text->find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos)
      return {.choice = SeriesChoice{.index = static_cast<std::size_t>(numMatrices),
                                     .signal = *signalChosen(given)}};
    if (matrix)
      throw UsageError("--signal " + *text + " names its matrix itself: leave out --matrix");
    return typedSignal(*text, profile, file, "--signal");
  }
  if (!matrix || !x || !y)
    throw UsageError("spectrum needs --matrix M --x X --y Y (a taxel), or --signal");
  return {.choice = taxelOf(layout, static_cast<std::size_t>(*matrix), *x, *y, file)};
}

// The signal, or the two of --coherence.
std::vector<TypedSignal> chosenSignals(const CommandLine& given, const Profile& profile) {
  const auto text = given.text("coherence");
  if (!text) return {choiceOf(given, profile)};
  std::vector<TypedSignal> chosen;
  for (const std::string& part : splitAtCommas(*text))
    chosen.push_back(typedSignal(part, profile, given.words().front(), "--coherence"));
  if (chosen.size() != 2)
    throw UsageError(
        "--coherence needs two signals A,B, as m1_mean,m3_mean or m5_x2_y9,m5_x3_y9; is \"" +
        *text + "\"");
  return chosen;
}

// The series from frame `from` to frame `to`, both inclusive.
Series seriesOf(const CommandLine& given,
                const Profile& profile,
                const TypedSignal& signal,
                const Progress& progress) {
  const std::string& file = given.words().front();
  if (profile.numFrames() == 0) throw Error(file + ": has no frames");
  const auto [from, to] = framesOf(frameChoiceOf(given), file, profile);
  const auto secondsOf = [&](std::size_t frame) {
    const auto us = profile.frameTimeUs(frame) - profile.frameTimeUs(0);
    return static_cast<double>(us) / 1e6;
  };
  const double fromS = secondsOf(from), toS = secondsOf(to);
  Series series = typedSeries(profile, signal, fromS, toS, file, progress);
  // readSeries() also returns neighbours of the requested part, which are removed.
  while (!series.timeS.empty() && series.timeS.back() > toS + 1e-7) {
    series.timeS.pop_back();
    series.values.pop_back();
  }
  return series;
}

SpectrumOptions spectrumOptionsOf(const CommandLine& given, bool oneLine) {
  SpectrumOptions options = oneLine ? welchOptions() : SpectrumOptions{};
  options.window =
      static_cast<int>(given.integer("window", options.kWindow).value_or(options.window));
  // Default: all but one sample, as in the study; half a window where segments are averaged.
  options.overlap =
      static_cast<int>(given.integer("overlap", 0, options.window - 1)
                           .value_or(oneLine ? options.window / 2 : options.window - 1));
  options.detrend = given.chosen("detrend", kDetrendWords).value_or(options.detrend);
  options.gridRate = given.chosen("rate", kGridRateWords).value_or(options.gridRate);
  return options;
}

std::string unitOf(const Profile& profile, const TypedSignal& signal) {
  return signal.choice ? seriesUnit(profile, *signal.choice) : std::string();
}

Json known(double value) { return value > 0.0 ? Json(value) : Json(); }

Json spectrumJsonOf(const SpectrumReport& report,
                    const SpectrumOptions& options,
                    const MeanSpectrum& mean,
                    double strongestTimeS) {
  Json stretches = jsonList(report.stretches, [](const GapFreeSpan& stretch) {
    return Json::object()
        .set("begin_s", stretch.beginS)
        .set("end_s", stretch.endS)
        .set("samples", stretch.samples)
        .set("rate_hz", known(stretch.rateHz))
        .set("segments", stretch.segments);
  });
  Json strongest;  // null: the signal is constant
  if (mean.strongestBin() > 0)
    strongest = Json::object()
                    .set("frequency_hz", mean.strongestHz())
                    .set("magnitude", mean.magnitude[mean.strongestBin()])
                    .set("psd", mean.psd[mean.strongestBin()])
                    .set("time_s", strongestTimeS);
  return Json::object()
      .set("samples", report.samples)
      .set("not_finite", report.notFinite)
      .set("in_no_segment", report.inNoSegment)
      .set("rate_hz", known(report.rateHz))
      .set("nyquist_hz", known(report.nyquistHz))
      .set("jitter", report.jitter)
      .set("window", options.window)
      .set("overlap", options.overlap)
      .set("bin_hz", mean.binHz)
      .set("segments", report.segments)
      .set("stretches", stretches)
      .set("strongest", strongest);
}

std::string tooShort(const SpectrumReport& report, const SpectrumOptions& options) {
  std::size_t longest = 0;
  for (const GapFreeSpan& stretch : report.stretches)
    longest = std::max(longest, stretch.gridSamples);
  return "the longest span without a gap has " + std::to_string(longest) +
         " samples, a window takes " + std::to_string(options.window) + ": take a smaller --window";
}

void sayGrid(const CommandLine& given, const SpectrumReport& report) {
  if (given.quiet()) return;
  sayLine("intervals vary by " + fixedText(report.jitter * kPercent, 0) + " %: resampled to " +
          fixedText(report.rateHz, 2) + " Hz; nothing above " + fixedText(report.nyquistHz, 2) +
          " Hz can be seen");
}

// --welch and --peaks.
int writeMeanSpectrum(const CommandLine& given,
                      const Series& series,
                      const std::string& unit,
                      const SpectrumOptions& options,
                      ProgressLine& line) {
  const std::string& file = given.words().front();
  const WelchSpectrum spectrum =
      welchSpectrum(series.timeS, series.values, options, line.callback());
  if (spectrum.mean.psd.empty()) throw Error(file + ": " + tooShort(spectrum.report, options));
  const std::vector<SpectralPeak> peaks = spectralPeaks(spectrum.mean);
  line.wipe();
  if (formOf(given) == TableForm::kJson) {
    printJson(given,
              Json::object()
                  .set("samples", spectrum.report.samples)
                  .set("rate_hz", known(spectrum.report.rateHz))
                  .set("nyquist_hz", known(spectrum.report.nyquistHz))
                  .set("jitter", spectrum.report.jitter)
                  .set("window", options.window)
                  .set("overlap", options.overlap)
                  .set("bin_hz", spectrum.mean.binHz)
                  .set("segments", spectrum.mean.segments)
                  .set("psd", jsonList(spectrum.mean.psd))
                  .set("magnitude", jsonList(spectrum.mean.magnitude))
                  .set("peaks", rowsJson(*peakTable(peaks, unit))));
    return kDone;
  }
  const int code = writeTable(
      given,
      *(given.has("peaks") ? peakTable(peaks, unit) : meanSpectrumTable(spectrum.mean, unit)));
  sayGrid(given, spectrum.report);
  return code;
}

int writeCoherence(const CommandLine& given,
                   const Profile& profile,
                   const std::vector<TypedSignal>& chosen,
                   const SpectrumOptions& options,
                   ProgressLine& line) {
  const std::string& file = given.words().front();
  const TypedSignal &signalA = chosen[0], &signalB = chosen[1];
  const Series a = seriesOf(given, profile, signalA, line.callback());
  const Series b = seriesOf(given, profile, signalB, line.callback());
  // Joint angles and temperatures have other stamps than frames.
  const Coherence found = coherenceOf(a.timeS,
                                      a.values,
                                      resampled(b, a.timeS, gapFromS(timingOf(profile))),
                                      options,
                                      line.callback());
  if (found.coherence.empty())
    throw Error(file + ": coherence needs two segments; " + tooShort(found.report, options));
  line.wipe();
  if (formOf(given) == TableForm::kJson) {
    printJson(given,
              Json::object()
                  .set("rate_hz", known(found.report.rateHz))
                  .set("nyquist_hz", known(found.report.nyquistHz))
                  .set("window", options.window)
                  .set("overlap", options.overlap)
                  .set("bin_hz", found.binHz)
                  .set("segments", found.segments)
                  .set("level_95", found.level95())
                  .set("coherence", jsonList(found.coherence))
                  .set("phase_deg", jsonList(found.phaseDeg)));
    return kDone;
  }
  const int code =
      writeTable(given, *coherenceTable(found, unitOf(profile, signalA), unitOf(profile, signalB)));
  sayGrid(given, found.report);
  if (!given.quiet())
    sayLine("of independent noise 5 % of the bins are above " + fixedText(found.level95(), 3) +
            " (" + std::to_string(found.segments) + " segments)");
  return code;
}

}  // namespace

int spectrumCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate spectrum FILE --matrix M --x X --y Y [--window 32] [--overlap 31] ..",
       .purpose =
           "Computes the short-time Fourier transform of one taxel (in counts; 0 where it is not "
           "active) or of a signal of a matrix, as CSV: segment,time_s,frequency_hz,psd,magnitude. "
           "The intervals of frames are uneven: every span without a gap is first interpolated to "
           "equal intervals at its mean rate; frequencies above half that rate can't be measured. "
           "Hann window (periodic), power spectral density one-sided in counts^2/Hz, magnitude in "
           "counts: a sine of amplitude A at a bin has magnitude A. time_s is the middle of the "
           "window, from the recording's first frame.\n\nWith --welch it prints one spectrum "
           "instead, the mean over all segments: frequency_hz,psd,magnitude; with --peaks the "
           "peaks of this spectrum; with --coherence what two signals have in common: "
           "frequency_hz,coherence,phase_deg,psd_a,psd_b.",
       .options = withOneTableOptions(
           withCalibration(withFilterOptions(withFrameOptions(
               {rangedWhole("matrix", "M", "matrix", kMatrixOption),
                rangedWhole("x", "X", "column of the taxel", kMatrixOption),
                rangedWhole("y", "Y", "row of the taxel; row 0 is the fingertip", kMatrixOption),
                {"signal",
                 "NAME",
                 "instead of a taxel: mean, filtered_mean, min, max, sum, active, area_mm2; "
                 "without --matrix of the whole hand; or a name or formula as for derive: m1_mean, "
                 "m5_x2_y9, angle3, m1_slip_mm, m1_sum-m3_sum"},
                {"welch", "", "print one spectrum, the mean over all segments (Welch)"},
                {"peaks",
                 "",
                 "print the peaks of this spectrum: frequency, density, amplitude, width"},
                {"coherence",
                 "A,B",
                 "print coherence and phase of two signals or formulas, as m1_mean,m3_mean or "
                 "m5_x2_y9,m5_x3_y9"},
                rangedWhole("window",
                            "N",
                            "length of a segment",
                            SpectrumOptions::kWindow,
                            std::to_string(SpectrumOptions{}.window) + "; " +
                                std::to_string(welchOptions().window) +
                                " for --welch, --peaks, --coherence"),
                {"overlap",
                 "N",
                 "samples shared with the next segment, default window - 1; window / 2 for "
                 "--welch, "
                 "--peaks, --coherence"},
                worded("detrend",
                       "HOW",
                       "subtract this from each segment first",
                       kDetrendWords,
                       "mean"),
                worded("rate",
                       "HOW",
                       "interval that sets the sampling rate after interpolation",
                       kGridRateWords,
                       "mean"),
                timeOption()}))),
           "no table: rate, Nyquist, jitter, strongest line (or line and peaks) as JSON"),
       .example = "palpate spectrum roughness_test_rough.dsa --matrix 5 --x 2 --y 9 > spectra.csv",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const bool twoSignals = given.has("coherence");
  const bool oneLine = given.has("welch") || given.has("peaks");
  if (given.has("welch") && given.has("peaks"))
    throw UsageError("--welch and --peaks are two tables of one spectrum: give one of them");
  if (twoSignals && oneLine) throw UsageError("--coherence doesn't go with --welch or --peaks");
  if (twoSignals)
    for (const char* one : {"matrix", "x", "y", "signal"})
      if (given.has(one))
        throw UsageError(std::string("--coherence names its signals itself: leave out --") + one);
  frameChoiceOf(given);
  const SpectrumOptions options = spectrumOptionsOf(given, twoSignals || oneLine);
  const Recipe recipe = recipeOf(given);
  const auto calibration = calibrationGiven(given);
  const std::string& file = given.words().front();
  ProgressLine line("reading " + file, given.quiet());
  Recording recorded = openReported(file, line, given.quiet());
  takeTimes(given, recorded, file, line.callback());
  const NamedSignals named = namedSignals(
      calibration, file, recorded, filteredBy(recipe, recorded, file, line.callback()));
  const Profile& profile = named.profile;
  const std::vector<TypedSignal> chosen = chosenSignals(given, profile);
  std::vector<std::string> used;
  for (const TypedSignal& one : chosen)
    for (const std::string& name : namesOf(one, profile.layout())) used.push_back(name);
  reportAssumptions(named, used, given.quiet());
  if (twoSignals) return writeCoherence(given, profile, chosen, options, line);
  const TypedSignal& signal = chosen.front();
  const Series series = seriesOf(given, profile, signal, line.callback());
  const std::string unit = unitOf(profile, signal);
  if (oneLine) return writeMeanSpectrum(given, series, unit, options, line);
  auto run = std::make_unique<SpectrumRun>(series.timeS, series.values, options);
  const SpectrumReport plan = run->report();
  if (plan.segments == 0) throw Error(file + ": " + tooShort(plan, options));

  line.setLabel("transforming " + file);
  if (formOf(given) == TableForm::kCsv) {
    const int code = writeTable(given, *spectraTable(std::move(run), unit, line.callback()));
    line.wipe();
    sayGrid(given, plan);
    return code;
  }
  MeanSpectrumCollector collector(plan);
  const auto visit = [&](const SpectrumSink& sink) {
    visitSpectra(series.timeS, series.values, options, sink, line.callback());
  };
  visit([&](const SpectrumSegment& segment) { collector.add(segment); });
  const MeanSpectrum mean = collector.result();
  // Reads the segments a second time, to find when that frequency was strongest.
  double largest = -1.0, timeS = 0.0;
  visit([&](const SpectrumSegment& segment) {
    if (segment.binHz != mean.binHz || !(segment.magnitude[mean.strongestBin()] > largest)) return;
    largest = segment.magnitude[mean.strongestBin()];
    timeS = segment.timeS;
  });
  printJson(given, spectrumJsonOf(plan, options, mean, timeS));
  return kDone;
}

}  // namespace palpate::commands
