#include "capture/interval_statistics.h"

#include <algorithm>

#include "palpate/model/gap_detector.h"

namespace palpate {

void IntervalStatistics::add(std::int64_t stampUs) {
  if (frames_++ == 0) {
    firstUs_ = lastUs_ = stampUs;
    return;
  }
  const std::int64_t interval = stampUs - lastUs_;
  lastUs_ = stampUs;
  if (interval >= kPage * kPages) {
    if (longOnes_.size() < kMaxLongIntervals) longOnes_.push_back(interval);
    return;
  }
  auto& page = pages_.at(static_cast<std::size_t>(interval / kPage));
  if (!page) page = std::make_unique<Page>();
  ++page->at(static_cast<std::size_t>(interval % kPage));
}

double IntervalStatistics::durationS() const noexcept {
  return static_cast<double>(lastUs_ - firstUs_) / 1e6;
}

double IntervalStatistics::meanRateHz() const noexcept {
  return frames_ < 2 ? 0.0 : static_cast<double>(frames_ - 1) / durationS();
}

double IntervalStatistics::rateHz() const noexcept {
  if (frames_ < 2) return 0.0;
  const double median = medianUs();
  const double between = static_cast<double>(lastUs_ - firstUs_) - 1e6 * gapsS();
  const double mean =
      between / static_cast<double>(std::max<std::int64_t>(frames_ - 1 - gaps(), 1));
  return 1e6 / (isInBursts(median, mean) ? mean : median);
}

std::int64_t IntervalStatistics::gaps() const noexcept {
  if (frames_ < 2) return 0;
  const double gapUs = gapThresholdUs(medianUs());
  return std::count_if(longOnes_.begin(), longOnes_.end(), [gapUs](std::int64_t interval) {
    return static_cast<double>(interval) > gapUs;
  });
}

double IntervalStatistics::gapsS() const noexcept {
  if (frames_ < 2) return 0.0;
  const double gapUs = gapThresholdUs(medianUs());
  double sumUs = 0.0;
  for (const std::int64_t interval : longOnes_)
    if (static_cast<double>(interval) > gapUs) sumUs += static_cast<double>(interval);
  return sumUs / 1e6;
}

double IntervalStatistics::medianUs() const noexcept {
  const std::int64_t intervals = frames_ - 1;
  const auto upper = static_cast<double>(intervalAt(intervals / 2));
  if (intervals % 2 == 1) return upper;
  return 0.5 * (static_cast<double>(intervalAt(intervals / 2 - 1)) + upper);
}

std::int64_t IntervalStatistics::intervalAt(std::int64_t rank) const noexcept {
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    if (!pages_[p]) continue;
    for (std::size_t i = 0; i < pages_[p]->size(); ++i) {
      rank -= (*pages_[p])[i];
      if (rank < 0) return static_cast<std::int64_t>(p) * kPage + static_cast<std::int64_t>(i);
    }
  }
  if (longOnes_.empty()) return 0;
  std::vector<std::int64_t> sorted = longOnes_;
  const auto at = std::min<std::size_t>(static_cast<std::size_t>(rank), sorted.size() - 1);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(at), sorted.end());
  return sorted[at];
}

}  // namespace palpate
