// What is looked at: a recording, as recorded and as seen through the filters, or what is
// connected. All that is known of it is new before anybody hears of it.
#pragma once

#include <QObject>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
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

  // All of them must outlive it.
  DisplayedSource(LiveController& live,
                  PlaybackController& playback,
                  Selection& selection,
                  QObject* parent = nullptr);

  // From now on what is connected is looked at when it comes: once all others that must know of it
  // first listen.
  void follow();

  Kind kind() const noexcept { return kind_; }
  bool isLive() const noexcept { return kind_ == Kind::kLive; }
  bool isRecording() const noexcept { return kind_ == Kind::kRecording; }
  // As recorded; null unless a recording is looked at.
  OpenedRecordingPtr recorded() const { return isRecording() ? unfiltered_ : nullptr; }
  // The recording that is looked at, or that comes back when what is live is left; null: none.
  const OpenedRecordingPtr& unfilteredRecording() const noexcept { return unfiltered_; }
  // unfilteredRecording(), or the same through the filters.
  const OpenedRecordingPtr& filteredRecording() const noexcept { return filtered_; }
  // What is connected, where that is looked at; null: it isn't, or is about to go.
  LiveSource* source() const { return isLive() ? live_.source() : nullptr; }
  // Of what is looked at; null: nothing is.
  const HandDescription* hand() const;
  // There is a frame to be seen.
  bool hasFrames() const;

  // Null: what is connected is looked at, else nothing.
  void show(OpenedRecordingPtr recording);
  void showLive();
  // The same recording, other values: filtered, or as recorded.
  void setFilteredRecording(OpenedRecordingPtr seen);
  // A long recording has been read through: its range, gaps and what is found in it are known now.
  void notifyMoreKnown();
  // Closed, or read anew as `now` (null: closed): it isn't looked at any more. show() follows.
  void replace(const OpenedRecordingPtr& recording, const OpenedRecordingPtr& now);

  // Where a recording was left, and will be found again.
  const ViewPosition* viewPosition(const std::filesystem::path& path) const;
  void setLeftAt(const std::filesystem::path& path, const ViewPosition& left) {
    leftAt_[path] = left;
  }
  void saveViewPosition();

  // Filtered already: what is seen of a recording from the start. Empty, or null: as recorded.
  std::function<OpenedRecordingPtr(const OpenedRecordingPtr&)> filtered;

 signals:
  // What is looked at is another one.
  void changed();
  // So are the values of filteredRecording() or of the source, or they alone: take them.
  void filteredRecordingChanged();
  // Of the same recording the moment that is shown has other values.
  void valuesChanged();
  // All have taken it, and the frame where it was left is shown.
  void shown();
  void moreKnown();
  // Of the connected hand other taxels are scanned, or another hand was found.
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
  std::optional<HandDescription> hand_;     // of what is live
  const SignalHistory* history_ = nullptr;  // of what is live; never looked into
  std::map<std::filesystem::path, ViewPosition> leftAt_;
};

}  // namespace palpate::gui
