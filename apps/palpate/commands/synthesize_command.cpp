// palpate synthesize -o OUT.dsa: a synthetic recording with known content.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/dsa_writer.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

constexpr double kFramesPerGrasp = 12.0;  // at least: SyntheticOptions::validate

}  // namespace

int synthesizeCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate synthesize -o OUT.dsa [--duration S] [--grasps N] [--noise SD] ..",
       .purpose = "Makes a synthetic recording of pinch grasps: the same options give the same "
                  "frames. The\nrecording in data/ was made by it.",
       .options = {{"output,o", "OUT.dsa", "where to write it"},
                   {"duration", "S", "length [s], default 12"},
                   {"rate", "HZ", "tactile frames per second, default 31.7"},
                   {"grasps", "N", "grasps, spread evenly; default 3"},
                   {"peak", "COUNTS", "value under the middle of the contact, default 1800"},
                   {"noise", "SD", "standard deviation of the noise [counts], default 0"},
                   {"seed", "N", "of the noise, default 1"},
                   {"force", "", "replace OUT.dsa"}},
       .example = "palpate synthesize -o grasps.dsa --grasps 4 --noise 8",
       .mostWords = 0},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("synthesize needs -o OUT.dsa");
  if (std::filesystem::path(*out).extension() != ".dsa")
    throw UsageError("the recording's name must end in .dsa, not '" + *out + "'");
  SyntheticOptions options;
  options.durationS = given.number("duration", 0.1, 86'400.0).value_or(options.durationS);
  options.rateHz = given.number("rate", 0.1, 1000.0).value_or(options.rateHz);
  // Unasked, no more grasps than a short recording holds.
  const double fits = std::floor(options.durationS * options.rateHz / kFramesPerGrasp);
  options.grasps = static_cast<int>(std::min<double>(options.grasps, fits));
  options.grasps = static_cast<int>(given.integer("grasps", 0, 10'000).value_or(options.grasps));
  options.peakCounts = given.number("peak", 50.0, 3500.0).value_or(options.peakCounts);
  options.noiseCounts = given.number("noise", 0.0, 1000.0).value_or(options.noiseCounts);
  options.seed =
      static_cast<std::uint32_t>(given.integer("seed", 0, UINT32_MAX).value_or(options.seed));
  const Profile profile = synthesize(options);
  ProgressLine progress("writing " + *out, given.quiet());
  writeDsa(profile,
           *out,
           given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse,
           progress.callback());
  if (!given.quiet()) std::printf("%s: %zu frames\n", out->c_str(), profile.numFrames());
  return kDone;
}

}  // namespace palpate::commands
