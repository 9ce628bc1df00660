// A slider over the frames of a recording: a click seeks to a frame, a drag follows the mouse.
#pragma once

#include <QSlider>

#include "gui/appearance/theme.h"

namespace palpate::gui {

class SeekBar : public QSlider {
  Q_OBJECT
 public:
  explicit SeekBar(QWidget* parent = nullptr);
  // Convert between a frame and its horizontal position [px].
  double pixelOf(int frame) const;
  int frameAt(double pixel) const;

 signals:
  // Emitted for the mouse only, not while the slider follows the playback.
  void seekRequested(int frame);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void seekTo(double pixel);
};

}  // namespace palpate::gui
