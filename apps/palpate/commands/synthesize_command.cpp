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
constexpr OptionRange kRuns{1, 1000};  // of a scene
constexpr OptionRange kZeroErrorDeg{-5.0, 5.0, "deg"};
constexpr OptionRange kDaysLater{0, 36'500};
constexpr double kFramesPerGrasp = 12.0;  // at least; see SyntheticOptions::validate

Profile fromScene(const CommandLine& given, const std::string& name, const Progress& progress) {
  const Scene scene = loadScene(name, dataFolder() / "scenes");
  SimulatedRecordingOptions options;
  options.durationS =
      given.number("duration", SyntheticOptions::kDurationS).value_or(options.durationS);
  options.frameIntervalS =
      1.0 / given.number("rate", SyntheticOptions::kRateHz).value_or(1.0 / options.frameIntervalS);
  options.hand.seed = static_cast<std::uint64_t>(given.integer("seed", kSeedOption).value_or(1));
  if (const auto error = given.number("zero-error", kZeroErrorDeg))
    options.hand.zeroErrorDeg = {0.0, *error, 0.0, *error, 0.0, *error, 0.0};  // proximal joints
  options.startUs += kDayUs * given.integer("days-later", kDaysLater).value_or(0);
  const auto runs = given.integer("grasps", kRuns);
  if (!runs) return simulateRecording(scene, options, progress);
  return simulateGrasps(scene, static_cast<int>(*runs), {}, options, progress);
}

Profile fromOptions(const CommandLine& given, SyntheticOptions options) {
  // The default is limited to the grasps that fit into a short recording.
  const double fits = std::floor(options.durationS * options.rateHz / kFramesPerGrasp);
  if (!given.has("grasps"))
    options.grasps = static_cast<int>(std::min<double>(options.grasps, fits));
  return synthesize(options);
}

}  // namespace

int synthesizeCommand(const Arguments& words) {
  SyntheticOptions options;
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
                    "write the recording to this file: .palpate, .dsa and the other endings of "
                    "palpate convert"},
                   {"scene", "NAME", "of data/scenes, or a JSON file"},
                   bound("duration",
                         "S",
                         "length (of a scene: of each run)",
                         options.durationS,
                         options.kDurationS),
                   bound("rate", "HZ", "of the tactile frames", options.rateHz, options.kRateHz),
                   bound("grasps", "N", "grasps, spread evenly", options.grasps, options.kGrasps),
                   bound("peak",
                         "COUNTS",
                         "value under the middle of the contact",
                         options.peakCounts,
                         options.kPeakCounts),
                   bound("noise",
                         "SD",
                         "standard deviation of the noise",
                         options.noiseCounts,
                         options.kNoiseCounts),
                   bound("seed", "N", "seed of the noise", options.seed, kSeedOption),
                   ranged("zero-error",
                          "DEG",
                          "of a scene: error of the proximal joints' zero",
                          kZeroErrorDeg,
                          "0"),
                   rangedWhole(
                       "days-later", "N", "of a scene: host time N days later", kDaysLater, "0"),
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
      scene ? fromScene(given, *scene, progress.callback()) : fromOptions(given, options);
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
