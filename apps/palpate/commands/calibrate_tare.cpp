// The command `palpate calibrate tare FILE [--apply | --remove]` determines the readings of the
// unloaded taxels and stores them as an event of the recording, or removes that event.
#include <cstdio>

#include "palpate/calibration/tare.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

// The events without those of kind "tare".
std::vector<Event> withoutTare(const EventsReport& events) {
  std::vector<Event> kept;
  for (const Event& event : events.events)
    if (event.kind != "tare") kept.push_back(event);
  return kept;
}

Event eventOf(const Tare& tare, const Profile& profile) {
  Event event;
  event.tUs = profile.frameTimeUs(0);
  event.t1Us = profile.frameTimeUs(profile.numFrames() - 1);
  event.kind = "tare";
  std::size_t raised = 0;
  for (const MatrixTare& matrix : tare.matrices) raised += matrix.raisedTaxels;
  event.text = "tare of " + counted(raised, "taxel");
  event.json = jsonOf(tare, profile.layout()).text(-1);
  return event;
}

}  // namespace

int calibrateTare(const Arguments& words) {
  TareOptions options;
  const CommandLine given(
      {.synopsis = "palpate calibrate tare FILE [--apply | --remove]",
       .purpose = "Finds the windows in which nothing touches a matrix, and what its taxels read "
                  "there: the zero. Prints JSON. With --apply the zero is noted in the recording "
                  "as an event (kind tare; of a .dsa in its sidecar), and `calibrate apply` and "
                  "`contact --calibration` subtract it. The recorded values never change; --remove "
                  "deletes the event.",
       .options = withOutputOptions(
           {bound("window", "S", "length of a window", options.windowS, options.kWindowS),
            bound("most",
                  "N",
                  "count a matrix that never reads less as always loaded",
                  options.maxRestCounts,
                  options.kMaxRestCounts),
            {"apply", "", "note it in the recording"},
            {"remove", "", "remove it from the recording"}}),
       .example = "palpate calibrate tare session.palpate --apply",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("apply") && given.has("remove"))
    throw UsageError("give --apply or --remove, not both");
  const std::filesystem::path file = given.words().front();
  if (given.has("remove")) {
    const EventsReport events = readEvents(file);
    const std::vector<Event> kept = withoutTare(events);
    if (kept.size() == events.events.size()) throw FileError(file, "has no tare");
    saveEvents(file, events, kept);
    if (!given.quiet()) std::printf("%s: tare removed\n", escapedLine(file.string()).c_str());
    return kDone;
  }
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Recording recording = openReported(file, progress, given.quiet());
  const Profile& profile = recording.profile;
  requireWithinFullScale("most", options.maxRestCounts, profile.hand());
  const Tare tare = findTare(profile, options, progress.callback());
  progress.wipe();
  std::size_t found = 0;
  for (const MatrixTare& matrix : tare.matrices) found += matrix.valid ? 1 : 0;
  if (given.has("apply")) {
    if (found == 0)
      throw FileError(file,
                      "has no unloaded window, so no zero can be stored; give a larger --most, "
                      "or a recording in which nothing touches the hand");
    recording.requireEvents();
    const EventsReport events{recording.events, recording.damage.events};
    std::vector<Event> all = withoutTare(events);
    all.push_back(eventOf(tare, profile));
    saveEvents(file, events, all);
  }
  Json json = provenance("tare");
  json.set("file", file.string()).set("applied", given.has("apply"));
  const Json result = jsonOf(tare, profile.layout());
  for (const std::string& key : result.keys()) json.set(key, result.at(key));
  printJson(given, json);
  return found == tare.matrices.size() ? kDone : kPartlyDone;
}

}  // namespace palpate::commands
