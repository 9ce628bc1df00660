// The one frame that is seen, of a recording or live, and whether it is of now.
#pragma once

#include <QObject>
#include <cstddef>
#include <optional>

#include <palpate/live/live_results.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

#include "gui/picture/stale_notice.h"
#include "gui/window_state/active_filters.h"
#include "gui/window_state/displayed_source.h"

namespace palpate::gui {

class CurrentFrame : public QObject {
  Q_OBJECT
 public:
  // All of them must outlive it.
  CurrentFrame(DisplayedSource& displayed,
               ActiveFilters& activeFilters,
               LiveController& live,
               PlaybackController& playback,
               QObject* parent = nullptr);

  // No values: none yet.
  const TactileFrame& frame() const noexcept { return frame_; }
  bool hasFrame() const { return !frame_.values.empty(); }
  // Of a recording, the last ones at or before the frame; nothing: it has none, or they are
  // damaged.
  const std::optional<JointAngles>& angles() const noexcept { return angles_; }
  const std::optional<Temperatures>& temperatures() const noexcept { return temperatures_; }
  // They can't be read: what is known of them is of another frame.
  bool damaged() const noexcept { return damaged_; }
  // Of a recording; 0 else.
  std::size_t index() const { return displayed_.isRecording() ? playback_.frame() : 0; }
  // Taxels at or above saturation, as recorded, whatever the filters make of them.
  std::ptrdiff_t saturated() const;

  // The live picture stands still until it isn't held any more.
  bool held() const noexcept { return held_; }
  void hold(bool on);
  // Why the picture isn't of now: held, nothing comes, damaged. Without a notice it is.
  const StaleNotice& old() const noexcept { return stale_; }

 signals:
  void frameChanged();  // live: before anything is computed of it
  // What was computed of a live frame.
  void resultsReceived(const palpate::LiveResults& results);
  void staleNoticeChanged();
  void heldChanged();
  // Of this source the first one: there is something to be seen now.
  void firstFrameReceived();

 private:
  void begin();
  void showFrame(std::size_t index);
  void takeLive(const TactileFrame& frame);
  void renewLiveNotice();
  void setStale(const StaleNotice& old);

  DisplayedSource& displayed_;
  ActiveFilters& activeFilters_;
  LiveController& live_;
  PlaybackController& playback_;
  TactileFrame frame_;
  std::optional<JointAngles> angles_;
  std::optional<Temperatures> temperatures_;
  bool damaged_ = false;
  bool held_ = false;
  StaleNotice stale_;
};

}  // namespace palpate::gui
