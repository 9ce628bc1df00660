#include "gui/hand3d/hand_camera.h"

#include <QMatrix4x4>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "testing/testing.h"

namespace palpate::gui::hand_camera_test {
namespace {

constexpr QSizeF kSize(800.0, 600.0);
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

HandCamera looking(double azimuthDeg, double elevationDeg, double distanceMm = 500.0) {
  HandCamera camera;
  camera.targetMm = {10.0, -20.0, 70.0};
  camera.azimuthDeg = azimuthDeg;
  camera.elevationDeg = elevationDeg;
  camera.distanceMm = distanceMm;
  return camera;
}

bool isFinite(const HandCamera& camera, const QSizeF& size) {
  const double aspect = size.width() / size.height();
  return camera.eyeMm().allFinite() && camera.eyeFromBase().allFinite() &&
         camera.clipFromBase(aspect).allFinite() && camera.rayAt({3.0, 4.0}, size).allFinite() &&
         std::isfinite(camera.pxPerMm(size.height()));
}

QPointF seen(const HandCamera& camera, const Eigen::Vector3d& mm, const QSizeF& size = kSize) {
  const auto projected = camera.project(mm, size);
  EXPECT_TRUE(projected.has_value());
  return projected ? projected->at : QPointF();
}

void expectNear(const QPointF& a, const QPointF& b, double tolerance) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
}

TEST(HandCamera, StandsWhereItsAnglesSay) {
  HandCamera camera;
  camera.targetMm = {1.0, 2.0, 3.0};
  camera.distanceMm = 100.0;
  camera.azimuthDeg = 0.0;
  camera.elevationDeg = 0.0;
  EXPECT_TRUE(camera.eyeMm().isApprox(Eigen::Vector3d(101.0, 2.0, 3.0)));
  camera.azimuthDeg = 90.0;
  EXPECT_TRUE(camera.eyeMm().isApprox(Eigen::Vector3d(1.0, 102.0, 3.0)));
  camera.elevationDeg = 30.0;
  EXPECT_TRUE(
      camera.eyeMm().isApprox(Eigen::Vector3d(1.0, 2.0 + 100.0 * std::sqrt(0.75), 3.0 + 50.0)));
}

TEST(HandCamera, SeesUpAboveAndRightOnTheRight) {
  const HandCamera camera = looking(0.0, 0.0);  // from +x: +y is on the right, +z above
  expectNear(seen(camera, camera.targetMm), {400.0, 300.0}, 1e-9);
  EXPECT_GT(seen(camera, camera.targetMm + Eigen::Vector3d(0.0, 10.0, 0.0)).x(), 400.0);
  EXPECT_LT(seen(camera, camera.targetMm + Eigen::Vector3d(0.0, 0.0, 10.0)).y(), 300.0);
  EXPECT_NEAR(camera.project(camera.targetMm, kSize)->depthMm, 500.0, 1e-9);
}

TEST(HandCamera, AgreesWithQtsMatrices) {
  const HandCamera camera = looking(37.0, 24.0);
  const auto vector = [](const Eigen::Vector3d& v) {
    return QVector3D(
        static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
  };
  QMatrix4x4 reference;
  reference.perspective(static_cast<float>(camera.fieldDeg),
                        800.0F / 600.0F,
                        static_cast<float>(camera.nearMm()),
                        static_cast<float>(camera.farMm()));
  reference.lookAt(vector(camera.eyeMm()), vector(camera.targetMm), QVector3D(0, 0, 1));
  for (const Eigen::Vector3d& mm :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(60, -40, 180), Eigen::Vector3d(-90, 80, 20)}) {
    const QVector4D expected = reference * QVector4D(vector(mm), 1.0F);
    const Eigen::Vector4d clip = camera.clipFromBase(800.0 / 600.0) * mm.homogeneous();
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(clip[i], expected[i], 0.01) << i;
    expectNear(seen(camera, mm),
               {400.0 * (1.0 + static_cast<double>(expected.x() / expected.w())),
                300.0 * (1.0 - static_cast<double>(expected.y() / expected.w()))},
               0.01);
    EXPECT_NEAR(camera.project(mm, kSize)->depthMm, static_cast<double>(expected.w()), 0.01);
  }
}

TEST(HandCamera, ARayGoesThroughWhatItsPixelShows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-180.0, 180.0), mm(-120.0, 120.0);
  int seenPoints = 0;
  for (int i = 0; i < 300; ++i) {
    const HandCamera camera = looking(angle(random), angle(random) / 2.1, 600.0);
    const Eigen::Vector3d point(mm(random), mm(random), mm(random));
    const auto projected = camera.project(point, kSize);
    if (!projected) continue;
    ++seenPoints;
    const Eigen::Vector3d ray = camera.rayAt(projected->at, kSize);
    EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
    EXPECT_LT((point - camera.eyeMm()).cross(ray).norm(), 1e-9 * 600.0);
    EXPECT_GT((point - camera.eyeMm()).dot(ray), 0.0);
  }
  EXPECT_EQ(seenPoints, 300);
}

TEST(HandCamera, SeesNothingBesideOrBehindTheEye) {
  const HandCamera camera = looking(20.0, 10.0);
  const Eigen::Vector3d eye = camera.eyeMm();
  EXPECT_FALSE(camera.project(eye, kSize));
  EXPECT_FALSE(camera.project(eye + (eye - camera.targetMm), kSize));
  EXPECT_FALSE(camera.project(eye + camera.eyeFromBase().row(0).transpose() * 50.0, kSize));
  EXPECT_FALSE(camera.project({kNan, 0.0, 0.0}, kSize));
  EXPECT_FALSE(camera.project(camera.targetMm, {0.0, 0.0}));
  EXPECT_FALSE(camera.project(camera.targetMm, {kNan, 100.0}));
}

TEST(HandCamera, OrbitOnceAroundIsTwoHeights) {
  HandCamera camera = looking(-60.0, 18.0);
  const Eigen::Vector3d before = camera.eyeMm();
  camera.orbit({300.0, 0.0}, 600.0);  // a quarter, the thing turns with the mouse
  EXPECT_NEAR(camera.azimuthDeg, -150.0, 1e-9);
  for (int i = 0; i < 3; ++i) camera.orbit({300.0, 0.0}, 600.0);
  EXPECT_LT((camera.eyeMm() - before).norm(), 1e-6);
  // What is nearest to the eye moves the way the mouse does.
  camera = looking(0.0, 0.0);
  const Eigen::Vector3d front = camera.targetMm + Eigen::Vector3d(50.0, 0.0, 0.0);
  camera.orbit({20.0, 0.0}, 600.0);
  EXPECT_GT(seen(camera, front).x(), 400.0);
  camera.orbit({0.0, 20.0}, 600.0);
  EXPECT_GT(seen(camera, front).y(), 300.0);
}

TEST(HandCamera, OrbitNeverFlips) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> px(-400.0, 400.0);
  HandCamera camera = looking(0.0, 0.0);
  for (int i = 0; i < 2000; ++i) {
    camera.orbit({px(random), px(random) * 3.0}, 600.0);
    ASSERT_LE(std::abs(camera.elevationDeg), 89.0);
    ASSERT_LE(std::abs(camera.azimuthDeg), 180.0);
    const Eigen::Matrix3d axes = camera.eyeFromBase();
    ASSERT_GT(axes(1, 2), 0.0) << "z of the base points down in the picture";
    ASSERT_NEAR(axes(0, 2), 0.0, 1e-12) << "the horizon is tilted";
    ASSERT_NEAR(axes.determinant(), 1.0, 1e-12);
    ASSERT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
  camera.orbit({0.0, 1e9}, 600.0);
  EXPECT_EQ(camera.elevationDeg, 89.0);
}

TEST(HandCamera, PanTakesTheTargetsPlaneAlong) {
  HandCamera camera = looking(33.0, -20.0);
  const Eigen::Vector3d point = camera.targetMm + camera.eyeFromBase().row(0).transpose() * 30.0 +
                                camera.eyeFromBase().row(1).transpose() * 12.0;
  const QPointF before = seen(camera, point);
  camera.pan({25.0, -40.0}, kSize.height());
  expectNear(seen(camera, point), before + QPointF(25.0, -40.0), 1e-9);
}

TEST(HandCamera, AMillimetreAtTheTargetIsAsLargeAsItSays) {
  const HandCamera camera = looking(10.0, 5.0);
  const Eigen::Vector3d beside = camera.targetMm + camera.eyeFromBase().row(0).transpose() * 1.0;
  EXPECT_NEAR(seen(camera, beside).x() - 400.0, camera.pxPerMm(600.0), 1e-9);
  // 28 degrees from bottom to top: 2 * 500 mm * tan(14 deg) are 600 px.
  EXPECT_NEAR(camera.pxPerMm(600.0), 600.0 / 249.328, 1e-4);
}

TEST(HandCamera, ZoomKeepsWhatIsUnderTheMouse) {
  for (const double factor : {1.1, 0.8, 3.0, 1000.0, 0.0001}) {
    HandCamera camera = looking(-70.0, 35.0);
    const QPointF mouse(130.0, 480.0);
    const double depth = camera.distanceMm;
    const Eigen::Vector3d ray = camera.rayAt(mouse, kSize);
    const Eigen::Vector3d forward = (camera.targetMm - camera.eyeMm()).normalized();
    const Eigen::Vector3d under = camera.eyeMm() + ray * (depth / ray.dot(forward));
    camera.zoom(factor, mouse, kSize);
    expectNear(seen(camera, under), mouse, 1e-6);
    EXPECT_GE(camera.distanceMm, HandCamera::kMinDistanceMm);
    EXPECT_LE(camera.distanceMm, HandCamera::kMaxDistanceMm);
  }
  HandCamera camera = looking(0.0, 0.0);
  camera.zoom(2.0, {400.0, 300.0}, kSize);
  EXPECT_NEAR(camera.distanceMm, 250.0, 1e-9);
  camera.zoom(0.5, {400.0, 300.0}, kSize);
  EXPECT_TRUE(camera.eyeMm().isApprox(looking(0.0, 0.0).eyeMm()));
}

TEST(HandCamera, FitShowsAllPointsWhateverTheShape) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-180.0, 180.0), mm(-100.0, 100.0), part(0.3, 1.0);
  for (const double aspect : {0.2, 0.6, 1.0, 4.0 / 3.0, 2.5, 6.0})
    for (int i = 0; i < 40; ++i) {
      std::vector<Eigen::Vector3d> points;
      const Eigen::Vector3d stretch(part(random), part(random), part(random));
      for (int k = 0; k < 30; ++k)
        points.push_back(Eigen::Vector3d(mm(random), mm(random), mm(random)).cwiseProduct(stretch));
      HandCamera camera = looking(angle(random), angle(random) / 2.1);
      const HandCamera before = camera;
      camera.fit(points, aspect);
      EXPECT_EQ(camera.azimuthDeg, before.azimuthDeg);
      EXPECT_EQ(camera.elevationDeg, before.elevationDeg);
      const QSizeF size(600.0 * aspect, 600.0);
      double largest = 0.0;  // of the half width or height that the points reach
      for (const Eigen::Vector3d& point : points) {
        const QPointF at = seen(camera, point, size);
        EXPECT_TRUE(QRectF(QPointF(), size).contains(at));
        largest = std::max({largest,
                            std::abs(at.x() / size.width() - 0.5) * 2.0,
                            std::abs(at.y() / size.height() - 0.5) * 2.0});
      }
      EXPECT_LT(largest, 0.95) << "no margin";
      EXPECT_GT(largest, 0.85) << "too far away";
    }
}

// arrays A15: four taxels of 5 mm.
TEST(HandCamera, FitLeavesRoomAroundASmallSensor) {
  HandCamera camera = looking(0.0, 90.0);
  const std::vector<Eigen::Vector3d> corners = {
      {-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {5.0, 5.0, 0.0}, {-5.0, 5.0, 0.0}};
  camera.fit(corners, kSize.width() / kSize.height());
  for (const Eigen::Vector3d& corner : corners)
    EXPECT_NEAR(std::abs(seen(camera, corner).y() / kSize.height() - 0.5), 0.25, 0.01);
}

TEST(HandCamera, FitCopesWithOnePointALineAndNothing) {
  HandCamera camera = looking(15.0, 40.0);
  const HandCamera before = camera;
  camera.fit({}, 1.0);
  EXPECT_EQ(camera, before);
  camera.fit({{kNan, 0.0, 0.0}}, 1.0);
  EXPECT_EQ(camera, before);
  camera.fit({{5.0, 6.0, 7.0}}, 1.0);
  expectNear(seen(camera, {5.0, 6.0, 7.0}), {400.0, 300.0}, 1e-6);
  // Two points on the line of sight: the nearer one isn't cut off by the near plane.
  const Eigen::Vector3d towards = camera.eyeFromBase().row(2).transpose();
  camera.fit({{0.0, 0.0, 0.0}, 900.0 * towards}, 0.5);
  EXPECT_TRUE(camera.project({0.0, 0.0, 0.0}, kSize));
  EXPECT_TRUE(camera.project(900.0 * towards, kSize));
  camera.fit({{0.0, 0.0, 0.0}, {1e9, 1e9, 1e9}}, 1.0);
  EXPECT_LE(camera.distanceMm, HandCamera::kMaxDistanceMm);
  EXPECT_TRUE(isFinite(camera, kSize));
}

TEST(HandCamera, WhatIsNoNumberNeverSpreads) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300}) {
    HandCamera broken;
    broken.targetMm = {bad, bad, bad};
    broken.azimuthDeg = broken.elevationDeg = broken.distanceMm = broken.fieldDeg = bad;
    for (const QSizeF& size : {kSize, QSizeF(0.0, 0.0), QSizeF(-1.0, 5.0), QSizeF(bad, bad)}) {
      EXPECT_TRUE(isFinite(broken, size));
      HandCamera camera;
      camera.orbit({bad, bad}, size.height());
      camera.pan({bad, bad}, size.height());
      camera.zoom(bad, {bad, bad}, size);
      camera.zoom(0.0, {bad, bad}, size);
      camera.zoom(-1.0, {1.0, 1.0}, size);
      camera.fit({{bad, bad, bad}, {1.0, 2.0, 3.0}}, bad);
      EXPECT_TRUE(isFinite(camera, kSize)) << bad;
      broken.orbit({1.0, 1.0}, 100.0);
      EXPECT_TRUE(std::isfinite(broken.azimuthDeg) && std::isfinite(broken.distanceMm));
    }
  }
  HandCamera pole = looking(0.0, 90.0);
  EXPECT_EQ(pole.inRange().elevationDeg, 89.0);
  EXPECT_TRUE(isFinite(pole, kSize));
}

}  // namespace
}  // namespace palpate::gui::hand_camera_test
