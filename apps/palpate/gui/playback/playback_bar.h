// The bar below the views with the position of the playback: a seek bar, and editable fields for
// frame and time.
#pragma once

#include <QWidget>

#include "gui/appearance/theme.h"
#include "gui/source/playback_controller.h"

class QLabel;

namespace palpate::gui {

class FrameField;
class SecondsField;
class SeekBar;

class PlaybackBar : public QWidget {
  Q_OBJECT
 public:
  // `playback` must outlive this.
  explicit PlaybackBar(PlaybackController& playback, QWidget* parent = nullptr);
  // Moves the keyboard focus to the frame field.
  void editFrame();

 private:
  void takeRecording();
  void showFrame(std::size_t frame);
  void showTime(double seconds);

  PlaybackController& playback_;
  SeekBar* seekBar_;
  FrameField* frame_;
  QLabel* ofFrames_;
  SecondsField* time_;
  QLabel* ofTime_;
};

}  // namespace palpate::gui
