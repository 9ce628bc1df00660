#include "gui/source/playback_controller.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <palpate/core/time.h>

namespace palpate::gui {
namespace {

constexpr int kPlaybackControllerRefreshMs = 16;  // [ms], 60 Hz

}  // namespace

PlaybackController::PlaybackController(const Clock& clock, QObject* parent)
    : QObject(parent), clock_(clock) {
  timer_.setInterval(kPlaybackControllerRefreshMs);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &PlaybackController::tick);
}

void PlaybackController::setProfile(const std::optional<Profile>& profile) {
  take(profile ? std::optional(Playback(*profile)) : std::nullopt);
}

void PlaybackController::setProfile(const Profile& profile, std::span<const Gap> gaps) {
  take(Playback(profile, gaps));
}

void PlaybackController::take(std::optional<Playback> playback) {
  timer_.stop();
  playback_ = std::move(playback);
  shownFrame_.reset();
  if (playback_) {
    playback_->setSpeed(speed_);
    playback_->setLoop(loop_);
    playback_->setSkipGaps(skipGaps_);
    moved();
  }
  emit stateChanged();
}

void PlaybackController::setGaps(std::span<const Gap> gaps) {
  if (playback_) playback_->setGaps(gaps);
}

bool PlaybackController::hasFrames() const { return numFrames() > 0; }

std::size_t PlaybackController::numFrames() const {
  return playback_ ? playback_->profile().numFrames() : 0;
}

std::size_t PlaybackController::frame() const { return hasFrames() ? playback_->frame() : 0; }

double PlaybackController::positionS() const {
  if (!hasFrames()) return 0.0;
  const std::int64_t startUs = playback_->profile().frameTimeUs(0);
  return static_cast<double>(playback_->positionUs() - startUs) / kUsPerS;
}

double PlaybackController::frameTimeS() const {
  if (!hasFrames()) return 0.0;
  const Profile& profile = playback_->profile();
  return static_cast<double>(profile.frameTimeUs(playback_->frame()) - profile.frameTimeUs(0)) /
         kUsPerS;
}

double PlaybackController::durationS() const {
  return playback_ ? static_cast<double>(playback_->profile().durationUs()) / kUsPerS : 0.0;
}

void PlaybackController::play() {
  if (!hasFrames() || playing()) return;
  playback_->play();
  startClock();
  moved();
  emit stateChanged();
}

void PlaybackController::pause() {
  if (!playing()) return;
  playback_->pause();
  timer_.stop();
  emit stateChanged();
}

void PlaybackController::togglePlay() { playing() ? pause() : play(); }

void PlaybackController::startClock() {
  lastTickUs_ = clock_.monotonicUs();
  if (playing()) timer_.start();
}

void PlaybackController::step(std::ptrdiff_t frames) {
  if (!hasFrames()) return;
  pause();
  playback_->step(frames);
  moved();
}

void PlaybackController::seekFrame(std::size_t frame) {
  if (!hasFrames()) return;
  playback_->seekFrame(frame);
  moved();
}

void PlaybackController::seekSeconds(double seconds) {
  if (!hasFrames() || !std::isfinite(seconds)) return;
  const double inside = std::clamp(seconds, 0.0, durationS());
  playback_->seekTime(playback_->profile().frameTimeUs(0) +
                      static_cast<std::int64_t>(std::llround(inside * kUsPerS)));
  moved();
}

void PlaybackController::setSpeed(double factor) {
  if (playback_) {
    // The time until now counts at the old speed.
    tick();
    playback_->setSpeed(factor);
  } else if (!(factor >= Playback::kMinimumSpeed && factor <= Playback::kMaximumSpeed)) {
    throw std::invalid_argument("PlaybackController: speed must be 0.1..16");
  }
  speed_ = factor;
  emit stateChanged();
}

void PlaybackController::faster() {
  const auto* next = std::upper_bound(std::begin(kSpeeds), std::end(kSpeeds), speed_);
  if (next != std::end(kSpeeds)) setSpeed(*next);
}

void PlaybackController::slower() {
  const auto* here = std::lower_bound(std::begin(kSpeeds), std::end(kSpeeds), speed_);
  if (here != std::begin(kSpeeds)) setSpeed(*std::prev(here));
}

void PlaybackController::setLoop(bool on) {
  loop_ = on;
  if (playback_) playback_->setLoop(on);
  emit stateChanged();
}

void PlaybackController::setSkipGaps(bool on) {
  skipGaps_ = on;
  if (playback_) playback_->setSkipGaps(on);
  emit stateChanged();
}

void PlaybackController::tick() {
  if (!playing()) return;
  const std::int64_t nowUs = clock_.monotonicUs();
  playback_->advance(nowUs - lastTickUs_);
  lastTickUs_ = nowUs;
  moved();
  if (playing()) return;
  // The end of the recording is reached.
  timer_.stop();
  emit stateChanged();
}

void PlaybackController::moved() {
  if (!hasFrames()) return;
  const std::size_t now = playback_->frame();
  if (shownFrame_ != now) {
    shownFrame_ = now;
    emit frameChanged(now);
  }
  emit positionChanged(positionS());
}

}  // namespace palpate::gui
