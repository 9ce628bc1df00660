// Draws a hand in space with OpenGL 3.3 (core profile) into whatever framebuffer is bound. The same
// picture as hand_raster.h, but for what drivers make of edges.
#pragma once

#include <QSizeF>
#include <QString>
#include <memory>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

// Every function needs the same current context, but for the constructor, and for the destructor
// once release() was called or initialize() said no.
class HandGl {
 public:
  HandGl();
  ~HandGl();
  HandGl(const HandGl&) = delete;
  HandGl& operator=(const HandGl&) = delete;

  // Empty when it can draw now; else why it can't: no context, too old, a shader that the driver
  // doesn't take. May be called again, in another context as well when release() was called in the
  // one before.
  QString initialize();
  bool canDraw() const { return gl_ != nullptr; }
  // The scene without its labels, over all of the framebuffer's first size * pixelRatio pixels
  // (rounded). Triangles with a vertex that isn't a number are left out. Leaves the context as Qt
  // expects it (no buffer, no program, no depth test). Nothing happens when it can't draw.
  void draw(const HandScene& scene,
            const HandCamera& camera,
            const QSizeF& size,
            double pixelRatio = 1.0);
  // Gives back what it has in the context. May be called at any time, also twice.
  void release();

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

}  // namespace palpate::gui
