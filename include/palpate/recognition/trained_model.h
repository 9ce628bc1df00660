// A trained model: the fitted classifier, what it was made from, and what is known of the present
// session. It is stored as a JSON file with format version, program version, options and the
// SHA-256 of every input.
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

// A recording that a model was trained on.
struct ModelInput {
  std::string file;
  std::string sha256;
  std::string className;
  std::size_t grasps = 0;
  // Host times of its first and last grasp [us since 1970].
  std::int64_t firstUs = 0, lastUs = 0;
};

// Classification result for one grasp.
struct Prediction {
  static constexpr int kUnknown = -1;
  // Class index, or kUnknown if the grasp belongs to no known class.
  int label = kUnknown;
  // Probability of the best class, given that the object is one of the known classes.
  double confidence = 0.0;
  // True if the result is expected to be correct in 95 % of the cases; never true without a trusted
  // session offset.
  bool sure = false;
  // All classes, best first, whether or not the object is known.
  std::vector<int> ranking;
  // Probability of each class, in the order of the ranking.
  std::vector<double> p;
  // Whether the object is one of the known classes. kNotKnownYet: `label` is only the best of them.
  Membership membership = Membership::kKnown;
  // Novelty score: distance from the training samples; larger for unknown objects.
  double novelty = 0.0;
};

struct TrainedModel {
  // Version 1, which has no fields for zeros, can be read, too.
  static constexpr int kFormatVersion = 2;

  std::string programVersion;
  // Time of training in UTC, ISO 8601; may be empty.
  std::string madeAt;
  // See FeatureTable::sensor.
  std::string sensor;
  FeatureSet set = FeatureSet::kBest;
  std::vector<std::string> features, classes;
  // The calibrated pipeline.
  ClassifierPipeline pipeline;
  // For all classifiers except gauss: results with at least minSureConfidence are sure (above 1:
  // none is); results with a novelty above maxNovelty are unknown.
  double minSureConfidence = 2.0;
  double maxNovelty = 0.0;
  // Session offset that `palpate adapt` stored; noOffset() in a model that was never adapted.
  SessionOffset offset = noOffset();
  // Zero of the empty hand in the session of training, and in the session of the stored offset.
  std::optional<EmptyHandZero> trainingZero, sessionZero;
  std::vector<ModelInput> inputs, adaptedFrom;
  // Options of the command that made the model.
  Json options = Json::object();
  // Accuracy on contiguous blocks of its own training recordings.
  Json validation = Json::object();

  // Whether the classifier models a session offset and can be adapted; true for gauss only.
  bool adaptsToSession() const noexcept { return pipeline.sessionAdaptive.has_value(); }
  // Whether a time [us since 1970] is within half a day of the data that the offset belongs to: the
  // training recordings, or, for an adapted model, the recordings that adapted it. This is the best
  // available sign that it is the same session.
  bool sameSession(std::int64_t timeUs) const noexcept;
};

// Returns the recordings of a table with class, number of grasps and hash; hashes every file.
// Throws FileError, Cancelled.
std::vector<ModelInput> inputsOf(const FeatureTable& table, const Progress& progress = {});

// Fits a classifier and its confidence thresholds; the probabilities are calibrated on contiguous
// blocks (5 if the options name none). The caller fills in inputs, options and versions.
TrainedModel trainModel(const SampleSet& samples,
                        FeatureSet set,
                        const std::string& sensor,
                        PipelineOptions options,
                        const Progress& progress = {});

// Classifies rows of features. `offset` is ignored by classifiers that do not adapt to a session.
// Results of gauss can be sure only if the offset is trusted, or if `sameSession` is true and there
// is no offset; results of the other classifiers only if `sameSession` is true. Throws
// std::invalid_argument (another number of features).
std::vector<Prediction> classifyRows(const TrainedModel& model,
                                     const Eigen::MatrixXd& x,
                                     const SessionOffset& offset,
                                     bool sameSession);

// Returns one sentence, without a full stop: why it can't be known yet whether an object is one of
// the known classes, and which touch would tell it (Membership::kNotKnownYet).
std::string notKnownYetText(const TrainedModel& model, const SessionOffset& offset);

// Throws Error naming the difference when features do not fit a model: another sensor, or another
// set or version of features.
void requireFits(const TrainedModel& model, const FeatureTable& table);

// Adapts a model to a session with labelled grasps: narrows the offset `before`, and adds
// components of this session. Throws Error when the model can't be adapted.
void adaptModel(TrainedModel& model,
                const SampleSet& today,
                const SessionOffset& before = unknownOffset());
// Returns the offset given by a touch of the empty hand in this session, compared with the one in
// the session of training. Throws Error when `today` has a problem, when the model can't be
// adapted, or when it has no zero from its training.
SessionOffset offsetOfEmptyHand(const TrainedModel& model, const EmptyHandZero& today);
// Stores that offset and the zero in the model; components of the session are kept. Throws as
// offsetOfEmptyHand().
void adaptToEmptyHand(TrainedModel& model, const EmptyHandZero& today);

// Removes everything that belongs to a session after training: offset, zero, components, and the
// list of recordings that adapted the model.
void resetSession(TrainedModel& model);

Json jsonOf(const TrainedModel& model);
// Reads a model from JSON. Throws Error naming what is missing, damaged, or of a later format.
TrainedModel trainedModelFrom(const Json& json);
// Reads a model file. Throws FileError, FormatError (not a model, or damaged; names the cause).
TrainedModel loadModel(const std::filesystem::path& path);
// Writes a model file. Throws FileError.
void saveModel(const TrainedModel& model,
               const std::filesystem::path& path,
               Overwrite overwrite = Overwrite::kRefuse);

}  // namespace palpate
