#include "palpate/signals/signal_overview.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr std::size_t kSignalOverviewPlacesPerReport = 250'000;  // takes some milliseconds
// Limit for the buckets of all series together: the 49 series of an SDH-2 with one bucket per
// second take 64 MB for 47 hours. Longer recordings, and sensors with more matrices, have longer
// buckets.
constexpr double kMaxBucketsOfAll = 8'388'608.0;

}  // namespace

SignalOverview::SignalOverview(const Profile& profile, double bucketS)
    : profile_(profile),
      numRows_(profile.layout().numMatrices() + 1),
      kinds_(signalKinds(profile.givesReadings())) {
  if (profile.numFrames() == 0)
    throw std::invalid_argument("SignalOverview: the profile has no frames");
  const double durationS = static_cast<double>(profile.durationUs()) / kUsPerS;
  const std::size_t count = numRows_ * kinds_.size();
  if (!(bucketS > 0.0))
    throw std::invalid_argument("SignalOverview: buckets of " + std::to_string(bucketS) + " s");
  const double most = kMaxBucketsOfAll / static_cast<double>(count);
  const double lengthS = std::max(bucketS, durationS / most);
  for (std::size_t i = 0; i < count; ++i)
    series_.push_back(std::make_unique<BucketSeries>(durationS, lengthS));
}

void SignalOverview::compute(const Progress& progress) {
  const std::size_t frames = profile_.numFrames();
  const std::size_t framesPerReport =
      std::max<std::size_t>(1, kSignalOverviewPlacesPerReport / profile_.layout().numCells());
  std::vector<std::int64_t> stampsUs;
  stampsUs.reserve(frames);
  std::vector<CharacteristicSignals> rows;
  TactileFrame frame;
  for (std::size_t i = 0; i < frames; ++i) {
    reportProgress(progress, i, frames, framesPerReport);
    const bool readable = profile_.readFrame(i, frame, &unreadable_);
    stampsUs.push_back(frame.hostUs);
    if (!readable) continue;
    const double timeS = static_cast<double>(frame.hostUs - stampsUs.front()) / kUsPerS;
    allSignals(frame, rows);
    auto series = series_.begin();
    for (const CharacteristicSignals& row : rows)
      for (const SignalKind kind : kinds_) (*series++)->add(timeS, valueOf(row, kind));
    maximum_ = std::max(maximum_, rows.back().maximum);
    if (isSaturated(rows, profile_.hand())) ++saturatedFrames_;
  }
  timing_ = timingOf(stampsUs);
  // The first series is finished last, since complete() looks at it.
  for (auto series = series_.rbegin(); series != series_.rend(); ++series) (*series)->finish();
}

const BucketSeries& SignalOverview::of(std::size_t row, SignalKind kind) const {
  if (row >= numRows_) throw std::out_of_range("SignalOverview: no row " + std::to_string(row));
  if (static_cast<std::size_t>(kind) >= kinds_.size())
    throw std::out_of_range("SignalOverview: no signal " + std::string(signalName(kind)));
  return *series_[row * kinds_.size() + static_cast<std::size_t>(kind)];
}

}  // namespace palpate
