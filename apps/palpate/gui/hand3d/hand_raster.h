// Draws a hand in space without OpenGL: where there is none (--no-gl, no driver), for pictures of
// any size and for pictures that are compared. The same scene gives the same pixels, whatever the
// machine.
#pragma once

#include <QImage>
#include <QSizeF>
#include <memory>

#include <palpate/core/progress.h>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

// Samples per pixel: what an edge looks like, and the time it takes (4 to 1).
enum class RasterQuality {
  kScreen,   // 4, where a graphics card with fourfold multisampling has them
  kPicture,  // 16
};

// Not thread-safe; several of them may draw at once.
class HandRaster {
 public:
  HandRaster();
  ~HandRaster();
  HandRaster(const HandRaster&) = delete;
  HandRaster& operator=(const HandRaster&) = delete;

  // The scene without its labels, opaque, Format_RGB32, of size * pixelRatio pixels (rounded, at
  // least 1) and with that device pixel ratio. Triangles with a vertex that isn't a number are left
  // out. A null image: no size, or no memory for it. Throws Cancelled when `progress` says so; else
  // valid until the next draw.
  const QImage& draw(const HandScene& scene,
                     const HandCamera& camera,
                     const QSizeF& size,
                     double pixelRatio = 1.0,
                     RasterQuality quality = RasterQuality::kScreen,
                     const Progress& progress = {});

 private:
  struct Work;
  std::unique_ptr<Work> work_;  // buffers, kept from one picture to the next
};

// The same for one picture. May be called in any thread.
QImage rasterize(const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size,
                 double pixelRatio = 1.0,
                 RasterQuality quality = RasterQuality::kPicture,
                 const Progress& progress = {});

}  // namespace palpate::gui
