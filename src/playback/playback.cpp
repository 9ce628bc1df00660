#include "palpate/playback/playback.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

Playback::Playback(Profile profile) : Playback(profile, timingOf(profile).gaps) {}

Playback::Playback(Profile profile, std::span<const Gap> gaps) : profile_(std::move(profile)) {
  positionUs_ = firstUs();
  setGaps(gaps);
}

void Playback::setGaps(std::span<const Gap> gaps) {
  gapsUs_.clear();
  for (const Gap& gap : gaps)
    gapsUs_.emplace_back(profile_.frameTimeUs(gap.frame), profile_.frameTimeUs(gap.frame + 1));
}

std::int64_t Playback::firstUs() const {
  return profile_.numFrames() == 0 ? 0 : profile_.frameTimeUs(0);
}

std::int64_t Playback::lastUs() const {
  return profile_.numFrames() == 0 ? 0 : profile_.frameTimeUs(profile_.numFrames() - 1);
}

void Playback::play() {
  if (lastUs() == firstUs()) return;  // nothing to play: at most one frame
  if (positionUs_ >= lastUs()) seekFrame(0);
  playing_ = true;
}

void Playback::setSpeed(double factor) {
  if (!(factor >= kMinimumSpeed && factor <= kMaximumSpeed))
    throw std::invalid_argument("Playback: speed must be 0.1..16, is " + std::to_string(factor));
  speed_ = factor;
}

void Playback::seekFrame(std::size_t frame) {
  if (profile_.numFrames() == 0) return;
  const std::size_t to = std::min(frame, profile_.numFrames() - 1);
  moveTo(profile_.frameTimeUs(to), to);
}

void Playback::seekTime(std::int64_t timeUs) {
  const std::int64_t toUs = std::clamp(timeUs, firstUs(), lastUs());
  moveTo(toUs, profile_.frameAt(toUs).value_or(0));
}

void Playback::moveTo(std::int64_t timeUs, std::size_t frame) {
  positionUs_ = timeUs;
  frame_ = frame;
  remainderUs_ = 0.0;
}

void Playback::step(std::ptrdiff_t frames) {
  pause();
  if (profile_.numFrames() == 0) return;
  const auto last = static_cast<std::ptrdiff_t>(profile_.numFrames()) - 1;
  const auto now = static_cast<std::ptrdiff_t>(frame());
  // Clamped before the addition, to avoid overflow.
  const std::ptrdiff_t to = now + std::clamp(frames, -now, last - now);
  seekFrame(static_cast<std::size_t>(to));
}

void Playback::advance(std::int64_t elapsedUs) {
  if (!playing_ || elapsedUs <= 0) return;
  // The last frame has been shown: start over or stop.
  if (positionUs_ >= lastUs()) {
    if (loop_)
      seekFrame(0);
    else
      playing_ = false;
    return;
  }
  const double moved = static_cast<double>(elapsedUs) * speed_ + remainderUs_;
  const double whole = std::floor(moved);
  std::int64_t toUs = lastUs();
  if (whole < static_cast<double>(lastUs() - positionUs_))
    toUs = positionUs_ + static_cast<std::int64_t>(whole);
  remainderUs_ = moved - whole;
  if (skipGaps_) {
    for (const auto& [begin, end] : gapsUs_)
      if (toUs > begin && toUs < end) toUs = end;
  }
  if (toUs != positionUs_) frame_ = profile_.frameAt(toUs).value_or(0);
  positionUs_ = toUs;
  if (positionUs_ < lastUs()) return;
  remainderUs_ = 0.0;
  playing_ = loop_;
}

}  // namespace palpate
