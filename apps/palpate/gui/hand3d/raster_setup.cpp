#include "gui/hand3d/raster_setup.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::gui {

namespace {

// Triangles are clipped at this multiple of the distance from the middle to the edge of the
// picture: further out their edges would be computed too coarsely.
constexpr float kGuard = 8.0F;
// Up to this ratio of depths the colour is treated as linear in the picture; the error is at most
// one level of 255.
constexpr double kSameDepth = 1.015;

Float4 channels(QRgb color) {
  return Float4{static_cast<float>(qBlue(color)),
                static_cast<float>(qGreen(color)),
                static_cast<float>(qRed(color)),
                static_cast<float>(qAlpha(color))};
}

Float4 smaller(Float4 a, Float4 b) {
  for (int i = 0; i < 4; ++i) a[i] = std::min(a[i], b[i]);
  return a;
}

Float4 larger(Float4 a, Float4 b) {
  for (int i = 0; i < 4; ++i) a[i] = std::max(a[i], b[i]);
  return a;
}

// Signed distance to a clipping plane, positive inside.
constexpr int kNumPlanes = 6;
float inside(const Float4& clip, int plane) {
  const float w = clip[3];
  switch (plane) {
    case 0:
      return w + clip[2];  // near
    case 1:
      return w - clip[2];  // far
    case 2:
      return kGuard * w + clip[0];
    case 3:
      return kGuard * w - clip[0];
    case 4:
      return kGuard * w + clip[1];
    default:
      return kGuard * w - clip[1];
  }
}

// Bit set of the planes that a corner is outside of.
unsigned outsideOf(const Float4& clip) {
  unsigned bits = 0;
  for (int plane = 0; plane < kNumPlanes; ++plane)
    bits |= inside(clip, plane) <= 0.0F ? 1U << plane : 0U;
  return bits;
}

// Bit set of the edges of the picture that a corner is beyond.
unsigned beyond(const Float4& clip) {
  const float w = clip[3];
  return (clip[0] > w ? 1U : 0U) | (clip[0] < -w ? 2U : 0U) | (clip[1] > w ? 4U : 0U) |
         (clip[1] < -w ? 8U : 0U);
}

}  // namespace

struct RasterSetup::OnScreen {
  double x = 0.0, y = 0.0;  // [pixels], y down
  double nearness = 0.0;    // 1 / w
  Float4 bgra{};

  bool before(const OnScreen& other) const { return x < other.x || (x == other.x && y < other.y); }
  // Gives exactly opposite numbers for the same edge in the other direction.
  static RasterTriangle::Edge edge(const OnScreen& from, const OnScreen& to) {
    const bool turned = to.before(from);
    const OnScreen& first = turned ? to : from;
    const OnScreen& second = turned ? from : to;
    const auto a = static_cast<float>(first.y - second.y);
    const auto b = static_cast<float>(second.x - first.x);
    const double c = -(static_cast<double>(a) * first.x + static_cast<double>(b) * first.y);
    if (turned) return {.a = -a, .b = -b, .least = 0.0F, .c = -c};
    return {.a = a, .b = b, .least = -1e-37F, .c = c};
  }
};

void RasterSetup::fill(const HandScene& scene,
                       const HandCamera& camera,
                       const QSizeF& size,
                       const QSize& pixels,
                       RasterList& list) {
  list_ = &list;
  list.triangles.clear();
  list.shades.clear();
  width_ = static_cast<float>(pixels.width());
  height_ = static_cast<float>(pixels.height());
  const Eigen::Matrix4f clip = camera.clipFromBase(size.width() / size.height()).cast<float>();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      clipFromBase_[static_cast<std::size_t>(column)][row] = clip(row, column);
  eyeFromBase_ = camera.eyeFromBase().cast<float>();
  addTriangles(scene.solid, Side::kBoth, Paint::kOpaque);
  flatTriangles_.clear();
  appendLinesAndPoints(scene, camera, size, flatTriangles_);
  addLinesAndPoints();
  addTriangles(scene.clear, Side::kBack, Paint::kClear);
  addTriangles(scene.clear, Side::kFront, Paint::kClear);
}

void RasterSetup::addTriangles(const std::vector<SceneVertex>& vertices, Side side, Paint paint) {
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
    std::array<Corner, 3> corners;
    std::array<QRgb, 3> colors{};
    for (std::size_t k = 0; k < 3; ++k) {
      const SceneVertex& vertex = vertices[i + k];
      corners[k].clip = clipFromBase_[0] * splat(vertex.positionMm[0]) +
                        clipFromBase_[1] * splat(vertex.positionMm[1]) +
                        clipFromBase_[2] * splat(vertex.positionMm[2]) + clipFromBase_[3];
    }
    if (beyond(corners[0].clip) & beyond(corners[1].clip) & beyond(corners[2].clip)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const SceneVertex& vertex = vertices[i + k];
      const Eigen::Map<const Eigen::Vector3f> normal(vertex.normal.data());
      colors[k] = litColor(vertex.color, normal, eyeFromBase_);
      corners[k].bgra = channels(colors[k]);
    }
    addWhole(corners, colors[0] == colors[1] && colors[1] == colors[2], side, paint);
  }
}

void RasterSetup::addLinesAndPoints() {
  for (std::size_t i = 0; i + 2 < flatTriangles_.size(); i += 3) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const ClipVertex& vertex = flatTriangles_[i + k];
      corners[k] = {.clip = Float4{vertex.clip[0], vertex.clip[1], vertex.clip[2], vertex.clip[3]},
                    .bgra = channels(vertex.color)};
    }
    addWhole(corners, true, Side::kBoth, Paint::kLine);
  }
}

void RasterSetup::addWhole(const std::array<Corner, 3>& corners,
                           bool flat,
                           Side side,
                           Paint paint) {
  unsigned any = 0, all = ~0U;
  for (const Corner& corner : corners) {
    if (!isFinite(corner.clip)) return;
    const unsigned outside = outsideOf(corner.clip);
    any |= outside;
    all &= outside;
  }
  if (all) return;
  if (any)
    cutAndAdd(corners, flat, side, paint);
  else
    addOnScreen(corners[0], corners[1], corners[2], flat, side, paint);
}

// Clips a triangle: I. Sutherland and G. Hodgman, Reentrant polygon clipping, CACM 17 (1974). A new
// corner is always computed from the corner inside, so that the neighbour at the clipped edge gets
// the same one.
void RasterSetup::cutAndAdd(const std::array<Corner, 3>& corners,
                            bool flat,
                            Side side,
                            Paint paint) {
  polygon_.assign(corners.begin(), corners.end());
  for (int plane = 0; plane < kNumPlanes; ++plane) {
    cut_.clear();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      const Corner& here = polygon_[i];
      const Corner& next = polygon_[(i + 1) % polygon_.size()];
      const float hereInside = inside(here.clip, plane), nextInside = inside(next.clip, plane);
      if (hereInside > 0.0F) cut_.push_back(here);
      if ((hereInside > 0.0F) == (nextInside > 0.0F)) continue;
      const Corner& in = hereInside > 0.0F ? here : next;
      const Corner& out = hereInside > 0.0F ? next : here;
      const float inBy = std::max(hereInside, nextInside), outBy = std::min(hereInside, nextInside);
      const float part = inBy / (inBy - outBy);
      cut_.push_back({.clip = in.clip + splat(part) * (out.clip - in.clip),
                      .bgra = in.bgra + splat(part) * (out.bgra - in.bgra)});
    }
    polygon_.swap(cut_);
    if (polygon_.size() < 3) return;
  }
  for (const Corner& corner : polygon_)
    if (!(corner.clip[3] > 0.0F) || !isFinite(corner.clip)) return;
  for (std::size_t i = 2; i < polygon_.size(); ++i)
    addOnScreen(polygon_[0], polygon_[i - 1], polygon_[i], flat, side, paint);
}

RasterSetup::OnScreen RasterSetup::onScreen(const Corner& corner) const {
  const float nearness = 1.0F / corner.clip[3];
  return {.x = static_cast<double>((0.5F + 0.5F * corner.clip[0] * nearness) * width_),
          .y = static_cast<double>((0.5F - 0.5F * corner.clip[1] * nearness) * height_),
          .nearness = static_cast<double>(nearness),
          .bgra = corner.bgra};
}

void RasterSetup::addOnScreen(
    const Corner& a, const Corner& b, const Corner& c, bool flat, Side side, Paint paint) {
  std::array<OnScreen, 3> p = {onScreen(a), onScreen(b), onScreen(c)};
  double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  // Counter-clockwise with y up is clockwise with y down.
  if (area == 0.0 || !std::isfinite(area)) return;
  if ((side == Side::kFront && area > 0.0) || (side == Side::kBack && area < 0.0)) return;
  if (area < 0.0) {
    std::swap(p[1], p[2]);
    area = -area;
  }
  RasterTriangle triangle;
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  if (right < 0.0 || bottom < 0.0 || left >= static_cast<double>(width_) ||
      top >= static_cast<double>(height_))
    return;
  triangle.left = static_cast<int>(std::max(left, 0.0));
  triangle.top = static_cast<int>(std::max(top, 0.0));
  triangle.right = static_cast<int>(std::min(right, static_cast<double>(width_) - 1.0));
  triangle.bottom = static_cast<int>(std::min(bottom, static_cast<double>(height_) - 1.0));
  for (std::size_t i = 0; i < 3; ++i) triangle.edges[i] = OnScreen::edge(p[i], p[(i + 1) % 3]);

  // Linear functions over the picture from the three corners: value at p0 and change per pixel.
  const double ax = (p[2].y - p[0].y) / area, bx = (p[0].y - p[1].y) / area;
  const double ay = (p[0].x - p[2].x) / area, by = (p[1].x - p[0].x) / area;
  const double d1 = p[1].nearness - p[0].nearness, d2 = p[2].nearness - p[0].nearness;
  triangle.nearnessX = static_cast<float>(d1 * ax + d2 * bx);
  triangle.nearnessY = static_cast<float>(d1 * ay + d2 * by);
  triangle.nearness = p[0].nearness - static_cast<double>(triangle.nearnessX) * p[0].x -
                      static_cast<double>(triangle.nearnessY) * p[0].y;
  if (!std::isfinite(triangle.nearnessX) || !std::isfinite(triangle.nearnessY)) return;
  triangle.paint = paint;
  const auto channel = [&](int i) { return static_cast<int>(p[0].bgra[i] + 0.5F); };
  triangle.color = qRgba(channel(2), channel(1), channel(0), channel(3));
  if (!flat) {
    triangle.shade = static_cast<std::int32_t>(list_->shades.size());
    const auto [least, most] = std::minmax({p[0].nearness, p[1].nearness, p[2].nearness});
    const bool overDepth = most > kSameDepth * least;
    std::array<Float4, 3> bgra = {p[0].bgra, p[1].bgra, p[2].bgra};
    if (overDepth)
      for (std::size_t i = 0; i < 3; ++i) bgra[i] *= splat(static_cast<float>(p[i].nearness));
    const Float4 c1 = bgra[1] - bgra[0], c2 = bgra[2] - bgra[0];
    list_->shades.push_back({.atMiddle = bgra[0],
                             .byX = c1 * static_cast<float>(ax) + c2 * static_cast<float>(bx),
                             .byY = c1 * static_cast<float>(ay) + c2 * static_cast<float>(by),
                             .least = smaller(p[0].bgra, smaller(p[1].bgra, p[2].bgra)),
                             .most = larger(p[0].bgra, larger(p[1].bgra, p[2].bgra)),
                             .middleX = static_cast<float>(p[0].x),
                             .middleY = static_cast<float>(p[0].y),
                             .overDepth = overDepth});
  }
  list_->triangles.push_back(triangle);
}

}  // namespace palpate::gui
