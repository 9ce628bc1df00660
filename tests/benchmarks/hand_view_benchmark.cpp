// Drawing a hand in space at 800 x 600, about 5,000 triangles and 1,000 lines: target 16.7 ms (60 Hz) on one core.
#include <benchmark/benchmark.h>

#include "gui/hand_drawing.h"
#include "gui/hand_raster.h"
#include "gui/sample_scene.h"
#include "window_bench.h"

namespace {
using namespace palpate::gui;

constexpr QSizeF kSize(800.0, 600.0);

// Without OpenGL. The hand turns, so that every picture is another one.
void handRaster(benchmark::State& state, RasterQuality quality, double distanceMm) {
  const HandScene scene = palpate::gui::testing::sampleScene();
  HandCamera camera = palpate::gui::testing::sampleCamera();
  camera.distanceMm = distanceMm;
  HandRaster raster;
  for (auto _ : state) {
    camera.orbit({5.0, 0.0}, kSize.height());
    benchmark::DoNotOptimize(raster.draw(scene, camera, kSize, 1.0, quality).constBits());
  }
  state.counters["triangles"] = static_cast<double>((scene.solid.size() + scene.clear.size()) / 3);
  state.counters["lines"] = static_cast<double>(scene.lines.size());
}

// The whole way of the window without OpenGL, one frame of a grasp after the other: pose, contact geometry, scene, picture.
void handRepaint(benchmark::State& state) {
  HandDrawing drawing;
  drawing.setHand(palpate::sdh2());
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
BENCHMARK(handFilled)->Unit(benchmark::kMillisecond);

}  // namespace
