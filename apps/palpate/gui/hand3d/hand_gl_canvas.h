// Where a view of the hand is drawn with OpenGL. Only draws: what, and what the mouse means, is its
// owner's affair.
#pragma once

#include <QOpenGLWidget>
#include <functional>

#include "gui/hand3d/hand_gl.h"
#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

class HandGlCanvas : public QOpenGLWidget {
  Q_OBJECT
 public:
  explicit HandGlCanvas(QWidget* parent = nullptr);
  ~HandGlCanvas() override;

  // Asked for whenever it is drawn.
  std::function<const HandScene&()> scene;
  std::function<const HandCamera&()> camera;
  std::function<void(QPainter&)> paintOver;

 signals:
  // OpenGL said no; sent once, after the painting that found it out.
  void failed(const QString& why);

 protected:
  void initializeGL() override;
  void paintGL() override;

 private:
  void fail(const QString& why);

  HandGl gl_;
  bool failed_ = false;
};

}  // namespace palpate::gui
