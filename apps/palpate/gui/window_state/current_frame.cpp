#include "gui/window_state/current_frame.h"

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

// A device says how long it heard nothing when it noticed that: "no frames for 0.5 s; check power".
// The notice has a duration of its own, which goes on.
QString withoutDuration(const QString& why) {
  constexpr const char* kDuration = "no frames for ";
  if (!why.startsWith(kDuration)) return why;
  return why.contains("; ") ? why.section("; ", 1) : QString();
}

}  // namespace

CurrentFrame::CurrentFrame(DisplayedSource& displayed,
                           ActiveFilters& activeFilters,
                           LiveController& live,
                           PlaybackController& playback,
                           QObject* parent)
    : QObject(parent),
      displayed_(displayed),
      activeFilters_(activeFilters),
      live_(live),
      playback_(playback) {
  connect(&displayed_, &DisplayedSource::changed, this, &CurrentFrame::begin);
  connect(&displayed_, &DisplayedSource::valuesChanged, this, [this] {
    if (playback_.hasFrames()) showFrame(playback_.frame());
  });
  // The frames that follow have other taxels.
  connect(&displayed_, &DisplayedSource::handChanged, this, [this] { frame_ = TactileFrame(); });
  connect(&playback_, &PlaybackController::frameChanged, this, &CurrentFrame::showFrame);
  connect(&live_, &LiveController::frameReceived, this, [this](const TactileFrame& frame) {
    if (!activeFilters_.applied()) takeLive(frame);
  });
  connect(&live_, &LiveController::resultsReceived, this, [this](const LiveResults& results) {
    if (!displayed_.isLive() || held_) return;
    if (activeFilters_.applied()) takeLive(*results.frame);
    emit resultsReceived(results);
  });
  connect(&live_, &LiveController::staleChanged, this, &CurrentFrame::renewLiveNotice);
  connect(&live_, &LiveController::refreshed, this, [this] {
    if (live_.stale()) renewLiveNotice();
  });
  connect(&live_, &LiveController::leaving, this, [this] {
    if (displayed_.isLive()) setStale({"not connected any more"});
  });
}

// Starts anew after the source changed to another recording, another connection or nothing.
void CurrentFrame::begin() {
  frame_ = TactileFrame();
  angles_.reset();
  temperatures_.reset();
  damaged_ = false;
  hold(false);
  setStale({});
  renewLiveNotice();
}

void CurrentFrame::hold(bool on) {
  if (on == held_) return;
  held_ = on;
  emit heldChanged();
  renewLiveNotice();
}

void CurrentFrame::showFrame(std::size_t index) {
  const OpenedRecordingPtr& seen = displayed_.filteredRecording();
  if (!displayed_.isRecording() || !seen || index >= seen->profile.numFrames()) return;
  angles_.reset();
  temperatures_.reset();
  QString damage;
  try {
    seen->profile.readFrame(index, frame_);
  } catch (const Error& error) {
    // The frame can't be read: the views still show the previous one.
    return setStale({inWindowWords(QString::fromUtf8(error.what()))});
  }
  try {
    angles_ = seen->profile.anglesAtFrame(index);
    temperatures_ = seen->profile.temperaturesAtFrame(index);
  } catch (const Error& error) {
    // The frame was read, but angles or temperatures can't be.
    damage = inWindowWords(QString::fromUtf8(error.what()));
  }
  damaged_ = !damage.isEmpty();
  emit frameChanged();
  setStale({damage});
}

void CurrentFrame::takeLive(const TactileFrame& frame) {
  if (!displayed_.isLive() || held_) return;
  const bool first = !hasFrame();
  frame_ = frame;
  emit frameChanged();
  if (first) emit firstFrameReceived();
}

void CurrentFrame::renewLiveNotice() {
  if (!displayed_.isLive()) return;
  QString notice;
  if (live_.source() && live_.source()->finished()) {
    notice = "the replay has ended";
  } else if (live_.stale()) {
    const PortStatus& port = live_.health().device.tactile;
    notice = !live_.hasReceivedFrames() ? QString("waiting for the first frame")
                                        : "no frame for " + figure(live_.silentS(), 1) + " s";
    const QString why = withoutDuration(QString::fromStdString(withoutPort(port)));
    // Once there were frames, the alarm above the views says why.
    if (!why.isEmpty() && !live_.hasReceivedFrames()) notice += ": " + why;
  }
  if (held_) notice = notice.isEmpty() ? QString(kHeldText) : kHeldText + ("; " + notice);
  setStale({notice, held_});
}

void CurrentFrame::setStale(const StaleNotice& old) {
  if (old == stale_) return;
  stale_ = old;
  emit staleNoticeChanged();
}

std::ptrdiff_t CurrentFrame::saturated() const {
  const OpenedRecordingPtr recording = displayed_.recorded();
  if (!recording) return 0;
  const auto count = [&hand = recording->profile.hand()](const TactileFrame& frame) {
    return static_cast<std::ptrdiff_t>(numSaturated(hand, frame));
  };
  if (displayed_.filteredRecording() == recording) return count(frame_);
  try {
    return count(recording->profile.frame(playback_.frame()));
  } catch (const Error&) {
    // showFrame() reports the failure to read.
    return 0;
  }
}

}  // namespace palpate::gui
