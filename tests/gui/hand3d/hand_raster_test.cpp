#include "gui/hand3d/hand_raster.h"

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <palpate/core/error.h>

#include "gui/hand3d/sample_scene.h"
#include "testing/testing.h"

namespace palpate::gui::hand_raster_test {
namespace {

constexpr QSizeF kSize(200.0, 150.0);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Eigen::Vector3f kUnlit = Eigen::Vector3f::Zero();
const QRgb kBlack = qRgb(0, 0, 0), kRed = qRgb(250, 0, 0), kGreen = qRgb(0, 250, 0);

// From +x on the plane x = 0: y to the right, z up, a mm is a pixel.
HandCamera onePxPerMm() {
  HandCamera camera;
  camera.targetMm = {0.0, 0.0, 0.0};
  camera.azimuthDeg = 0.0;
  camera.elevationDeg = 0.0;
  camera.distanceMm = 0.5 * kSize.height() / std::tan(camera.fieldDeg * std::numbers::pi / 360.0);
  return camera;
}

struct Maker : samples::SceneMaker {
  Maker() { scene.background = kBlack; }
  // Of a plane across the line of sight, nearer to the eye by xMm.
  void rectangle(float xMm, float fromY, float toY, float fromZ, float toZ, QRgb color) {
    quad({Eigen::Vector3f(xMm, fromY, fromZ),
          Eigen::Vector3f(xMm, toY, fromZ),
          Eigen::Vector3f(xMm, toY, toZ),
          Eigen::Vector3f(xMm, fromY, toZ)},
         kUnlit,
         color);
  }
  void flat(const std::array<Eigen::Vector3f, 3>& mm, QRgb color) {
    triangle(scene.solid, mm, {kUnlit, kUnlit, kUnlit}, color);
  }
  void moveToClear() {
    scene.clear.insert(scene.clear.end(), scene.solid.begin(), scene.solid.end());
    scene.solid.clear();
  }
};

QImage drawn(const HandScene& scene,
             const HandCamera& camera = onePxPerMm(),
             RasterQuality quality = RasterQuality::kScreen) {
  return rasterize(scene, camera, kSize, 1.0, quality);
}

// Of a point of the plane x = 0 [mm].
QRgb at(const QImage& image, double y, double z) {
  return image.pixel(static_cast<int>(0.5 * kSize.width() + y),
                     static_cast<int>(0.5 * kSize.height() - z));
}

// How much of the picture is red [pixels].
double redPixels(const QImage& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += qRed(image.pixel(x, y)) / 250.0;
  return sum;
}

TEST(HandRaster, AnEmptySceneIsItsBackground) {
  HandScene scene;
  scene.background = qRgb(10, 20, 30);
  const QImage image = drawn(scene);
  EXPECT_EQ(image.size(), QSize(200, 150));
  EXPECT_EQ(image.format(), QImage::Format_RGB32);
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x) ASSERT_EQ(image.pixel(x, y), qRgb(10, 20, 30));
}

TEST(HandRaster, ATriangleCoversItsArea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> y(-90.0F, 90.0F), z(-70.0F, 70.0F);
  for (int i = 0; i < 50; ++i) {
    Maker make;
    const std::array<Eigen::Vector3f, 3> mm = {Eigen::Vector3f(0, y(random), z(random)),
                                               Eigen::Vector3f(0, y(random), z(random)),
                                               Eigen::Vector3f(0, y(random), z(random))};
    make.flat(mm, kRed);
    const double area = 0.5 * static_cast<double>((mm[1] - mm[0]).cross(mm[2] - mm[0]).norm());
    const double screen = redPixels(drawn(make.scene));
    const double picture = redPixels(drawn(make.scene, onePxPerMm(), RasterQuality::kPicture));
    EXPECT_NEAR(screen, area, 0.01 * area + 3.0);
    EXPECT_NEAR(picture, area, 0.004 * area + 1.5);
  }
}

TEST(HandRaster, APixelHalfCoveredIsHalf) {
  Maker make;
  make.rectangle(0, -20.5F, 20.25F, -10.0F, 10.0F, qRgb(200, 200, 200));
  const QImage screen = drawn(make.scene);
  EXPECT_EQ(qRed(at(screen, -21, 0)), 100);
  EXPECT_EQ(qRed(at(screen, 20, 0)), 50);
  EXPECT_EQ(qRed(at(screen, -20, 0)), 200);
  EXPECT_EQ(qRed(at(screen, 0, 9.5)), 200);
  EXPECT_EQ(qRed(at(screen, 0, 10.5)), 0);
}

TEST(HandRaster, AnEdgeHasManySteps) {
  Maker make;
  make.flat({Eigen::Vector3f(0, -80, -40), {0, 80, -40}, {0, 80, -9.3F}}, kRed);
  const auto levels = [&](RasterQuality quality) {
    std::set<int> found;
    const QImage image = drawn(make.scene, onePxPerMm(), quality);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) found.insert(qRed(image.pixel(x, y)));
    return found.size();
  };
  EXPECT_EQ(levels(RasterQuality::kScreen), 5u);
  EXPECT_EQ(levels(RasterQuality::kPicture), 17u);
}

// Half transparent: a sample drawn twice is brighter, one left out is dark.
TEST(HandRaster, NeighboursLeaveNoGapAndDontOverlap) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> move(-0.22F, 0.22F);
  for (int run = 0; run < 4; ++run) {
    constexpr int kCells = 14;
    std::array<std::array<Eigen::Vector3f, kCells + 1>, kCells + 1> grid;
    for (int i = 0; i <= kCells; ++i)
      for (int k = 0; k <= kCells; ++k) {
        const bool edge = i == 0 || k == 0 || i == kCells || k == kCells;
        const float cell = 9.0F;
        grid[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = {
            edge ? 0.0F : 9.0F * move(random),
            cell * (static_cast<float>(i) - 7.0F + (edge ? 0.0F : move(random))),
            cell * (static_cast<float>(k) - 7.0F + (edge ? 0.0F : move(random)))};
      }
    Maker make;
    for (std::size_t i = 0; i < kCells; ++i)
      for (std::size_t k = 0; k < kCells; ++k) {
        const auto& a = grid[i][k];
        const auto& b = grid[i + 1][k];
        const auto& c = grid[i + 1][k + 1];
        const auto& d = grid[i][k + 1];
        make.flat({a, b, c}, qRgba(200, 200, 200, 128));
        make.flat({a, c, d}, qRgba(200, 200, 200, 128));
      }
    make.moveToClear();
    HandCamera camera = onePxPerMm();
    if (run > 1) camera.distanceMm *= 0.31;  // the edges of the picture cut it
    const QImage image = drawn(make.scene, camera);
    const int once = qRed(image.pixel(100, 75));
    EXPECT_NEAR(once, 100, 1) << "half of 200 on black";
    for (int y = 14; y < 136; ++y)
      for (int x = 40; x < 160; ++x) ASSERT_EQ(qRed(image.pixel(x, y)), once) << x << ", " << y;
  }
}

// Strips whose edges go through samples exactly (sixteenths of a pixel, both ways and aslant).
TEST(HandRaster, ASampleOnALineBelongsToOneSide) {
  for (const bool upright : {true, false}) {
    Maker make;
    for (int i = -240; i < 240; ++i) {
      const float from = 0.1875F * static_cast<float>(i), to = from + 0.1875F;
      if (upright)
        make.rectangle(0, from, to, -45, 45, qRgba(200, 200, 200, 128));
      else
        make.rectangle(0, -45, 45, from, to, qRgba(200, 200, 200, 128));
    }
    make.moveToClear();
    const QImage image = drawn(make.scene);
    for (int y = 32; y < 118; ++y)
      for (int x = 57; x < 143; ++x) ASSERT_NEAR(qRed(image.pixel(x, y)), 100, 1) << x << ", " << y;
  }
}

TEST(HandRaster, TheNearerHidesTheFurtherInAnyOrder) {
  for (const bool nearFirst : {false, true}) {
    Maker make;
    if (nearFirst) make.rectangle(10, -20, 20, -20, 20, kRed);
    make.rectangle(0, -40, 40, -40, 40, kGreen);
    if (!nearFirst) make.rectangle(10, -20, 20, -20, 20, kRed);
    const QImage image = drawn(make.scene);
    EXPECT_EQ(at(image, 0, 0), kRed);
    EXPECT_EQ(at(image, 30, 0), kGreen);
    EXPECT_EQ(at(image, 60, 0), kBlack);
  }
}

TEST(HandRaster, SurfacesCutEachOtherWhereTheyMeet) {
  Maker make;
  make.rectangle(0, -50, 50, -50, 50, kGreen);
  // Comes out of it at y = 0, towards the right nearer.
  make.flat({Eigen::Vector3f(-50, -50, -20), {50, 50, -20}, {50, 50, 20}}, kRed);
  make.flat({Eigen::Vector3f(-50, -50, -20), {50, 50, 20}, {-50, -50, 20}}, kRed);
  const QImage image = drawn(make.scene);
  EXPECT_EQ(at(image, -2.5, 0), kGreen);
  EXPECT_EQ(at(image, 2.5, 0), kRed);
}

TEST(HandRaster, IsLitAsTheSceneSays) {
  Maker make;
  make.box({0, 0, 0}, {10, 20, 20}, qRgb(200, 100, 50));
  const HandCamera camera = onePxPerMm();
  const QRgb expected =
      litColor(qRgb(200, 100, 50), Eigen::Vector3f::UnitX(), camera.eyeFromBase().cast<float>());
  EXPECT_EQ(at(drawn(make.scene, camera), 0, 0), expected);
  // From behind: seen and lit as well.
  Maker turned;
  turned.flat({Eigen::Vector3f(0, -30, -30), {0, 0, 30}, {0, 30, -30}}, kRed);
  EXPECT_EQ(at(drawn(turned.scene), 0, 0), kRed);
}

TEST(HandRaster, ColorsRunFromCornerToCorner) {
  Maker make;
  make.flat({Eigen::Vector3f(0, -60, -40), {0, 60, -40}, {0, 60, 40}}, kBlack);
  make.scene.solid[1].color = qRgb(240, 0, 0);
  make.scene.solid[2].color = qRgb(240, 240, 0);
  const QImage image = drawn(make.scene);
  for (const double y : {-30.0, 0.0, 40.0}) {
    EXPECT_NEAR(qRed(at(image, y, -38)), 240.0 * (y + 60.5) / 120.0, 2.0) << y;
    EXPECT_NEAR(qGreen(at(image, y, -38)), 240.0 * 1.5 / 80.0, 2.0);
  }
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) ASSERT_EQ(qBlue(image.pixel(x, y)), 0);
}

TEST(HandRaster, WhatIsClearIsSeenThrough) {
  Maker back;  // faces away, further: first
  back.rectangle(-10, 40, -40, -40, 40, qRgba(0, 200, 0, 128));
  Maker make;
  make.rectangle(10, -40, 40, -40, 40, qRgba(200, 0, 0, 128));
  make.scene.solid.insert(make.scene.solid.end(), back.scene.solid.begin(), back.scene.solid.end());
  make.moveToClear();
  make.rectangle(0, 0, 60, -60, 60, qRgb(0, 0, 200));  // in between: hides the back
  make.scene.background = qRgb(100, 100, 100);
  const QImage image = drawn(make.scene);
  const auto expectNear = [](QRgb a, int red, int green, int blue) {
    EXPECT_NEAR(qRed(a), red, 2);
    EXPECT_NEAR(qGreen(a), green, 2);
    EXPECT_NEAR(qBlue(a), blue, 2);
  };
  // Half of the ground and the back, then half of that and the front.
  expectNear(at(image, -20, 0), 125, 75, 25);
  expectNear(at(image, 20, 0), 100, 0, 100);
  expectNear(at(image, 50, 0), 0, 0, 200);
  expectNear(at(image, -50, 0), 100, 100, 100);
}

TEST(HandRaster, LinesAndPointsLieOnSurfacesAndHideBehindThem) {
  Maker make;
  make.rectangle(0, -40, 40, -40, 40, kGreen);
  make.scene.lines.push_back(
      {.fromMm = {0, -60, 0}, .toMm = {0, 60, 0}, .widthPx = 4.0F, .color = kRed});
  make.scene.lines.push_back(
      {.fromMm = {-30, -80, 20}, .toMm = {-30, 80, 20}, .widthPx = 4.0F, .color = kRed});
  make.scene.points.push_back({.atMm = {0, 10, -20}, .radiusPx = 5.0F, .color = kRed});
  const QImage image = drawn(make.scene);
  EXPECT_EQ(at(image, 20, 0), kRed) << "on the surface";
  EXPECT_EQ(at(image, 50, 0), kRed) << "beside it";
  EXPECT_EQ(at(image, 20, 5), kGreen);
  EXPECT_EQ(at(image, 20, 18.2), kGreen) << "behind it";
  EXPECT_EQ(at(image, 55, 18.2), kRed);
  EXPECT_EQ(at(image, 10, -20), kRed);
  EXPECT_EQ(at(image, 16, -20), kGreen);
}

TEST(HandRaster, AFloorUnderTheEyeIsCutAtIt) {
  Maker make;  // 20 mm below the eye, far behind it and far ahead
  make.quad({Eigen::Vector3f(-3000, -3000, -20),
             {3000, -3000, -20},
             {3000, 3000, -20},
             {-3000, 3000, -20}},
            kUnlit,
            kRed);
  const QImage image = drawn(make.scene);
  // 20 mm below the eye, at most 3300 mm ahead: from about 2 pixels below the horizon down to the
  // edge.
  for (int x = 0; x < 200; x += 7) {
    for (int y = 0; y < 74; ++y) ASSERT_EQ(image.pixel(x, y), kBlack) << x << ", " << y;
    for (int y = 80; y < 150; ++y) ASSERT_EQ(image.pixel(x, y), kRed) << x << ", " << y;
  }
}

TEST(HandRaster, TheSameScaledIsTheSamePicture) {
  const HandScene scene = samples::sampleScene();
  const HandCamera camera = samples::sampleCamera();
  const QImage once = rasterize(scene, camera, {300.0, 220.0}, 1.0, RasterQuality::kPicture);
  const QImage twice = rasterize(scene, camera, {300.0, 220.0}, 2.0, RasterQuality::kPicture);
  EXPECT_EQ(twice.size(), QSize(600, 440));
  EXPECT_EQ(twice.devicePixelRatio(), 2.0);
  double difference = 0.0;
  for (int y = 0; y < once.height(); ++y)
    for (int x = 0; x < once.width(); ++x) {
      int green = 2;
      for (const int dy : {0, 1})
        for (const int dx : {0, 1}) green += qGreen(twice.pixel(2 * x + dx, 2 * y + dy));
      difference += std::abs(green / 4 - qGreen(once.pixel(x, y)));
    }
  EXPECT_LT(difference / (300.0 * 220.0), 0.5) << "mean over the picture, of 255";
}

TEST(HandRaster, AThingDoesntDependOnWhatWasDrawnBefore) {
  const HandScene scene = samples::sampleScene();
  const QImage expected = drawn(scene, samples::sampleCamera());
  HandRaster raster;
  HandCamera other = samples::sampleCamera();
  other.zoom(4.0, {20.0, 30.0}, kSize);
  raster.draw(scene, other, {333.0, 77.0}, 1.5, RasterQuality::kPicture);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(raster.draw(scene, samples::sampleCamera(), kSize, 1.0), expected);
}

TEST(HandRaster, VerticesThatAreNoNumbersAreLeftOut) {
  for (const float bad : {kNan, kInfinity, -kInfinity, 3e38F}) {
    Maker make;
    make.rectangle(0, -40, 40, -40, 40, kGreen);
    make.flat({Eigen::Vector3f(bad, -90, -90), {20, 90, -90}, {20, 0, 90}}, kRed);
    make.flat({Eigen::Vector3f(20, -90, -90), {20, bad, -90}, {20, 0, bad}}, kRed);
    make.scene.clear = make.scene.solid;
    make.scene.lines.push_back({.fromMm = {0, bad, 0}, .toMm = {0, 0, 0}, .color = kRed});
    make.scene.points.push_back({.atMm = {bad, 0, 0}, .color = kRed});
    const QImage image = drawn(make.scene);
    EXPECT_EQ(qBlue(at(image, 0, 0)), 0);
    EXPECT_EQ(image.pixel(0, 0), kBlack);
    if (!std::isfinite(bad)) {
      EXPECT_EQ(at(image, 0, 0), kGreen);
    }
  }
  Maker lit;  // a normal that is not a number doesn't hurt either
  lit.rectangle(0, -40, 40, -40, 40, kGreen);
  for (SceneVertex& vertex : lit.scene.solid) vertex.normal = {kNan, 0, 0};
  lit.scene.solid.resize(lit.scene.solid.size() - 1);  // no whole triangle at the end
  EXPECT_EQ(at(drawn(lit.scene), 10, -10), kGreen);
}

TEST(HandRaster, HugeThingsAndOddSizes) {
  Maker make;
  make.rectangle(0, -1e6F, 1e6F, -1e6F, 1e6F, kRed);
  make.flat({Eigen::Vector3f(0, 0, 0), {0, 1e-7F, 0}, {0, 0, 1e-7F}}, kGreen);
  for (const QSizeF& size : {QSizeF(1, 1), QSizeF(0.2, 0.2), QSizeF(31, 33), QSizeF(1000, 2)}) {
    const QImage image = rasterize(make.scene, onePxPerMm(), size);
    ASSERT_FALSE(image.isNull());
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) ASSERT_EQ(image.pixel(x, y), kRed);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const QSizeF& size : {QSizeF(0, 10), QSizeF(10, -1), QSizeF(nan, nan), QSizeF(1e9, 1e9)})
    EXPECT_TRUE(rasterize(make.scene, onePxPerMm(), size).isNull());
  EXPECT_TRUE(rasterize(make.scene, onePxPerMm(), {10, 10}, 0.0).isNull());
  EXPECT_TRUE(rasterize(make.scene, onePxPerMm(), {10, 10}, nan).isNull());
}

TEST(HandRaster, APictureOfTheLargestWidthIsDrawn) {
  Maker make;
  make.box({0, 0, 0}, {10, 60, 60}, kRed);
  const QImage image = rasterize(make.scene, onePxPerMm(), {16384, 150}, 1.0);
  EXPECT_EQ(image.size(), QSize(16384, 150));
  EXPECT_GT(qRed(image.pixel(8192, 75)), 200);
  EXPECT_EQ(image.pixel(8000, 75), kBlack);
  EXPECT_EQ(image.pixel(16383, 149), kBlack);
}

TEST(HandRaster, CanBeCancelled) {
  const HandScene scene = samples::sampleScene();
  int calls = 0;
  double last = -1.0;
  const auto all = [&](double fraction) {
    EXPECT_GT(fraction, last);
    EXPECT_LT(fraction, 1.0);
    last = fraction;
    ++calls;
    return true;
  };
  rasterize(scene, samples::sampleCamera(), kSize, 1.0, RasterQuality::kScreen, all);
  EXPECT_GE(calls, 3);
  HandRaster raster;
  EXPECT_THROW(raster.draw(scene,
                           samples::sampleCamera(),
                           kSize,
                           1.0,
                           RasterQuality::kScreen,
                           [](double fraction) { return fraction < 0.4; }),
               Cancelled);
  EXPECT_EQ(raster.draw(scene, samples::sampleCamera(), kSize),
            drawn(scene, samples::sampleCamera()));
}

// A picture that follows another one is the same as one that was drawn alone; only tiles whose
// triangles differ are drawn.
TEST(HandRaster, APictureAfterAnotherDrawsOnlyTheTilesThatChanged) {
  HandScene scene = samples::sampleScene();
  HandCamera camera = samples::sampleCamera();
  HandRaster raster;
  const auto expectSame = [&] {
    EXPECT_EQ(raster.draw(scene, camera, kSize),
              rasterize(scene, camera, kSize, 1.0, RasterQuality::kScreen));
  };
  expectSame();
  const std::size_t all = raster.numTilesDrawn();
  EXPECT_EQ(all, 7u * 5u);  // 200 x 150 pixels in tiles of 32 x 32
  expectSame();
  EXPECT_EQ(raster.numTilesDrawn(), 0u);
  // Another colour of one triangle: the tiles that it touches.
  for (std::size_t i = 0; i < 3; ++i) scene.solid[i].color ^= 0x404040U;
  expectSame();
  EXPECT_GT(raster.numTilesDrawn(), 0u);
  EXPECT_LT(raster.numTilesDrawn(), all);
  // One triangle fewer at the front: the others have other numbers, and look the same elsewhere.
  scene.solid.erase(scene.solid.begin(), scene.solid.begin() + 3);
  expectSame();
  EXPECT_LT(raster.numTilesDrawn(), all);
  // The background is in every tile, and a picture for a file uses none of this.
  scene.background ^= 0x101010U;
  expectSame();
  EXPECT_EQ(raster.numTilesDrawn(), all);
  EXPECT_EQ(raster.draw(scene, camera, kSize, 1.0, RasterQuality::kPicture),
            rasterize(scene, camera, kSize, 1.0, RasterQuality::kPicture));
  expectSame();
  EXPECT_EQ(raster.numTilesDrawn(), all);
  camera.orbit({5.0, 0.0}, kSize.height());
  expectSame();
  // A picture of another size, and one that was cancelled, leave nothing behind.
  EXPECT_EQ(raster.draw(scene, camera, kSize * 2.0),
            rasterize(scene, camera, kSize * 2.0, 1.0, RasterQuality::kScreen));
  EXPECT_THROW(
      raster.draw(
          scene, camera, kSize * 2.0, 1.0, RasterQuality::kScreen, [](double) { return false; }),
      Cancelled);
  expectSame();
}

}  // namespace
}  // namespace palpate::gui::hand_raster_test
