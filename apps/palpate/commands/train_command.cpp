// The command `palpate train PATH -o MODEL.json` trains a model of the objects in a folder.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/recognition/model_search.h"
#include "palpate/recognition/trained_model.h"
#include "palpate/recognition/training_choice.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

namespace fs = std::filesystem;

ModelSearchOptions searchGiven(const CommandLine& given, FeatureSet set) {
  PipelineOptions requested;
  requested.classifier =
      set == FeatureSet::kBest && !given.has("lda") ? ClassifierKind::kGauss : ClassifierKind::kSvm;
  takePipelineOptions(given, requested);
  std::optional<ClassifierKind> classifier;
  if (given.has("classifier")) classifier = requested.classifier;
  ModelSearchOptions search = searchOptions(set, classifier);
  // gauss takes no components, so that another classifier is meant.
  if (given.has("lda") && !classifier) search.classifier.reset();
  search.components = requested.components;
  if (given.has("c")) search.costs = {requested.svm.c};
  return search;
}

Json reportOf(const TrainedModel& model,
              const fs::path& out,
              const std::vector<std::string>& notes) {
  Json classes = Json::array();
  for (const std::string& name : model.classes) {
    std::size_t grasps = 0;
    for (const ModelInput& input : model.inputs)
      grasps += input.className == name ? input.grasps : 0;
    classes.push(Json::object().set("name", name).set("grasps", grasps));
  }
  return Json::object()
      .set("model", out.string())
      .set("set", featureSetName(model.set))
      .set("classifier", classifierName(model.pipeline.classifier))
      .set("carries_over_to_another_day", model.adaptsToSession())
      .set("empty_hand_zero", model.trainingZero ? emptyHandZeroJson(*model.trainingZero) : Json())
      .set("classes", std::move(classes))
      .set("features", model.features.size())
      .set("validation", model.validation)
      .set("options", model.options)
      .set("notes", jsonList(notes));
}

}  // namespace

int trainCommand(const Arguments& words) {
  std::optional<FeatureSet> asked;
  std::vector<OptionSpec> options = {
      {"output,o", "MODEL.json", "write the model to this file"},
      boundChoice("set", "SET", "", asked, kFeatureSetWords, kDefaultFeatureSetText),
      zeroOptionSpec(),
      {"force", "", "replace MODEL.json"},
      {"json", "", "no effect: it always prints JSON"}};
  for (OptionSpec& one : pipelineOptionSpecs()) options.insert(options.end() - 3, std::move(one));
  const CommandLine given(
      {.synopsis =
           "palpate train PATH -o MODEL.json [--set best|study|session] [--lda N] "
           "[--classifier svm|qda|lda|gauss]\n                     [--empty-hand-zero FILE]",
       .purpose =
           "Trains a model of the objects in a folder (a folder of recordings per class) and "
           "prints a report as JSON. Options that aren't given are chosen by cross-validation over "
           "contiguous blocks. For the set best the classifier is gauss, the only one that can be "
           "adapted to another session (--session-offset, adapt). If the model also has the empty "
           "hand's zero of this session (--empty-hand-zero), `adapt` can use a recording of the "
           "empty hand of another session instead of labelled grasps.",
       .options = options,
       .example = "palpate train recordings -o objects.json",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("-o MODEL.json is missing: the file for the model");
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  searchGiven(given, asked.value_or(FeatureSet::kBest));  // refuses wrong options first
  requireWritable(*out, overwrite);

  const FeatureTable table = extractFeatureTable(given, {given.words().front()}, asked);
  const FeatureSet set = table.set;
  const ModelSearchOptions search = searchGiven(given, set);
  const auto zero = zeroGiven(given);
  if (zero) requireSameSession(*zero, table);
  const SampleSet samples = samplesOf(table);
  requireLearnable(samples);
  sayNotes(given, set, samples);
  if (modelGrid(samples, search).empty())
    throw UsageError("gauss takes no --lda: choose --classifier svm, qda or lda");
  ChosenPipeline found;
  TrainedModel model;
  runInterruptibly(given, "choosing", [&](const Progress& progress) {
    found = choosePipeline(samples, search, progress);
  });
  PipelineOptions chosen = found.options;
  if (given.text("shrinkage")) {
    PipelineOptions requested = chosen;
    requested.components.reset();
    takePipelineOptions(given, requested);
    chosen.discriminant = requested.discriminant;
  }
  runInterruptibly(given, "training", [&](const Progress& progress) {
    model = trainModel(samples, set, table.sensor, chosen, progress);
    model.inputs = inputsOf(table, progress);
  });
  model.programVersion = PALPATE_VERSION;
  model.madeAt = utcStamp();
  model.trainingZero = zero;
  model.options = jsonOf(chosen).set("path", given.words().front());
  if (!found.report.candidates.empty()) model.options.set("chosen_from", jsonOf(found.report));
  saveModel(model, *out, overwrite);
  printJson(given, reportOf(model, *out, learningNotes(samples)), true);
  return codeFor(table);
}

}  // namespace palpate::commands
