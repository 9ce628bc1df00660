// Spectra as result tables. docs/manual/columns.md explains the columns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/signals/coherence.h>
#include <palpate/signals/spectrum.h>
#include <palpate/signals/welch.h>

namespace palpate {

// `unit`: that of the signal; empty: not known.

// The table "spectra": a row for each segment and frequency. Its rows throw Cancelled.
std::unique_ptr<ResultTable> spectraTable(std::unique_ptr<SpectrumRun> run,
                                          const std::string& unit = {},
                                          const Progress& progress = {});
// The table "spectrum": a row for each frequency of a mean spectrum.
std::unique_ptr<ResultTable> meanSpectrumTable(const MeanSpectrum& mean,
                                               const std::string& unit = {});
// The table "spectrum_peaks".
std::unique_ptr<ResultTable> peakTable(std::vector<SpectralPeak> peaks,
                                       const std::string& unit = {});
// The table "coherence": a row for each frequency; units of the first and the second signal.
std::unique_ptr<ResultTable> coherenceTable(const Coherence& found,
                                            const std::string& unitA = {},
                                            const std::string& unitB = {});

}  // namespace palpate
