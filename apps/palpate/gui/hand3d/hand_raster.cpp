#include "gui/hand3d/hand_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <palpate/core/error.h>

#include "gui/hand3d/hand_tile.h"
#include "gui/hand3d/raster_setup.h"

namespace palpate::gui {

namespace {

// Four sample places in sixteenths of a pixel, no two in the same row or column: where OpenGL
// drivers put them (here with y down).
constexpr std::array<std::array<int, 2>, 4> kFour = {{{-2, 6}, {6, 2}, {-6, -2}, {2, -6}}};

std::vector<SamplePlaces> handRasterPlacesOf(RasterQuality quality) {
  std::vector<SamplePlaces> passes(quality == RasterQuality::kScreen ? 1 : 4);
  for (std::size_t pass = 0; pass < passes.size(); ++pass)
    for (std::size_t i = 0; i < 4; ++i) {
      if (quality == RasterQuality::kScreen) {
        passes[pass].x[i] = static_cast<float>(kFour[i][0]) / 16.0F;
        passes[pass].y[i] = static_cast<float>(kFour[i][1]) / 16.0F;
      } else {
        // Hammersley's points: one in every row, column and 4 x 4 cell.
        const std::size_t n = 4 * i + pass;
        const std::size_t turned = ((n & 1) << 3) | ((n & 2) << 1) | ((n & 4) >> 1) | (n >> 3);
        passes[pass].x[i] = (static_cast<float>(n) + 0.5F) / 16.0F - 0.5F;
        passes[pass].y[i] = (static_cast<float>(turned) + 0.5F) / 16.0F - 0.5F;
      }
    }
  return passes;
}

QSize pixelsOf(const QSizeF& size, double pixelRatio) {
  const double width = size.width() * pixelRatio, height = size.height() * pixelRatio;
  // Largest side of a QImage [pixels].
  constexpr double kMaximum = 32767.0;
  if (!(size.width() > 0.0) || !(size.height() > 0.0) || !(pixelRatio > 0.0) ||
      !(width <= kMaximum) || !(height <= kMaximum))
    return {};
  return {std::max(1, static_cast<int>(std::lround(width))),
          std::max(1, static_cast<int>(std::lround(height)))};
}

}  // namespace

struct HandRaster::Work {
  QImage image;
  RasterSetup setup;
  RasterList list;
  HandTile tile;
  // For each tile of a row of tiles: the triangles that may touch it.
  std::vector<std::vector<std::uint32_t>> ofTile;
  // What a tile of the image shows: its triangles in order, their shades counted from 0.
  struct Shown {
    bool known = false;
    std::vector<RasterTriangle> triangles;
    std::vector<RasterShade> shades;
  };
  std::vector<Shown> shown;  // of the tiles of the image, row by row; empty: nothing is known
  QRgb shownBackground = 0;
  std::size_t numDrawn = 0;

  // Whether the tile shows these triangles already; otherwise it is noted that it shows them now.
  bool isShown(Shown& tileShown, const std::vector<std::uint32_t>& triangles) const {
    std::size_t at = 0, shadeAt = 0;
    bool same = tileShown.known && tileShown.triangles.size() == triangles.size();
    for (; same && at < triangles.size(); ++at) {
      const auto [triangle, shade] = numbered(triangles[at], shadeAt);
      same = triangle == tileShown.triangles[at] && (!shade || *shade == tileShown.shades[shadeAt]);
      if (shade) ++shadeAt;
    }
    if (same) return true;
    tileShown.known = true;
    tileShown.triangles.clear();
    tileShown.shades.clear();
    for (const std::uint32_t i : triangles) {
      const auto [triangle, shade] = numbered(i, tileShown.shades.size());
      tileShown.triangles.push_back(triangle);
      if (shade) tileShown.shades.push_back(*shade);
    }
    return false;
  }
  // A triangle of the list with the number `shadeAt` for its shade, and the shade.
  std::pair<RasterTriangle, const RasterShade*> numbered(std::uint32_t i,
                                                         std::size_t shadeAt) const {
    RasterTriangle triangle = list.triangles[i];
    if (triangle.shade < 0) return {triangle, nullptr};
    const RasterShade* shade = &list.shades[static_cast<std::size_t>(triangle.shade)];
    triangle.shade = static_cast<std::int32_t>(shadeAt);
    return {triangle, shade};
  }

  void sortIntoTiles(int top, int numTiles) {
    ofTile.resize(std::max(ofTile.size(), static_cast<std::size_t>(numTiles)));
    for (auto& triangles : ofTile) triangles.clear();
    for (std::size_t i = 0; i < list.triangles.size(); ++i) {
      const RasterTriangle& triangle = list.triangles[i];
      if (triangle.bottom < top || triangle.top >= top + HandTile::kSide) continue;
      for (int t = triangle.left / HandTile::kSide; t <= triangle.right / HandTile::kSide; ++t)
        ofTile[static_cast<std::size_t>(t)].push_back(static_cast<std::uint32_t>(i));
    }
  }
  void drawTile(const std::vector<std::uint32_t>& triangles,
                const SamplePlaces& samples,
                QRgb background) {
    tile.clear(background);
    for (const std::uint32_t i : triangles) tile.draw(list.triangles[i], list.shades, samples);
  }
  // Draws all passes of a tile of `width` x `height` pixels.
  void drawTile(const std::vector<std::uint32_t>& triangles,
                const std::vector<SamplePlaces>& passes,
                QRgb background,
                QRgb* pixels,
                std::ptrdiff_t stride,
                int width,
                int height) {
    if (triangles.empty()) {
      for (int y = 0; y < height; ++y)
        std::fill_n(pixels + y * stride, width, background | 0xFF000000U);
    } else if (passes.size() == 1) {
      drawTile(triangles, passes.front(), background);
      tile.writeMean(pixels, stride, width, height);
    } else {
      tile.clearSums();
      for (const SamplePlaces& samples : passes) {
        drawTile(triangles, samples, background);
        tile.add();
      }
      tile.writeMeanOfSums(pixels, stride, width, height, static_cast<unsigned>(passes.size()));
    }
  }
};

HandRaster::HandRaster() : work_(std::make_unique<Work>()) {}
HandRaster::~HandRaster() = default;

const QImage& HandRaster::draw(const HandScene& scene,
                               const HandCamera& camera,
                               const QSizeF& size,
                               double pixelRatio,
                               RasterQuality quality,
                               const Progress& progress) {
  QImage& image = work_->image;
  const QSize pixels = pixelsOf(size, pixelRatio);
  if (image.size() != pixels) {
    // Frees the memory before new memory is allocated.
    image = QImage();
    image = QImage(pixels, QImage::Format_RGB32);
    work_->shown.clear();
  }
  if (image.isNull()) return image;
  image.setDevicePixelRatio(pixelRatio);
  work_->setup.fill(scene, camera, size, pixels, work_->list);
  const auto passes = handRasterPlacesOf(quality);
  auto* first = reinterpret_cast<QRgb*>(image.bits());
  const std::ptrdiff_t stride = image.bytesPerLine() / static_cast<std::ptrdiff_t>(sizeof(QRgb));
  constexpr int kSide = HandTile::kSide;
  const int numTiles = (pixels.width() + kSide - 1) / kSide;
  // A large picture for a file is drawn once: nothing is remembered of it.
  if (quality != RasterQuality::kScreen || scene.background != work_->shownBackground)
    work_->shown.clear();
  work_->shownBackground = scene.background;
  if (quality == RasterQuality::kScreen && work_->shown.empty())
    work_->shown.resize(static_cast<std::size_t>(numTiles) *
                        static_cast<std::size_t>((pixels.height() + kSide - 1) / kSide));
  work_->numDrawn = 0;
  for (int top = 0; top < pixels.height(); top += kSide) {
    if (progress && !progress(static_cast<double>(top) / pixels.height())) {
      image = QImage();
      throw Cancelled();
    }
    work_->sortIntoTiles(top, numTiles);
    for (int t = 0; t < numTiles; ++t) {
      const int left = t * kSide;
      if (!work_->shown.empty() &&
          work_->isShown(work_->shown[static_cast<std::size_t>(top / kSide * numTiles + t)],
                         work_->ofTile[static_cast<std::size_t>(t)]))
        continue;
      ++work_->numDrawn;
      work_->tile.moveTo(left, top);
      work_->drawTile(work_->ofTile[static_cast<std::size_t>(t)],
                      passes,
                      scene.background,
                      first + top * stride + left,
                      stride,
                      std::min(kSide, pixels.width() - left),
                      std::min(kSide, pixels.height() - top));
    }
  }
  return image;
}

std::size_t HandRaster::numTilesDrawn() const noexcept { return work_->numDrawn; }

QImage rasterize(const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size,
                 double pixelRatio,
                 RasterQuality quality,
                 const Progress& progress) {
  return HandRaster().draw(scene, camera, size, pixelRatio, quality, progress);
}

}  // namespace palpate::gui
