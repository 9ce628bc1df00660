#include "gui/hand3d/hand_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>

#include <palpate/model/hand_description.h>

#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::gui::hand_mesh_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::tuple<int, int, int> key(const Eigen::Vector3f& at) {
  const auto whole = [](float mm) { return static_cast<int>(std::lround(mm * 1000.0F)); };
  return {whole(at.x()), whole(at.y()), whole(at.z())};
}

double volumeMm3(const HandBody& body) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < body.triangles.size(); i += 3) {
    const Vector3d a = body.triangles[i].atMm.cast<double>(),
                   b = body.triangles[i + 1].atMm.cast<double>(),
                   c = body.triangles[i + 2].atMm.cast<double>();
    sum += a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

// Every edge is walked once in each direction: nothing is open, nothing inside out.
void expectClosed(const HandBody& body) {
  std::map<std::pair<std::tuple<int, int, int>, std::tuple<int, int, int>>, int> walked;
  for (std::size_t i = 0; i < body.triangles.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++walked[{key(body.triangles[i + k].atMm), key(body.triangles[i + (k + 1) % 3].atMm)}];
  for (const auto& [edge, times] : walked) {
    const auto back = walked.find({edge.second, edge.first});
    ASSERT_TRUE(back != walked.end());
    EXPECT_EQ(back->second, times);
  }
}

TEST(HandMesh, OutlineAroundPoints) {
  const auto outline = convexOutline(
      {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}, {1.0, 1.0}, {2.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(outline, (std::vector<Vector2d>{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}));
  EXPECT_EQ(convexOutline({{1.0, 1.0}, {1.0, 1.0}}).size(), 1u);
  EXPECT_TRUE(convexOutline({}).empty());
}

TEST(HandMesh, AnExtrusionIsABoxWithCutRims) {
  HandBody body;
  appendExtrusion(body, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 20.0}, {0.0, 20.0}}, 0.0, 30.0, 1.0);
  expectClosed(body);
  // The box, less a frame at both ends: the prismatoid formula for a rim of height 1.
  const double rim = (10.0 * 20.0 + 8.0 * 18.0 + 4.0 * 9.0 * 19.0) / 6.0;
  EXPECT_NEAR(volumeMm3(body), 10.0 * 20.0 * 28.0 + 2.0 * rim, 1e-3);
  for (const HandBody::Corner& corner : body.triangles)
    EXPECT_NEAR(static_cast<double>(corner.normal.norm()), 1.0, 1e-5);
}

TEST(HandMesh, BodiesOfTheSdh2AreClosedAndCarryTheirSensors) {
  const HandGeometry geometry(sdh2Geometry());
  const auto bodies = handBodies(geometry);
  const HandPose pose = geometry.pose(std::vector<double>(7, 0.0));
  std::size_t links = 0;
  for (const HandBody& body : bodies) {
    expectClosed(body);
    EXPECT_GT(volumeMm3(body), 1000.0);
    // Normals point the way the triangles face.
    for (std::size_t i = 0; i < body.triangles.size(); i += 3) {
      const auto& a = body.triangles[i];
      const Eigen::Vector3f facing =
          (body.triangles[i + 1].atMm - a.atMm).cross(body.triangles[i + 2].atMm - a.atMm);
      if (facing.norm() > 1e-4F) {
        EXPECT_GT(facing.dot(a.normal), 0.0F);
      }
    }
    if (body.role == HandBodyRole::kLink && body.place.link != 0u) ++links;
  }
  EXPECT_EQ(links, 6u);
  // No taxel lies inside the link that carries it, nor far above it: in front of its surface within
  // a mm.
  const GeometryDescription& hand = geometry.description();
  for (std::size_t m = 0; m < hand.surfaces.size(); ++m) {
    const auto carrier = std::find_if(bodies.begin(), bodies.end(), [&](const HandBody& body) {
      return body.role == HandBodyRole::kLink && body.place == hand.surfaces[m].place;
    });
    ASSERT_TRUE(carrier != bodies.end());
    const Eigen::Isometry3d linkFromBase = pose.baseFrom(carrier->place).inverse();
    const MatrixLayout& layout = hand.layout.matrix(m);
    for (int y = 0; y < layout.rows; ++y) {
      const Vector3d at = linkFromBase * pose.positionMm(m, y, 2);
      const Vector3d out = linkFromBase.linear() * pose.normal(m, y, 2);
      double nearest = 1e9;  // along the normal from the taxel down to the body
      for (std::size_t i = 0; i < carrier->triangles.size(); i += 3) {
        const Vector3d a = carrier->triangles[i].atMm.cast<double>(),
                       ab = carrier->triangles[i + 1].atMm.cast<double>() - a,
                       ac = carrier->triangles[i + 2].atMm.cast<double>() - a;
        Eigen::Matrix3d sides;
        sides << ab, ac, out;
        if (std::abs(sides.determinant()) < 1e-9) continue;
        const Vector3d solved = sides.inverse() * (at - a);
        if (solved.x() < 0.0 || solved.y() < 0.0 || solved.x() + solved.y() > 1.0) continue;
        if (solved.z() > -5.0) nearest = std::min(nearest, solved.z());
      }
      EXPECT_GT(nearest, 0.2) << "matrix " << m << ", row " << y;
      EXPECT_LT(nearest, 1.2) << "matrix " << m << ", row " << y;
    }
  }
}

TEST(HandMesh, AnotherHandGetsBodiesToo) {
  GeometryDescription pad;
  pad.numAxes = 1;
  pad.layout = SensorLayout({MatrixLayout::full(4, 4, 5.0)});
  Finger finger;
  finger.links = {denavitHartenbergLink(0, 1.0, 0.0, 20.0, 0.0, -90.0),
                  denavitHartenbergLink(std::nullopt, 1.0, 0.0, 0.0, 60.0, 0.0)};
  pad.fingers = {finger};
  SensorSurface surface;
  surface.place = {0, 1};
  surface.linkFromSurface.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  surface.linkFromSurface.translation() = Eigen::Vector3d(-10.0, 12.0, -7.5);
  pad.surfaces = {surface};
  const auto bodies = handBodies(HandGeometry(pad));
  EXPECT_EQ(bodies.size(), 4u);  // palm, column, knuckle, link
  for (const HandBody& body : bodies) expectClosed(body);
}

// Taxels on a dome, given one by one in the frame of the palm.
GeometryDescription domeOf(double openingDeg) {
  GeometryDescription hand;
  hand.layout = SensorLayout({MatrixLayout::full(6, 6, 5.0)});
  hand.surfaces.resize(1);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) {
      const double degree = std::numbers::pi / 180.0;
      const double a = openingDeg * degree * (y - 2.5) / 2.5,
                   b = openingDeg * degree * (x - 2.5) / 2.5;
      const Vector3d normal(std::sin(b), std::cos(b) * std::sin(a), std::cos(b) * std::cos(a));
      hand.surfaces[0].normals.push_back(normal);
      hand.surfaces[0].positionsMm.push_back(30.0 * normal);
    }
  return hand;
}

// arrays A6
TEST(HandMesh, TheSlabUnderACurvedSurfaceIsBelowItsLowestTaxel) {
  const GeometryDescription dome = domeOf(40.0);
  double lowestMm = 1e9;
  for (const Vector3d& at : dome.surfaces[0].positionsMm) lowestMm = std::min(lowestMm, at.z());
  const auto bodies = handBodies(HandGeometry(dome));
  ASSERT_EQ(bodies.size(), 1u);
  expectClosed(bodies[0]);
  Eigen::AlignedBox3f box;
  for (const HandBody::Corner& corner : bodies[0].triangles) box.extend(corner.atMm);
  EXPECT_LT(static_cast<double>(box.max().z()), lowestMm);
  EXPECT_GT(static_cast<double>(box.max().z()), lowestMm - 2.0) << "close to it";
  for (const Vector3d& at : dome.surfaces[0].positionsMm) {
    EXPECT_LT(static_cast<double>(box.min().x()), at.x());
    EXPECT_GT(static_cast<double>(box.max().y()), at.y());
  }
}

TEST(HandMesh, NoBodyHidesTaxelsThatLookToAllSides) {
  EXPECT_TRUE(handBodies(HandGeometry(domeOf(150.0))).empty());
}

// As the signed distance of the emulator sees it; rims are chamfered.
TEST(HandMesh, ObjectsHaveTheSurfaceOfTheirShape) {
  const std::pair<ShapeKind, Vector3d> shapes[] = {{ShapeKind::kSphere, {60.0, 60.0, 60.0}},
                                                   {ShapeKind::kCylinder, {60.0, 60.0, 90.0}},
                                                   {ShapeKind::kBox, {40.0, 60.0, 90.0}},
                                                   {ShapeKind::kEllipsoid, {40.0, 60.0, 90.0}},
                                                   {ShapeKind::kCone, {60.0, 60.0, 90.0}}};
  for (const auto& [kind, sizeMm] : shapes) {
    const Shape shape{kind, sizeMm};
    HandBody body;
    body.triangles = trianglesOf(shape);
    expectClosed(body);
    ASSERT_FALSE(body.triangles.empty());
    EXPECT_GT(volumeMm3(body), 0.0);
    for (const HandBody::Corner& corner : body.triangles) {
      const Vector3d at = corner.atMm.cast<double>();
      EXPECT_LE(shape.distanceMm(at), 0.01);
      EXPECT_GE(shape.distanceMm(at), -0.02 * sizeMm.minCoeff() - 0.01);
      EXPECT_GT(corner.normal.cast<double>().dot(shape.gradient(at)), 0.0);
    }
  }
}

TEST(HandMesh, ALinkWhoseMeshCantBeReadIsABox) {
  GeometryDescription pad;
  pad.layout = SensorLayout({MatrixLayout::full(1, 1, 5.0)});
  Finger finger;
  finger.links = {denavitHartenbergLink(std::nullopt, 1.0, 0.0, 0.0, 60.0, 0.0)};
  pad.fingers = {finger};
  pad.surfaces.resize(1);
  LinkShape shape;
  shape.kind = LinkShape::Kind::kMesh;
  shape.place = {0, 0};
  shape.mesh = "/nowhere/link.dae";
  pad.shapes = {shape, shape};
  const auto bodies = handBodies(HandGeometry(pad));
  ASSERT_EQ(bodies.size(), 1u);
  expectClosed(bodies[0]);
  Eigen::AlignedBox3f box;
  for (const HandBody::Corner& corner : bodies[0].triangles) box.extend(corner.atMm);
  // From the joint to the end of the link, where its frame is; 0.4 times as wide.
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(-60.0F, -12.0F, -12.0F), 1e-5F));
  EXPECT_NEAR(box.max().x(), 0.0F, 1e-4F);
  EXPECT_NEAR(box.max().y(), 12.0F, 1e-4F);
}

}  // namespace
}  // namespace palpate::gui::hand_mesh_test
