#include "gui/timeline/series_store.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/signals/formula.h>

namespace palpate::gui {
namespace {

// Up to so many samples are read in the thread of the window (a few milliseconds).
constexpr std::size_t kReadAtOnce = 3000;
// Most samples that are read for the visible span.
constexpr std::size_t kMaxExact = 16'000;
// Samples of the first look at a long recording.
constexpr std::size_t kSpread = 1500;
// Most taxels in all these samples together: a sensor with many taxels gets fewer samples.
constexpr std::size_t kMaxLookedAt = 5'000'000;
constexpr int kNewsMs = 200;
constexpr double kForever = 1e12;  // [s]; longer than any recording

std::optional<std::pair<double, double>> extremesOf(const std::vector<double>& values) {
  std::optional<std::pair<double, double>> found;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (!found) found.emplace(value, value);
    found->first = std::min(found->first, value);
    found->second = std::max(found->second, value);
  }
  return found;
}

// As readSeries(); NaN where the recording is damaged.
Series readableSeries(const Profile& profile,
                      const SeriesChoice& choice,
                      double fromS,
                      double toS,
                      const Progress& progress = {}) {
  UnreadableSamples unreadable;
  return readSeries(profile, choice, fromS, toS, progress, &unreadable);
}

// The series of a matrix of a short recording, whose signals are all known already.
Series fromTable(const OpenedRecording& recording, const SeriesChoice& choice) {
  Series series;
  series.timeS = recording.timeS;
  series.values.reserve(series.timeS.size());
  for (std::size_t i = 0; i < series.timeS.size(); ++i)
    series.values.push_back(valueOf(recording.at(i, choice.index), choice.signal));
  return series;
}

}  // namespace

SeriesStore::SeriesStore(QObject* parent) : QObject(parent) {
  passes_.setMaxThreadCount(1);
  reads_.setMaxThreadCount(1);
  passes_.setThreadPriority(QThread::LowPriority);
  news_.setInterval(kNewsMs);
  connect(&news_, &QTimer::timeout, this, [this] {
    const double now = progress();
    const double computing = computing_;
    const bool isNew = now != toldProgress_ || computing != toldComputing_;
    toldProgress_ = now;
    toldComputing_ = computing;
    if (now >= 1.0 && numJobs_ == 0) news_.stop();
    if (isNew) emit changed();
  });
}

SeriesStore::~SeriesStore() {
  if (stop_) *stop_ = true;
  passes_.clear();
  reads_.clear();
  passes_.waitForDone();
  reads_.waitForDone();
}

void SeriesStore::setRecording(const OpenedRecordingPtr& recording) {
  if (stop_) *stop_ = true;
  stop_ = std::make_shared<std::atomic<bool>>(false);
  recording_ = recording;
  profile_ = recording ? std::optional(recording->profile) : std::nullopt;
  entries_.clear();
  firstLook_.reset();
  fromS_ = 0.0;
  toS_ = recording ? recording->durationS() : 0.0;
  if (!recording_ || !recording_->isLong() || recording_->overview->complete()) return;
  // Waits for the first look: both at once would only slow each other down.
  ++numJobs_;
  passes_.start([this, stop = stop_, overview = recording_->overview, looked = lookAtFrames()] {
    looked.wait();
    try {
      overview->compute([&](double) { return !*stop; });
    } catch (const std::exception&) {
      // Cancelled, or no memory is left: what has been read stays. Damage is left out and counted.
    }
    --numJobs_;
    QMetaObject::invokeMethod(this, &SeriesStore::changed, Qt::QueuedConnection);
  });
  toldProgress_ = 0.0;
  news_.start();
}

void SeriesStore::setProfile(const Profile& profile) {
  if (!recording_) return;
  profile_ = profile;
  dropIf([&](const Entry& entry) {
    if (entry.choice.kind == SeriesChoice::Kind::kFormula) return true;
    const auto column = columnOf(recording_->profile, entry.choice);
    return entry.choice.kind == SeriesChoice::Kind::kColumn && !column;
  });
}

template <typename Which>
void SeriesStore::dropIf(const Which& which) {
  std::erase_if(entries_, [&](const Entry& entry) {
    if (!which(entry)) return false;
    *entry.dropped = true;
    return true;
  });
}

// The progress of reading a curve in a worker; computing() tells how far the series that it needs
// are.
Progress SeriesStore::progressOf(const Entry& entry) {
  const bool computes = !isReady(*profile_, entry.choice);
  if (computes) news_.start();
  return [this, computes, stop = stop_, dropped = entry.dropped](double done) {
    if (computes) computing_ = done;
    return !*stop && !*dropped;
  };
}

// Reads all signals of frames spread over the recording, once for all curves.
std::shared_future<void> SeriesStore::lookAtFrames() {
  // A job that never runs destroys its promise, which also ends the waiting.
  auto done = std::make_shared<std::promise<void>>();
  std::shared_future<void> looked = done->get_future().share();
  ++numJobs_;
  reads_.start([this, stop = stop_, profile = recording_->profile, done] {
    auto look = std::make_shared<FirstLook>();
    try {
      const std::size_t frames = profile.numFrames();
      const std::size_t spread =
          std::clamp<std::size_t>(kMaxLookedAt / profile.layout().numCells(), 1, kSpread);
      TactileFrame frame;
      UnreadableSamples unreadable;  // the overview counts them all
      for (std::size_t i = 0; i <= spread && !*stop; ++i) {
        if (!profile.readFrame((frames - 1) * i / spread, frame, &unreadable)) continue;
        look->timeS.push_back(static_cast<double>(frame.hostUs - profile.frameTimeUs(0)) / kUsPerS);
        allSignals(frame, look->rows.emplace_back());
      }
    } catch (const std::exception&) {
      look->rows.resize(look->timeS.size());
    }
    QMetaObject::invokeMethod(
        this,
        [this, stop, look] {
          if (*stop) return;
          firstLook_ = look;
          for (Entry& entry : entries_) takeFirstLook(entry);
          emit changed();
        },
        Qt::QueuedConnection);
    --numJobs_;
    done->set_value();
  });
  return looked;
}

void SeriesStore::takeFirstLook(Entry& entry) const {
  if (!firstLook_ || entry.choice.kind != SeriesChoice::Kind::kMatrix) return;
  auto series = std::make_shared<Series>();
  for (std::size_t i = 0; i < firstLook_->timeS.size(); ++i) {
    if (entry.choice.index >= firstLook_->rows[i].size()) continue;
    series->timeS.push_back(firstLook_->timeS[i]);
    series->values.push_back(valueOf(firstLook_->rows[i][entry.choice.index], entry.choice.signal));
  }
  entry.extremes = extremesOf(series->values);
  entry.sample = std::move(series);
}

SeriesStore::Entry* SeriesStore::find(const SeriesChoice& choice) {
  const auto at = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.choice == choice; });
  return at == entries_.end() ? nullptr : &*at;
}

const SeriesStore::Entry* SeriesStore::find(const SeriesChoice& choice) const {
  return const_cast<SeriesStore*>(this)->find(choice);
}

void SeriesStore::setWanted(const std::vector<SeriesChoice>& wanted) {
  dropIf([&](const Entry& entry) {
    return std::find(wanted.begin(), wanted.end(), entry.choice) == wanted.end();
  });
  if (!recording_) return;
  for (const SeriesChoice& choice : wanted) {
    if (find(choice) || !hasSeries(*profile_, choice)) continue;
    Entry& entry = entries_.emplace_back();
    entry.choice = choice;
    begin(entry);
  }
  askForExact();
}

void SeriesStore::deliver(const SeriesChoice& choice,
                          const Stop& stop,
                          std::function<void(Entry&)> put) {
  QMetaObject::invokeMethod(
      this,
      [this, choice, stop, put = std::move(put)] {
        if (*stop) return;
        if (Entry* entry = find(choice)) {
          put(*entry);
          emit changed();
        }
      },
      Qt::QueuedConnection);
}

void SeriesStore::begin(Entry& entry) {
  if (recording_->isLong()) return beginLong(entry);
  const SeriesChoice& choice = entry.choice;
  const auto keep = [](Entry& to, Series series) {
    to.extremes = extremesOf(series.values);
    to.whole = std::make_shared<const Series>(std::move(series));
  };
  if (choice.kind == SeriesChoice::Kind::kMatrix)
    return keep(entry, fromTable(*recording_, choice));
  // A formula may be slow, and may not be computable: it is read in the background, as is what must
  // be computed.
  if (choice.kind != SeriesChoice::Kind::kFormula && isReady(*profile_, choice) &&
      numSamples(*profile_, choice, -kForever, kForever) <= kReadAtOnce)
    return keep(entry, readableSeries(*profile_, choice, -kForever, kForever));
  ++numJobs_;
  reads_.start([this,
                stop = stop_,
                dropped = entry.dropped,
                choice,
                keep,
                goOn = progressOf(entry),
                profile = *profile_] {
    try {
      auto series =
          std::make_shared<Series>(readableSeries(profile, choice, -kForever, kForever, goOn));
      // The same curve may have been dropped and wanted again, of another profile.
      deliver(choice, stop, [keep, series, dropped](Entry& to) {
        if (to.dropped == dropped) keep(to, std::move(*series));
      });
    } catch (const std::exception&) {
    }
    computing_ = -1.0;
    --numJobs_;
  });
}

void SeriesStore::beginLong(Entry& entry) {
  const SeriesChoice choice = entry.choice;
  const bool ofMatrix = choice.kind == SeriesChoice::Kind::kMatrix;
  if (!ofMatrix) entry.buckets = std::make_shared<BucketSeries>(recording_->durationS(), 1.0);
  const Progress goOn = progressOf(entry);
  takeFirstLook(entry);
  // Of a formula each sample needs its neighbours, so that there is no quick first look; nor is
  // there one of what must be computed.
  if (!ofMatrix && choice.kind != SeriesChoice::Kind::kFormula && isReady(*profile_, choice)) {
    ++numJobs_;
    reads_.start([this, stop = stop_, choice, goOn, profile = *profile_] {
      try {
        UnreadableSamples unreadable;
        auto series =
            std::make_shared<const Series>(readSpread(profile, choice, kSpread, goOn, &unreadable));
        deliver(choice, stop, [series](Entry& to) {
          to.sample = series;
          to.extremes = extremesOf(series->values);
        });
      } catch (const std::exception&) {
      }
      --numJobs_;
    });
  }
  if (ofMatrix) return;
  ++numJobs_;
  passes_.start([this, goOn, choice, buckets = entry.buckets, profile = *profile_] {
    try {
      UnreadableSamples unreadable;
      visitSeries(
          profile,
          choice,
          [&](double timeS, double value) { buckets->add(timeS, value); },
          goOn,
          &unreadable);
      buckets->finish();
    } catch (const Cancelled&) {
    } catch (const std::exception&) {
      buckets->finish();  // a formula that can't be computed: nothing more will come
    }
    computing_ = -1.0;
    --numJobs_;
    QMetaObject::invokeMethod(
        this,
        [this] {
          askForExact();
          emit changed();
        },
        Qt::QueuedConnection);
  });
  news_.start();
}

void SeriesStore::setVisibleRange(double fromS, double toS) {
  fromS_ = fromS;
  toS_ = toS;
  askForExact();
}

// Reads the visible span and as much again on either side, so that small movements need no reading.
void SeriesStore::askForExact() {
  if (!recording_ || !recording_->isLong()) return;
  for (Entry& entry : entries_) {
    if (entry.exactRequested || (entry.exactFromS <= fromS_ && toS_ <= entry.exactToS)) continue;
    if (!isReady(*profile_, entry.choice)) continue;  // asked again when it is computed
    double fromS = fromS_ - (toS_ - fromS_);
    double toS = toS_ + (toS_ - fromS_);
    const auto many = [&] { return numSamples(*profile_, entry.choice, fromS, toS) > kMaxExact; };
    if (many()) {
      fromS = fromS_;
      toS = toS_;
      if (many()) continue;
    }
    entry.exactRequested = true;
    ++numJobs_;
    reads_.start(
        [this,
         stop = stop_,
         dropped = entry.dropped,
         choice = entry.choice,
         fromS,
         toS,
         profile = *profile_] {
          // Where nothing can be read, it has no sample: those of another span would be wrong here.
          auto series = std::make_shared<const Series>();
          try {
            series = std::make_shared<const Series>(
                readableSeries(profile, choice, fromS, toS, [&](double) { return !*stop; }));
          } catch (const std::exception&) {
          }
          deliver(choice, stop, [this, series, dropped, fromS, toS](Entry& to) {
            if (to.dropped != dropped) return;
            to.exactRequested = false;
            to.exactFromS = fromS;
            to.exactToS = toS;
            to.exact = series;
            // The view may have moved meanwhile.
            askForExact();
          });
          --numJobs_;
        },
        1);  // priority above first looks
  }
}

const BucketSeries* SeriesStore::bucketsOf(const Entry& entry) const {
  if (entry.buckets) return entry.buckets.get();
  return &recording_->overview->of(entry.choice.index, entry.choice.signal);
}

// Indices of the samples after which the line is interrupted, because a gap of the recording lies
// between them and the next sample.
std::vector<std::size_t> SeriesStore::breaksIn(const std::vector<double>& timeS) const {
  std::vector<std::size_t> breaks;
  for (const Gap& gap : recording_->timingNow().gaps) {
    const double begin = recording_->timeAt(gap.frame);
    const double end = begin + gap.seconds;
    const auto after = std::upper_bound(timeS.begin(), timeS.end(), begin);
    if (after == timeS.begin() || after == timeS.end() || *after < end - 1e-6) continue;
    breaks.push_back(static_cast<std::size_t>(after - timeS.begin()) - 1);
  }
  return breaks;
}

std::vector<SeriesPoint> SeriesStore::points(const SeriesChoice& choice,
                                             const DecimationOptions& options) const {
  const Entry* entry = find(choice);
  if (!entry) return {};
  const auto thin = [&](const Series& series) {
    const auto breaks = breaksIn(series.timeS);
    DecimationOptions with = options;
    with.breaks = breaks;
    return minMaxDecimated(series.timeS, series.values, with);
  };
  if (entry->whole) return thin(*entry->whole);
  if (!recording_->isLong()) return {};
  if (entry->exact && entry->exactFromS <= options.from && options.to <= entry->exactToS)
    return thin(*entry->exact);
  const BucketSeries* buckets = bucketsOf(*entry);
  auto points = buckets->points(options);
  if (buckets->complete() || !entry->sample) return points;
  // The part that isn't read yet is shown by the samples of the first look.
  const double readyS = buckets->readyS();
  std::erase_if(points, [&](const SeriesPoint& point) { return point.x >= readyS; });
  for (const SeriesPoint& point : thin(*entry->sample))
    if (point.x >= readyS) points.push_back(point);
  return points;
}

std::optional<double> SeriesStore::valueAt(const SeriesChoice& choice, double timeS) const {
  const Entry* entry = find(choice);
  if (!entry || !recording_ || recording_->gapAt(timeS)) return std::nullopt;
  const auto last = [&](const Series& series) -> std::optional<double> {
    const auto after = std::upper_bound(series.timeS.begin(), series.timeS.end(), timeS);
    if (after == series.timeS.begin()) return std::nullopt;
    const double value = series.values[static_cast<std::size_t>(after - series.timeS.begin()) - 1];
    return std::isnan(value) ? std::nullopt : std::optional(value);
  };
  if (entry->whole) return last(*entry->whole);
  if (holds(choice, timeS, timeS)) return last(*entry->exact);
  // It would have to be computed from gap to gap, with the window standing still.
  if (choice.kind == SeriesChoice::Kind::kFormula && Formula(choice.formula).hasFrequencyFilter())
    return std::nullopt;
  if (!isReady(*profile_, choice)) return std::nullopt;
  try {
    const Series one = readableSeries(*profile_, choice, timeS, timeS);
    if (!one.values.empty()) return last(one);
  } catch (const Error&) {
    // A formula of signals that can't be read.
  }
  return std::nullopt;
}

bool SeriesStore::holds(const SeriesChoice& choice, double fromS, double toS) const {
  const Entry* entry = find(choice);
  if (!entry) return false;
  return entry->whole || (entry->exact && entry->exactFromS <= fromS && toS <= entry->exactToS);
}

std::shared_ptr<const Series> SeriesStore::samples(const SeriesChoice& choice) const {
  const Entry* entry = find(choice);
  if (!entry) return nullptr;
  if (entry->whole) return entry->whole;
  return holds(choice, fromS_, toS_) ? entry->exact : nullptr;
}

std::optional<std::pair<double, double>> SeriesStore::extremes(const SeriesChoice& choice) const {
  const Entry* entry = find(choice);
  if (!entry || !recording_->isLong()) return entry ? entry->extremes : std::nullopt;
  auto found = entry->extremes;
  const BucketSeries* buckets = bucketsOf(*entry);
  for (std::size_t i = 0; i < buckets->numReady(); ++i) {
    const auto low = static_cast<double>(buckets->minimum(i));
    const auto high = static_cast<double>(buckets->maximum(i));
    if (std::isnan(low)) continue;
    if (!found) found.emplace(low, high);
    found->first = std::min(found->first, low);
    found->second = std::max(found->second, high);
  }
  return found;
}

double SeriesStore::progress() const {
  if (!recording_ || !recording_->isLong()) return 1.0;
  double least = 1.0;
  for (const Entry& entry : entries_) {
    const BucketSeries* buckets = bucketsOf(entry);
    least = std::min(
        least,
        static_cast<double>(buckets->numReady()) / static_cast<double>(buckets->numBuckets()));
  }
  return least;
}

std::optional<double> SeriesStore::computing() const {
  const double share = computing_;
  return share < 0.0 ? std::nullopt : std::optional(share);
}

void SeriesStore::waitForFirstLook() {
  reads_.waitForDone();
  QCoreApplication::sendPostedEvents(this);
}

void SeriesStore::waitUntilRead() {
  do {
    passes_.waitForDone();
    reads_.waitForDone();
    QCoreApplication::sendPostedEvents(this);
  } while (numJobs_ > 0);
}

}  // namespace palpate::gui
