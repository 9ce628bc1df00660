// The widget on which HandView draws with OpenGL. It only draws; its owner supplies the scene and
// handles the mouse.
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

  // Called whenever the widget is drawn.
  std::function<const HandScene&()> scene;
  std::function<const HandCamera&()> camera;
  std::function<void(QPainter&)> paintOver;

 signals:
  // OpenGL can't be used; emitted once, after the paint event that found it out.
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
