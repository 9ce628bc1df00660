// From the triangles of a scene to triangles in pixels: projected, lit, cut at the edges of what is
// seen. Private to hand_raster.cpp.
#pragma once

#include <QSize>
#include <QSizeF>
#include <vector>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_scene.h"
#include "gui/hand3d/hand_tile.h"

namespace palpate::gui {

// In the order they are drawn in.
struct RasterList {
  std::vector<RasterTriangle> triangles;
  std::vector<RasterShade> shades;
};

class RasterSetup {
 public:
  // Replaces what is in `list`. The picture is `size`, on so many pixels.
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
  // All three corners of one colour: no shade.
  void addWhole(const std::array<Corner, 3>& corners, bool flat, Side side, Paint paint);
  void cutAndAdd(const std::array<Corner, 3>& corners, bool flat, Side side, Paint paint);
  void addOnScreen(
      const Corner& a, const Corner& b, const Corner& c, bool flat, Side side, Paint paint);
  OnScreen onScreen(const Corner& corner) const;

  RasterList* list_ = nullptr;
  std::array<Float4, 4> clipFromBase_{};  // columns
  Eigen::Matrix3f eyeFromBase_;
  float width_ = 0.0F, height_ = 0.0F;  // [pixels]
  std::vector<ClipVertex> flatTriangles_;
  std::vector<Corner> polygon_, cut_;
};

}  // namespace palpate::gui
