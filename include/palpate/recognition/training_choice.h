// What a model is trained with: the set of features and the classifier. Both may be left open; then
// they are chosen here, for `palpate train` and for the training in the window in the same way.
#pragma once

#include <optional>
#include <string>

#include <palpate/core/progress.h>
#include <palpate/recognition/classifier_pipeline.h>
#include <palpate/recognition/grasp_features.h>
#include <palpate/recognition/model_search.h>
#include <palpate/recognition/sample_set.h>

namespace palpate {

struct TrainingChoice {
  // Empty: that of the hand (defaultFeatureSet()).
  std::optional<FeatureSet> set = std::nullopt;
  // Empty: gauss with the set `best`, else the search decides (searchOptions()).
  std::optional<ClassifierKind> classifier = std::nullopt;
  bool operator==(const TrainingChoice&) const = default;
};

// What a search has to try. The set `best` is meant for other sessions, and only gauss can be
// adapted to them, so that it is used even if another classifier is more accurate within the
// recordings.
ModelSearchOptions searchOptions(FeatureSet set, std::optional<ClassifierKind> classifier);

struct ChosenPipeline {
  PipelineOptions options;
  // Without candidates when there was nothing to choose.
  ModelSearchReport report;
};
// Chooses by cross-validation (searchModel()); where there is one candidate only, without it.
// Throws as searchModel() and modelGrid().
ChosenPipeline choosePipeline(const SampleSet& samples,
                              const ModelSearchOptions& search,
                              const Progress& progress = {});

// Why a set can't be computed, one line; empty: it can. `pinches`: whether the hand has two pads
// that pinch.
std::string whyNoFeatures(FeatureSet set, bool pinches);
// Why a model can't be used in another session than that of its training, one line; empty: it can
// be adapted to one. It needs the classifier gauss, and features that stay valid, among them the
// size that the session offset shifts.
std::string whyBoundToSession(FeatureSet set, ClassifierKind classifier);

// "best, gauss"; with the components and C of a classifier that has them: "study, 14 components,
// svm (C = 100)".
std::string madeWithText(FeatureSet set, const PipelineOptions& options);
// The same of a model, without what its options don't tell.
std::string madeWithText(FeatureSet set, const ClassifierPipeline& pipeline);

}  // namespace palpate
