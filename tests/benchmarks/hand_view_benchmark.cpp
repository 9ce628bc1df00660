// Drawing a hand in 3-D at 800 x 600, about 5,000 triangles and 1,000 lines: target 16.7 ms (60
// Hz) on one core. OpenGL where a display is (`xvfb-run -a`); what Mesa draws on the processor it
// draws on all cores.
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>

#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"

#include "gui/hand3d/gl_probe.h"
#include "gui/hand3d/hand_gl.h"
#include "gui/hand3d/hand_raster.h"
#include "gui/hand3d/hand_scene_builder.h"
#include "gui/hand3d/sample_scene.h"
#include "window_bench.h"

namespace {
using namespace palpate::gui;

constexpr QSizeF kSize(800.0, 600.0);

// Without OpenGL. The hand turns, so that every picture is another one.
void handRaster(benchmark::State& state, RasterQuality quality, double distanceMm) {
  const HandScene scene = palpate::gui::samples::sampleScene();
  HandCamera camera = palpate::gui::samples::sampleCamera();
  camera.distanceMm = distanceMm;
  HandRaster raster;
  for (auto _ : state) {
    camera.orbit({5.0, 0.0}, kSize.height());
    benchmark::DoNotOptimize(raster.draw(scene, camera, kSize, 1.0, quality).constBits());
  }
  state.counters["triangles"] = static_cast<double>((scene.solid.size() + scene.clear.size()) / 3);
  state.counters["lines"] = static_cast<double>(scene.lines.size());
}

// The whole way of the window without OpenGL, one frame of a grasp after the other: pose, contact
// geometry, scene, picture.
void handRepaint(benchmark::State& state) {
  HandSceneBuilder drawing;
  drawing.setHand(palpate::sdh2(), true);
  palpate::TactileFrame frame(palpate::sdh2().layout);
  for (int y = 3; y < 9; ++y)
    for (int x = 0; x < 6; ++x) {
      frame.matrix(1)(y, x) = static_cast<float>(100 * (y + x));
      frame.matrix(5)(y, x) = static_cast<float>(60 * (y + x));
    }
  std::vector<double> anglesDeg = {90.0, -10.0, 3.0, -90.0, 0.0, -4.0, 3.0};
  HandLook look;
  look.range = {0.0, 1500.0};
  HandScene scene;
  HandRaster raster;
  HandCamera camera = drawing.usualCamera(look);
  drawing.setMoment(frame, anglesDeg);
  camera.fit(drawing.extent(look), kSize.width() / kSize.height());
  for (auto _ : state) {
    anglesDeg[1] = -10.0 + 0.01 * static_cast<double>(state.iterations() % 100);
    drawing.setMoment(frame, anglesDeg);
    drawing.fill(scene, look, camera);
    benchmark::DoNotOptimize(raster.draw(scene, camera, kSize).constBits());
  }
  state.counters["triangles"] = static_cast<double>((scene.solid.size() + scene.clear.size()) / 3);
  state.counters["lines"] = static_cast<double>(scene.lines.size());
}

// With OpenGL, into a picture with fourfold multisampling; read back as well, or only finished.
void handGl(benchmark::State& state, double distanceMm, bool readBack) {
  palpate::testing::windowApplication();
  if (const QString why = openGlProblem(); !why.isEmpty())
    return state.SkipWithError(qUtf8Printable(why));
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  QOffscreenSurface surface;
  surface.setFormat(format);
  surface.create();
  QOpenGLContext context;
  context.setFormat(format);
  HandGl gl;
  if (!context.create() || !context.makeCurrent(&surface) || !gl.initialize().isEmpty())
    return state.SkipWithError("no context");
  QOpenGLFramebufferObjectFormat pixels;
  pixels.setAttachment(QOpenGLFramebufferObject::Depth);
  pixels.setSamples(4);
  QOpenGLFramebufferObject target(kSize.toSize(), pixels);
  QOpenGLFramebufferObject resolved(kSize.toSize());
  const HandScene scene = palpate::gui::samples::sampleScene();
  HandCamera camera = palpate::gui::samples::sampleCamera();
  camera.distanceMm = distanceMm;
  for (auto _ : state) {
    camera.orbit({5.0, 0.0}, kSize.height());
    target.bind();
    gl.draw(scene, camera, kSize);
    QOpenGLFramebufferObject::blitFramebuffer(&resolved, &target);
    if (readBack) benchmark::DoNotOptimize(resolved.toImage().constBits());
    context.functions()->glFinish();
  }
  gl.release();
  state.SetLabel(reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER)));
}

// The reference: a picture of that size filled with one colour.
void handFilled(benchmark::State& state) {
  QImage image(kSize.toSize(), QImage::Format_RGB32);
  for (auto _ : state) {
    image.fill(Qt::black);
    benchmark::DoNotOptimize(image.constBits());
  }
}

BENCHMARK_CAPTURE(handRaster, whole, RasterQuality::kScreen, 640.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(handRaster, near, RasterQuality::kScreen, 300.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(handRaster, picture, RasterQuality::kPicture, 640.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(handRepaint)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(handGl, whole, 640.0, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(handGl, near, 300.0, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(handGl, whole_read, 640.0, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(handFilled)->Unit(benchmark::kMillisecond);

}  // namespace
