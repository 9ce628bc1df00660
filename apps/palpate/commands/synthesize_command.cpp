// The command `palpate synthesize -o OUT` makes a synthetic recording with known content.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/emulator/scene.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

constexpr std::int64_t kDayUs = 24LL * 3600 * 1'000'000;
constexpr double kFramesPerGrasp = 12.0;  // at least; see SyntheticOptions::validate

Profile fromScene(const CommandLine& given, const std::string& name, const Progress& progress) {
  const Scene scene = loadScene(name, dataFolder() / "scenes");
  SimulatedRecordingOptions options;
  options.durationS = given.number("duration", 0.1, 3600.0).value_or(options.durationS);
  options.frameIntervalS =
      1.0 / given.number("rate", 0.1, 1000.0).value_or(1.0 / options.frameIntervalS);
  options.hand.seed = static_cast<std::uint64_t>(given.integer("seed", 0, UINT32_MAX).value_or(1));
  if (const auto error = given.number("zero-error", -5.0, 5.0))
    options.hand.zeroErrorDeg = {0.0, *error, 0.0, *error, 0.0, *error, 0.0};  // proximal joints
  options.startUs += kDayUs * given.integer("days-later", 0, 36'500).value_or(0);
  const auto runs = given.integer("grasps", 1, 1000);
  if (!runs) return simulateRecording(scene, options, progress);
  return simulateGrasps(scene, static_cast<int>(*runs), {}, options, progress);
}

Profile fromOptions(const CommandLine& given) {
  SyntheticOptions options;
  options.durationS = given.number("duration", 0.1, 86'400.0).value_or(options.durationS);
  options.rateHz = given.number("rate", 0.1, 1000.0).value_or(options.rateHz);
  // The default is limited to the grasps that fit into a short recording.
  const double fits = std::floor(options.durationS * options.rateHz / kFramesPerGrasp);
  options.grasps = static_cast<int>(std::min<double>(options.grasps, fits));
  options.grasps = static_cast<int>(given.integer("grasps", 0, 10'000).value_or(options.grasps));
  options.peakCounts = given.number("peak", 50.0, 3500.0).value_or(options.peakCounts);
  options.noiseCounts = given.number("noise", 0.0, 1000.0).value_or(options.noiseCounts);
  options.seed =
      static_cast<std::uint32_t>(given.integer("seed", 0, UINT32_MAX).value_or(options.seed));
  return synthesize(options);
}

}  // namespace

int synthesizeCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate synthesize -o OUT [--scene NAME] [--duration S] [--grasps N] "
                   "[--noise SD] ..",
       .purpose =
           "Makes a synthetic recording of pinch grasps: the same options give the same frames. "
           "The recording in data/ was made by this command.\n\nWith --scene the emulated hand "
           "plays a scene (palpate emulate --scene), without ports and without waiting; with "
           "--grasps N it plays the scene N times, each time with the objects at slightly "
           "different places. --zero-error gives its joints an error of their zero, as after a new "
           "referencing: the scene empty_touch with the same error makes the recording of the "
           "empty hand for palpate adapt --empty-hand-zero.",
       .options = {{"output,o",
                    "OUT",
                    "where to write it: .palpate, .dsa and the other endings of palpate convert"},
                   {"scene", "NAME", "of data/scenes, or a JSON file"},
                   {"duration", "S", "length [s] (of a scene: of each run), default 12"},
                   {"rate", "HZ", "tactile frames per second, default 31.7"},
                   {"grasps", "N", "grasps, spread evenly; default 3"},
                   {"peak", "COUNTS", "value under the middle of the contact, default 1800"},
                   {"noise", "SD", "standard deviation of the noise [counts], default 0"},
                   {"seed", "N", "seed of the noise, default 1"},
                   {"zero-error",
                    "DEG",
                    "of a scene: error of the proximal joints' zero, default 0"},
                   {"days-later", "N", "of a scene: host time N days later, default 0"},
                   {"force", "", "replace OUT"}},
       .example = "palpate synthesize -o grasps.dsa --grasps 4 --noise 8",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("synthesize needs -o OUT");
  try {
    formatOf(*out);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  const auto scene = given.text("scene");
  for (const char* name : {"peak", "noise"})
    if (scene && given.has(name))
      throw UsageError(std::string("--") + name + " can't be used with --scene");
  for (const char* name : {"zero-error", "days-later"})
    if (!scene && given.has(name)) throw UsageError(std::string("--") + name + " needs --scene");
  ProgressLine progress("making " + *out, given.quiet());
  const Profile profile =
      scene ? fromScene(given, *scene, progress.callback()) : fromOptions(given);
  progress.setLabel("writing " + *out);
  saveRecording(profile,
                {},
                *out,
                given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse,
                progress.callback());
  if (!given.quiet())
    std::printf("%s: %zu frames\n", escapedLine(*out).c_str(), profile.numFrames());
  return kDone;
}

}  // namespace palpate::commands
