#include "gui/hand3d/hand_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "palpate/core/error.h"
#include "palpate/kinematics/stl_mesh.h"

namespace palpate::gui {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Above this cosine of their normals, neighbouring faces are shaded as one smooth surface.
constexpr double kSmoothBelow = 0.82;
// Corners of a circle.
constexpr int kRound = 28;
constexpr double kChamferMm = 2.0;
// The body is wider than the sensor by this much on either side.
constexpr double kBesideMm = 2.6;
// Height of the taxels above the body.
constexpr double kUnderMm = 0.6;
// Depth of a link behind its axis, as a share of the sensor's height.
constexpr double kBackShare = 0.78;
// Radius of a knuckle, as a share of the sensor's height.
constexpr double kKnuckleShare = 0.9;
// Height of a link without a sensor.
constexpr double kPlainHeightMm = 14.0;
constexpr double kPlainHalfWidthMm = 12.8;
// Radius of the palm around the base of a finger.
constexpr double kPalmAroundMm = 25.0;
constexpr double kPalmDepthMm = 44.0;
// Thickness of the slab under a matrix whose link has no length.
constexpr double kSlabMm = 8.0;

std::vector<Vector2d> circle(const Vector2d& centre, double radius) {
  std::vector<Vector2d> outline;
  for (int i = 0; i < kRound; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRound;
    outline.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

void appendTriangle(HandBody& body,
                    const HandBody::Corner& a,
                    const HandBody::Corner& b,
                    const HandBody::Corner& c) {
  body.triangles.push_back(a);
  body.triangles.push_back(b);
  body.triangles.push_back(c);
}

void appendFlat(
    HandBody& body, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3f normal = (b - a).cross(c - a).normalized().cast<float>();
  const auto corner = [&](const Vector3d& at) {
    return HandBody::Corner{at.cast<float>(), normal};
  };
  appendTriangle(body, corner(a), corner(b), corner(c));
  appendTriangle(body, corner(a), corner(c), corner(d));
}

// Moves every edge of a convex outline inwards.
std::vector<Vector2d> inset(const std::vector<Vector2d>& outline, double by) {
  std::vector<Vector2d> inner;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d before = (outline[i] - outline[(i + n - 1) % n]).normalized();
    const Vector2d after = (outline[(i + 1) % n] - outline[i]).normalized();
    const Vector2d inwards = Vector2d(-before.y() - after.y(), before.x() + after.x()).normalized();
    const double cosine = std::max(0.5, inwards.dot(Vector2d(-after.y(), after.x())));
    inner.push_back(outline[i] + inwards * (by / cosine));
  }
  return inner;
}

void turn(HandBody& body,
          std::size_t firstCorner,
          std::size_t firstEdge,
          const Eigen::Isometry3d& to) {
  const Eigen::Isometry3f move = to.cast<float>();
  for (std::size_t i = firstCorner; i < body.triangles.size(); ++i) {
    body.triangles[i].atMm = move * body.triangles[i].atMm;
    body.triangles[i].normal = move.linear() * body.triangles[i].normal;
  }
  for (std::size_t i = firstEdge; i < body.edges.size(); ++i)
    body.edges[i] = {move * body.edges[i].first, move * body.edges[i].second};
}

// The frame in which a link's body is built, in the frame of the link's end: x along the link
// towards its end, y out of its sensor surface, z across. Nothing for a link without length.
std::optional<Eigen::Isometry3d> bodyFrame(const ChainLink& link,
                                           const std::optional<Vector3d>& outwards) {
  const Eigen::Isometry3d endFromJoint = link.jointFromEnd.inverse(Eigen::Isometry);
  const Vector3d along = -endFromJoint.translation();
  if (along.norm() < 1.0) return std::nullopt;
  const Vector3d x = along.normalized();
  Vector3d z;
  if (outwards) {
    z = x.cross(*outwards);
  } else {
    z = endFromJoint.linear().col(2);
    z -= x * x.dot(z);
  }
  if (z.norm() < 0.1) return std::nullopt;
  z.normalize();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  return frame;
}

// The course of a matrix' surface in the frame of a body, from the palm to the tip.
struct SurfaceLine {
  // x along the link, y out of the surface.
  std::vector<Vector2d> pointsMm;
  double zMinMm = 0.0, zMaxMm = 0.0;  // across
  double heightMm = 0.0;
};

// Calls `work` with position and normal of each taxel, in the frame to which `toFrame` leads from
// the base frame of `pose`.
template <typename Work>
void forEachTaxel(const HandPose& pose,
                  std::size_t matrix,
                  const Eigen::Isometry3d& toFrame,
                  const Work& work) {
  const MatrixLayout& layout = pose.description().layout.matrix(matrix);
  for (int y = layout.rows - 1; y >= 0; --y)
    for (int x = 0; x < layout.columns; ++x)
      if (layout.enabled(y, x))
        work(y,
             Vector3d(toFrame * pose.positionMm(matrix, y, x)),
             Vector3d(toFrame.linear() * pose.normal(matrix, y, x)));
}

// The direction out of a surface, in the base frame; nothing where its taxels look to all sides, as
// on a ball: no side of it is free for a body.
std::optional<Vector3d> outwardsOf(const HandPose& pose, std::size_t matrix) {
  if (pose.description().surfaces[matrix].positionsMm.empty())
    return Vector3d(-pose.baseFromMatrix(matrix).linear().col(2));
  const Eigen::Isometry3d same = Eigen::Isometry3d::Identity();
  Vector3d sum = Vector3d::Zero();
  forEachTaxel(
      pose, matrix, same, [&](int, const Vector3d&, const Vector3d& normal) { sum += normal; });
  if (sum.norm() < 0.1) return std::nullopt;
  bool oneSide = true;
  forEachTaxel(pose, matrix, same, [&](int, const Vector3d&, const Vector3d& normal) {
    oneSide = oneSide && normal.dot(sum) > 0.0;
  });
  return oneSide ? std::optional(Vector3d(sum.normalized())) : std::nullopt;
}

// The course of a surface that is given taxel by taxel: of each row its lowest taxel, so that no
// taxel lies inside of the body.
SurfaceLine lineOfTaxels(const HandPose& pose,
                         std::size_t matrix,
                         const Eigen::Isometry3d& bodyFromBase) {
  const MatrixLayout& layout = pose.description().layout.matrix(matrix);
  Eigen::AlignedBox3d box;
  std::vector<Eigen::AlignedBox3d> rows(static_cast<std::size_t>(layout.rows));
  forEachTaxel(pose, matrix, bodyFromBase, [&](int y, const Vector3d& at, const Vector3d&) {
    box.extend(at);
    rows[static_cast<std::size_t>(y)].extend(at);
  });
  SurfaceLine line;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    if (!row->isEmpty()) line.pointsMm.emplace_back(row->center().x(), row->min().y() - kUnderMm);
  const double besideMm = std::max(layout.pitchMm.x, layout.pitchMm.y) / 2.0 + kBesideMm;
  line.zMinMm = box.min().z() - besideMm;
  line.zMaxMm = box.max().z() + besideMm;
  line.heightMm = box.max().y();
  return line;
}

// `bodyFromBase` leads from the base frame of `pose` to the frame of the body.
SurfaceLine lineOf(const HandPose& pose,
                   std::size_t matrix,
                   const Eigen::Isometry3d& bodyFromBase) {
  const GeometryDescription& hand = pose.description();
  if (!hand.surfaces[matrix].positionsMm.empty()) return lineOfTaxels(pose, matrix, bodyFromBase);
  const MatrixLayout& layout = hand.layout.matrix(matrix);
  SurfaceLine line;
  const double middleMm = layout.pitchMm.x * (layout.columns - 1) / 2.0;
  const double halfWidthMm = layout.pitchMm.x * layout.columns / 2.0 + kBesideMm;
  line.heightMm = (bodyFromBase * pose.baseFromMatrix(matrix)).translation().y();
  double zMm = 0.0;
  for (double row = layout.rows - 0.2; row >= -0.5; row -= 0.5) {
    const Vector3d at = bodyFromBase * pose.pointMm(matrix, middleMm, row * layout.pitchMm.y);
    line.pointsMm.emplace_back(at.x(), at.y() - kUnderMm);
    zMm = at.z();
  }
  line.zMinMm = zMm - halfWidthMm;
  line.zMaxMm = zMm + halfWidthMm;
  return line;
}

// A slab below the lowest taxel of a surface that is given taxel by taxel; without triangles where
// its taxels look to all sides.
HandBody slabUnderTaxels(const HandPose& pose, std::size_t matrix) {
  const SensorSurface& surface = pose.description().surfaces[matrix];
  HandBody body{.role = HandBodyRole::kLink, .place = surface.place, .triangles = {}, .edges = {}};
  const std::optional<Vector3d> outwards = outwardsOf(pose, matrix);
  if (!outwards) return body;
  Eigen::Isometry3d bodyFrame = Eigen::Isometry3d::Identity();
  bodyFrame.linear().col(0) = outwards->unitOrthogonal();
  bodyFrame.linear().col(1) = *outwards;
  bodyFrame.linear().col(2) = bodyFrame.linear().col(0).cross(*outwards);
  Eigen::AlignedBox3d box;
  forEachTaxel(pose,
               matrix,
               bodyFrame.inverse(Eigen::Isometry),
               [&](int, const Vector3d& at, const Vector3d&) { box.extend(at); });
  const TaxelPitch& pitchMm = pose.description().layout.matrix(matrix).pitchMm;
  const double besideMm = std::max(pitchMm.x, pitchMm.y) / 2.0 + kBesideMm;
  const double topMm = box.min().y() - kUnderMm;
  const double leftMm = box.min().x() - besideMm, rightMm = box.max().x() + besideMm;
  appendExtrusion(
      body,
      {{leftMm, topMm - kSlabMm}, {rightMm, topMm - kSlabMm}, {rightMm, topMm}, {leftMm, topMm}},
      box.min().z() - besideMm,
      box.max().z() + besideMm,
      kSlabMm / 8.0);
  turn(body, 0, 0, pose.baseFrom(surface.place).inverse(Eigen::Isometry) * bodyFrame);
  return body;
}

// A slab under a matrix whose link has no length, such as a pad on the palm.
HandBody slabUnder(const HandPose& pose, std::size_t matrix) {
  const SensorSurface& surface = pose.description().surfaces[matrix];
  if (!surface.positionsMm.empty()) return slabUnderTaxels(pose, matrix);
  // x towards row 0, y out of the surface, z across.
  Eigen::Isometry3d bodyFrame = pose.baseFromMatrix(matrix);
  bodyFrame.linear() = (Eigen::Matrix3d() << -bodyFrame.linear().col(1),
                        -bodyFrame.linear().col(2),
                        bodyFrame.linear().col(0))
                           .finished();
  const SurfaceLine line = lineOf(pose, matrix, bodyFrame.inverse(Eigen::Isometry));
  std::vector<Vector2d> outline = line.pointsMm;
  double lowMm = 0.0;
  for (const Vector2d& point : line.pointsMm) lowMm = std::min(lowMm, point.y());
  outline.emplace_back(line.pointsMm.front().x(), lowMm - kSlabMm);
  outline.emplace_back(line.pointsMm.back().x(), lowMm - kSlabMm);
  HandBody body{.role = HandBodyRole::kLink, .place = surface.place, .triangles = {}, .edges = {}};
  appendExtrusion(body, convexOutline(std::move(outline)), line.zMinMm, line.zMaxMm, kSlabMm / 8.0);
  turn(body, 0, 0, pose.baseFrom(surface.place).inverse(Eigen::Isometry) * bodyFrame);
  return body;
}

// Outline of a link seen from the side: its joint at -lengthMm, the next joint or the tip at 0, the
// sensor's surface on top.
std::vector<Vector2d> linkOutline(const std::optional<SurfaceLine>& surface,
                                  double lengthMm,
                                  bool tip) {
  const double heightMm = surface ? surface->heightMm : kPlainHeightMm;
  const double backMm = -heightMm * kBackShare;
  const double jointMm = heightMm * kKnuckleShare * 0.8;
  std::vector<Vector2d> points = {{-lengthMm + jointMm * 0.6, -jointMm},
                                  {-lengthMm + jointMm, backMm},
                                  {-lengthMm + jointMm * 0.6, jointMm}};
  if (surface) points.insert(points.end(), surface->pointsMm.begin(), surface->pointsMm.end());
  if (!tip) {
    points.insert(points.end(),
                  {{-jointMm * 0.6, jointMm}, {-jointMm * 0.6, -jointMm}, {-jointMm, backMm}});
    if (!surface)
      points.insert(points.end(), {{-lengthMm + jointMm, heightMm}, {-jointMm, heightMm}});
    return convexOutline(std::move(points));
  }
  // The tip is round from the end of the surface to the back.
  const Vector2d from = surface ? surface->pointsMm.back() : Vector2d(-heightMm, heightMm);
  const Vector2d to(std::min(-heightMm * 1.2, from.x() - heightMm * 0.6), backMm);
  const Vector2d over(std::max(0.0, from.x()) + heightMm * 0.35, backMm * 0.8);
  for (int i = 1; i <= 10; ++i) {
    const double t = i / 10.0;
    points.push_back((1.0 - t) * (1.0 - t) * from + 2.0 * t * (1.0 - t) * over + t * t * to);
  }
  return convexOutline(std::move(points));
}

HandBody palm(const GeometryDescription& hand) {
  HandBody body{.role = HandBodyRole::kPalm, .place = {}, .triangles = {}, .edges = {}};
  std::vector<Vector2d> points;
  double topMm = 0.0;
  for (const Finger& finger : hand.fingers) {
    const auto around = circle(finger.baseMm.head<2>(), kPalmAroundMm);
    points.insert(points.end(), around.begin(), around.end());
    topMm = std::max(topMm, finger.baseMm.z());
  }
  appendExtrusion(
      body, convexOutline(std::move(points)), topMm - kPalmDepthMm, topMm, 3.0 * kChamferMm);
  return body;
}

// Triangles whose normals are those of their faces; edges where faces meet at an angle are left to
// the shape's maker.
void appendMesh(HandBody& body, const std::vector<StlTriangle>& triangles, const Vector3f& scale) {
  const bool mirrored = scale.prod() < 0.0F;
  for (const StlTriangle& triangle : triangles) {
    std::array<Vector3f, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = triangle[i].cwiseProduct(scale);
    if (mirrored) std::swap(at[1], at[2]);
    const Vector3f normal = (at[1] - at[0]).cross(at[2] - at[0]);
    if (!(normal.norm() > 0.0F)) continue;
    const Vector3f unit = normal.normalized();
    appendTriangle(body, {at[0], unit}, {at[1], unit}, {at[2], unit});
    for (std::size_t i = 0; i < 3; ++i) body.edges.emplace_back(at[i], at[(i + 1) % 3]);
  }
}

void appendSphere(HandBody& body, float radiusMm) {
  const auto corner = [radiusMm](int ring, int step) {
    const float polar = std::numbers::pi_v<float> * static_cast<float>(ring) / (kRound / 2);
    const float around = 2.0F * std::numbers::pi_v<float> * static_cast<float>(step) / kRound;
    const Vector3f normal(
        std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
    return HandBody::Corner{radiusMm * normal, normal};
  };
  for (int ring = 0; ring < kRound / 2; ++ring)
    for (int step = 0; step < kRound; ++step) {
      if (ring > 0)
        appendTriangle(body, corner(ring, step), corner(ring + 1, step), corner(ring, step + 1));
      if (ring + 1 < kRound / 2)
        appendTriangle(
            body, corner(ring, step + 1), corner(ring + 1, step), corner(ring + 1, step + 1));
    }
}

// A cone about z; the origin is at half its height, the tip up.
void appendCone(HandBody& body, double radiusMm, double heightMm) {
  const auto face = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3f normal = (b - a).cross(c - a).normalized().cast<float>();
    appendTriangle(
        body, {a.cast<float>(), normal}, {b.cast<float>(), normal}, {c.cast<float>(), normal});
  };
  const std::vector<Vector2d> rim = circle(Vector2d::Zero(), radiusMm);
  const Vector3d tip = heightMm / 2.0 * Vector3d::UnitZ();
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector2d &at = rim[i], &next = rim[(i + 1) % rim.size()];
    const Vector3d from(at.x(), at.y(), -tip.z()), until(next.x(), next.y(), -tip.z());
    face(from, until, tip);
    face(until, from, -tip);
  }
}

// A box from the joint of a link to its end, for a link whose mesh can't be read; a cube for the
// base and for links without length.
HandBody boxOf(const GeometryDescription& hand, const LinkPlace& place) {
  constexpr double kCubeMm = 20.0;
  constexpr double kThickness = 0.4;  // of its length
  Vector3d joint = Vector3d::Zero();  // in the frame of the end
  if (place.link)
    joint = hand.fingers[place.finger]
                .links[*place.link]
                .jointFromEnd.inverse(Eigen::Isometry)
                .translation();
  const bool isLong = joint.norm() >= 1.0;
  const double length = isLong ? joint.norm() : kCubeMm;
  const double half = (isLong ? kThickness * length : kCubeMm) / 2.0;
  HandBody body{.role = place.link ? HandBodyRole::kLink : HandBodyRole::kPalm,
                .place = place,
                .triangles = {},
                .edges = {}};
  const double begin = isLong ? 0.0 : -half;
  appendExtrusion(body,
                  {{-half, -half}, {half, -half}, {half, half}, {-half, half}},
                  begin,
                  begin + length,
                  0.02 * length);
  Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
  if (isLong)
    to.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), joint).toRotationMatrix();
  turn(body, 0, 0, to);
  return body;
}

HandBody bodyOf(const LinkShape& shape) {
  HandBody body{.role = shape.place.link ? HandBodyRole::kLink : HandBodyRole::kPalm,
                .place = shape.place,
                .triangles = {},
                .edges = {}};
  const Vector3d half = shape.sizeMm / 2.0;
  switch (shape.kind) {
    case LinkShape::Kind::kBox:
      appendExtrusion(body,
                      {{-half.x(), -half.y()},
                       {half.x(), -half.y()},
                       {half.x(), half.y()},
                       {-half.x(), half.y()}},
                      -half.z(),
                      half.z(),
                      0.02 * shape.sizeMm.minCoeff());
      break;
    case LinkShape::Kind::kCylinder:
      appendExtrusion(body,
                      circle(Vector2d::Zero(), half.x()),
                      -half.z(),
                      half.z(),
                      0.02 * shape.sizeMm.minCoeff());
      break;
    case LinkShape::Kind::kSphere:
      appendSphere(body, static_cast<float>(half.x()));
      break;
    case LinkShape::Kind::kMesh:
      appendMesh(body, readStl(shape.mesh), shape.sizeMm.cast<float>());
      break;
  }
  turn(body, 0, 0, shape.linkFromShape);
  return body;
}

}  // namespace

std::vector<HandBody::Corner> trianglesOf(const Shape& shape) {
  LinkShape link;
  link.sizeMm = shape.sizeMm;
  HandBody body;
  switch (shape.kind) {
    case ShapeKind::kBox:
      return bodyOf(link).triangles;
    case ShapeKind::kCylinder:
      link.kind = LinkShape::Kind::kCylinder;
      return bodyOf(link).triangles;
    case ShapeKind::kSphere:
    case ShapeKind::kEllipsoid: {
      const Vector3f half = shape.sizeMm.cast<float>() / 2.0F;
      appendSphere(body, 1.0F);
      for (HandBody::Corner& corner : body.triangles) {
        corner.atMm = corner.atMm.cwiseProduct(half);
        corner.normal = corner.normal.cwiseQuotient(half).normalized();
      }
      break;
    }
    case ShapeKind::kCone:
      appendCone(body, shape.sizeMm.x() / 2.0, shape.sizeMm.z());
      break;
  }
  return body.triangles;
}

std::vector<Vector2d> convexOutline(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // Andrew's monotone chain.
  std::vector<Vector2d> outline;
  const auto add = [&outline](const Vector2d& point, std::size_t keep) {
    while (outline.size() >= keep + 2) {
      const Vector2d last = outline.back() - outline[outline.size() - 2];
      const Vector2d next = point - outline.back();
      if (last.x() * next.y() - last.y() * next.x() > 0.0) break;
      outline.pop_back();
    }
    outline.push_back(point);
  };
  for (const Vector2d& point : points) add(point, 0);
  const std::size_t lower = outline.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  outline.pop_back();
  return outline;
}

void appendExtrusion(HandBody& body,
                     const std::vector<Vector2d>& outline,
                     double zMin,
                     double zMax,
                     double chamfer) {
  const std::size_t n = outline.size();
  if (n < 3) return;
  const std::vector<Vector2d> inner = inset(outline, chamfer);
  const auto at = [](const Vector2d& point, double z) { return Vector3d(point.x(), point.y(), z); };
  std::vector<Vector2d> faceNormals;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d along = (outline[(i + 1) % n] - outline[i]).normalized();
    faceNormals.emplace_back(along.y(), -along.x());
  }
  // The normal of face `i` at the corner that it shares with face `j`.
  const auto normal = [&](std::size_t i, std::size_t j) {
    const bool smooth = faceNormals[i].dot(faceNormals[j]) > kSmoothBelow;
    const Vector2d both = smooth ? (faceNormals[i] + faceNormals[j]).normalized() : faceNormals[i];
    return Vector3f(static_cast<float>(both.x()), static_cast<float>(both.y()), 0.0F);
  };
  const double low = zMin + chamfer, high = zMax - chamfer;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n, before = (i + n - 1) % n;
    const Vector3f here = normal(i, before), there = normal(i, next);
    const HandBody::Corner a{at(outline[i], low).cast<float>(), here};
    const HandBody::Corner b{at(outline[next], low).cast<float>(), there};
    const HandBody::Corner c{at(outline[next], high).cast<float>(), there};
    const HandBody::Corner d{at(outline[i], high).cast<float>(), here};
    appendTriangle(body, a, b, c);
    appendTriangle(body, a, c, d);
    appendFlat(body,
               at(inner[i], zMin),
               at(inner[next], zMin),
               at(outline[next], low),
               at(outline[i], low));
    appendFlat(body,
               at(outline[i], high),
               at(outline[next], high),
               at(inner[next], zMax),
               at(inner[i], zMax));
    body.edges.emplace_back(a.atMm, b.atMm);
    body.edges.emplace_back(d.atMm, c.atMm);
    if (faceNormals[i].dot(faceNormals[before]) <= kSmoothBelow)
      body.edges.emplace_back(a.atMm, d.atMm);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const auto cap = [&](std::size_t corner, double z, float out) {
      return HandBody::Corner{at(inner[corner], z).cast<float>(), Vector3f(0.0F, 0.0F, out)};
    };
    appendTriangle(body, cap(0, zMax, 1.0F), cap(i, zMax, 1.0F), cap(i + 1, zMax, 1.0F));
    appendTriangle(body, cap(0, zMin, -1.0F), cap(i + 1, zMin, -1.0F), cap(i, zMin, -1.0F));
  }
}

std::vector<HandBody> handBodies(const HandGeometry& geometry) {
  const GeometryDescription& hand = geometry.description();
  std::vector<HandBody> bodies;
  std::vector<LinkPlace> boxes;
  for (const LinkShape& shape : hand.shapes) {
    try {
      bodies.push_back(bodyOf(shape));
    } catch (const Error&) {
      if (std::find(boxes.begin(), boxes.end(), shape.place) != boxes.end()) continue;
      boxes.push_back(shape.place);
      bodies.push_back(boxOf(hand, shape.place));
    }
  }
  if (!bodies.empty()) return bodies;
  const HandPose pose = geometry.pose(std::vector<double>(hand.numAxes, 0.0));
  std::vector<bool> carried(hand.surfaces.size(), false);
  if (!hand.fingers.empty()) bodies.push_back(palm(hand));
  for (std::size_t f = 0; f < hand.fingers.size(); ++f) {
    const std::vector<ChainLink>& links = hand.fingers[f].links;
    for (std::size_t l = 0; l < links.size(); ++l) {
      const LinkPlace place{f, l};
      std::optional<std::size_t> matrix;
      for (std::size_t m = 0; m < hand.surfaces.size() && !matrix; ++m)
        if (hand.surfaces[m].place == place) matrix = m;
      const Eigen::Isometry3d linkFromBase = pose.baseFrom(place).inverse(Eigen::Isometry);
      std::optional<Vector3d> outwards;
      if (matrix) outwards = outwardsOf(pose, *matrix);
      if (outwards) outwards = Vector3d(linkFromBase.linear() * *outwards);
      const std::optional<Eigen::Isometry3d> frame = bodyFrame(links[l], outwards);
      const double lengthMm = links[l].jointFromEnd.translation().norm();
      std::optional<SurfaceLine> surface;
      if (matrix && frame) {
        surface = lineOf(pose, *matrix, frame->inverse(Eigen::Isometry) * linkFromBase);
        carried[*matrix] = true;
      }
      const double heightMm = surface ? surface->heightMm : kPlainHeightMm;
      HandBody body{.role = HandBodyRole::kLink, .place = place, .triangles = {}, .edges = {}};
      if (frame) {
        const bool tip = l + 1 == links.size();
        appendExtrusion(body,
                        linkOutline(surface, lengthMm, tip),
                        surface ? surface->zMinMm : -kPlainHalfWidthMm,
                        surface ? surface->zMaxMm : kPlainHalfWidthMm,
                        kChamferMm);
        turn(body, 0, 0, *frame);
      } else if (lengthMm >= 1.0) {
        // A column from the joint to the end of the link.
        const Vector3d before = links[l].jointFromEnd.inverse(Eigen::Isometry).translation();
        appendExtrusion(body, circle(Vector2d::Zero(), heightMm * 1.05), 0.0, lengthMm, 1.0);
        Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
        to.linear() =
            Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), before).toRotationMatrix();
        turn(body, 0, 0, to);
      }
      if (!body.triangles.empty()) bodies.push_back(std::move(body));
      if (l + 1 == links.size()) continue;
      // The knuckle of the next link, about the axis of its joint, is given in the frame of this
      // one.
      HandBody knuckle{
          .role = HandBodyRole::kKnuckle, .place = place, .triangles = {}, .edges = {}};
      const double wideMm = kPlainHalfWidthMm + 1.2;
      appendExtrusion(
          knuckle, circle(Vector2d::Zero(), heightMm * kKnuckleShare), -wideMm, wideMm, 1.2);
      bodies.push_back(std::move(knuckle));
    }
  }
  for (std::size_t m = 0; m < hand.surfaces.size(); ++m)
    if (!carried[m])
      if (HandBody slab = slabUnder(pose, m); !slab.triangles.empty())
        bodies.push_back(std::move(slab));
  return bodies;
}

}  // namespace palpate::gui
