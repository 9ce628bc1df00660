#include "palpate/signals/profile_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"
#include "palpate/signals/formula.h"
#include "palpate/signals/signal_name.h"

namespace palpate {
namespace {

constexpr double kProfileSeriesFurthestS = 1e12;
constexpr std::size_t kSamplesPerReport = 512;

using ProfileSeriesKind = SeriesChoice::Kind;

bool isOfSamples(ProfileSeriesKind kind) {
  return kind == ProfileSeriesKind::kAngle || kind == ProfileSeriesKind::kTemperature ||
         kind == ProfileSeriesKind::kColumn;
}

// The samples that a choice is made of: those of a series, or the frames.
class Samples {
 public:
  Samples(const Profile& profile, const SeriesChoice& choice)
      : profile_(profile), column_(columnOf(profile, choice)) {
    if (column_)
      count_ = profile.numSamples(column_->series);
    else if (!isOfSamples(choice.kind))
      count_ = profile.numFrames();
  }

  const std::optional<SeriesColumn>& column() const { return column_; }
  std::size_t count() const { return count_; }
  std::int64_t timeUs(std::size_t i) const {
    return column_ ? profile_.sampleTimeUs(column_->series, i) : profile_.frameTimeUs(i);
  }
  // Of samples that there are.
  std::size_t at(std::int64_t timeUs) const {
    return *(column_ ? profile_.sampleAt(column_->series, timeUs) : profile_.frameAt(timeUs));
  }

 private:
  const Profile& profile_;
  std::optional<SeriesColumn> column_;
  std::size_t count_ = 0;
};

// Time 0 of all series: the first frame; without frames, the first sample of the first series that
// has one.
std::int64_t originUs(const Profile& profile) {
  if (profile.numFrames() > 0) return profile.frameTimeUs(0);
  for (std::size_t s = 0; s < profile.series().size(); ++s)
    if (profile.numSamples(s) > 0) return profile.sampleTimeUs(s, 0);
  return 0;
}

std::int64_t usOf(const Profile& profile, double seconds) {
  return originUs(profile) +
         std::llround(std::clamp(seconds, -kProfileSeriesFurthestS, kProfileSeriesFurthestS) *
                      kUsPerS);
}

// Reads the samples of a series one after the other.
class Reader {
 public:
  Reader(const Profile& profile, const SeriesChoice& choice)
      : profile_(profile),
        choice_(choice),
        samples_(profile, choice),
        originUs_(originUs(profile)) {}

  // NaN, and the sample added to `unreadable`, where it can't be read.
  std::pair<double, double> read(std::size_t sample, UnreadableSamples* unreadable) {
    try {
      return read(sample);
    } catch (const Error& error) {
      if (!unreadable) throw;
      unreadable->add(sample, error.what());
      return {seconds(samples_.timeUs(sample)), std::numeric_limits<double>::quiet_NaN()};
    }
  }

 private:
  std::pair<double, double> read(std::size_t sample) {
    if (const auto& column = samples_.column()) {
      const Sample read = profile_.sample(column->series, sample);
      return {seconds(read.hostUs), valueIn(read, *column)};
    }
    profile_.readFrame(sample, frame_);
    if (choice_.kind == ProfileSeriesKind::kTaxels)
      return {seconds(frame_.hostUs), meanOf(frame_, choice_.taxels)};
    // No profile has kForce (hasSeries()), and readFormula() computes kFormula.
    const std::size_t m = choice_.index;
    const CharacteristicSignals values = m == frame_.layout->numMatrices()
                                             ? wholeFrameSignals(frame_)
                                             : characteristicSignals(frame_, m);
    return {seconds(frame_.hostUs), valueOf(values, choice_.signal)};
  }

  double seconds(std::int64_t us) const { return static_cast<double>(us - originUs_) / kUsPerS; }

  const Profile& profile_;
  const SeriesChoice& choice_;
  Samples samples_;
  std::int64_t originUs_;
  TactileFrame frame_;
};

void requireSeries(const Profile& profile, const SeriesChoice& choice) {
  if (!hasSeries(profile, choice))
    throw std::invalid_argument("readSeries: the profile hasn't what was chosen");
}

template <class Sink>
void readAll(const Profile& profile,
             const SeriesChoice& choice,
             std::size_t begin,
             std::size_t end,
             const Progress& progress,
             UnreadableSamples* unreadable,
             Sink sink) {
  if (const auto column = columnOf(profile, choice)) profile.prepare(column->series, progress);
  Reader reader(profile, choice);
  for (std::size_t i = begin; i < end; ++i) {
    reportProgress(progress, i - begin, end - begin, kSamplesPerReport);
    const auto [timeS, value] = reader.read(i, unreadable);
    sink(timeS, value);
  }
}

bool hasFormula(const Profile& profile, const std::string& text) {
  try {
    const Formula formula(text);
    return std::all_of(
        formula.names().begin(), formula.names().end(), [&](const std::string& name) {
          const auto choice = signalNamed(name, profile);
          return choice && hasSeries(profile, *choice);
        });
  } catch (const std::invalid_argument&) {
    return false;
  }
}

// The formula at the frames begin..end, end exclusive.
Series readFormula(const Profile& profile,
                   const SeriesChoice& choice,
                   std::size_t begin,
                   std::size_t end,
                   const Progress& progress,
                   UnreadableSamples* unreadable) {
  if (begin >= end) return {};
  const auto secondsAt = [&](std::size_t frame) {
    return static_cast<double>(profile.frameTimeUs(frame) - originUs(profile)) / kUsPerS;
  };
  return formulaSeries(
      profile, Formula(choice.formula), secondsAt(begin), secondsAt(end - 1), progress, unreadable);
}

// The samples begin..end, end exclusive.
Series readSamples(const Profile& profile,
                   const SeriesChoice& choice,
                   std::size_t begin,
                   std::size_t end,
                   const Progress& progress,
                   UnreadableSamples* unreadable) {
  if (choice.kind == ProfileSeriesKind::kFormula)
    return readFormula(profile, choice, begin, end, progress, unreadable);
  Series series;
  series.timeS.reserve(end - begin);
  series.values.reserve(end - begin);
  readAll(profile, choice, begin, end, progress, unreadable, [&](double timeS, double value) {
    series.timeS.push_back(timeS);
    series.values.push_back(value);
  });
  return series;
}

}  // namespace

double meanOf(const TactileFrame& frame, const TaxelSelection& taxels) {
  double sum = 0.0;
  std::size_t count = 0;
  const std::size_t matrices = std::min(taxels.numMatrices(), frame.layout->numMatrices());
  for (std::size_t m = 0; m < matrices; ++m) {
    const auto values = frame.allValues(m);
    const Mask& mask = taxels.mask(m);
    const auto places = std::min(mask.size(), static_cast<std::size_t>(values.size()));
    for (std::size_t i = 0; i < places; ++i)
      if (mask[i]) {
        sum += static_cast<double>(values.data()[i]);
        ++count;
      }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

std::optional<SeriesColumn> columnOf(const Profile& profile, const SeriesChoice& choice) {
  const auto ofHand = [&](std::size_t series) -> std::optional<SeriesColumn> {
    if (profile.numSamples(series) == 0 || choice.index >= profile.series()[series].columns.size())
      return std::nullopt;
    return SeriesColumn{series, choice.index};
  };
  if (choice.kind == ProfileSeriesKind::kAngle) return ofHand(kAngleSeries);
  if (choice.kind == ProfileSeriesKind::kTemperature) return ofHand(kTemperatureSeries);
  if (choice.kind != ProfileSeriesKind::kColumn) return std::nullopt;
  const auto series = profile.seriesNamed(choice.series);
  if (!series) return std::nullopt;
  const auto& columns = profile.series()[*series].columns;
  const auto column =
      std::ranges::find_if(columns, [&](const Column& c) { return c.name == choice.column; });
  if (column == columns.end()) return std::nullopt;
  return SeriesColumn{*series, static_cast<std::size_t>(column - columns.begin())};
}

std::string seriesUnit(const Profile& profile, const SeriesChoice& choice) {
  if (const auto column = columnOf(profile, choice))
    return profile.series()[column->series].columns[column->column].unit;
  switch (choice.kind) {
    case ProfileSeriesKind::kForce:
      return "N";
    case ProfileSeriesKind::kTaxels:
      return profile.hand().unit;
    case ProfileSeriesKind::kMatrix:
      return choice.signal == SignalKind::kActive ? "taxels"
             : choice.signal == SignalKind::kArea ? "mm^2"
                                                  : profile.hand().unit;
    default:
      return {};
  }
}

double valueIn(const Sample& sample, const SeriesColumn& column) {
  constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
  if (column.column >= sample.values.size()) return kNotKnown;
  const double value = sample.values[column.column];
  return column.series == kTemperatureSeries && value == 0.0 ? kNotKnown : value;
}

bool hasSeries(const Profile& profile, const SeriesChoice& choice) {
  if (isOfSamples(choice.kind)) return columnOf(profile, choice).has_value();
  if (profile.numFrames() == 0) return false;
  switch (choice.kind) {
    case ProfileSeriesKind::kTaxels:
      return !choice.taxels.empty() && TaxelSelection(profile.layout()).sameSensor(choice.taxels);
    case ProfileSeriesKind::kForce:
      return false;
    case ProfileSeriesKind::kFormula:
      return hasFormula(profile, choice.formula);
    default:
      break;
  }
  if (isComponent(choice.signal))
    return profile.givesReadings() && choice.index < profile.layout().numMatrices();
  return choice.index <= profile.layout().numMatrices();
}

std::string whyMissing(const Profile& profile, const SeriesChoice& choice) {
  if (hasSeries(profile, choice)) return {};
  if (choice.kind == ProfileSeriesKind::kMatrix && isComponent(choice.signal))
    return "only a matrix whose sensor sends readings has it, unfiltered";
  if (choice.kind == ProfileSeriesKind::kColumn)
    for (const SeriesDescription& series : profile.series())
      if (series.name == choice.series && series.role == kComputedRole) return series.source;
  return {};
}

bool isReady(const Profile& profile, const SeriesChoice& choice) {
  if (choice.kind != ProfileSeriesKind::kFormula) {
    const auto column = columnOf(profile, choice);
    return !column || profile.isReady(column->series);
  }
  if (!hasFormula(profile, choice.formula)) return true;
  const Formula formula(choice.formula);
  return std::ranges::all_of(formula.names(), [&](const std::string& name) {
    return isReady(profile, *signalNamed(name, profile));
  });
}

std::size_t numSamples(const Profile& profile,
                       const SeriesChoice& choice,
                       double fromS,
                       double toS) {
  const Samples samples(profile, choice);
  if (samples.count() == 0 || !(fromS <= toS)) return 0;
  return samples.at(usOf(profile, toS)) - samples.at(usOf(profile, fromS)) + 1;
}

Series readSeries(const Profile& profile,
                  const SeriesChoice& choice,
                  double fromS,
                  double toS,
                  const Progress& progress,
                  UnreadableSamples* unreadable) {
  requireSeries(profile, choice);
  if (!(fromS <= toS)) return {};
  const Samples samples(profile, choice);
  const std::size_t begin = samples.at(usOf(profile, fromS));
  const std::size_t end = std::min(samples.at(usOf(profile, toS)) + 2, samples.count());
  return readSamples(profile, choice, begin, end, progress, unreadable);
}

void visitSeries(const Profile& profile,
                 const SeriesChoice& choice,
                 const std::function<void(double, double)>& sink,
                 const Progress& progress,
                 UnreadableSamples* unreadable) {
  requireSeries(profile, choice);
  if (choice.kind == ProfileSeriesKind::kFormula) {
    // Long recordings are computed in parts, unless each part needs the others.
    constexpr std::size_t kPart = 200'000;
    const std::size_t frames = profile.numFrames();
    const std::size_t step =
        Formula(choice.formula).hasFrequencyFilter() ? std::max<std::size_t>(frames, 1) : kPart;
    for (std::size_t begin = 0; begin < frames; begin += step) {
      const std::size_t end = std::min(frames, begin + step);
      const Progress part = [&](double done) {
        const double now = static_cast<double>(begin) + done * static_cast<double>(end - begin);
        return !progress || progress(now / static_cast<double>(frames));
      };
      const Series computed = readFormula(profile, choice, begin, end, part, unreadable);
      for (std::size_t i = 0; i < computed.timeS.size(); ++i)
        sink(computed.timeS[i], computed.values[i]);
    }
    return;
  }
  readAll(profile, choice, 0, Samples(profile, choice).count(), progress, unreadable, sink);
}

Series readSpread(const Profile& profile,
                  const SeriesChoice& choice,
                  std::size_t numSteps,
                  const Progress& progress,
                  UnreadableSamples* unreadable) {
  requireSeries(profile, choice);
  if (numSteps == 0) throw std::invalid_argument("readSpread: no step");
  Series series;
  const double durationS = static_cast<double>(profile.durationUs()) / kUsPerS;
  const Samples samples(profile, choice);
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i <= numSteps; ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(numSteps);
    if (progress && !progress(done)) throw Cancelled();
    const std::size_t sample = samples.at(usOf(profile, durationS * done));
    if (last && sample <= *last) continue;
    last = sample;
    const Series one = readSamples(profile, choice, sample, sample + 1, {}, unreadable);
    if (one.values.empty()) continue;
    series.timeS.push_back(one.timeS.front());
    series.values.push_back(one.values.front());
  }
  return series;
}

}  // namespace palpate
