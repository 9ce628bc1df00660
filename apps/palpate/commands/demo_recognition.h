// The recognition of `palpate demo`: asks a model what was held in each of some recordings of which
// that is known, and compares.
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
  std::string object;  // "foam ball"
};

struct AskedGrasp {
  KnownGrasp known;
  bool inTraining = false;               // whether the model knows the object
  FeatureRow row;                        // of the longest grasp of the recording
  std::optional<Prediction> prediction;  // nothing: there was none to ask about
  std::string called;                    // the verdict's label; empty without one
  // of the object among the classes, from 1; nothing: not taught, or no verdict
  std::optional<std::size_t> rank;
  double probability = 0.0;  // of the object, were it one of the known ones
  std::string problem;       // why there is no verdict; else empty

  // Called by its name; of an object that was not taught: called unknown.
  bool right() const;
};

struct DemoRecognition {
  std::vector<AskedGrasp> grasps;  // in the order asked for
  std::vector<std::string> warnings;
  Json sessionOffset;

  std::size_t numInTraining() const;
  std::size_t numRight(bool inTraining) const;  // among those that were taught, or that were not
};

// The grasps count as one session of a hand whose joints were never referenced anew: session offset
// 0. Throws Error: a recording that isn't there, or is of another sensor.
DemoRecognition askModel(const TrainedModel& model,
                         const std::vector<KnownGrasp>& grasps,
                         const Progress& progress = {});

// One line for a person: how many are right, each with its probability, and what is wrong.
std::string demoRecognitionText(const DemoRecognition& recognition);
// As `palpate classify --json`, each grasp with `object`, `taught`, `rank`, `probability`, `right`.
Json demoRecognitionJson(const DemoRecognition& recognition,
                         const TrainedModel& model,
                         const std::string& modelName);

}  // namespace palpate::commands
