#include "palpate/signals/spectrum_rows.h"

#include <cstddef>
#include <utility>

namespace palpate {
namespace {

// A frequency of a spectrum, with what is known there.
struct SpectrumLine {
  std::size_t segment = 0;
  double timeS = 0.0, frequencyHz = 0.0;
  double values[4] = {};
};
using LineColumns = std::vector<ColumnOf<SpectrumLine>>;

ColumnOf<SpectrumLine> valueColumn(const char* name,
                                   const std::string& unit,
                                   const char* meaning,
                                   std::size_t at) {
  return finiteColumn<SpectrumLine>(
      name, unit, meaning, [at](const SpectrumLine& line) { return line.values[at]; });
}

ColumnOf<SpectrumLine> frequencyColumn() {
  return finiteColumn<SpectrumLine>(
      "frequency_hz", "Hz", "frequency of the bin", &SpectrumLine::frequencyHz);
}

std::string densityUnit(const std::string& unit) {
  if (unit.empty()) return {};
  return (unit.find('^') == std::string::npos ? unit : "(" + unit + ")") + "^2/Hz";
}

constexpr const char* kDensity = "power spectral density, one-sided";
constexpr const char* kMagnitude = "amplitude of a tone at this frequency";

}  // namespace

std::unique_ptr<ResultTable> spectraTable(std::unique_ptr<SpectrumRun> run,
                                          const std::string& unit,
                                          const Progress& progress) {
  using Line = SpectrumLine;
  return std::make_unique<RowTable<Line>>(
      "spectra",
      LineColumns{columnOf<Line>("segment", "", "number of the segment, from 0", &Line::segment),
                  finiteColumn<Line>(
                      "time_s", "s", "middle of the segment, from the first frame", &Line::timeS),
                  frequencyColumn(),
                  valueColumn("psd", densityUnit(unit), kDensity, 0),
                  valueColumn("magnitude", unit, kMagnitude, 1)},
      [run = std::shared_ptr<SpectrumRun>(std::move(run)), progress](std::vector<Line>& lines) {
        SpectrumSegment at;
        if (!run->next(at, progress)) return false;
        for (std::size_t k = 0; k < at.psd.size(); ++k)
          lines.push_back({at.segment,
                           at.timeS,
                           static_cast<double>(k) * at.binHz,
                           {at.psd[k], at.magnitude[k]}});
        return true;
      });
}

std::unique_ptr<ResultTable> meanSpectrumTable(const MeanSpectrum& mean, const std::string& unit) {
  std::vector<SpectrumLine> lines;
  for (std::size_t k = 0; k < mean.psd.size(); ++k)
    lines.push_back(
        {0, 0.0, static_cast<double>(k) * mean.binHz, {mean.psd[k], mean.magnitude[k]}});
  return std::make_unique<RowTable<SpectrumLine>>(
      "spectrum",
      LineColumns{frequencyColumn(),
                  valueColumn("psd", densityUnit(unit), "mean power spectral density", 0),
                  valueColumn("magnitude", unit, kMagnitude, 1)},
      std::move(lines));
}

std::unique_ptr<ResultTable> peakTable(std::vector<SpectralPeak> peaks, const std::string& unit) {
  using Peak = SpectralPeak;
  return std::make_unique<RowTable<Peak>>(
      "spectrum_peaks",
      std::vector<ColumnOf<Peak>>{
          finiteColumn<Peak>("frequency_hz", "Hz", "frequency of the peak", &Peak::frequencyHz),
          finiteColumn<Peak>("psd", densityUnit(unit), "density there", &Peak::psd),
          finiteColumn<Peak>("amplitude", unit, "of a tone with this peak", &Peak::amplitude),
          finiteColumn<Peak>("width_hz", "Hz", "full width at half of the density", &Peak::widthHz),
          finiteColumn<Peak>("prominence_db",
                             "dB",
                             "height above the higher of the valleys next to it",
                             &Peak::prominenceDb)},
      std::move(peaks));
}

std::unique_ptr<ResultTable> coherenceTable(const Coherence& found,
                                            const std::string& unitA,
                                            const std::string& unitB) {
  std::vector<SpectrumLine> lines;
  for (std::size_t k = 0; k < found.coherence.size(); ++k)
    lines.push_back({0,
                     0.0,
                     static_cast<double>(k) * found.binHz,
                     {found.coherence[k], found.phaseDeg[k], found.psdA[k], found.psdB[k]}});
  return std::make_unique<RowTable<SpectrumLine>>(
      "coherence",
      LineColumns{
          frequencyColumn(),
          valueColumn("coherence", "", "part of the power that both have in common, 0 to 1", 0),
          valueColumn("phase_deg", "deg", "of the second signal; below 0: it is later", 1),
          valueColumn("psd_a", densityUnit(unitA), "density of the first signal", 2),
          valueColumn("psd_b", densityUnit(unitB), "density of the second signal", 3)},
      std::move(lines));
}

}  // namespace palpate
