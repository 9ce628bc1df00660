#include "gui/hand3d/hand_tile.h"

#include <algorithm>
#include <bit>

namespace palpate::gui {

namespace {

using Byte4 = std::uint8_t __attribute__((vector_size(4)));
using Long2 = std::int64_t __attribute__((vector_size(16)));

// Whether any bit of the mask is set.
bool any(Int4 mask) {
  const auto halves = reinterpret_cast<Long2>(mask);
  return (halves[0] | halves[1]) != 0;
}

// Selects bit by bit: from `yes` where the mask is set, else from `no`.
Float4 whereSet(Int4 mask, Float4 yes, Float4 no) {
  return reinterpret_cast<Float4>((mask & reinterpret_cast<Int4>(yes)) |
                                  (~mask & reinterpret_cast<Int4>(no)));
}

Uint4 whereSet(Int4 mask, Uint4 yes, Uint4 no) {
  const auto bits = reinterpret_cast<Uint4>(mask);
  return (bits & yes) | (~bits & no);
}

float largest(Float4 v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

// Packs a colour, blue in the lowest byte, which also comes first in memory.
QRgb packed(Float4 bgra) {
  static_assert(std::endian::native == std::endian::little);
  const Int4 whole = __builtin_convertvector(bgra + splat(0.5F), Int4);
  return std::bit_cast<QRgb>(__builtin_convertvector(whole, Byte4));
}

// source * alpha + old * (1 - alpha) in units of 1/256; red and blue are computed together in one
// word.
Uint4 blended(QRgb source, Uint4 old) {
  const auto alpha = static_cast<std::uint32_t>(qAlpha(source) + (qAlpha(source) >> 7));
  const Uint4 rest = splat(256U - alpha);
  const std::uint32_t redBlue = (source & 0xFF00FFU) * alpha + 0x00800080U;
  const std::uint32_t green = ((source >> 8) & 0xFFU) * alpha + 0x80U;
  const Uint4 newRedBlue = (((old & 0xFF00FFU) * rest + splat(redBlue)) >> 8) & 0xFF00FFU;
  const Uint4 newGreen = (((old >> 8) & 0xFFU) * rest + splat(green)) & 0xFF00U;
  return newRedBlue | newGreen | 0xFF000000U;
}

std::uint32_t handTileSum(Uint4 v) { return v[0] + v[1] + v[2] + v[3]; }

}  // namespace

void HandTile::moveTo(int left, int top) {
  left_ = left;
  top_ = top;
}

bool operator==(const RasterShade& a, const RasterShade& b) noexcept {
  const Int4 same = (a.atMiddle == b.atMiddle) & (a.byX == b.byX) & (a.byY == b.byY) &
                    (a.least == b.least) & (a.most == b.most);
  return !any(~same) && a.middleX == b.middleX && a.middleY == b.middleY &&
         a.overDepth == b.overDepth;
}

void HandTile::clear(QRgb background) {
  color_.fill(splat(background | 0xFF000000U));
  nearness_.fill(splat(0.0F));
}

void HandTile::draw(const RasterTriangle& triangle,
                    const std::vector<RasterShade>& shades,
                    const SamplePlaces& samples) {
  const RasterShade* shade =
      triangle.shade < 0 ? nullptr : &shades[static_cast<std::size_t>(triangle.shade)];
  switch (triangle.paint) {
    case Paint::kOpaque:
      return shade ? fill<Paint::kOpaque, true>(triangle, shade, samples)
                   : fill<Paint::kOpaque, false>(triangle, shade, samples);
    case Paint::kLine:
      return shade ? fill<Paint::kLine, true>(triangle, shade, samples)
                   : fill<Paint::kLine, false>(triangle, shade, samples);
    case Paint::kClear:
      return shade ? fill<Paint::kClear, true>(triangle, shade, samples)
                   : fill<Paint::kClear, false>(triangle, shade, samples);
  }
}

// Edge functions are computed from the corner of the tile and the index of the pixel, never
// incrementally: so the values of two triangles at a shared edge stay exactly opposite.
template <Paint paint, bool kShaded>
void HandTile::fill(const RasterTriangle& triangle,
                    const RasterShade* shade,
                    const SamplePlaces& samples) {
  const int firstX = std::max(triangle.left - left_, 0);
  const int lastX = std::min(triangle.right - left_, kSide - 1);
  const int firstY = std::max(triangle.top - top_, 0);
  const int lastY = std::min(triangle.bottom - top_, kSide - 1);
  const double cornerX = left_ + 0.5, cornerY = top_ + 0.5;

  std::array<float, 3> corner{}, most{}, perStep{};
  std::array<Float4, 3> bySample{};
  for (std::size_t i = 0; i < 3; ++i) {
    const RasterTriangle::Edge& edge = triangle.edges[i];
    corner[i] = static_cast<float>(
        edge.c + (static_cast<double>(edge.a) * cornerX + static_cast<double>(edge.b) * cornerY));
    bySample[i] = edge.a * samples.x + edge.b * samples.y;
    most[i] = largest(bySample[i]);
    perStep[i] = edge.a != 0.0F ? -1.0F / edge.a : 0.0F;
  }
  const auto nearness =
      static_cast<float>(triangle.nearness + (static_cast<double>(triangle.nearnessX) * cornerX +
                                              static_cast<double>(triangle.nearnessY) * cornerY));
  const Float4 nearnessBySample = triangle.nearnessX * samples.x + triangle.nearnessY * samples.y;
  // Copied into local variables: the compiler can't know that drawing doesn't change the originals.
  const std::array<Float4, 3> step = {
      splat(triangle.edges[0].a), splat(triangle.edges[1].a), splat(triangle.edges[2].a)};
  const std::array<Float4, 3> least = {splat(triangle.edges[0].least),
                                       splat(triangle.edges[1].least),
                                       splat(triangle.edges[2].least)};
  const Float4 nearnessStep = splat(triangle.nearnessX);
  RasterShade own;
  if constexpr (kShaded) own = *shade;
  const bool overDepth = kShaded && own.overDepth;
  const QRgb color = triangle.color;

  for (int y = firstY; y <= lastY; ++y) {
    const auto fy = static_cast<float>(y);
    // Range of the row that may be covered, with a pixel to spare for rounding.
    auto from = static_cast<float>(firstX), to = static_cast<float>(lastX);
    std::array<Float4, 3> row{};
    bool outside = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const RasterTriangle::Edge& edge = triangle.edges[i];
      const float atRow = corner[i] + fy * edge.b;
      row[i] = splat(atRow) + bySample[i];
      const float reach = atRow + most[i];
      if (edge.a > 0.0F)
        from = std::max(from, reach * perStep[i] - 1.0F);
      else if (edge.a < 0.0F)
        to = std::min(to, reach * perStep[i] + 1.0F);
      else if (reach < 0.0F)
        outside = true;
    }
    if (outside || !(from <= to)) continue;
    const auto begin = static_cast<int>(from), end = static_cast<int>(to);
    const float middleNearness = nearness + fy * triangle.nearnessY;
    const Float4 rowNearness = splat(middleNearness) + nearnessBySample;
    Float4 rowShade{};
    if constexpr (kShaded)
      rowShade = own.atMiddle + splat(static_cast<float>(top_ + y) + 0.5F - own.middleY) * own.byY +
                 splat(static_cast<float>(left_) + 0.5F - own.middleX) * own.byX;

    const std::size_t rowStart = static_cast<std::size_t>(y) * kSide;
    Float4 fx = splat(static_cast<float>(begin));
    for (int x = begin; x <= end; ++x, fx += splat(1.0F)) {
      Int4 covered = (row[0] + fx * step[0] > least[0]) & (row[1] + fx * step[1] > least[1]) &
                     (row[2] + fx * step[2] > least[2]);
      const std::size_t at = rowStart + static_cast<std::size_t>(x);
      const Float4 depth = rowNearness + fx * nearnessStep;
      const Float4 before = nearness_[at];
      covered &= depth > before;
      if (!any(covered)) continue;
      QRgb here = color;
      if constexpr (kShaded) {
        Float4 bgra = rowShade + fx * own.byX;
        if (overDepth) bgra /= splat(middleNearness) + fx * nearnessStep;
        bgra = whereSet(bgra > own.least, bgra, own.least);
        bgra = whereSet(bgra < own.most, bgra, own.most);
        here = packed(bgra);
      }
      const Uint4 old = color_[at];
      if constexpr (paint == Paint::kOpaque)
        color_[at] = whereSet(covered, splat(here | 0xFF000000U), old);
      else
        color_[at] = whereSet(covered, blended(here, old), old);
      if constexpr (paint != Paint::kClear) nearness_[at] = whereSet(covered, depth, before);
    }
  }
}

void HandTile::writeMean(QRgb* pixels, std::ptrdiff_t stride, int width, int height) const {
  for (int y = 0; y < height; ++y, pixels += stride)
    for (int x = 0; x < width; ++x) {
      const Uint4 samples = color_[static_cast<std::size_t>(y * kSide + x)];
      const std::uint32_t redBlue = handTileSum(samples & 0xFF00FFU) + 0x20002U;
      const std::uint32_t green = handTileSum((samples >> 8) & 0xFFU) + 2U;
      pixels[x] = 0xFF000000U | ((redBlue >> 2) & 0xFF00FFU) | ((green >> 2) << 8);
    }
}

void HandTile::clearSums() {
  sumRedBlue_.fill(0);
  sumGreen_.fill(0);
}

void HandTile::add() {
  for (std::size_t i = 0; i < color_.size(); ++i) {
    sumRedBlue_[i] += handTileSum(color_[i] & 0xFF00FFU);
    sumGreen_[i] += handTileSum((color_[i] >> 8) & 0xFFU);
  }
}

void HandTile::writeMeanOfSums(
    QRgb* pixels, std::ptrdiff_t stride, int width, int height, unsigned numPasses) const {
  const std::uint32_t number = 4 * numPasses, half = number / 2;
  for (int y = 0; y < height; ++y, pixels += stride)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * kSide + x);
      const std::uint32_t red = ((sumRedBlue_[i] >> 16) + half) / number;
      const std::uint32_t blue = ((sumRedBlue_[i] & 0xFFFFU) + half) / number;
      const std::uint32_t green = (sumGreen_[i] + half) / number;
      pixels[x] = 0xFF000000U | (red << 16) | (green << 8) | blue;
    }
}

}  // namespace palpate::gui
