// Where the playback stands: a seek bar, and frame and time as fields that can be typed in.
#pragma once

#include <QWidget>

#include "gui/playback_controller.h"
#include "gui/theme.h"

class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace palpate::gui {

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

  PlaybackController& playback_;
  SeekBar* seekBar_;
  QSpinBox* frame_;
  QLabel* ofFrames_;
  QDoubleSpinBox* time_;
  QLabel* ofTime_;
};

}  // namespace palpate::gui
