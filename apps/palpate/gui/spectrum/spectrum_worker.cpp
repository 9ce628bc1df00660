#include "gui/spectrum/spectrum_worker.h"

#include <optional>

#include <palpate/recognition/filtered_recording.h>
#include <palpate/signals/resampled_series.h>
#include <palpate/signals/signal_name.h>
#include <palpate/signals/strongest_taxel.h>

#include "gui/appearance/hand_unit.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kFramesLookedAt = 4000;  // to find the strongest taxel
// Shares of the whole work.
constexpr double kLookShare = 0.2;
constexpr double kSpectrumWorkerReadShare = 0.5;

// The samples of a series within a span; readSeries() also returns their neighbours.
Series spanOf(const Profile& profile,
              const SeriesChoice& choice,
              const TimeSpan& span,
              const Progress& progress) {
  const Series all = readSeries(profile, choice, span.fromS, span.toS, progress);
  Series within;
  for (std::size_t i = 0; i < all.timeS.size(); ++i)
    if (all.timeS[i] >= span.fromS && all.timeS[i] <= span.toS) {
      within.timeS.push_back(all.timeS[i]);
      within.values.push_back(all.values[i]);
    }
  return within;
}

// A formula that is only the name of a column has the times of its series, not those of the frames.
SeriesChoice choiceOf(const FormulaCurve& formula, const Profile& profile) {
  const auto named = signalNamed(formula.formula.simplified().toStdString(), profile);
  return named && named->kind == SeriesChoice::Kind::kColumn ? *named : formula.choice();
}

// Progress of one part of the work, which starts at `base` and makes up `share` of the whole.
Progress part(const Progress& whole, double base, double share) {
  return [&whole, base, share](double done) { return whole(base + share * done); };
}

// Results for the last recording; the pointer is weak, so that a closed recording is freed.
struct SpectrumKept {
  std::weak_ptr<const OpenedRecording> of = {};
  TimeChoice times = TimeChoice::kArrival;
  bool looked = false;
  // Valid once `looked`; empty when no taxel has a signal.
  TaxelSelection strongest = {};
  // What is kept of the whole recording.
  SeriesChoice choice = {};
  std::shared_ptr<const Series> series = {};
  // The recording at fitted times, which keeps it open until the next question; empty until asked
  // for.
  std::optional<Profile> fitted = {};
  QString clock = {};
};

void answerOverSpan(const SpectrumQuestion& question,
                    const Profile& profile,
                    const SeriesChoice& choice,
                    SpectrumAnswer& answer,
                    const Progress& progress) {
  const double half = kSpectrumWorkerReadShare / 2.0, read = kLookShare + kSpectrumWorkerReadShare;
  answer.series = std::make_shared<Series>(
      spanOf(profile, choice, question.span, part(progress, kLookShare, half)));
  if (question.work == SpectrumWork::kMean) {
    answer.mean = std::make_shared<WelchSpectrum>(welchSpectrum(answer.series->timeS,
                                                                answer.series->values,
                                                                answer.options,
                                                                part(progress, read, 1.0 - read)));
    answer.peaks = spectralPeaks(answer.mean->mean);
    return;
  }
  const Series other =
      spanOf(profile, question.other, question.span, part(progress, kLookShare + half, half));
  answer.coherence = std::make_shared<Coherence>(coherenceOf(answer.series->timeS,
                                                             answer.series->values,
                                                             resampled(other, answer.series->timeS),
                                                             answer.options,
                                                             part(progress, read, 1.0 - read)));
}

SpectrumAnswer answerTo(SpectrumKept& kept,
                        const SpectrumQuestion& question,
                        const Progress& progress) {
  if (kept.of.lock() != question.recording || kept.times != question.times) {
    kept = {};
    kept.of = question.recording;
    kept.times = question.times;
  }
  if (question.times == TimeChoice::kFitted && !kept.fitted) {
    std::string said;
    kept.fitted = atTimes(question.times,
                          question.recording->profile,
                          question.recording->path.filename(),
                          part(progress, 0.0, kLookShare),
                          &said);
    kept.clock = QString::fromStdString(said);
  }
  const Profile& profile = kept.fitted ? *kept.fitted : question.recording->profile;
  SpectrumAnswer answer{.taxels = question.taxels,
                        .unit = unitOf(profile.hand()),
                        .strongest = question.taxels.empty(),
                        .whole = fitsWhole(question),
                        .options = question.options.limitedToCells(),
                        .work = question.work,
                        .span = question.span,
                        .clock = kept.clock};
  if (question.formula) {
    answer.strongest = false;
    answer.formula = question.formula->name;
    answer.unit = question.formula->unit;
  }
  if (answer.strongest) {
    if (!kept.looked) {
      kept.strongest = TaxelSelection(profile.layout());
      if (const auto place =
              strongestTaxel(profile, kFramesLookedAt, part(progress, 0.0, kLookShare)))
        kept.strongest.toggle(place->matrix, place->y, place->x);
      kept.looked = true;
    }
    answer.taxels = kept.strongest;
  }
  const SeriesChoice choice =
      question.formula ? choiceOf(*question.formula, profile)
                       : SeriesChoice{.kind = SeriesChoice::Kind::kTaxels, .taxels = answer.taxels};
  if (!hasSeries(profile, choice)) return answer;
  const Progress reading = part(progress, kLookShare, kSpectrumWorkerReadShare);
  if (question.work != SpectrumWork::kOverTime) {
    answerOverSpan(question, profile, choice, answer, progress);
    return answer;
  }
  if (!answer.whole) {
    answer.series = std::make_shared<Series>(
        readSeries(profile, choice, question.fromS, question.toS, reading));
  } else {
    if (!kept.series || kept.choice != choice) {
      kept.series =
          std::make_shared<Series>(readSeries(profile, choice, -kEndOfTimeS, kEndOfTimeS, reading));
      kept.choice = choice;
    }
    answer.series = kept.series;
  }
  const double read = kLookShare + kSpectrumWorkerReadShare;
  answer.spectrogram =
      std::make_shared<Spectrogram>(spectrogramOf(answer.series->timeS,
                                                  answer.series->values,
                                                  question.options,
                                                  part(progress, read, 1.0 - read)));
  return answer;
}

}  // namespace

bool fitsWhole(const SpectrumQuestion& question) {
  const SpectrumOptions& spectrum = question.options.spectrum;
  const auto hop = static_cast<std::size_t>(spectrum.window - spectrum.overlap);
  return question.recording->profile.numFrames() / hop <=
         question.options.limitedToCells().maxSegments;
}

SpectrumWorker::SpectrumWorker(QObject* parent)
    : LatestAnswer(
          [kept = std::make_shared<SpectrumKept>()](
              const SpectrumQuestion& question, const Progress& progress, const Tell&) {
            return answerTo(*kept, question, progress);
          },
          [this](const SpectrumAnswer& answer) { emit answered(answer); },
          [this](const QString& why) { emit answered({.failure = why}); },
          parent) {}

}  // namespace palpate::gui
