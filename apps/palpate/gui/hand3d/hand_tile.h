// A square piece of a picture while triangles are drawn into it, four samples a pixel with their
// depth: small enough to stay in the processor's nearest memory. Private to hand_raster.cpp.
//
// A pixel's four samples are one vector. A triangle covers a sample when its three edge functions
// are positive there (J. Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988).
// Nearer is the larger 1 / w, which is linear in the picture.
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

// The same in all four.
inline Float4 splat(float value) { return Float4{value, value, value, value}; }
inline Uint4 splat(std::uint32_t value) { return Uint4{value, value, value, value}; }
inline bool isFinite(const Float4& v) {
  return std::isfinite(v[0] + v[1]) && std::isfinite(v[2] + v[3]);
}

enum class Paint : std::uint8_t {
  kOpaque,
  kLine,   // blended, hides what lies behind
  kClear,  // blended, hides nothing
};

// Of pixels: x right, y down, from the picture's top left corner.
struct RasterTriangle {
  // a x + b y + c: positive inside. Of an edge that two triangles share, both have exactly the same
  // numbers with the opposite sign, and only one counts what lies on the line (least = below 0): no
  // sample is drawn twice or left out.
  struct Edge {
    float a = 0.0F, b = 0.0F;
    float least = 0.0F;
    double c = 0.0;
  };
  std::array<Edge, 3> edges{};
  float nearnessX = 0.0F, nearnessY = 0.0F;      // 1 / w, its change per pixel
  double nearness = 0.0;                         // at (0, 0)
  int left = 0, right = 0, top = 0, bottom = 0;  // pixels it may touch, inclusive
  std::int32_t shade = -1;                       // of the shades; below 0: `color` everywhere
  QRgb color = 0;
  Paint paint = Paint::kOpaque;
};

// A colour that changes from vertex to vertex: blue, green, red, alpha, 0..255.
struct RasterShade {
  Float4 atMiddle{}, byX{}, byY{};  // around (middleX, middleY)
  Float4 least{},
      most{};  // of the three vertices: a pixel's middle may lie outside of the triangle
  float middleX = 0.0F, middleY = 0.0F;
  // The colour is linear in space, so what is linear in the picture is colour / w: the three above
  // are of that. False: they are of the colour itself, where w hardly changes.
  bool overDepth = false;
};

// Where in a pixel its four samples are, from its middle, -0.5..0.5.
struct SamplePlaces {
  Float4 x{}, y{};
};

class HandTile {
 public:
  static constexpr int kSide = 32;

  // The pixel at the tile's top left corner.
  void moveTo(int left, int top);
  void clear(QRgb background);
  void draw(const RasterTriangle& triangle,
            const std::vector<RasterShade>& shades,
            const SamplePlaces& samples);
  // The mean of the four samples into each pixel; when there are several passes with other sample
  // places, add() each of them and then take the mean of all.
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
