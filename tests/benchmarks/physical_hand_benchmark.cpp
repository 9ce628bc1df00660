// The physical hand: one scan, and one frame period of the simulation, with a ball grasped; beside
// them the least a scan can be: a normal draw and its rounding for every taxel.
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/physical_hand.h"

#include "testing/testing.h"

namespace {

using namespace palpate;

// The ball's script grasps at 1.5 s, holds from 6.5 s, releases at 9 s.
constexpr double kClosingS = 5.4, kHeldS = 8.0;

std::unique_ptr<PhysicalHand> handWithBall(double timeS) {
  auto hand =
      std::make_unique<PhysicalHand>(loadScene("ball", palpate::testing::dataFolder() / "scenes"));
  hand->advanceTo(timeS);
  return hand;
}

void scanOfAHeldBall(benchmark::State& state) {
  const auto hand = handWithBall(kHeldS);
  for (MatrixSetting& setting : hand->settings())
    if (state.range(0) == 0) setting.thresholdCounts = 0;
  std::vector<std::uint16_t> counts(hand->hand().layout->numCells());
  for (auto _ : state) {
    hand->scan(counts);
    benchmark::DoNotOptimize(counts.data());
  }
}
BENCHMARK(scanOfAHeldBall)->ArgName("threshold")->Arg(0)->Arg(150)->Unit(benchmark::kMicrosecond);

// Everything between two frames at 300 frames/s while the fingers close on the ball and press it.
void framePeriodOfAClosingGrasp(benchmark::State& state) {
  constexpr double kPeriodS = 1.0 / 300.0;
  auto hand = handWithBall(kClosingS);
  std::vector<std::uint16_t> counts(hand->hand().layout->numCells());
  double timeS = kClosingS;
  for (auto _ : state) {
    if (timeS > kHeldS) {
      state.PauseTiming();
      hand = handWithBall(kClosingS);
      timeS = kClosingS;
      state.ResumeTiming();
    }
    timeS += kPeriodS;
    hand->advanceTo(timeS);
    hand->scan(counts);
    benchmark::DoNotOptimize(counts.data());
  }
}
BENCHMARK(framePeriodOfAClosingGrasp)->Unit(benchmark::kMicrosecond);

void noiseAlone(benchmark::State& state) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<std::uint16_t> counts(sdh2().layout->numCells());
  for (auto _ : state) {
    for (std::uint16_t& count : counts)
      count = static_cast<std::uint16_t>(std::round(42.0 + normal(random)));
    benchmark::DoNotOptimize(counts.data());
  }
}
BENCHMARK(noiseAlone)->Unit(benchmark::kMicrosecond);

}  // namespace
