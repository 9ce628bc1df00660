// The recognition of `palpate demo`: asks a model which object was held in recordings with a known
// object, and compares.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/json.h"
#include "palpate/core/progress.h"
#include "palpate/recognition/feature_table.h"
#include "palpate/recognition/trained_model.h"

namespace palpate::commands {

// A recording of one grasp of a known object.
struct KnownGrasp {
  std::filesystem::path file;
  // The common name: "foam ball".
  std::string object;
};

// A grasp with the answer of the model about it.
struct AskedGrasp {
  KnownGrasp known;
  // Whether the model was trained with the object.
  bool inTraining = false;
  // Features of the longest grasp of the recording.
  FeatureRow row;
  // Nothing when there was no grasp to evaluate.
  std::optional<Prediction> prediction;
  // The predicted label; empty without a prediction.
  std::string called;
  // Rank of the true object among the classes, from 1; nothing when the object was not in the
  // training data or there is no prediction.
  std::optional<std::size_t> rank;
  // Probability of the true object, given that it is one of the known classes.
  double probability = 0.0;
  // Why there is no prediction; else empty.
  std::string problem;

  // Whether the prediction is the true object, or "unknown" for an object that was not in the
  // training data.
  bool right() const;
};

// The answers about all grasps.
struct DemoRecognition {
  // In the order of the input.
  std::vector<AskedGrasp> grasps;
  std::vector<std::string> warnings;
  Json sessionOffset;

  std::size_t numInTraining() const;
  // Counts either the grasps of objects in the training data or the others.
  std::size_t numRight(bool inTraining) const;
};

// Treats the grasps as one session of a hand whose joints were not referenced again: session offset
// 0. Throws Error for a missing recording or another sensor.
DemoRecognition askModel(const TrainedModel& model,
                         const std::vector<KnownGrasp>& grasps,
                         const Progress& progress = {});

// One line of text: how many are right, each with its probability, and which are wrong.
std::string demoRecognitionText(const DemoRecognition& recognition);
// As `palpate classify --json`, with the additional members `object`, `taught`, `rank`,
// `probability` and `right` for each grasp.
Json demoRecognitionJson(const DemoRecognition& recognition,
                         const TrainedModel& model,
                         const std::string& modelName);

}  // namespace palpate::commands
