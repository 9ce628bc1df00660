#include "gui/bench/moment.h"

#include <algorithm>

#include <palpate/core/error.h>

#include "gui/look/captions.h"

namespace palpate::gui {

Moment::Moment(Subject& subject,
               Filtering& filtering,
               LiveController& live,
               PlaybackController& playback,
               QObject* parent)
    : QObject(parent), subject_(subject), filtering_(filtering), live_(live), playback_(playback) {
  connect(&subject_, &Subject::changed, this, &Moment::begin);
  connect(&subject_, &Subject::valuesChanged, this, [this] {
    if (playback_.hasFrames()) showFrame(playback_.frame());
  });
  // Its frames are of other taxels from now on.
  connect(&subject_, &Subject::handChanged, this, [this] { frame_ = TactileFrame(); });
  connect(&playback_, &PlaybackController::frameChanged, this, &Moment::showFrame);
  connect(&live_, &LiveController::frameCame, this, [this](const TactileFrame& frame) {
    if (!filtering_.applied()) takeLive(frame);
  });
  connect(&live_, &LiveController::resultsCame, this, [this](const LiveResults& results) {
    if (!subject_.isLive() || held_) return;
    if (filtering_.applied()) takeLive(*results.frame);
    emit resultsCame(results);
  });
  connect(&live_, &LiveController::staleChanged, this, &Moment::renewLiveNotice);
  connect(&live_, &LiveController::looked, this, [this] {
    if (live_.stale()) renewLiveNotice();
  });
  connect(&live_, &LiveController::leaving, this, [this] {
    if (subject_.isLive()) setOld({"not connected any more"});
  });
}

// Another recording, another source, or nothing.
void Moment::begin() {
  frame_ = TactileFrame();
  angles_.reset();
  temperatures_.reset();
  damaged_ = false;
  hold(false);
  setOld({});
  renewLiveNotice();
}

void Moment::hold(bool on) {
  if (on == held_) return;
  held_ = on;
  emit heldChanged();
  renewLiveNotice();
}

void Moment::showFrame(std::size_t index) {
  const OpenedRecordingPtr& seen = subject_.seen();
  if (!subject_.isRecording() || !seen || index >= seen->profile.numFrames()) return;
  angles_.reset();
  temperatures_.reset();
  QString damage;
  try {
    seen->profile.readFrame(index, frame_);
  } catch (const Error& error) {
    return setOld({error.what()});  // what is seen is of another frame
  }
  try {
    angles_ = seen->profile.anglesAtFrame(index);
    temperatures_ = seen->profile.temperaturesAtFrame(index);
  } catch (const Error& error) {
    damage = error.what();  // a part of it is of another one
  }
  damaged_ = !damage.isEmpty();
  emit frameChanged();
  setOld({damage});
}

void Moment::takeLive(const TactileFrame& frame) {
  if (!subject_.isLive() || held_) return;
  const bool first = !hasFrame();
  frame_ = frame;
  emit frameChanged();
  if (first) emit firstFrameCame();
}

void Moment::renewLiveNotice() {
  if (!subject_.isLive()) return;
  QString notice;
  if (live_.source() && live_.source()->finished()) {
    notice = "the replay has ended";
  } else if (live_.stale()) {
    const PortStatus& port = live_.health().device.tactile;
    notice = !live_.framesCameYet() ? QString("waiting for the first frame")
                                    : "no frame for " + figure(live_.silentS(), 1) + " s";
    if (!port.message.empty()) notice += ": " + QString::fromStdString(withoutPort(port));
  }
  if (held_) notice = notice.isEmpty() ? QString(kHeldText) : kHeldText + ("; " + notice);
  setOld({notice, held_});
}

void Moment::setOld(const OldPicture& old) {
  if (old == old_) return;
  old_ = old;
  emit oldChanged();
}

std::ptrdiff_t Moment::saturated() const {
  const OpenedRecordingPtr recording = subject_.recorded();
  if (!recording) return 0;
  const float saturation = recording->profile.hand().saturationCounts;
  const auto count = [saturation](const TactileFrame& frame) {
    return std::count_if(frame.values.begin(), frame.values.end(), [saturation](float value) {
      return value >= saturation;
    });
  };
  if (subject_.seen() == recording) return count(frame_);
  try {
    return count(recording->profile.frame(playback_.frame()));
  } catch (const Error&) {
    return 0;  // said where the frame would be
  }
}

}  // namespace palpate::gui
