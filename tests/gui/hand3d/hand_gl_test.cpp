// OpenGL as it is here, a graphics card or Mesa's software; skipped where there is none.
#include "gui/hand3d/hand_gl.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <cmath>
#include <limits>

#include "gui/hand3d/gl_probe.h"
#include "gui/hand3d/hand_raster.h"
#include "gui/hand3d/sample_scene.h"
#include "testing/testing.h"

namespace palpate::gui::hand_gl_test {
namespace {

constexpr QSizeF kSize(400.0, 300.0);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

QSurfaceFormat formatOf(int major, int minor, QSurfaceFormat::OpenGLContextProfile profile) {
  QSurfaceFormat format;
  format.setVersion(major, minor);
  format.setProfile(profile);
  return format;
}

class HandGlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const QString why = openGlProblem(); !why.isEmpty())
      PALPATE_CANNOT_SHOW("no OpenGL here: " << why.toStdString());
    use(formatOf(3, 3, QSurfaceFormat::CoreProfile));
  }
  void TearDown() override {
    if (context_) gl_.release();
  }
  void use(const QSurfaceFormat& format) {
    surface_ = std::make_unique<QOffscreenSurface>();
    surface_->setFormat(format);
    surface_->create();
    context_ = std::make_unique<QOpenGLContext>();
    context_->setFormat(format);
    ASSERT_TRUE(context_->create());
    ASSERT_TRUE(context_->makeCurrent(surface_.get()));
  }
  QImage drawn(const HandScene& scene,
               const HandCamera& camera,
               const QSizeF& size = kSize,
               double pixelRatio = 1.0) {
    QOpenGLFramebufferObjectFormat format;
    format.setAttachment(QOpenGLFramebufferObject::Depth);
    format.setSamples(4);
    const QSize pixels = (size * pixelRatio).toSize();
    QOpenGLFramebufferObject target(pixels, format);
    EXPECT_TRUE(target.bind());
    gl_.draw(scene, camera, size, pixelRatio);
    EXPECT_EQ(context_->functions()->glGetError(), GLenum{GL_NO_ERROR});
    return target.toImage().convertToFormat(QImage::Format_RGB32);
  }

  HandGl gl_;
  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
};

struct Difference {
  double mean = 0.0;  // of the channels, of 255
  double part = 0.0;  // of the pixels that are further off than 40 in some channel
};

Difference differenceOf(const QImage& a, const QImage& b) {
  Difference difference;
  EXPECT_EQ(a.size(), b.size());
  if (a.size() != b.size()) return {.mean = 255.0, .part = 1.0};
  const double numPixels = static_cast<double>(a.width()) * a.height();
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      const int red = std::abs(qRed(p) - qRed(q)), green = std::abs(qGreen(p) - qGreen(q)),
                blue = std::abs(qBlue(p) - qBlue(q));
      difference.mean += (red + green + blue) / (3.0 * numPixels);
      difference.part += std::max({red, green, blue}) > 40 ? 1.0 / numPixels : 0.0;
    }
  return difference;
}

TEST_F(HandGlTest, DrawsWhatTheRasteriserDraws) {
  ASSERT_EQ(gl_.initialize(), QString());
  const HandScene scene = samples::sampleScene();
  for (const double distanceMm : {640.0, 260.0, 120.0}) {
    HandCamera camera = samples::sampleCamera();
    camera.distanceMm = distanceMm;
    for (const double elevationDeg : {18.0, 80.0, -35.0}) {
      camera.elevationDeg = elevationDeg;
      const Difference difference = differenceOf(
          drawn(scene, camera), rasterize(scene, camera, kSize, 1.0, RasterQuality::kScreen));
      EXPECT_LT(difference.mean, 1.0) << distanceMm << " mm, " << elevationDeg << " degrees";
      EXPECT_LT(difference.part, 0.008) << distanceMm << " mm, " << elevationDeg << " degrees";
    }
  }
  // The measure tells pictures apart.
  HandCamera turned = samples::sampleCamera();
  turned.azimuthDeg += 3.0;
  EXPECT_GT(
      differenceOf(drawn(scene, turned), rasterize(scene, samples::sampleCamera(), kSize)).mean,
      1.5);
}

TEST_F(HandGlTest, ColorsAreExactWhereASurfaceIs) {
  ASSERT_EQ(gl_.initialize(), QString());
  samples::SceneMaker make;
  make.scene.background = qRgb(11, 22, 33);
  make.box({0, 0, 95}, {40, 40, 40}, qRgb(200, 120, 60));
  HandCamera camera = samples::sampleCamera();
  camera.azimuthDeg = 0.0;
  camera.elevationDeg = 0.0;
  const QImage image = drawn(make.scene, camera);
  EXPECT_EQ(image.pixel(0, 0), qRgb(11, 22, 33));
  const QRgb expected =
      litColor(qRgb(200, 120, 60), Eigen::Vector3f::UnitX(), camera.eyeFromBase().cast<float>());
  const QRgb seen = image.pixel(200, 150);
  EXPECT_NEAR(qRed(seen), qRed(expected), 1);
  EXPECT_NEAR(qGreen(seen), qGreen(expected), 1);
  EXPECT_NEAR(qBlue(seen), qBlue(expected), 1);
}

TEST_F(HandGlTest, OddScenesAreDrawnToo) {
  ASSERT_EQ(gl_.initialize(), QString());
  HandScene scene;
  scene.background = qRgb(1, 2, 3);
  const HandCamera camera = samples::sampleCamera();
  EXPECT_EQ(drawn(scene, camera).pixel(200, 150), qRgb(1, 2, 3)) << "empty";

  samples::SceneMaker make;
  make.box({0, 0, 95}, {40, 40, 40}, qRgb(0, 250, 0));
  const QImage expected = drawn(make.scene, camera);
  // What is not a number is left out, and nothing else; so is what is no whole triangle.
  HandScene broken;
  broken.solid = {{.positionMm = {kNan, 0, 0}, .color = qRgb(255, 0, 0)},
                  {.positionMm = {0, 300, 300}, .color = qRgb(255, 0, 0)},
                  {.positionMm = {0, -300, 300}, .color = qRgb(255, 0, 0)}};
  broken.clear = broken.solid;
  broken.solid.insert(broken.solid.end(), make.scene.solid.begin(), make.scene.solid.end());
  broken.solid.push_back({.positionMm = {0, 0, 0}, .color = 0});
  broken.lines.push_back({.fromMm = {kNan, 0, 0}, .toMm = {0, 0, 0}, .color = 0});
  broken.points.push_back({.atMm = {0, kNan, 0}, .color = 0});
  EXPECT_EQ(drawn(broken, camera), expected);
  // Huge, and with a normal that is not a number: the picture is full of it.
  samples::SceneMaker huge;
  huge.box({0, 0, 0}, {1e5F, 1e5F, 10}, qRgb(90, 90, 90));
  for (SceneVertex& vertex : huge.scene.solid) vertex.normal = {kNan, kNan, kNan};
  HandCamera above = camera;
  above.elevationDeg = 89.0;
  EXPECT_EQ(drawn(huge.scene, above).pixel(5, 5), qRgb(90, 90, 90));
  // A picture smaller than a pixel, or none.
  EXPECT_FALSE(drawn(make.scene, camera, {1.0, 1.0}).isNull());
  gl_.draw(make.scene, camera, {0.0, 0.0});
  EXPECT_EQ(context_->functions()->glGetError(), GLenum{GL_NO_ERROR});
}

TEST_F(HandGlTest, PixelsOfAFineScreen) {
  ASSERT_EQ(gl_.initialize(), QString());
  const HandScene scene = samples::sampleScene();
  const HandCamera camera = samples::sampleCamera();
  const Difference difference =
      differenceOf(drawn(scene, camera, kSize, 2.0),
                   rasterize(scene, camera, kSize, 2.0, RasterQuality::kScreen));
  EXPECT_LT(difference.mean, 1.0);
}

TEST_F(HandGlTest, LeavesTheContextAsOthersExpectIt) {
  ASSERT_EQ(gl_.initialize(), QString());
  drawn(samples::sampleScene(), samples::sampleCamera());
  QOpenGLFunctions& gl = *context_->functions();
  EXPECT_FALSE(gl.glIsEnabled(GL_DEPTH_TEST));
  EXPECT_FALSE(gl.glIsEnabled(GL_CULL_FACE));
  EXPECT_FALSE(gl.glIsEnabled(GL_BLEND));
  GLint bound = -1;
  gl.glGetIntegerv(GL_CURRENT_PROGRAM, &bound);
  EXPECT_EQ(bound, 0);
  gl.glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &bound);
  EXPECT_EQ(bound, 0);
  GLboolean writes = GL_FALSE;
  gl.glGetBooleanv(GL_DEPTH_WRITEMASK, &writes);
  EXPECT_TRUE(writes);
}

TEST_F(HandGlTest, GoesOnInAnotherContext) {
  const HandScene scene = samples::sampleScene();
  ASSERT_EQ(gl_.initialize(), QString());
  const QImage expected = drawn(scene, samples::sampleCamera());
  gl_.release();
  gl_.release();
  EXPECT_FALSE(gl_.canDraw());
  use(formatOf(3, 3, QSurfaceFormat::CoreProfile));
  EXPECT_NE(drawn(scene, samples::sampleCamera()), expected) << "drew without a context of its own";
  ASSERT_EQ(gl_.initialize(), QString());
  EXPECT_TRUE(gl_.canDraw());
  EXPECT_EQ(drawn(scene, samples::sampleCamera()), expected);
}

TEST_F(HandGlTest, SaysWhyItCantDraw) {
  context_->doneCurrent();
  EXPECT_EQ(gl_.initialize(), "there is no OpenGL context");
  EXPECT_FALSE(gl_.canDraw());
  use(formatOf(2, 1, QSurfaceFormat::NoProfile));
  if (context_->format().version() < std::pair(3, 3)) {
    EXPECT_TRUE(gl_.initialize().startsWith("the driver offers OpenGL "));
    EXPECT_FALSE(gl_.canDraw());
    gl_.draw(samples::sampleScene(), samples::sampleCamera(), kSize);
  }
}

}  // namespace
}  // namespace palpate::gui::hand_gl_test
