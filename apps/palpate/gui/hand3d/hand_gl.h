// Draws a hand in 3-D with OpenGL 3.3 (core profile) into the bound framebuffer. The picture is
// that of hand_raster.h, except for how drivers draw edges.
#pragma once

#include <QSizeF>
#include <QString>
#include <memory>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

// Every function needs the same current context, except the constructor, and the destructor after
// release() or a failed initialize().
class HandGl {
 public:
  HandGl();
  ~HandGl();
  HandGl(const HandGl&) = delete;
  HandGl& operator=(const HandGl&) = delete;

  // Returns an empty text when drawing is possible; else the reason: no context, too old, a shader
  // that the driver rejects. May be called again, also in another context if release() was called
  // in the previous one.
  QString initialize();
  bool canDraw() const { return gl_ != nullptr; }
  // Draws the scene without its labels over the first size * pixelRatio pixels (rounded) of the
  // framebuffer. Triangles with a vertex that isn't a number are left out. Leaves the context as Qt
  // expects it (no buffer, no program, no depth test). Does nothing when canDraw() is false.
  void draw(const HandScene& scene,
            const HandCamera& camera,
            const QSizeF& size,
            double pixelRatio = 1.0);
  // Frees all resources in the context. May be called at any time, also twice.
  void release();

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

}  // namespace palpate::gui
