// The command `palpate step-benchmark` measures how often the stated intervals of loading steps
// contain the truth, against synthetic steps.
#include <array>

#include "palpate/core/json.h"
#include "palpate/laboratory/step_coverage.h"
#include "palpate/recognition/classification_report.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

Json coverageToJson(const std::array<IntervalCoverage, 4>& counts, bool oscillating) {
  Json json = Json::object();
  const std::array names{"K", "m", oscillating ? "T" : "T1", oscillating ? "d" : "T2"};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto [stated, inside] = counts[i];
    Json one = Json::object();
    one.set("stated", stated).set("inside", inside);
    if (stated > 0) {
      const BinomialInterval interval = wilsonInterval(inside, stated);
      one.set("coverage", static_cast<double>(inside) / static_cast<double>(stated));
      one.set("low", interval.low).set("high", interval.high);
    } else {
      for (const char* key : {"coverage", "low", "high"}) one.set(key, Json());
    }
    json.set(names[i], std::move(one));
  }
  return json;
}

Json stepsToJson(const StepCoverage& coverage) {
  const SimulatedSteps& steps = coverage.steps;
  const bool oscillating = steps.truth.damping < 1.0;
  Json json = Json::object();
  json.set("shape", steps.shape)
      .set("noise", steps.noise)
      .set("correlation_s", steps.correlationS)
      .set("length_s", steps.lengthS)
      .set("drift_per_s", steps.driftPerS)
      .set("outliers", steps.outlierShare)
      .set("loss",
           steps.fit.loss == StepLoss::kSquares ? "squares"
           : steps.fit.loss == StepLoss::kHuber ? "huber"
                                                : "cauchy")
      .set("trials", coverage.trials)
      .set("usable", coverage.usable)
      .set("not_identifiable", coverage.notIdentifiable)
      .set("cut_off", coverage.cutOff)
      .set("not_converged", coverage.notConverged)
      .set("usable_and_not_identifiable", coverage.contradictory)
      .set("stated", coverageToJson(coverage.stated, oscillating))
      .set("of_usable", coverageToJson(coverage.ofUsable, oscillating));
  return json;
}

}  // namespace

int stepBenchmarkCommand(const Arguments& words) {
  std::size_t trials = 200;
  std::uint64_t seed = 1;
  const CommandLine given(
      {.synopsis = "palpate step-benchmark [--trials N] [--seed N]",
       .purpose =
           "Fits synthetic loading steps whose parameters are known, by noise, length and drift, "
           "and counts how often the stated 95 % intervals contain them, with Wilson's interval of "
           "that fraction. Prints JSON; docs/notes/calibration.md explains it.",
       .options =
           withOutputOptions({bound("trials", "N", "steps per kind", trials, {1, 1e6}),
                              bound("seed", "N", "seed of noise and loads", seed, kSeedOption)}),
       .example = "palpate step-benchmark --trials 50",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  Json cells = Json::array();
  std::size_t contradictory = 0;
  {
    ProgressLine progress("fitting steps", given.quiet());
    const auto grid = coverageGrid();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      reportProgress(progress.callback(), i, grid.size(), 1);
      // Kinds of steps have different noise.
      const StepCoverage coverage =
          measureStepCoverage(grid[i], trials, (seed * grid.size() + i) * 1'000'000);
      contradictory += coverage.contradictory;
      cells.push(stepsToJson(coverage));
    }
  }
  Json json = Json::object();
  json.set("seed", static_cast<std::int64_t>(seed))
      .set("usable_and_not_identifiable", contradictory)
      .set("steps", std::move(cells));
  printJson(given, json);
  return kDone;
}

}  // namespace palpate::commands
