// Drawing a hand in space at 800 x 600, about 5,000 triangles and 1,000 lines: target 16.7 ms (60 Hz) on one core.
#include <benchmark/benchmark.h>

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
BENCHMARK(handFilled)->Unit(benchmark::kMillisecond);

}  // namespace
