// palpate convert IN OUT: from one form of a recording to another.
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {

int convertCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate convert IN OUT [--from N --to M]",
       .purpose = "Converts a recording; the ending of OUT chooses the form: .dsa, .palpate, .csv "
                  "(with\nOUT.angles.csv and OUT.temperatures.csv beside it) or .npz (for NumPy).",
       .options = {{"from", "N", "first frame, default 0"},
                   {"to", "M", "last frame (inclusive), default the last one"},
                   {"force", "", "replace OUT"}},
       .example = "palpate convert foam_ball.dsa grasp3.palpate --from 700 --to 1400",
       .fewestWords = 2,
       .mostWords = 2},
      words);
  if (given.helpShown()) return kDone;
  const std::string& in = given.words()[0];
  const std::string& out = given.words()[1];
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  formOf(out);
  requireOther(in, out);
  requireWritable(out, overwrite);
  const auto from = given.integer("from", 0, INT64_MAX);
  const auto to = given.integer("to", 0, INT64_MAX);
  Profile profile = [&] {
    ProgressLine progress("reading " + in, given.quiet());
    return openRecording(in, progress.callback());
  }();
  EventsReport events = readEvents(in);
  if (from || to) {
    if (profile.numFrames() == 0) throw Error(in + ": has no frames");
    const std::size_t first = static_cast<std::size_t>(from.value_or(0));
    const std::size_t last = to ? static_cast<std::size_t>(*to) : profile.numFrames() - 1;
    if (first > last || last >= profile.numFrames())
      throw Error(in + ": has no frames " + std::to_string(first) + ".." + std::to_string(last) +
                  ", only 0.." + std::to_string(profile.numFrames() - 1));
    profile = cropped(profile, first, last);
    events.events = eventsWithin(events.events, profile);
  }
  {
    ProgressLine progress("writing " + out, given.quiet());
    saveRecording(profile, events.events, out, overwrite, progress.callback());
  }
  if (!given.quiet()) std::printf("%s: %zu frames\n", out.c_str(), profile.numFrames());
  if (events.damaged == 0) return kDone;
  std::fprintf(
      stderr, "palpate: %s: %zu damaged events were left out\n", in.c_str(), events.damaged);
  return kPartlyDone;
}

}  // namespace palpate::commands
