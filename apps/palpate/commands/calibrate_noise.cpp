// The command `palpate calibrate noise FILE [-o N.xml]` determines the noise floor of an unloaded
// hand.
#include <filesystem>

#include "palpate/calibration/noise_floor.h"
#include "palpate/core/hash.h"
#include "palpate/core/output_file.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/recording_list.h"

namespace palpate::commands {

int calibrateNoise(const Arguments& words) {
  NoiseFloorOptions options;
  const CommandLine given(
      {.synopsis = "palpate calibrate noise FILE [-o N.xml|N.json]",
       .purpose = "Measures the noise floor of a hand that nothing touches, recorded at threshold "
                  "0 while it warms up: per matrix a line of the largest reading over the "
                  "temperature of the nearest motor. Prints JSON: slope [counts/deg C], intercept "
                  "[counts], rmse [counts] (as the study defines it) and rmse_true (of this line). "
                  "A threshold of intercept + slope T + 3 rmse hides the noise.",
       .options = withOutputOptions(
           {bound("bins", "N", "equal bins over the temperatures", options.bins, options.kBins)},
           "OUT",
           "write the lines to this file: .xml for the prior program, else JSON"),
       .example = "palpate calibrate noise temperature-noise.dsa -o noise.xml",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::filesystem::path file = given.words().front();
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Profile profile = openReported(file, progress, given.quiet()).profile;
  const NoiseFloor floor = fitNoiseFloor(profile, options, progress.callback());
  progress.wipe();
  const auto out = given.text("output");
  const bool xml = out && std::filesystem::path(*out).extension() == ".xml";
  if (xml) {
    OutputFile written(*out, given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse);
    written.write(noiseXml(floor));
    written.commit();
  }
  Json json = provenance("noise");
  json.set("file", file.string()).set("sha256", sha256OfFile(file));
  json.set("options", Json::object().set("bins", options.bins));
  const Json found = jsonOf(floor);
  for (const std::string& key : found.keys()) json.set(key, found.at(key));
  printJson(given, json, xml);
  if (!floor.notAtRest.empty()) {
    sayLine(floor.notAtRest +
            "; these lines are not noise: record the hand while nothing touches it");
    return kPartlyDone;
  }
  for (const NoiseLine& line : floor.lines)
    if (!line.valid) return kPartlyDone;
  return kDone;
}

}  // namespace palpate::commands
