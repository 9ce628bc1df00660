#include "palpate/recognition/training_choice.h"

#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate {
namespace {

std::string madeWith(FeatureSet set,
                     ClassifierKind classifier,
                     std::size_t components,
                     const std::string& detail) {
  return std::string(featureSetName(set)) + ", " +
         (components > 0 ? counted(components, "component") + ", " : std::string()) +
         std::string(classifierName(classifier)) + detail;
}

}  // namespace

ModelSearchOptions searchOptions(FeatureSet set, std::optional<ClassifierKind> classifier) {
  ModelSearchOptions search;
  search.classifier = classifier;
  if (!classifier && set == FeatureSet::kBest) search.classifier = ClassifierKind::kGauss;
  return search;
}

ChosenPipeline choosePipeline(const SampleSet& samples,
                              const ModelSearchOptions& search,
                              const Progress& progress) {
  const std::vector<PipelineOptions> grid = modelGrid(samples, search);
  if (grid.empty()) throw std::invalid_argument("choosePipeline: nothing to choose from");
  if (grid.size() == 1) return {grid.front(), {}};
  ChosenPipeline chosen;
  chosen.report = searchModel(samples, search, progress);
  chosen.options = chosen.report.candidates[chosen.report.chosen].options;
  return chosen;
}

std::string whyNoFeatures(FeatureSet set, bool pinches) {
  if (pinches || set == FeatureSet::kStatistics) return {};
  return "the hand of these recordings has no two pads that pinch";
}

std::string whyBoundToSession(FeatureSet set, ClassifierKind classifier) {
  if (classifier != ClassifierKind::kGauss) return "only gauss can be adapted to another session";
  switch (set) {
    case FeatureSet::kBest:
      return {};
    case FeatureSet::kSession:
      return "the set session holds the pose in which each object was presented";
    default:
      return "the set " + std::string(featureSetName(set)) + " has no " +
             plateauFeatureNames()[kSizeZColumn] + ", which the session offset shifts";
  }
}

std::string madeWithText(FeatureSet set, const PipelineOptions& options) {
  std::string detail;
  if (options.classifier == ClassifierKind::kSvm)
    detail = " (C = " + numberText(options.svm.c) + ")";
  return madeWith(set, options.classifier, options.components.value_or(0), detail);
}

std::string madeWithText(FeatureSet set, const ClassifierPipeline& pipeline) {
  const std::size_t components =
      pipeline.discriminant ? static_cast<std::size_t>(pipeline.discriminant->directions.cols())
                            : 0;
  return madeWith(set, pipeline.classifier, components, {});
}

}  // namespace palpate
