#include "palpate/slip/slip_windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "palpate/core/option_check.h"

namespace palpate {
namespace {

constexpr std::size_t kRing = kWindowFrames.back() + 2;
// Shift of the centroid [taxels] above which a second start value is worth the computing time.
constexpr double kLongWay = 0.5;

std::size_t recentFrames(std::size_t numKept) {
  return std::min(kWindowFrames[kShortWindow], numKept - 1);
}

}  // namespace

void SlipWindowsOptions::validate() const {
  constexpr OptionCheck check{"SlipWindowsOptions"};
  hypotheses.validate();
  check(minActiveTaxels >= 2, "minActiveTaxels", minActiveTaxels);
  check(minCounts >= 0.0, "minCounts", minCounts);
  check(keepUs >= 0, "keepUs", static_cast<double>(keepUs));
}

SlipWindows::SlipWindows(const MatrixLayout& layout, const SlipWindowsOptions& options)
    : layout_(layout),
      options_(options),
      kept_(kRing),
      current_(layout.numCells()),
      key_(layout, {.blurTaxels = 0.0}) {
  options_.validate();
  for (Kept& kept : kept_) kept.values.resize(layout.numCells());
}

void SlipWindows::reset() {
  gaps_.reset();
  numKept_ = 0;
  std::fill(current_.begin(), current_.end(), 0.0F);
  evidence_ = {};
  moments_ = {};
  afterGap_ = false;
}

const SlipWindows::Kept& SlipWindows::back(std::size_t frames) const {
  return kept_[(newest_ + kRing - frames) % kRing];
}

const SlipEvidence& SlipWindows::add(const ConstMatrixMap& frame,
                                     std::int64_t timeUs,
                                     std::span<const double> jointsDeg) {
  if (frame.rows() != layout_.rows || frame.cols() != layout_.columns)
    throw std::invalid_argument("SlipWindows: the frame doesn't have the size of the matrix");
  afterGap_ = gaps_.afterGap(timeUs);
  for (std::size_t i = 0; i < current_.size(); ++i) {
    const float value = frame.data()[i];
    current_[i] = std::isfinite(value) && isTouched(value) ? value : 0.0F;
  }
  moments_ = contactMoments(this->frame());
  const std::size_t ageBefore = evidence_.contactAge;
  evidence_ = {};
  evidence_.computable =
      moments_.active >= options_.minActiveTaxels && moments_.sum > options_.minCounts;
  if (!evidence_.computable || afterGap_) numKept_ = 0;
  if (!evidence_.computable) return evidence_;
  evidence_.contactAge = numKept_ == 0 ? 0 : ageBefore;
  if (numKept_ == 0 || timeUs - keptUs_ >= options_.keepUs) {
    newest_ = (newest_ + 1) % kRing;
    Kept& kept = kept_[newest_];
    kept.values = current_;
    kept.jointsDeg.assign(jointsDeg.begin(), jointsDeg.end());
    kept.moments = moments_;
    keptUs_ = timeUs;
    numKept_ = std::min(numKept_ + 1, kRing);
    ++evidence_.contactAge;
    evidence_.stored = true;
  }
  for (std::size_t i = 0; i < kSlipWindows; ++i)
    if (numKept_ > kWindowFrames[i]) evidence_.windows[i] = compare(kWindowFrames[i], jointsDeg);
  if (numKept_ > 1) {
    evidence_.last = compare(1, jointsDeg);
    evidence_.recent = compare(recentFrames(numKept_), jointsDeg);
  }
  return evidence_;
}

WindowEvidence SlipWindows::compare(std::size_t frames, std::span<const double> jointsDeg) const {
  WindowEvidence window;
  const Kept& then = back(frames);
  window.filled = true;
  window.centroidX = moments_.x - then.moments.x;
  window.centroidY = moments_.y - then.moments.y;
  window.logLoadRatio = std::log(moments_.sum / then.moments.sum);
  const std::size_t joints = std::min(then.jointsDeg.size(), jointsDeg.size());
  for (std::size_t j = 0; j < joints; ++j)
    window.jointsDeg = std::max(window.jointsDeg, std::abs(jointsDeg[j] - then.jointsDeg[j]));
  if (!std::isfinite(window.jointsDeg)) window.jointsDeg = 0.0;
  return window;
}

SlipHypothesisResult SlipWindows::hypothesesAgainst(const Kept& then,
                                                    const WindowEvidence& window) {
  key_.set(ConstMatrixMap(then.values.data(), layout_.rows, layout_.columns));
  const double gain = moments_.sum / then.moments.sum;
  const std::array<RigidMotion, 2> starts = {
      RigidMotion{.dx = window.centroidX, .dy = window.centroidY, .gain = gain}, RigidMotion{}};
  const bool far = std::abs(window.centroidX) + std::abs(window.centroidY) > kLongWay;
  return compareSlipHypotheses(
      key_, frame(), std::span(starts).first(far ? 2 : 1), options_.hypotheses);
}

void SlipWindows::evaluateHypotheses(SlipWindow which) {
  WindowEvidence& window = evidence_.windows.at(which);
  if (!window.filled) return;
  window.hypotheses = hypothesesAgainst(back(kWindowFrames[which]), window);
}

void SlipWindows::evaluateRecent() {
  if (!evidence_.recent.filled) return;
  evidence_.recent.hypotheses = hypothesesAgainst(back(recentFrames(numKept_)), evidence_.recent);
  WindowEvidence& shortWindow = evidence_.windows[kShortWindow];
  if (shortWindow.filled) shortWindow.hypotheses = evidence_.recent.hypotheses;
}

}  // namespace palpate
