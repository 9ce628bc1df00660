// Converts the triangles of a scene into triangles in pixels: projects, lights and clips them.
// Private to hand_raster.cpp.
#pragma once

#include <QSize>
#include <QSizeF>
#include <vector>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"
#include "gui/hand3d/hand_tile.h"

namespace palpate::gui {

// Triangles in the order in which they are drawn.
struct RasterList {
  std::vector<RasterTriangle> triangles;
  std::vector<RasterShade> shades;
};

class RasterSetup {
 public:
  // Replaces the content of `list`. The picture has the size `size` on `pixels` pixels.
  void fill(const HandScene& scene,
            const HandCamera& camera,
            const QSizeF& size,
            const QSize& pixels,
            RasterList& list);

 private:
  struct Corner {
    Float4 clip{};
    Float4 bgra{};
  };
  struct OnScreen;
  enum class Side { kFront, kBack, kBoth };

  void addTriangles(const std::vector<SceneVertex>& vertices, Side side, Paint paint);
  void addLinesAndPoints();
  // `flat`: all three corners have one colour, so there is no shade.
  void addWhole(const std::array<Corner, 3>& corners, bool flat, Side side, Paint paint);
  void cutAndAdd(const std::array<Corner, 3>& corners, bool flat, Side side, Paint paint);
  void addOnScreen(
      const Corner& a, const Corner& b, const Corner& c, bool flat, Side side, Paint paint);
  OnScreen onScreen(const Corner& corner) const;

  RasterList* list_ = nullptr;
  // Columns of the matrix.
  std::array<Float4, 4> clipFromBase_{};
  Eigen::Matrix3f eyeFromBase_;
  float width_ = 0.0F, height_ = 0.0F;  // [pixels]
  std::vector<ClipVertex> flatTriangles_;
  std::vector<Corner> polygon_, cut_;
};

}  // namespace palpate::gui
