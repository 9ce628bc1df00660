// Holds what the window shows: a recording, as recorded and as filtered, or the connected hand. All
// members are up to date before the first signal is emitted.
#pragma once

#include <QObject>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include <palpate/model/hand_description.h>

#include "gui/source/live_controller.h"
#include "gui/source/opened_recording.h"
#include "gui/source/playback_controller.h"
#include "gui/source/session.h"
#include "gui/window_state/selection.h"

namespace palpate::gui {

class DisplayedSource : public QObject {
  Q_OBJECT
 public:
  enum class Kind { kNothing, kRecording, kLive };

  // All arguments must outlive this object.
  DisplayedSource(LiveController& live,
                  PlaybackController& playback,
                  Selection& selection,
                  QObject* parent = nullptr);

  Kind kind() const noexcept { return kind_; }
  bool isLive() const noexcept { return kind_ == Kind::kLive; }
  bool isRecording() const noexcept { return kind_ == Kind::kRecording; }
  // The displayed recording as recorded; null unless a recording is shown.
  OpenedRecordingPtr recorded() const { return isRecording() ? unfiltered_ : nullptr; }
  // The displayed recording or, while the view is live, the recording to which the window returns;
  // null: none.
  const OpenedRecordingPtr& unfilteredRecording() const noexcept { return unfiltered_; }
  // unfilteredRecording(), as recorded or filtered.
  const OpenedRecordingPtr& filteredRecording() const noexcept { return filtered_; }
  // The live source while it is shown; null when it isn't, or when it is about to be closed.
  LiveSource* source() const { return isLive() ? live_.source() : nullptr; }
  // The hand of the displayed source; null: nothing is shown.
  const HandDescription* hand() const;
  // Whether its frames, as they are shown, have readings, and so components; of a live hand whether
  // it sends them.
  bool givesReadings() const;
  // Whether a recording with at least one frame is shown.
  bool hasFrames() const;

  // Shows `recording`. With null, shows the live source, or nothing when there is no connection.
  void show(OpenedRecordingPtr recording);
  void showLive();
  // Shows the same recording with other values: filtered, or as recorded.
  void setFilteredRecording(OpenedRecordingPtr seen);
  // To be called when a long recording has been read completely: its range, gaps and findings are
  // known now.
  void notifyMoreKnown();
  // To be called when `recording` was closed (`now` null) or read again as `now`: it isn't shown
  // any more, and until show() is called, nothing is.
  void replace(const OpenedRecordingPtr& recording, const OpenedRecordingPtr& now);

  // The position at which the user left a recording and at which it opens again; null: not shown
  // before.
  const ViewPosition* viewPosition(const std::filesystem::path& path) const;
  void setLeftAt(const std::filesystem::path& path, const ViewPosition& left) {
    leftAt_[path] = left;
  }
  void saveViewPosition();

  // Returns the filtered recording if it exists already, so that it is shown from the start. Empty,
  // or a null result: it is shown as recorded.
  std::function<OpenedRecordingPtr(const OpenedRecordingPtr&)> filtered;

 signals:
  // Another source is shown.
  void changed();
  // filteredRecording() or source() has changed, with or without changed() before: listeners take
  // the new one.
  void filteredRecordingChanged();
  // The recording and the position are the same, but the values are others.
  void valuesChanged();
  // All listeners have taken the new source, and the frame at which the user left it is shown.
  void shown();
  void moreKnown();
  // The connected hand scans other taxels than before, or another hand was found.
  void handChanged();

 private:
  void goBack();
  void look();

  LiveController& live_;
  PlaybackController& playback_;
  Selection& selection_;
  Kind kind_ = Kind::kNothing;
  OpenedRecordingPtr unfiltered_;
  OpenedRecordingPtr filtered_;
  // The hand of the live source.
  std::optional<HandDescription> hand_;
  // Identifies the live source; never dereferenced.
  const SignalHistory* history_ = nullptr;
  std::map<std::filesystem::path, ViewPosition> leftAt_;
};

}  // namespace palpate::gui
