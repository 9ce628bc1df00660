// Draws a hand in 3-D without OpenGL: where OpenGL isn't available (--no-gl, no driver), for
// exported pictures of any size, and for pictures that tests compare. The same scene gives the same
// pixels on every machine.
#pragma once

#include <QImage>
#include <QSizeF>
#include <memory>

#include <palpate/core/progress.h>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

// Samples per pixel; more of them give smoother edges and take more time (4 to 1).
enum class RasterQuality {
  // 4, at the places of a graphics card with fourfold multisampling.
  kScreen,
  // 16.
  kPicture,
};

// Not thread-safe, but several objects may draw at the same time.
class HandRaster {
 public:
  HandRaster();
  ~HandRaster();
  HandRaster(const HandRaster&) = delete;
  HandRaster& operator=(const HandRaster&) = delete;

  // Draws the scene without its labels: opaque, Format_RGB32, size * pixelRatio pixels (rounded, at
  // least 1), with that device pixel ratio. Triangles with a vertex that isn't a number are left
  // out. Returns a null image for an empty size or when there is not enough memory. Throws
  // Cancelled when `progress` asks for it. The image is valid until the next call. In pictures for
  // the screen only the tiles whose triangles differ from the last picture's are drawn anew; the
  // pixels are the same as without that.
  const QImage& draw(const HandScene& scene,
                     const HandCamera& camera,
                     const QSizeF& size,
                     double pixelRatio = 1.0,
                     RasterQuality quality = RasterQuality::kScreen,
                     const Progress& progress = {});
  // Number of tiles that the last draw() drew.
  std::size_t numTilesDrawn() const noexcept;

 private:
  struct Work;
  // Buffers, reused from one picture to the next.
  std::unique_ptr<Work> work_;
};

// The same for a single picture. May be called in any thread.
QImage rasterize(const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size,
                 double pixelRatio = 1.0,
                 RasterQuality quality = RasterQuality::kPicture,
                 const Progress& progress = {});

}  // namespace palpate::gui
