// The command `palpate spectrum FILE` prints the short-time Fourier transform of a taxel or a
// matrix signal as CSV.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
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
#include "palpate/signals/welch.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"
#include "commands/signal_options.h"

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
    if (matrix && parseSignalName(*text))
      throw UsageError("--signal " + *text + " names its matrix itself: leave out --matrix");
    // A plain word is one of the signals of a matrix, and refused with their names.
    if (text->find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos)
      return {.choice = SeriesChoice{.index = static_cast<std::size_t>(numMatrices),
                                     .signal = *signalChosen(given)}};
    return typedSignal(*text, profile, file, "--signal");
  }
  if (!matrix || !x || !y)
    throw UsageError("spectrum needs --matrix M --x X --y Y (a taxel), or --signal");
  return {.choice = taxelOf(layout, static_cast<std::size_t>(*matrix), *x, *y, file)};
}

// The two signals of --coherence.
std::pair<TypedSignal, TypedSignal> coherenceChoices(const CommandLine& given,
                                                     const Profile& profile) {
  const std::string text = *given.text("coherence");
  const std::vector<std::string> parts = splitAtCommas(text);
  if (parts.size() != 2)
    throw UsageError(
        "--coherence needs two signals A,B, as m1_mean,m3_mean or m5_x2_y9,m5_x3_y9; is \"" + text +
        "\"");
  const std::string& file = given.words().front();
  return {typedSignal(parts[0], profile, file, "--coherence"),
          typedSignal(parts[1], profile, file, "--coherence")};
}

// The series from frame `from` to frame `to`, both inclusive.
Series seriesOf(const CommandLine& given,
                const Profile& profile,
                const TypedSignal& signal,
                const Progress& progress) {
  const std::string& file = given.words().front();
  if (profile.numFrames() == 0) throw Error(file + ": has no frames");
  const auto last = static_cast<std::int64_t>(profile.numFrames()) - 1;
  const std::int64_t from = given.integer("from", 0, last).value_or(0);
  const std::int64_t to = given.integer("to", 0, last).value_or(last);
  if (from > to) throw UsageError("--from is after --to");
  const auto secondsOf = [&](std::int64_t frame) {
    const auto us = profile.frameTimeUs(static_cast<std::size_t>(frame)) - profile.frameTimeUs(0);
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

void appendRows(std::string& text, const SpectrumSegment& segment) {
  for (std::size_t k = 0; k < segment.psd.size(); ++k) {
    appendNumber(text, static_cast<std::int64_t>(segment.segment));
    for (const double value : {segment.timeS,
                               static_cast<double>(k) * segment.binHz,
                               segment.psd[k],
                               segment.magnitude[k]}) {
      text += ',';
      appendNumber(text, value);
    }
    text += '\n';
  }
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

Json peaksJson(const std::vector<SpectralPeak>& peaks) {
  return jsonList(peaks, [](const SpectralPeak& peak) {
    return Json::object()
        .set("frequency_hz", peak.frequencyHz)
        .set("psd", peak.psd)
        .set("amplitude", peak.amplitude)
        .set("width_hz", peak.widthHz)
        .set("prominence_db", peak.prominenceDb);
  });
}

// A line of numbers; NaN is an empty cell.
void appendLine(std::string& text, std::initializer_list<double> values) {
  char before = 0;
  for (const double value : values) {
    if (before != 0) text += before;
    before = ',';
    if (std::isfinite(value)) appendNumber(text, value);
  }
  text += '\n';
}

void sayGrid(const CommandLine& given, const SpectrumReport& report) {
  if (given.quiet()) return;
  std::fprintf(stderr,
               "palpate: intervals vary by %s %%: resampled to %s Hz; nothing above %s Hz can be "
               "seen\n",
               fixedText(report.jitter * kPercent, 0).c_str(),
               fixedText(report.rateHz, 2).c_str(),
               fixedText(report.nyquistHz, 2).c_str());
}

// --welch and --peaks.
int writeMeanSpectrum(const CommandLine& given,
                      const Series& series,
                      const SpectrumOptions& options,
                      ProgressLine& line) {
  const std::string& file = given.words().front();
  const WelchSpectrum spectrum =
      welchSpectrum(series.timeS, series.values, options, line.callback());
  if (spectrum.mean.psd.empty()) throw Error(file + ": " + tooShort(spectrum.report, options));
  const std::vector<SpectralPeak> peaks = spectralPeaks(spectrum.mean);
  std::string text;
  if (given.has("json")) {
    text = Json::object()
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
               .set("peaks", peaksJson(peaks))
               .text() +
           "\n";
  } else if (given.has("peaks")) {
    text = "frequency_hz,psd,amplitude,width_hz,prominence_db\n";
    for (const SpectralPeak& peak : peaks)
      appendLine(text,
                 {peak.frequencyHz, peak.psd, peak.amplitude, peak.widthHz, peak.prominenceDb});
  } else {
    text = "frequency_hz,psd,magnitude\n";
    for (std::size_t k = 0; k < spectrum.mean.psd.size(); ++k)
      appendLine(text,
                 {static_cast<double>(k) * spectrum.mean.binHz,
                  spectrum.mean.psd[k],
                  spectrum.mean.magnitude[k]});
  }
  StandardOutput out;
  out.write(text);
  out.finish();
  line.wipe();
  if (!given.has("json")) sayGrid(given, spectrum.report);
  return kDone;
}

int writeCoherence(const CommandLine& given,
                   const Profile& profile,
                   const SpectrumOptions& options,
                   ProgressLine& line) {
  const std::string& file = given.words().front();
  const auto [signalA, signalB] = coherenceChoices(given, profile);
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
  std::string text;
  if (given.has("json")) {
    text = Json::object()
               .set("rate_hz", known(found.report.rateHz))
               .set("nyquist_hz", known(found.report.nyquistHz))
               .set("window", options.window)
               .set("overlap", options.overlap)
               .set("bin_hz", found.binHz)
               .set("segments", found.segments)
               .set("level_95", found.level95())
               .set("coherence", jsonList(found.coherence))
               .set("phase_deg", jsonList(found.phaseDeg))
               .text() +
           "\n";
  } else {
    text = "frequency_hz,coherence,phase_deg,psd_a,psd_b\n";
    for (std::size_t k = 0; k < found.coherence.size(); ++k)
      appendLine(text,
                 {static_cast<double>(k) * found.binHz,
                  found.coherence[k],
                  found.phaseDeg[k],
                  found.psdA[k],
                  found.psdB[k]});
  }
  StandardOutput out;
  out.write(text);
  out.finish();
  line.wipe();
  if (!given.has("json")) {
    sayGrid(given, found.report);
    if (!given.quiet())
      std::fprintf(stderr,
                   "palpate: of independent noise 5 %% of the bins are above %s (%zu segments)\n",
                   fixedText(found.level95(), 3).c_str(),
                   found.segments);
  }
  return kDone;
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
       .options = withFilterOptions(
           {rangedWhole("matrix", "M", "matrix", kMatrixOption),
            rangedWhole("x", "X", "column of the taxel", kMatrixOption),
            rangedWhole("y", "Y", "row of the taxel; row 0 is the fingertip", kMatrixOption),
            {"signal",
             "NAME",
             "instead of a taxel: mean, filtered_mean, min, max, sum, active, area_mm2; "
             "without --matrix of the whole hand; or a name or formula as for derive: m1_mean, "
             "m5_x2_y9, angle3, m1_sum-m3_sum"},
            {"welch", "", "the mean over all segments as one spectrum (Welch)"},
            {"peaks", "", "the peaks of this spectrum: frequency, density, amplitude, width"},
            {"coherence",
             "A,B",
             "coherence and phase of two signals or formulas, as m1_mean,m3_mean or "
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
             "samples shared with the next segment, default window - 1; window / 2 for --welch, "
             "--peaks, --coherence"},
            worded("detrend",
                   "HOW",
                   "what is subtracted from each segment first",
                   kDetrendWords,
                   "mean"),
            worded("rate",
                   "HOW",
                   "of the intervals: sampling rate after interpolation",
                   kGridRateWords,
                   "mean"),
            timeOption(),
            rangedWhole("from", "N", "first frame", kFrameOption, "0"),
            rangedWhole("to", "N", "last frame, inclusive", kFrameOption, "the last one"),
            {"json",
             "",
             "no table: rate, Nyquist, jitter, strongest line (or line and peaks) as JSON"}}),
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
  const SpectrumOptions options = spectrumOptionsOf(given, twoSignals || oneLine);
  const Recipe recipe = recipeOf(given);
  const std::string& file = given.words().front();
  ProgressLine line("reading " + file, given.quiet());
  Recording recorded = openReported(file, line, given.quiet());
  takeTimes(given, recorded, file, line.callback());
  const Profile profile = filteredBy(recipe, recorded, file, line.callback());
  if (twoSignals) return writeCoherence(given, profile, options, line);
  const Series series = seriesOf(given, profile, choiceOf(given, profile), line.callback());
  if (oneLine) return writeMeanSpectrum(given, series, options, line);
  const SpectrumReport plan = planSpectra(series.timeS, series.values, options);
  if (plan.segments == 0) throw Error(file + ": " + tooShort(plan, options));

  line.setLabel("transforming " + file);
  StandardOutput out;
  if (given.has("json")) {
    MeanSpectrumCollector collector(plan);
    const auto visit = [&](const SpectrumSink& sink) {
      visitSpectra(series.timeS, series.values, options, sink, line.callback());
    };
    visit([&](const SpectrumSegment& segment) { collector.add(segment); });
    const MeanSpectrum mean = collector.result();
    // Reads the segments a second time, to find when that frequency was strongest.
    double largest = -1.0, timeS = 0.0;
    visit([&](const SpectrumSegment& segment) {
      if (segment.binHz != mean.binHz || !(segment.magnitude[mean.strongestBin()] > largest))
        return;
      largest = segment.magnitude[mean.strongestBin()];
      timeS = segment.timeS;
    });
    out.write(spectrumJsonOf(plan, options, mean, timeS).text() + "\n");
    out.finish();
    return kDone;
  }
  std::string text = "segment,time_s,frequency_hz,psd,magnitude\n";
  visitSpectra(
      series.timeS,
      series.values,
      options,
      [&](const SpectrumSegment& segment) {
        appendRows(text, segment);
        out.write(text);
        text.clear();
      },
      line.callback());
  out.finish();
  line.wipe();
  sayGrid(given, plan);
  return kDone;
}

}  // namespace palpate::commands
