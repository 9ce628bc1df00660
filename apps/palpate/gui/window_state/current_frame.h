// Holds the one frame that all views show, of a recording or live, and whether it is stale.
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
  // All arguments must outlive this object.
  CurrentFrame(DisplayedSource& displayed,
               ActiveFilters& activeFilters,
               LiveController& live,
               PlaybackController& playback,
               QObject* parent = nullptr);

  // A frame without values: there is no frame yet.
  const TactileFrame& frame() const noexcept { return frame_; }
  bool hasFrame() const { return !frame_.values.empty(); }
  // Joint angles and temperatures of a recording: the last ones at or before the frame; nothing
  // when the recording has none or they are damaged.
  const std::optional<Sample>& angles() const noexcept { return angles_; }
  const std::optional<Sample>& temperatures() const noexcept { return temperatures_; }
  // The angles or temperatures at this frame can't be read.
  bool damaged() const noexcept { return damaged_; }
  // Index of the frame in the recording; 0 for a live source.
  std::size_t index() const { return displayed_.isRecording() ? playback_.frame() : 0; }
  // Number of taxels at or above saturation, counted on the recorded values, not on the filtered
  // ones.
  std::ptrdiff_t saturated() const;

  // While held, the live picture doesn't change.
  bool held() const noexcept { return held_; }
  void hold(bool on);
  // Why the picture is stale: held, no frames arrive, damaged. An empty notice: the picture is
  // current.
  const StaleNotice& old() const noexcept { return stale_; }

 signals:
  // For a live frame, comes before anything is computed from it, unless filters are on.
  void frameChanged();
  // What was computed from a live frame.
  void resultsReceived(const palpate::LiveResults& results);
  void staleNoticeChanged();
  void heldChanged();
  // The first frame of this source has arrived.
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
  std::optional<Sample> angles_;
  std::optional<Sample> temperatures_;
  bool damaged_ = false;
  bool held_ = false;
  StaleNotice stale_;
};

}  // namespace palpate::gui
