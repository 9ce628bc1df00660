// palpate adapt MODEL.json PATH -o MODEL2.json: today's labelled grasps, and the offset they tell.
#include <filesystem>

#include "palpate/core/error.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_work.h"

namespace palpate::commands {

int adaptCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate adapt MODEL.json PATH -o MODEL2.json",
       .purpose =
           "Adapts a model to today by labelled grasps: estimates the session offset (by how much "
           "the hand reads sizes\nwrong today), and adds what the objects feel like today. PATH: a "
           "folder with a folder of recordings per class;\nthe classes are some of the model's. "
           "One "
           "grasp of each object at hand is nearly all the gain; two different\nobjects are the "
           "least for verdicts that may be called sure. Prints the offset and the classes as JSON.",
       .options = {{"output,o", "MODEL2.json", "write the adapted model there"},
                   {"force", "", "replace MODEL2.json"},
                   {"json", "", "JSON is what it prints anyway"}},
       .example = "palpate adapt objects.json today -o objects_today.json",
       .fewestWords = 2,
       .mostWords = 2},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("-o MODEL2.json is missing: where the adapted model goes");
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  TrainedModel model = loadModel(given.words().front());
  requireWritable(*out, overwrite);
  const FeatureTable table = gatherTable(given, {given.words()[1]}, model.set);
  requireFits(model, table);
  const SampleSet today = samplesOf(table, model.classes);
  adaptModel(model, today);
  runInterruptibly(given, "hashing", [&](const Progress& progress) {
    model.adaptedFrom = inputsOf(table, progress);
  });
  model.programVersion = PALPATE_VERSION;
  model.madeAt = utcNow();
  saveModel(model, *out, overwrite);
  if (!model.offset.trusted) sayLine("nothing will be sure with it: " + model.offset.text());

  Json classes = Json::array();
  const std::vector<std::size_t> counts = today.counts();
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] > 0)
      classes.push(Json::object().set("name", today.classes[c]).set("grasps", counts[c]));
  printObject(Json::object()
                  .set("model", *out)
                  .set("session_offset",
                       Json::object()
                           .set("mm", model.offset.mm)
                           .set("sd_mm", model.offset.sdMm)
                           .set("origin", offsetOriginName(model.offset.origin))
                           .set("grasps", model.offset.grasps)
                           .set("objects", model.offset.objects)
                           .set("trusted", model.offset.trusted))
                  .set("text", model.offset.text())
                  .set("classes", std::move(classes)));
  return codeFor(table);
}

}  // namespace palpate::commands
