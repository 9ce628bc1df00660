#include "gui/hand3d/hand_scene.h"

#include <QImage>
#include <QPainter>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "testing/testing.h"

namespace palpate::gui::hand_scene_test {
namespace {

constexpr QSizeF kSize(800.0, 600.0);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

HandCamera fromX() {
  HandCamera camera;
  camera.targetMm = {0.0, 0.0, 0.0};
  camera.azimuthDeg = 0.0;
  camera.elevationDeg = 0.0;
  camera.distanceMm = 500.0;
  return camera;
}

QPointF pixelOf(const ClipVertex& vertex) {
  const double w = static_cast<double>(vertex.clip[3]);
  return {0.5 * kSize.width() * (1.0 + static_cast<double>(vertex.clip[0]) / w),
          0.5 * kSize.height() * (1.0 - static_cast<double>(vertex.clip[1]) / w)};
}

QRectF boundsOf(const std::vector<ClipVertex>& vertices) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const ClipVertex& vertex : vertices) {
    const QPointF at = pixelOf(vertex);
    left = std::min(left, at.x());
    right = std::max(right, at.x());
    top = std::min(top, at.y());
    bottom = std::max(bottom, at.y());
  }
  return {QPointF(left, top), QPointF(right, bottom)};
}

std::vector<ClipVertex> drawn(const HandScene& scene, const HandCamera& camera = fromX()) {
  std::vector<ClipVertex> out;
  appendLinesAndPoints(scene, camera, kSize, out);
  EXPECT_EQ(out.size() % 3, 0u);
  for (const ClipVertex& vertex : out)
    for (const float value : vertex.clip) EXPECT_TRUE(std::isfinite(value));
  return out;
}

TEST(HandScene, ClearAllLeavesNothingButMemory) {
  HandScene scene;
  scene.solid.resize(30);
  scene.clear.resize(3);
  scene.lines.resize(2);
  scene.points.resize(1);
  scene.labels.push_back({{0, 0, 0}, "a", Qt::red});
  scene.background = qRgb(1, 2, 3);
  scene.clearAll();
  EXPECT_TRUE(scene.solid.empty() && scene.clear.empty() && scene.lines.empty() &&
              scene.points.empty() && scene.labels.empty());
  EXPECT_EQ(scene.background, 0u);
  EXPECT_GE(scene.solid.capacity(), 30u);
}

TEST(HandScene, LightIsAmbientAndDiffuse) {
  const Eigen::Matrix3f eye = fromX().eyeFromBase().cast<float>();
  const QRgb gray = qRgba(200, 100, 50, 77);
  // A surface across the light: ambient only. One that faces it: 0.38 + 0.66 of the colour, no more
  // than 255.
  const Eigen::Vector3f across = kTowardsLight.cross(Eigen::Vector3f::UnitX()).normalized();
  EXPECT_EQ(litColor(gray, eye.transpose() * across, eye), qRgba(76, 38, 19, 77));
  EXPECT_EQ(litColor(gray, eye.transpose() * kTowardsLight, eye), qRgba(208, 104, 52, 77));
  EXPECT_EQ(litColor(gray, -(eye.transpose() * kTowardsLight), eye), qRgba(208, 104, 52, 77));
  EXPECT_EQ(litColor(qRgb(255, 255, 255), eye.transpose() * kTowardsLight, eye),
            qRgb(255, 255, 255));
  // Towards the eye (from +x): kTowardsLight.z is 0.7587 of its length, 0.38 + 0.66 * 0.7587 =
  // 0.8807.
  EXPECT_EQ(litColor(gray, Eigen::Vector3f::UnitX(), eye), qRgba(176, 88, 44, 77));
  // Not lit at all.
  EXPECT_EQ(litColor(gray, Eigen::Vector3f::Zero(), eye), gray);
  EXPECT_EQ(litColor(gray, {kNan, 0, 0}, eye), gray);
}

TEST(HandScene, ALineIsAsWideAsItSays) {
  HandScene scene;
  scene.lines.push_back(
      {.fromMm = {0, -50, 0}, .toMm = {0, 50, 0}, .widthPx = 4.0F, .color = qRgb(9, 8, 7)});
  const auto vertices = drawn(scene);
  ASSERT_EQ(vertices.size(), 6u);
  for (const ClipVertex& vertex : vertices) EXPECT_EQ(vertex.color, qRgb(9, 8, 7));
  const QRectF bounds = boundsOf(vertices);
  const double half = 50.0 * fromX().pxPerMm(kSize.height());
  EXPECT_NEAR(bounds.height(), 4.0, 1e-3);
  EXPECT_NEAR(bounds.center().y(), 300.0, 1e-3);
  EXPECT_NEAR(bounds.left(), 400.0 - half - 2.0, 1e-2) << "half a width longer";
  EXPECT_NEAR(bounds.right(), 400.0 + half + 2.0, 1e-2);
}

TEST(HandScene, APointIsADiscOfItsRadius) {
  HandScene scene;
  scene.points.push_back({.atMm = {0, 20, 10}, .radiusPx = 5.0F, .color = qRgb(1, 1, 1)});
  const QRectF bounds = boundsOf(drawn(scene));
  const QPointF middle = fromX().project({0, 20, 10}, kSize)->at;
  EXPECT_NEAR(bounds.center().x(), middle.x(), 0.2);
  EXPECT_NEAR(bounds.center().y(), middle.y(), 0.2);
  EXPECT_NEAR(bounds.width(), 10.0, 0.3);
  EXPECT_NEAR(bounds.height(), 10.0, 0.3);
}

TEST(HandScene, IsDrawnALittleNearerThanItIs) {
  HandScene scene;
  scene.lines.push_back({.fromMm = {0, -50, 0}, .toMm = {0, 50, 0}, .color = 0});
  scene.points.push_back({.atMm = {0, 0, 0}, .color = 0});
  const double aspect = kSize.width() / kSize.height();
  const Eigen::Vector4d surface = fromX().clipFromBase(aspect) * Eigen::Vector4d(0, 0, 0, 1);
  const Eigen::Vector4d before = fromX().clipFromBase(aspect) * Eigen::Vector4d(10, 0, 0, 1);
  for (const ClipVertex& vertex : drawn(scene)) {
    const double depth = static_cast<double>(vertex.clip[2] / vertex.clip[3]);
    EXPECT_LT(depth, surface.z() / surface.w());
    EXPECT_GT(depth, before.z() / before.w()) << "nearer by a centimetre is too much";
  }
}

TEST(HandScene, ALineThatPassesTheEyeIsCut) {
  HandScene scene;
  scene.lines.push_back({.fromMm = {-100, 5, 3}, .toMm = {2000, 5, 3}, .color = 0});
  scene.lines.push_back({.fromMm = {2000, 5, 3}, .toMm = {-100, 5, 3}, .color = 0});
  const auto vertices = drawn(scene);
  ASSERT_EQ(vertices.size(), 12u);
  for (const ClipVertex& vertex : vertices) {
    EXPECT_GE(static_cast<double>(vertex.clip[3]), fromX().nearMm());
    EXPECT_GE(vertex.clip[2], -vertex.clip[3]) << "in front of the near plane";
  }
  scene.lines = {{.fromMm = {600, 0, 0}, .toMm = {900, 0, 0}, .color = 0}};
  EXPECT_TRUE(drawn(scene).empty()) << "all of it is behind the eye";
}

TEST(HandScene, SkipsWhatIsNoNumberOrHasNoSize) {
  HandScene scene;
  scene.lines.push_back({.fromMm = {kNan, 0, 0}, .toMm = {0, 0, 0}, .color = 0});
  scene.lines.push_back({.fromMm = {0, 0, 0}, .toMm = {0, 9, 0}, .widthPx = 0.0F, .color = 0});
  scene.lines.push_back({.fromMm = {0, 0, 0}, .toMm = {0, 9, 0}, .widthPx = kNan, .color = 0});
  scene.points.push_back({.atMm = {0, kNan, 0}, .color = 0});
  scene.points.push_back({.atMm = {0, 0, 0}, .radiusPx = -1.0F, .color = 0});
  scene.points.push_back({.atMm = {900, 0, 0}, .color = 0});
  EXPECT_TRUE(drawn(scene).empty());
  // A line along the line of sight is a dot.
  scene.lines = {{.fromMm = {0, 0, 0}, .toMm = {50, 0, 0}, .widthPx = 2.0F, .color = 0}};
  EXPECT_EQ(drawn(scene).size(), 6u);
  std::vector<ClipVertex> out;
  appendLinesAndPoints(scene, fromX(), {0.0, 0.0}, out);
  EXPECT_TRUE(out.empty());
}

class HandLabelsTest : public ::testing::Test {
 protected:
  QImage painted(const std::vector<SceneLabel>& labels, QColor ground) {
    QImage image(kSize.toSize(), QImage::Format_RGB32);
    image.fill(ground);
    HandScene scene;
    scene.background = qRgb(0, 0, 0);
    scene.labels = labels;
    QPainter painter(&image);
    paintLabels(painter, scene, fromX(), kSize);
    return image;
  }
  // Where the picture isn't the ground.
  QRect touched(const QImage& image, QColor ground) {
    QRect bounds;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (image.pixel(x, y) != ground.rgb()) bounds |= QRect(x, y, 1, 1);
    return bounds;
  }
};

TEST_F(HandLabelsTest, AreReadOnAnyGround) {
  // White words with a dark rim on white: both are there.
  const QImage image = painted({{{0, 0, 0}, "62 mm", Qt::white}}, Qt::white);
  int dark = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) dark += qGray(image.pixel(x, y)) < 80;
  EXPECT_GT(dark, 40);
  const QImage onBlack = painted({{{0, 0, 0}, "62 mm", Qt::white}}, Qt::black);
  int light = 0;
  for (int y = 0; y < onBlack.height(); ++y)
    for (int x = 0; x < onBlack.width(); ++x) light += qGray(onBlack.pixel(x, y)) > 180;
  EXPECT_GT(light, 40);
}

TEST_F(HandLabelsTest, ManyAtOnePlaceAreAllRead) {
  const auto numLike = [](const QImage& image, QColor color) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor at = image.pixelColor(x, y);
        count += std::abs(at.red() - color.red()) < 100 &&
                 std::abs(at.green() - color.green()) < 100 &&
                 std::abs(at.blue() - color.blue()) < 100;
      }
    return count;
  };
  std::vector<SceneLabel> labels;
  for (const QColor& color : {QColor(Qt::red),
                              QColor(Qt::green),
                              QColor(Qt::blue),
                              QColor(Qt::yellow),
                              QColor(Qt::cyan),
                              QColor(Qt::magenta),
                              QColor(Qt::white)})
    labels.push_back({{0, 0, 0}, "slip 1.2 mm", color});
  const QImage image = painted(labels, Qt::black);
  for (const SceneLabel& label : labels) {
    const int alone = numLike(painted({label}, Qt::black), label.color);
    ASSERT_GT(alone, 50);
    EXPECT_GT(numLike(image, label.color), alone * 7 / 10) << label.color.name().toStdString();
  }
}

TEST_F(HandLabelsTest, AWideOneHasLines) {
  const QString part = QString("a part of it ").repeated(6);
  const QRect line = touched(painted({{{0, 0, 0}, part, Qt::white}}, Qt::gray), Qt::gray);
  const QRect whole = touched(
      painted({{{0, 0, 0}, part + ", " + part + ", " + part, Qt::white}}, Qt::gray), Qt::gray);
  EXPECT_GE(whole.left(), 1);
  EXPECT_LT(whole.right(), 799);
  EXPECT_GT(whole.height(), 2 * line.height());
}

TEST_F(HandLabelsTest, StandBesideTheirPlaceAndInThePicture) {
  const QRect middle = touched(painted({{{0, 0, 0}, "finger", Qt::white}}, Qt::gray), Qt::gray);
  EXPECT_GT(middle.left(), 400);
  EXPECT_LT(middle.left(), 415);
  EXPECT_NEAR(middle.center().y(), 300, 6);
  // At the right edge there is room on the left only.
  const double edgeMm = 390.0 / fromX().pxPerMm(kSize.height());
  const QRect right = touched(painted({{{0, edgeMm, 0}, "finger", Qt::white}}, Qt::gray), Qt::gray);
  EXPECT_LT(right.right(), 792);
  EXPECT_NEAR(right.width(), middle.width(), 1);
}

TEST_F(HandLabelsTest, DontCoverEachOther) {
  const QRect one = touched(painted({{{0, 0, 0}, "first", Qt::white}}, Qt::gray), Qt::gray);
  const QImage both =
      painted({{{0, 0, 0}, "first", Qt::white}, {{-1, 0, 0}, "second", Qt::red}}, Qt::gray);
  for (int y = one.top(); y <= one.bottom(); ++y)
    for (int x = one.left() + 3; x <= one.right() - 3; ++x)
      ASSERT_LE(qRed(both.pixel(x, y)) - qGreen(both.pixel(x, y)), 40)
          << "the second stands on the first at " << x << ", " << y;
  EXPECT_LT(touched(both, Qt::gray).left(), 400) << "the second isn't there";
}

TEST_F(HandLabelsTest, OutOfSightAreNotPainted) {
  EXPECT_TRUE(touched(painted({{{900, 0, 0}, "behind", Qt::white},
                               {{0, 1000, 0}, "beside", Qt::white},
                               {{0, 0, 0}, "", Qt::white}},
                              Qt::gray),
                      Qt::gray)
                  .isNull());
}

}  // namespace
}  // namespace palpate::gui::hand_scene_test
