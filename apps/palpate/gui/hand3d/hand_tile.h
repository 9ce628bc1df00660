// A square tile of a picture into which triangles are drawn, with four samples per pixel and their
// depth: small enough to stay in the processor's cache. Private to hand_raster.cpp.
//
// The four samples of a pixel form one vector. A triangle covers a sample when its three edge
// functions are positive there (J. Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH
// 1988). The nearer of two samples has the larger 1 / w, which is linear in the picture.
#pragma once

#include <QRgb>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palpate::gui {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using Uint4 = std::uint32_t __attribute__((vector_size(16)));

// A vector with the same value in all four elements.
inline Float4 splat(float value) { return Float4{value, value, value, value}; }
inline Uint4 splat(std::uint32_t value) { return Uint4{value, value, value, value}; }
inline bool isFinite(const Float4& v) {
  return std::isfinite(v[0] + v[1]) && std::isfinite(v[2] + v[3]);
}

enum class Paint : std::uint8_t {
  kOpaque,
  // Blended; hides what is behind it.
  kLine,
  // Blended; hides nothing.
  kClear,
};

// A triangle in pixel coordinates: x right, y down, from the top left corner of the picture.
struct RasterTriangle {
  // Edge function a x + b y + c, positive inside. Two triangles that share an edge have exactly the
  // same numbers with opposite signs, and only one of them includes samples on the edge (least =
  // below 0): no sample is drawn twice or left out.
  struct Edge {
    float a = 0.0F, b = 0.0F;
    float least = 0.0F;
    double c = 0.0;
    bool operator==(const Edge&) const = default;
  };
  std::array<Edge, 3> edges{};
  // Change of 1 / w per pixel.
  float nearnessX = 0.0F, nearnessY = 0.0F;
  // 1 / w at (0, 0).
  double nearness = 0.0;
  // Bounds of the pixels that the triangle may touch, inclusive.
  int left = 0, right = 0, top = 0, bottom = 0;
  // Index of the shade; below 0: `color` everywhere.
  std::int32_t shade = -1;
  QRgb color = 0;
  Paint paint = Paint::kOpaque;
  bool operator==(const RasterTriangle&) const = default;
};

// A colour that varies over a triangle: blue, green, red, alpha, 0..255.
struct RasterShade {
  // Colour at (middleX, middleY), and its change per pixel in x and y.
  Float4 atMiddle{}, byX{}, byY{};
  // Least and greatest colour of the three vertices: the middle of a pixel may be outside of the
  // triangle.
  Float4 least{}, most{};
  float middleX = 0.0F, middleY = 0.0F;
  // True: the three fields above are of colour / w, since the colour is linear in space and so
  // colour / w is linear in the picture. False: they are of the colour itself, where w hardly
  // changes.
  bool overDepth = false;
};
bool operator==(const RasterShade& a, const RasterShade& b) noexcept;

// The places of the four samples in a pixel, from its middle, -0.5..0.5.
struct SamplePlaces {
  Float4 x{}, y{};
};

class HandTile {
 public:
  static constexpr int kSide = 32;

  // Sets the pixel at the top left corner of the tile.
  void moveTo(int left, int top);
  void clear(QRgb background);
  void draw(const RasterTriangle& triangle,
            const std::vector<RasterShade>& shades,
            const SamplePlaces& samples);
  // Writes the mean of the four samples to each pixel. With several passes of different sample
  // places, call add() after each of them, and then writeMeanOfSums().
  void writeMean(QRgb* pixels, std::ptrdiff_t stride, int width, int height) const;
  void clearSums();
  void add();
  void writeMeanOfSums(
      QRgb* pixels, std::ptrdiff_t stride, int width, int height, unsigned numPasses) const;

 private:
  template <Paint paint, bool kShaded>
  void fill(const RasterTriangle& triangle, const RasterShade* shade, const SamplePlaces& samples);

  int left_ = 0, top_ = 0;
  std::array<Uint4, kSide * kSide> color_{};
  std::array<Float4, kSide * kSide> nearness_{};
  std::array<std::uint32_t, kSide * kSide> sumRedBlue_{}, sumGreen_{};
};

}  // namespace palpate::gui
