#include "palpate/signals/bucket_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr double kMaxBuckets = 1e8;
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

}  // namespace

BucketSeries::BucketSeries(double durationS, double bucketS) : bucketS_(bucketS) {
  if (!(durationS >= 0.0) || !(bucketS > 0.0) || !(durationS / bucketS < kMaxBuckets))
    throw std::invalid_argument("BucketSeries: " + std::to_string(durationS) + " s in buckets of " +
                                std::to_string(bucketS) + " s");
  const auto count = static_cast<std::size_t>(durationS / bucketS) + 1;
  minimum_.assign(count, kNothing);
  maximum_.assign(count, kNothing);
}

void BucketSeries::add(double timeS, double value) {
  if (!(timeS >= 0.0) || std::isnan(value)) return;
  const double at = timeS / bucketS_;
  if (!(at < static_cast<double>(minimum_.size()))) return;
  const auto bucket = static_cast<std::size_t>(at);
  if (bucket < current_) return;
  if (bucket > current_) {
    current_ = bucket;
    ready_.store(bucket, std::memory_order_release);
  }
  const auto number = static_cast<float>(value);
  if (!(minimum_[bucket] <= number)) minimum_[bucket] = number;
  if (!(maximum_[bucket] >= number)) maximum_[bucket] = number;
}

void BucketSeries::finish() {
  current_ = minimum_.size();
  ready_.store(minimum_.size(), std::memory_order_release);
}

void BucketSeries::check(std::size_t bucket) const {
  if (bucket >= numReady())
    throw std::out_of_range("BucketSeries: bucket " + std::to_string(bucket) + " of " +
                            std::to_string(numReady()) + " ready");
}

float BucketSeries::minimum(std::size_t bucket) const {
  check(bucket);
  return minimum_[bucket];
}

float BucketSeries::maximum(std::size_t bucket) const {
  check(bucket);
  return maximum_[bucket];
}

std::vector<SeriesPoint> BucketSeries::points(const DecimationOptions& options) const {
  options.validate();
  std::vector<SeriesPoint> out;
  const std::size_t ready = numReady();
  if (ready == 0) return out;
  const auto bucketAt = [&](double timeS) {
    return static_cast<std::size_t>(
        std::clamp(timeS / bucketS_, 0.0, static_cast<double>(ready - 1)));
  };
  const std::size_t first = bucketAt(options.from - bucketS_);
  const std::size_t last = bucketAt(options.to + bucketS_);
  const double seen = (options.to - options.from) / bucketS_;
  const auto together = static_cast<std::size_t>(
      std::max(1.0, std::floor(seen / static_cast<double>(options.columns))));
  // Groups of buckets have fixed limits, so that the picture does not flicker while it is dragged.
  for (std::size_t begin = first - first % together; begin <= last; begin += together) {
    const std::size_t end = std::min(begin + together, ready);
    float low = kNothing;
    float high = kNothing;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(low <= minimum_[i])) low = std::isnan(minimum_[i]) ? low : minimum_[i];
      if (!(high >= maximum_[i])) high = std::isnan(maximum_[i]) ? high : maximum_[i];
    }
    const double middle = 0.5 * static_cast<double>(begin + end) * bucketS_;
    if (std::isnan(low)) {
      if (!out.empty() && !std::isnan(out.back().y))
        out.push_back({middle, std::numeric_limits<double>::quiet_NaN()});
      continue;
    }
    // The extreme that is nearer to the previous point comes first.
    const bool up = out.empty() || std::isnan(out.back().y) ||
                    std::abs(out.back().y - static_cast<double>(low)) <=
                        std::abs(out.back().y - static_cast<double>(high));
    out.push_back({middle, static_cast<double>(up ? low : high)});
    if (low != high) out.push_back({middle, static_cast<double>(up ? high : low)});
  }
  return out;
}

}  // namespace palpate
