// The command `palpate slip-benchmark` measures how well every method measures slip, against
// synthetic truth.
#include "palpate/core/json.h"
#include "palpate/laboratory/slip_accuracy.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/slip_alarms.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

Json slipBenchmarkToJson(const SlipAccuracy& accuracy) {
  Json json = Json::object();
  json.set("rmse", accuracy.rmse)
      .set("bias", accuracy.bias)
      .set("gain_x", accuracy.gainX)
      .set("gain_y", accuracy.gainY)
      .set("drift_100", accuracy.drift100)
      .set("rmse_deg", accuracy.rmseDeg)
      .set("crb", accuracy.crb)
      .set("crb_deg", accuracy.crbDeg)
      .set("ns_per_step", accuracy.nsPerStep)
      .set("drift_100_deg", accuracy.driftDeg100)
      .set("edge_1_5", accuracy.edge)
      .set("tilt_40", accuracy.tilt)
      .set("tilt_worst_x", accuracy.worstTiltX)
      .set("tilt_worst_y", accuracy.worstTiltY)
      .set("rmse_first_10", accuracy.rmseFirst)
      .set("rmse_later", accuracy.rmseLater)
      .set("normalised_first_10", accuracy.normalisedFirst)
      .set("normalised_later", accuracy.normalisedLater)
      .set("steps", accuracy.steps)
      .set("invalid_steps", accuracy.invalid);
  Json drift = Json::array();
  for (const double one : accuracy.drift) drift.push(one);
  json.set("drift_10_to_100", drift);
  return json;
}

}  // namespace

int slipBenchmarkCommand(const Arguments& words) {
  SlipAccuracyOptions options;
  const CommandLine given(
      {.synopsis = "palpate slip-benchmark [--noise SD] [--edge SD] [--shape S].. [--seed N]",
       .purpose =
           "Measures the accuracy of every slip method on synthetic contacts whose motion "
           "is known, and compares it with the Cramer-Rao bound. Prints JSON; docs/notes/slip.md "
           "explains it.",
       .options = withOutputOptions(
           {bound("noise",
                  "SD",
                  "standard deviation of the noise",
                  options.noiseSd,
                  options.kNoiseSd),
            bound("edge",
                  "SD",
                  "standard deviation of the edges of disc, bar and flat-ellipse",
                  options.sensor.coverTaxels,
                  options.sensor.kCoverTaxels),
            {"shape",
             "S",
             "disc, bar, flat-ellipse, two-blobs, gaussian, elliptic-gaussian; "
             "default all"},
            bound("seed", "N", "seed of noise and places", options.seed, kSeedOption),
            bound("trials", "N", "contacts per shape", options.trials, options.kTrials),
            {"recordings",
             "FOLDER",
             "also score alarms on real recordings: FOLDER/slip-detection slips, "
             "FOLDER/grasps_by_class doesn't"}}),
       .example = "palpate slip-benchmark --noise 20",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  for (const std::string& name : given.texts("shape")) {
    const auto shape = slipShapeNamed(name);
    if (!shape) {
      std::string known;
      for (const SlipShape one : slipShapes())
        known += (known.empty() ? "" : ", ") + std::string(nameOf(one));
      throw UsageError("--shape is '" + name + "'; known: " + known);
    }
    options.shapes.push_back(*shape);
  }

  std::vector<MethodAccuracy> results;
  {
    ProgressLine progress("measuring slip", given.quiet());
    results = measureSlipAccuracy(benchmarkedMethods(), options, progress.callback());
  }
  Json methods = Json::object();
  for (const MethodAccuracy& result : results) {
    Json method = slipBenchmarkToJson(result.all);
    Json shapes = Json::object();
    for (const ShapeAccuracy& one : result.shapes)
      shapes.set(nameOf(one.shape), slipBenchmarkToJson(one.accuracy));
    method.set("shapes", shapes);
    methods.set(result.name, method);
  }
  Json json = Json::object();
  json.set("noise_sd", options.noiseSd)
      .set("edge_taxels", options.sensor.coverTaxels)
      .set("seed", static_cast<std::int64_t>(options.seed))
      .set("methods", methods);
  if (const auto folder = given.text("recordings"))
    json.set("alarms", slipAlarms(*folder, given.quiet()));
  printJson(given, json);
  return kDone;
}

}  // namespace palpate::commands
