// Binds palpate.train() and evaluate().
#include <string>

#include <pybind11/stl.h>

#include "palpate/recognition/cross_validation.h"
#include "palpate/recognition/model_search.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/features.h"
#include "python/interruption.h"
#include "python/models.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

constexpr std::size_t kBlocks = 5;

// The options of train() and evaluate() for the pipeline; empty ones are chosen by the program.
struct Wishes {
  std::optional<ClassifierKind> classifier;
  std::optional<std::size_t> components;
  std::optional<double> cost;
  std::optional<std::optional<double>> shrinkage;  // inner nothing: after Ledoit and Wolf
};

Wishes wishesOf(const std::optional<std::string>& classifier,
                std::optional<int> lda,
                std::optional<double> cost,
                const py::object& shrinkage) {
  Wishes wishes;
  constexpr OptionCheck check{"classifier"};
  if (classifier)
    wishes.classifier = choice<ClassifierKind>("classifier", *classifier, kClassifierWords);
  if (lda) check(PipelineOptions::kComponents, "lda", *lda);
  if (lda) wishes.components = static_cast<std::size_t>(*lda);
  if (cost) check(SvmOptions::kC, "c", *cost);
  wishes.cost = cost;
  if (py::isinstance<py::str>(shrinkage)) {
    choice<int>("shrinkage", shrinkage.cast<std::string>(), {{"auto", 0}});
    wishes.shrinkage.emplace(std::nullopt);
  } else if (!shrinkage.is_none()) {
    const auto share = shrinkage.cast<double>();
    check(DiscriminantOptions::kShrinkage, "shrinkage", share);
    wishes.shrinkage.emplace(share);
  }
  if (wishes.components && wishes.classifier == ClassifierKind::kGauss)
    throw py::value_error("gauss takes no lda: choose svm, qda or lda");
  return wishes;
}

// The classifier that the caller requested; else, for the feature set best, gauss, because only
// that works in another session.
ClassifierKind classifierFor(const Wishes& wishes, FeatureSet set) {
  if (wishes.classifier) return *wishes.classifier;
  return set == FeatureSet::kBest && !wishes.components ? ClassifierKind::kGauss
                                                        : ClassifierKind::kSvm;
}

void apply(const Wishes& wishes, PipelineOptions& options) {
  if (wishes.cost) options.svm.c = *wishes.cost;
  if (wishes.shrinkage) options.discriminant.shrinkage = *wishes.shrinkage;
}

TrainedModel train(const py::object& source,
                   const std::string& setName,
                   const std::optional<std::string>& classifier,
                   std::optional<int> lda,
                   std::optional<double> cost,
                   const py::object& shrinkage) {
  const FeatureSet set = featureSetOf(setName);
  const Wishes wishes = wishesOf(classifier, lda, cost, shrinkage);
  const FeatureTable table = featuresOf(source, set);
  requireRows(table);
  const SampleSet samples = samplesOf(table);
  requireLearnable(samples);
  ModelSearchOptions search;
  const ClassifierKind kind = classifierFor(wishes, set);
  if (wishes.classifier || kind == ClassifierKind::kGauss) search.classifier = kind;
  search.components = wishes.components;
  if (wishes.cost) search.costs = {*wishes.cost};
  const std::vector<PipelineOptions> grid = modelGrid(samples, search);
  if (grid.empty())
    throw py::value_error("no classifier fits these options: leave some of them out");
  return unlocked([&](const Progress& progress) {
    ModelSearchReport found;
    if (grid.size() > 1) found = searchModel(samples, search, progress);
    PipelineOptions chosen =
        found.candidates.empty() ? grid.front() : found.candidates[found.chosen].options;
    apply(wishes, chosen);
    TrainedModel model = trainModel(samples, set, table.sensor, chosen, progress);
    model.inputs = inputsFor(table, progress);
    stampProvenance(model);
    model.options = jsonOf(chosen);
    if (!found.candidates.empty()) model.options.set("chosen_from", jsonOf(found));
    return model;
  });
}

struct SetChoice {
  FeatureSet set = FeatureSet::kBest;
  StudyPart part = StudyPart::kAll;
};

SetChoice setNamed(const std::string& name) {
  return choice<SetChoice>("set",
                           name,
                           {{"diameter", {FeatureSet::kStudy, StudyPart::kDiameter}},
                            {"first4", {FeatureSet::kStudy, StudyPart::kFirst4}},
                            {"moments", {FeatureSet::kStudy, StudyPart::kMoments}},
                            {"study", {FeatureSet::kStudy, StudyPart::kAll}},
                            {"best", {FeatureSet::kBest, StudyPart::kAll}},
                            {"session", {FeatureSet::kSession, StudyPart::kAll}},
                            {"statistics", {FeatureSet::kStatistics, StudyPart::kAll}}});
}

py::object evaluate(const py::object& source,
                    const std::string& setName,
                    std::optional<int> lda,
                    const std::optional<std::string>& classifier,
                    const std::string& protocol,
                    std::size_t numSplits,
                    std::uint64_t seed,
                    std::optional<double> cost,
                    const py::object& shrinkage) {
  const SetChoice wanted = setNamed(setName);
  const Wishes wishes = wishesOf(classifier, lda, cost, shrinkage);
  PipelineOptions options;
  options.classifier = classifierFor(wishes, wanted.set);
  options.components = wishes.components;
  apply(wishes, options);
  const bool blocks = choice<bool>("protocol", protocol, {{"S", false}, {"B", true}});
  if (numSplits < 1 || numSplits > 100'000) throw py::value_error("splits is not in 1 .. 100000");
  const FeatureTable table = featuresOf(source, wanted.set);
  requireRows(table);
  SampleSet samples = samplesOf(table);
  if (wanted.part != StudyPart::kAll) samples = studyPart(samples, wanted.part);
  requireLearnable(samples);
  const auto splits =
      blocks ? blockSplits(samples.y, kBlocks) : stratifiedSplits(samples.y, numSplits, seed);
  const ValidationReport report = unlocked([&](const Progress& progress) {
    return crossValidate(samples, options, splits, 0, progress);
  });
  const Json confusion = report.confusion.confusionJson();
  py::dict result;
  result["accuracy_mean"] = report.accuracyMean;
  result["accuracy_sd"] = report.accuracySd;
  result["top3"] = report.top3;
  result["accuracies"] = arrayOf(report.accuracies);
  result["grasps"] = samples.numSamples();
  result["splits"] = splits.size();
  result["pipeline"] = toPython(jsonOf(options));
  result["classes"] = toPython(report.confusion.classesJson());
  result["confusion"] =
      py::module_::import("numpy").attr("array")(toPython(confusion.at("counts")));
  result["confusion_labels"] = toPython(confusion.at("labels"));
  return result;
}

}  // namespace

void bindTraining(py::module_& module) {
  module.def("train",
             &train,
             py::arg("source"),
             py::kw_only(),
             py::arg("set") = "best",
             py::arg("classifier") = py::none(),
             py::arg("lda") = py::none(),
             py::arg("c") = py::none(),
             py::arg("shrinkage") = py::none(),
             "Trains a model of the objects in a folder (a folder of recordings per class), or of "
             "Features. Options that aren't given are chosen by cross-validation; for the set "
             "'best' the classifier is gauss, the only one that carries over to another session. "
             "classifier: 'svm', 'qda', 'lda', 'gauss'; lda: components of a discriminant analysis "
             "before it; c: cost of svm; shrinkage: of the discriminant analysis, 0..1 or 'auto'. "
             "Error when the grasps don't suffice.");
  module.def(
      "evaluate",
      &evaluate,
      py::arg("source"),
      py::kw_only(),
      py::arg("set") = "best",
      py::arg("lda") = py::none(),
      py::arg("classifier") = py::none(),
      py::arg("protocol") = "S",
      py::arg("splits") = 10,
      py::arg("seed") = 0,
      py::arg("c") = py::none(),
      py::arg("shrinkage") = py::none(),
      "How well grasps are recognised, by cross-validation; everything is fitted to the training "
      "part of each split. source as for train(); set also 'diameter', 'first4', 'moments' (parts "
      "of 'study'); protocol 'S': stratified shuffles (20 % are tested), 'B': five contiguous "
      "blocks per class. dict accuracy_mean, accuracy_sd, top3, accuracies (splits,), grasps, "
      "splits, pipeline, classes [{name, precision, recall, f, support}], confusion (classes, "
      "classes): counts [truth][called], confusion_labels.");
}

}  // namespace palpate::python
