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

std::size_t countOf(const Profile& profile, ProfileSeriesKind kind) {
  if (kind == ProfileSeriesKind::kAngle) return profile.numAngles();
  if (kind == ProfileSeriesKind::kTemperature) return profile.numTemperatures();
  return profile.numFrames();
}

// Time 0 of all series: the first frame; without frames, the first angles or temperatures.
std::int64_t originUs(const Profile& profile) {
  if (profile.numFrames() > 0) return profile.frameTimeUs(0);
  if (profile.numAngles() > 0) return profile.angleTimeUs(0);
  return profile.numTemperatures() > 0 ? profile.temperatureTimeUs(0) : 0;
}

std::optional<std::size_t> sampleAt(const Profile& profile,
                                    ProfileSeriesKind kind,
                                    std::int64_t timeUs) {
  if (kind == ProfileSeriesKind::kAngle) return profile.angleSampleAt(timeUs);
  if (kind == ProfileSeriesKind::kTemperature) return profile.temperatureSampleAt(timeUs);
  return profile.frameAt(timeUs);
}

std::int64_t usOf(const Profile& profile, double seconds) {
  return originUs(profile) +
         std::llround(std::clamp(seconds, -kProfileSeriesFurthestS, kProfileSeriesFurthestS) *
                      kUsPerS);
}

double valueAt(const std::vector<double>& values, std::size_t index) {
  return index < values.size() ? values[index] : std::numeric_limits<double>::quiet_NaN();
}

// Reads the samples of a series one after the other.
class Reader {
 public:
  Reader(const Profile& profile, const SeriesChoice& choice)
      : profile_(profile), choice_(choice), originUs_(originUs(profile)) {}

  // NaN, and the sample added to `unreadable`, where it can't be read.
  std::pair<double, double> read(std::size_t sample, UnreadableSamples* unreadable) {
    try {
      return read(sample);
    } catch (const Error& error) {
      if (!unreadable) throw;
      unreadable->add(sample, error.what());
      return {seconds(timeUs(sample)), std::numeric_limits<double>::quiet_NaN()};
    }
  }

 private:
  std::int64_t timeUs(std::size_t sample) const {
    if (choice_.kind == ProfileSeriesKind::kAngle) return profile_.angleTimeUs(sample);
    if (choice_.kind == ProfileSeriesKind::kTemperature) return profile_.temperatureTimeUs(sample);
    return profile_.frameTimeUs(sample);
  }

  std::pair<double, double> read(std::size_t sample) {
    switch (choice_.kind) {
      case ProfileSeriesKind::kAngle: {
        const Sample angles = profile_.angles(sample);
        return {seconds(angles.hostUs), valueAt(angles.values, choice_.index)};
      }
      case ProfileSeriesKind::kTemperature: {
        const Sample temperatures = profile_.temperatures(sample);
        const double degC = valueAt(temperatures.values, choice_.index);
        return {seconds(temperatures.hostUs),
                degC == 0.0 ? std::numeric_limits<double>::quiet_NaN() : degC};
      }
      case ProfileSeriesKind::kTaxels:
        profile_.readFrame(sample, frame_);
        return {seconds(frame_.hostUs), meanOf(frame_, choice_.taxels)};
      case ProfileSeriesKind::kMatrix:
      case ProfileSeriesKind::kForce:    // no profile has it: hasSeries()
      case ProfileSeriesKind::kFormula:  // readFormula() computes it
        break;
    }
    profile_.readFrame(sample, frame_);
    const std::size_t m = choice_.index;
    const CharacteristicSignals values = m == frame_.layout->numMatrices()
                                             ? wholeFrameSignals(frame_)
                                             : characteristicSignals(frame_, m);
    return {seconds(frame_.hostUs), valueOf(values, choice_.signal)};
  }

  double seconds(std::int64_t us) const { return static_cast<double>(us - originUs_) / kUsPerS; }

  const Profile& profile_;
  const SeriesChoice& choice_;
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
          const auto choice = signalNamed(name, profile.layout());
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

bool hasSeries(const Profile& profile, const SeriesChoice& choice) {
  if (countOf(profile, choice.kind) == 0) return false;
  switch (choice.kind) {
    case ProfileSeriesKind::kAngle:
      return choice.index < profile.hand().axes.size();
    case ProfileSeriesKind::kTemperature:
      return choice.index < profile.hand().temperatureSensors.size();
    case ProfileSeriesKind::kTaxels:
      return !choice.taxels.empty() && TaxelSelection(profile.layout()).sameSensor(choice.taxels);
    case ProfileSeriesKind::kForce:
      return false;
    case ProfileSeriesKind::kFormula:
      return hasFormula(profile, choice.formula);
    case ProfileSeriesKind::kMatrix:
      break;
  }
  return choice.index <= profile.layout().numMatrices();
}

std::size_t numSamples(const Profile& profile,
                       const SeriesChoice& choice,
                       double fromS,
                       double toS) {
  if (countOf(profile, choice.kind) == 0 || !(fromS <= toS)) return 0;
  return *sampleAt(profile, choice.kind, usOf(profile, toS)) -
         *sampleAt(profile, choice.kind, usOf(profile, fromS)) + 1;
}

Series readSeries(const Profile& profile,
                  const SeriesChoice& choice,
                  double fromS,
                  double toS,
                  const Progress& progress,
                  UnreadableSamples* unreadable) {
  requireSeries(profile, choice);
  if (!(fromS <= toS)) return {};
  const std::size_t begin = *sampleAt(profile, choice.kind, usOf(profile, fromS));
  const std::size_t end = std::min(*sampleAt(profile, choice.kind, usOf(profile, toS)) + 2,
                                   countOf(profile, choice.kind));
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
  readAll(profile, choice, 0, countOf(profile, choice.kind), progress, unreadable, sink);
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
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i <= numSteps; ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(numSteps);
    if (progress && !progress(done)) throw Cancelled();
    const std::size_t sample = *sampleAt(profile, choice.kind, usOf(profile, durationS * done));
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
