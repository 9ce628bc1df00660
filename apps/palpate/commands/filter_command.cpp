// The command `palpate filter IN OUT` writes a recording filtered by a chain of filters as a new
// recording.
#include <cstdio>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

std::string latencyText(const Recipe& recipe, double rateHz) {
  if (!recipe.causal()) return "needs later frames: not for a live hand";
  const auto latency = rateHz > 0.0 ? latencyFrames(recipe, rateHz) : latencyFrames(recipe);
  if (!latency) return "a load step doesn't reach half its height";
  return "a contact is seen " + std::to_string(*latency) + (*latency == 1 ? " frame" : " frames") +
         " later";
}

Event filteredEvent(const Recipe& recipe, const Profile& profile) {
  const std::int64_t us = profile.numFrames() == 0 ? 0 : profile.frameTimeUs(0);
  return {us, us, "filtered", std::nullopt, fullRecipeText(recipe), recipeJson(recipe).text(-1)};
}

}  // namespace

int filterCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate filter IN OUT --filter SPEC.. | --recipe R.json | --list",
       .purpose = "Filters the recording IN and writes the result; the ending of OUT chooses the "
                  "format as in `palpate convert`. SPEC is a filter with its options, as "
                  "median:size=3,masked=1; several are applied one after the other. Values are "
                  "floats, nothing is rounded to counts. Filters over time start again after a gap "
                  "(longer than max(1 s, 5 median intervals) of the frames before it), and where "
                  "settings or masks of the sensor changed. At the borders of a matrix the "
                  "outermost values are repeated; masked taxels are neither read nor changed. The "
                  "window applies the same filters, to recordings and live.",
       .options = {{"filter", "SPEC", "a filter; may be given several times, or joined by |"},
                   {"recipe",
                    "R.json",
                    "a recipe, as the Filter dock saves it, before every --filter"},
                   {"save-recipe", "R.json", "also write the filters as a recipe"},
                   {"list", "", "list all filters with options, ranges and sources"},
                   timeOption(),
                   {"force", "", "replace OUT and R.json"}},
       .example = "palpate filter foam_ball.dsa calm.palpate --filter median --filter kalman:q=0.1",
       .maxArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("list")) {
    if (!given.words().empty()) throw UsageError("--list takes no recording");
    StandardOutput out;
    out.write(filterList());
    out.finish();
    return kDone;
  }
  if (given.words().size() != 2) throw UsageError("filter needs IN and OUT");
  const Recipe recipe = recipeOf(given);
  if (recipe.steps.empty())
    throw UsageError(
        "filter needs --filter SPEC or --recipe R.json; 'palpate filter --list' shows "
        "all filters");
  const std::string& in = given.words()[0];
  const std::string& out = given.words()[1];
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  formatOf(out);
  requireOther(in, out);
  requireWritable(out, overwrite);
  const auto recipePath = given.text("save-recipe");
  if (recipePath) requireWritable(*recipePath, overwrite);

  ProgressLine line("reading " + in, given.quiet());
  Recording recording = openReported(in, line, given.quiet());
  takeTimes(given, recording, in, line.callback());
  const Profile& profile = recording.profile;
  line.setLabel("filtering " + in);
  const Profile filtered = filteredBy(recipe, recording, in, line.callback());
  std::vector<Event> events = recording.events;
  events.push_back(filteredEvent(recipe, profile));
  reportLeftOut(filtered, out);
  line.setLabel("writing " + out);
  saveRecording(filtered, events, out, overwrite, line.callback());
  line.wipe();
  if (recipePath) writeRecipe(*recipePath, recipe, given.has("force"));
  if (!given.quiet())
    std::printf("%s: %s filtered by %s; %s\n",
                escapedLine(out).c_str(),
                counted(filtered.numFrames(), "frame").c_str(),
                fullRecipeText(recipe).c_str(),
                latencyText(recipe, timingOf(profile).rateHz).c_str());
  if (recording.damage.events == 0) return kDone;
  sayLine(in + ": " + eventsLeftOutText(recording.damage.events));
  return kPartlyDone;
}

}  // namespace palpate::commands
