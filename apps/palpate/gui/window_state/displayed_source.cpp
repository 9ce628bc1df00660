#include "gui/window_state/displayed_source.h"

#include <algorithm>
#include <utility>

namespace palpate::gui {

DisplayedSource::DisplayedSource(LiveController& live,
                                 PlaybackController& playback,
                                 Selection& selection,
                                 QObject* parent)
    : QObject(parent), live_(live), playback_(playback), selection_(selection) {
  connect(&live_, &LiveController::leaving, this, [this] { history_ = nullptr; });
  connect(&live_, &LiveController::sourceReady, this, &DisplayedSource::showLive);
  connect(&live_, &LiveController::refreshed, this, &DisplayedSource::look);
  connect(&live_, &LiveController::ended, this, [this] {
    if (isLive() && live_.state() == LiveController::State::kNone) show(unfiltered_);
  });
}

const HandDescription* DisplayedSource::hand() const {
  if (isLive()) return hand_ ? &*hand_ : nullptr;
  return unfiltered_ ? &unfiltered_->profile.hand() : nullptr;
}

bool DisplayedSource::givesReadings() const {
  if (isLive()) return hand_ && hand_->layout->decidesTouch();
  return filtered_ && filtered_->profile.givesReadings();
}

bool DisplayedSource::hasFrames() const { return isRecording() && playback_.hasFrames(); }

void DisplayedSource::show(OpenedRecordingPtr recording) {
  if (recording && isRecording() && recording == unfiltered_) return;
  if (!recording && live_.source()) {
    unfiltered_ = filtered_ = nullptr;
    playback_.setProfile(std::nullopt);
    // Makes showLive() announce the source again.
    if (isLive()) history_ = nullptr;
    return showLive();
  }
  saveViewPosition();
  // May throw: nothing has changed yet.
  OpenedRecordingPtr made = recording && filtered ? filtered(recording) : nullptr;
  // Without a profile, no listener can ask for a frame of the old recording before all have the new
  // one.
  playback_.setProfile(std::nullopt);
  unfiltered_ = recording;
  filtered_ = made ? std::move(made) : recording;
  kind_ = recording ? Kind::kRecording : Kind::kNothing;
  hand_.reset();
  history_ = nullptr;
  const bool frames = recording && recording->profile.numFrames() > 0;
  selection_.begin(frames ? std::max(recording->durationS(), Selection::kShortestS) : 0.0);
  emit changed();
  emit filteredRecordingChanged();
  if (recording) {
    playback_.setProfile(recording->profile, recording->timingNow().gaps);
    goBack();
  }
  emit shown();
}

void DisplayedSource::showLive() {
  LiveSource* source = live_.source();
  if (!source || (isLive() && source->history.get() == history_)) return;
  playback_.pause();
  saveViewPosition();
  kind_ = Kind::kLive;
  history_ = source->history.get();
  hand_ = source->session->device().hand();
  emit changed();
  emit filteredRecordingChanged();
  emit shown();
}

void DisplayedSource::setFilteredRecording(OpenedRecordingPtr seen) {
  if (!isRecording() || seen == filtered_) return;
  saveViewPosition();
  filtered_ = seen;
  emit filteredRecordingChanged();
  goBack();
  emit valuesChanged();
  emit shown();
}

void DisplayedSource::notifyMoreKnown() {
  if (!isRecording()) return;
  playback_.setGaps(unfiltered_->timingNow().gaps);
  emit moreKnown();
}

void DisplayedSource::replace(const OpenedRecordingPtr& recording, const OpenedRecordingPtr& now) {
  leftAt_.erase(recording->path);
  if (unfiltered_ != recording) return;
  unfiltered_ = filtered_ = isLive() ? now : nullptr;
  if (isRecording()) kind_ = Kind::kNothing;
}

// Called four times a second.
void DisplayedSource::look() {
  LiveSource* now = source();
  if (!now || !hand_) return;
  const HandDescription hand = now->session->device().hand();
  if (*hand.layout == *hand_->layout) return;
  hand_ = hand;
  emit handChanged();
}

const ViewPosition* DisplayedSource::viewPosition(const std::filesystem::path& path) const {
  const auto left = leftAt_.find(path);
  return left == leftAt_.end() ? nullptr : &left->second;
}

void DisplayedSource::saveViewPosition() {
  if (!isRecording() || !unfiltered_) return;
  constexpr double kWhole = 0.9999;
  ViewPosition& left = leftAt_[unfiltered_->path];
  left.frame = playback_.frame();
  const TimeSpan& seen = selection_.visibleSpan();
  const bool whole = seen.toS - seen.fromS > selection_.durationS() * kWhole;
  left.seen = whole ? std::nullopt : std::optional(seen);
  left.selection = selection_.span();
}

void DisplayedSource::goBack() {
  const auto left = leftAt_.find(unfiltered_->path);
  if (left == leftAt_.end()) return;
  const ViewPosition at = left->second;
  playback_.seekFrame(at.frame);
  if (at.seen) selection_.show(*at.seen);
  selection_.setSpan(at.selection);
}

}  // namespace palpate::gui
