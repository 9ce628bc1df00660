// Plays a recorded grasp of the emulated hand on the start page: the hand in 3-D beside its heat
// maps. Each picture is painted once, by a background thread; playing only shows them.
#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <memory>

#include "gui/source/background_job.h"

namespace palpate::gui {

class StartScene : public QWidget {
  Q_OBJECT
 public:
  // `recording`: the first grasp of it is played. It is read when this is first shown.
  StartScene(std::filesystem::path recording, QWidget* parent);
  // How many pictures there are so far.
  std::size_t numPictures() const;

 signals:
  void clicked();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  // The pictures that are finished.
  struct Film;

  std::filesystem::path recording_;
  std::shared_ptr<Film> film_;
  BackgroundJob painting_;
  QTimer timer_;
  std::size_t at_ = 0;
};

}  // namespace palpate::gui
