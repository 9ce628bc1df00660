// The command `palpate adapt MODEL.json [PATH] -o MODEL2.json` adapts a model to a session: it
// determines the session offset from the zero of the empty hand and labelled grasps.
#include <iterator>
#include <optional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

// Removes the session offset of an earlier session from the model.
void forgetAnotherDay(TrainedModel& model, std::int64_t todayUs) {
  if (model.offset.origin != OffsetSource::kNone && !model.sameSession(todayUs))
    resetSession(model);
}

// Adapts the model by labelled grasps. Returns the exit code, kPartlyDone when grasps were left
// out.
int adaptByGrasps(const CommandLine& given,
                  const std::optional<EmptyHandZero>& zero,
                  TrainedModel& model,
                  Json& classes) {
  FeatureTable table = extractFeatureTable(given, {given.words()[1]}, model.set);
  requireFits(model, table);
  const std::size_t earlier = keepNewestSession(table);
  if (earlier > 0)
    sayLine(std::to_string(earlier) + (earlier == 1 ? " grasp is" : " grasps are") +
            " of an earlier session, more than 8 h before the others, and left out: the hand reads "
            "sizes differently in each session");
  if (zero) requireSameSession(*zero, table);
  const SampleSet today = samplesOf(table, model.classes);
  forgetAnotherDay(model, table.rows.front().timeUs);
  adaptModel(
      model, today, model.offset.origin == OffsetSource::kNone ? unknownOffset() : model.offset);
  runInterruptibly(given, "hashing", [&](const Progress& progress) {
    std::vector<ModelInput> inputs = inputsOf(table, progress);
    std::move(inputs.begin(), inputs.end(), std::back_inserter(model.adaptedFrom));
  });
  const std::vector<std::size_t> counts = today.counts();
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] > 0)
      classes.push(Json::object().set("name", today.classes[c]).set("grasps", counts[c]));
  return earlier > 0 ? static_cast<int>(kPartlyDone) : codeFor(table);
}

}  // namespace

int adaptCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate adapt MODEL.json [PATH] [--empty-hand-zero FILE] -o MODEL2.json",
       .purpose =
           "Adapts a model to the session of today: estimates the session offset (by how many mm "
           "the hand reads all sizes larger or smaller today) and stores it with its standard "
           "deviation and its source. The sources, one or both:\n\n  FILE  a recording in which "
           "the empty hand closes until its pads touch (palpate grasp --preshape pinch-empty "
           "--mode reactive). It needs no object and no label, but a model that was trained with "
           "such a recording of the same session.\n  PATH  labelled grasps of today: a folder with "
           "a folder of recordings per class. They also show how the objects measure today. One "
           "grasp of each object is usually enough; answers are called sure only after grasps of "
           "at least two different objects.\n\nIf the grasps are of several sessions (more than 8 "
           "h apart), the newest session is used, and the others are reported: exit code 3. What "
           "an earlier call stored of the same session is kept; what it stored of another session "
           "is removed. Prints the offset and the classes as JSON.",
       .options = {{"output,o", "MODEL2.json", "write the adapted model to this file"},
                   zeroOptionSpec(),
                   {"force", "", "replace MODEL2.json"},
                   {"json", "", "no effect: it always prints JSON"}},
       .example = "palpate adapt objects.json --empty-hand-zero touch.dsa -o objects_today.json",
       .minArguments = 1,
       .maxArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("-o MODEL2.json is missing: the file for the adapted model");
  const bool grasps = given.words().size() > 1;
  if (!grasps && !given.has("empty-hand-zero"))
    throw UsageError(
        "nothing to adapt with: give a PATH with labelled grasps, or --empty-hand-zero FILE");
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  TrainedModel model = loadModel(given.words().front());
  requireWritable(*out, overwrite);
  const auto zero = zeroGiven(given);
  if (zero) {
    forgetAnotherDay(model, zero->timeUs);
    adaptToEmptyHand(model, *zero);
  }
  Json classes = Json::array();
  const int code = grasps ? adaptByGrasps(given, zero, model, classes) : kDone;
  model.programVersion = PALPATE_VERSION;
  model.madeAt = utcStamp();
  saveModel(model, *out, overwrite);
  if (!model.offset.trusted) sayLine("no answer will be sure with it: " + model.offset.text());
  printJson(given,
            Json::object()
                .set("model", *out)
                .set("session_offset", offsetJson(model.offset, model.sessionZero))
                .set("text", model.offset.text())
                .set("classes", std::move(classes)),
            true);
  return code;
}

}  // namespace palpate::commands
