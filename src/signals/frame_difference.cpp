#include "palpate/signals/frame_difference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr std::size_t kPairsPerReport = 256;

// Sums of the differences over taxels.
struct Sums {
  double sum = 0.0;
  double squares = 0.0;
  DifferenceStatistics found;

  void add(std::size_t matrix, int y, int x, double difference) {
    sum += difference;
    squares += difference * difference;
    ++found.touched;
    if (std::abs(difference) <= std::abs(found.largest) && found.touched > 1) return;
    found.largest = difference;
    found.matrix = matrix;
    found.y = y;
    found.x = x;
  }
  void add(const Sums& other) {
    if (other.found.touched == 0) return;
    if (found.touched == 0 || std::abs(other.found.largest) > std::abs(found.largest)) {
      const int touched = found.touched;
      found = other.found;
      found.touched = touched;
    }
    sum += other.sum;
    squares += other.squares;
    found.touched += other.found.touched;
  }
  DifferenceStatistics finished() const {
    DifferenceStatistics result = found;
    if (result.touched == 0) return result;
    result.mean = sum / result.touched;
    result.rms = std::sqrt(squares / result.touched);
    return result;
  }
};

}  // namespace

FrameComparison::FrameComparison(std::shared_ptr<const SensorLayout> a,
                                 std::shared_ptr<const SensorLayout> b)
    : a_(std::move(a)), b_(std::move(b)) {
  if (!a_ || !b_) throw std::invalid_argument("FrameComparison: needs two layouts");
  std::vector<MatrixLayout> matrices = a_->matrices();
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    MatrixLayout& matrix = matrices[m];
    const bool same = m < b_->numMatrices() && b_->matrix(m).rows == matrix.rows &&
                      b_->matrix(m).columns == matrix.columns;
    compared_.push_back(same);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x) {
        const bool both = same && a_->matrix(m).enabled(y, x) && b_->matrix(m).enabled(y, x);
        matrix.dynamicMask[static_cast<std::size_t>(y * matrix.columns + x)] = both ? 1 : 0;
      }
  }
  layout_ = std::make_shared<const SensorLayout>(std::move(matrices));
}

bool FrameComparison::allCompared() const {
  return a_->numMatrices() == b_->numMatrices() &&
         std::find(compared_.begin(), compared_.end(), false) == compared_.end();
}

void FrameComparison::check(const TactileFrame& a, const TactileFrame& b) const {
  if (a.values.size() != a_->numCells() || b.values.size() != b_->numCells())
    throw std::invalid_argument("FrameComparison: frames of " + std::to_string(a.values.size()) +
                                " and " + std::to_string(b.values.size()) +
                                " values, the layouts have " + std::to_string(a_->numCells()) +
                                " and " + std::to_string(b_->numCells()));
}

void FrameComparison::difference(const TactileFrame& a,
                                 const TactileFrame& b,
                                 TactileFrame& out) const {
  check(a, b);
  out.layout = layout_;
  out.hostUs = a.hostUs;
  out.deviceUs = a.deviceUs;
  out.values.assign(layout_->numCells(), 0.0F);
  for (std::size_t m = 0; m < layout_->numMatrices(); ++m) {
    if (!compared_[m]) continue;
    const Mask& existing = layout_->matrix(m).staticMask;
    const Mask& scanned = layout_->matrix(m).dynamicMask;
    const float* fromA = a.values.data() + a_->offset(m);
    const float* fromB = b.values.data() + b_->offset(m);
    float* to = out.values.data() + layout_->offset(m);
    for (std::size_t i = 0; i < scanned.size(); ++i)
      if (existing[i] && scanned[i]) to[i] = fromA[i] - fromB[i];
  }
}

TactileFrame FrameComparison::difference(const TactileFrame& a, const TactileFrame& b) const {
  TactileFrame out;
  difference(a, b, out);
  return out;
}

std::vector<DifferenceStatistics> FrameComparison::statistics(const TactileFrame& a,
                                                              const TactileFrame& b) const {
  check(a, b);
  std::vector<DifferenceStatistics> rows;
  Sums whole;
  for (std::size_t m = 0; m < layout_->numMatrices(); ++m) {
    Sums sums;
    const MatrixLayout& matrix = layout_->matrix(m);
    for (int y = 0; y < matrix.rows && compared_[m]; ++y)
      for (int x = 0; x < matrix.columns; ++x) {
        if (!matrix.enabled(y, x)) continue;
        const auto place = static_cast<std::size_t>(y * matrix.columns + x);
        const auto inA = static_cast<double>(a.values[a_->offset(m) + place]);
        const auto inB = static_cast<double>(b.values[b_->offset(m) + place]);
        if (isTouched(inA) || isTouched(inB)) sums.add(m, y, x, inA - inB);
      }
    rows.push_back(sums.finished());
    rows.back().matrix = m;
    whole.add(sums);
  }
  rows.push_back(whole.finished());
  return rows;
}

double FrameComparison::largest(const TactileFrame& a, const TactileFrame& b) const {
  return std::abs(statistics(a, b).back().largest);
}

FramePairs::FramePairs(TimedProfile a, TimedProfile b, double offsetS, std::size_t stride)
    : a_(std::move(a)),
      b_(std::move(b)),
      offsetS_(offsetS),
      stride_(stride),
      numFrames_(commonSpan(a_, b_, offsetS) ? a_.profile.numFrames() : 0) {
  if (stride == 0) throw std::invalid_argument("visitFramePairs: stride must be above 0");
}

bool FramePairs::next(const Progress& progress, UnreadableSamples* unreadable) {
  while (at_ < numFrames_) {
    const std::size_t i = at_;
    if (progress && visited_++ % kPairsPerReport == 0 &&
        !progress(static_cast<double>(i) / static_cast<double>(numFrames_)))
      throw Cancelled();
    at_ += std::min(stride_, numFrames_ - i);
    const double timeS = a_.timeS(i);
    const auto beside = b_.frameAt(timeS - offsetS_);
    if (!beside) continue;
    if (!a_.profile.readFrame(i, inA_, unreadable)) continue;
    if (readB_ != *beside) {
      readB_.reset();
      UnreadableSamples ofB;
      if (!b_.profile.readFrame(*beside, inB_, unreadable ? &ofB : nullptr)) {
        unreadable->add(i, ofB.firstFault.c_str());
        continue;
      }
      readB_ = *beside;
    }
    pair_ = {timeS, i, *beside};
    return true;
  }
  return false;
}

void visitFramePairs(
    const TimedProfile& a,
    const TimedProfile& b,
    double offsetS,
    std::size_t stride,
    const std::function<void(const FramePair&, const TactileFrame&, const TactileFrame&)>& sink,
    const Progress& progress,
    UnreadableSamples* unreadable) {
  FramePairs pairs(a, b, offsetS, stride);
  while (pairs.next(progress, unreadable)) sink(pairs.pair(), pairs.inA(), pairs.inB());
}

}  // namespace palpate
