// A trained model: the classifier with all that it was made from, and what is known of today. A
// JSON file with format version, program version, options, and the SHA-256 of every input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/recognition/classifier_pipeline.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/session_offset.h>

namespace palpate {

// A recording a model learnt from.
struct ModelInput {
  std::string file;
  std::string sha256;
  std::string className;
  std::size_t grasps = 0;
  std::int64_t firstUs = 0, lastUs = 0;  // host times of its first and last grasp [us since 1970]
};

// What a model says of one grasp.
struct Prediction {
  static constexpr int kUnknown = -1;
  // Class index, or kUnknown if the grasp belongs to no known class.
  int label = kUnknown;
  double confidence = 0.0;  // probability of the best class, were it one of the known ones
  // True if the result is expected to be correct in 95 % of the cases; never true without a trusted
  // session offset.
  bool sure = false;
  std::vector<int> ranking;  // all classes, best first, whether known or not
  std::vector<double> p;     // of each class of the ranking
  // Novelty score: distance from the training samples; larger for unknown objects.
  double novelty = 0.0;
};

struct TrainedModel {
  static constexpr int kFormatVersion = 2;  // 1 is read, too: it had no field for zeros

  std::string programVersion;
  std::string madeAt;  // UTC, ISO 8601; may be empty
  std::string sensor;  // FeatureTable::sensor
  FeatureSet set = FeatureSet::kBest;
  std::vector<std::string> features, classes;
  ClassifierPipeline pipeline;  // calibrated
  // For all classifiers except gauss: results with at least this confidence are sure (above 1:
  // never); results with at least maxNovelty are unknown.
  double minSureConfidence = 2.0;
  double maxNovelty = 0.0;
  // Session offset that `palpate adapt` stored; noOffset() in a model that was never adapted.
  SessionOffset offset = noOffset();
  // Of the empty hand: on the day of training, and on the day whose offset is stored.
  std::optional<EmptyHandZero> trainingZero, sessionZero;
  std::vector<ModelInput> inputs, adaptedFrom;
  Json options = Json::object();     // of the command that made it
  Json validation = Json::object();  // how well it did on blocks of its own recordings

  // Whether the classifier models a session offset and can be adapted; true for gauss only.
  bool adaptsToSession() const noexcept { return pipeline.sessionAdaptive.has_value(); }
  // Whether a time lies within half a day of the day its offset is of: that of what it learnt from,
  // or, once it is adapted, of what adapted it. The same session, as far as one can tell.
  bool sameSession(std::int64_t timeUs) const noexcept;
};

// Classes and their number of grasps, by file: hashes every file. Throws FileError, Cancelled.
std::vector<ModelInput> inputsOf(const FeatureTable& table, const Progress& progress = {});

// Fits a classifier and its confidence thresholds; the probabilities are calibrated on contiguous
// blocks (5 if the options name none). The caller fills in inputs, options and versions.
TrainedModel trainModel(const SampleSet& samples,
                        FeatureSet set,
                        const std::string& sensor,
                        PipelineOptions options,
                        const Progress& progress = {});

// Verdicts on rows of features. `offset` is of no use to a classifier that doesn't carry over. Sure
// with: an offset that can be trusted, or `sameSession` and no offset. Throws std::invalid_argument
// (another number of features).
std::vector<Prediction> classifyRows(const TrainedModel& model,
                                     const Eigen::MatrixXd& x,
                                     const SessionOffset& offset,
                                     bool sameSession);

// Throws Error naming what doesn't agree between a model and the features it is to judge: another
// sensor, another set of features (of another version).
void requireFits(const TrainedModel& model, const FeatureTable& table);

// Labelled grasps of today: the offset from them on top of what is known of it already, and their
// components. Throws Error when the model doesn't carry over.
void adaptModel(TrainedModel& model,
                const SampleSet& today,
                const SessionOffset& before = unknownOffset());
// The offset by a touch of the empty hand today against that of training. Throws Error: trouble in
// it, the model doesn't carry over or keeps no zero of its own to compare with.
SessionOffset offsetOfEmptyHand(const TrainedModel& model, const EmptyHandZero& today);
// Stores both, besides what else is known of today. Throws as offsetOfEmptyHand().
void adaptToEmptyHand(TrainedModel& model, const EmptyHandZero& today);

// What it knew of another day than that of its training: offset, zero, components, where they came
// from.
void resetSession(TrainedModel& model);

Json jsonOf(const TrainedModel& model);
// Throws Error naming what is missing, damaged, or of a later format.
TrainedModel trainedModelFrom(const Json& json);
// Throws FileError, FormatError (no model, damaged; names what).
TrainedModel loadModel(const std::filesystem::path& path);
// Throws FileError.
void saveModel(const TrainedModel& model,
               const std::filesystem::path& path,
               Overwrite overwrite = Overwrite::kRefuse);

}  // namespace palpate
