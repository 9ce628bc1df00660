// Computes spectra of a recording for the dock Spectrum.
#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/time_base.h>
#include <palpate/model/timing.h>
#include <palpate/signals/coherence.h>
#include <palpate/signals/profile_series.h>
#include <palpate/signals/spectrogram.h>
#include <palpate/signals/welch.h>

#include "gui/source/latest_answer.h"
#include "gui/source/opened_recording.h"
#include "gui/window_state/formula_curves.h"

namespace palpate::gui {

// What of a spectrum is requested.
enum class SpectrumWork { kOverTime, kMean, kCoherence };

// Which spectrum is requested.
struct SpectrumQuestion {
  // Never null.
  OpenedRecordingPtr recording = nullptr;
  // The chosen taxels; empty: the strongest taxel.
  TaxelSelection taxels = {};
  // Another signal instead of the taxels, with its name and unit.
  std::optional<FormulaCurve> formula = {};
  SpectrogramOptions options = {};
  // The visible span [s since the first frame]. If the options allow it (fitsWhole()), the whole
  // recording is computed instead.
  double fromS = 0.0;
  double toS = 0.0;
  SpectrumWork work = SpectrumWork::kOverTime;
  // The span of the mean or coherence [s since the first frame].
  TimeSpan span = {};
  // The other signal of the coherence.
  SeriesChoice other = {};
  TimeChoice times = TimeChoice::kArrival;
};

// The computed spectrum.
struct SpectrumAnswer {
  // The taxels whose mean is the signal; empty when no taxel has a signal.
  TaxelSelection taxels = {};
  // Unit of the hand's values.
  QString unit = "counts";
  // Name of a signal that isn't one of taxels.
  QString formula = {};
  // The taxel was chosen automatically.
  bool strongest = false;
  // The whole recording was computed, not only the visible span.
  bool whole = true;
  SpectrumOptions options = {};
  // Null when there is none.
  std::shared_ptr<const Series> series = nullptr;
  // Null when there is none; without parts when the signal is too short.
  std::shared_ptr<const Spectrogram> spectrogram = nullptr;
  SpectrumWork work = SpectrumWork::kOverTime;
  // The mean over the span with its peaks; null unless it was requested. Without bins when the span
  // is too short.
  std::shared_ptr<const WelchSpectrum> mean = nullptr;
  std::vector<SpectralPeak> peaks = {};
  // Null unless it was requested; without bins when the span is too short for two segments.
  std::shared_ptr<const Coherence> coherence = nullptr;
  TimeSpan span = {};
  // Of fitted times, what is known of the clocks.
  QString clock = {};
  // Why the work failed, in one line; for example an unreadable block.
  QString failure = {};
};

// Whether every segment of the whole recording is computed, rather than only those of the visible
// span.
bool fitsWhole(const SpectrumQuestion& question);

class SpectrumWorker : public LatestAnswer<SpectrumQuestion, SpectrumAnswer> {
  Q_OBJECT
 public:
  explicit SpectrumWorker(QObject* parent = nullptr);

 signals:
  void answered(const palpate::gui::SpectrumAnswer& answer);
};

}  // namespace palpate::gui
