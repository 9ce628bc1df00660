// Where the playback stands: a seek bar, and frame and time as fields that can be typed in.
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
  void setTheme(Theme theme);
  // Puts the keyboard into the frame field.
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
