// Evaluates a trained model on other recordings (protocol X): chooses the session offset,
// classifies, and measures the accuracy. Grasps that adapted the model are not counted. `palpate
// evaluate --model` and `palpate classify` use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/option_check.h>
#include <palpate/recognition/classification_report.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/session_offset.h>
#include <palpate/recognition/trained_model.h>

namespace palpate {

// Where the session offset comes from.
struct OffsetChoice {
  enum class Kind {
    // The offset that `adapt` stored. A model that was never adapted has the offset 0 in the
    // session of its training; in another session its offset is not known, as with kNone.
    kModel,
    // The offset is not known: classes are marginalised over all offsets.
    kNone,
    // Estimated from all grasps of the session, without labels.
    kBatch,
    // The value `mm`.
    kGiven
  };
  Kind kind = Kind::kModel;
  double mm = 0.0;
  // Reads "model", "none", "batch" or a number [mm, -20..20]. Throws std::invalid_argument naming
  // the allowed values.
  static OffsetChoice from(const std::string& text);
};

// What the predictions of a session depend on.
struct SessionContext {
  SessionOffset offset;
  // Whether it is the session in which the model was trained, judged by the times.
  bool sameSession = false;
  // One line for each reason why no prediction will be sure, or why it can't be known yet whether
  // an object is a class of the model.
  std::vector<std::string> warnings;
};

// Determines the offset of a session. x: all grasps of the session, one per row; timesUs: host time
// of each [us since 1970]. Throws Error if the classifier can't be adapted to a session and the
// choice is neither kModel nor kNone.
SessionContext sessionFor(const TrainedModel& model,
                          const Eigen::MatrixXd& x,
                          const std::vector<std::int64_t>& timesUs,
                          const OffsetChoice& choice);

// Predictions for every row of a table; all rows must be of one session.
struct Classification {
  SessionContext use;
  // One per row.
  std::vector<Prediction> predictions;
};
// Classifies all rows of a table. Throws Error when the table doesn't fit the model, or the model
// can't use such an offset.
Classification classifyTable(const TrainedModel& model,
                             const FeatureTable& table,
                             const OffsetChoice& choice);

// Groups grasps into sessions, in order of time. A pause of more than `pauseS` [s] begins a new
// session. Returns indices into `timesUs`.
std::vector<std::vector<std::size_t>> sessionsOf(const std::vector<std::int64_t>& timesUs,
                                                 double pauseS = 8.0 * 3600.0);

struct EvaluationOptions {
  // Number of grasps of each class and session, the first in time, that are labelled and adapt the
  // model; 0: none.
  static constexpr OptionRange kAdaptPerClass{0, 10'000};
  std::size_t adaptPerClass = 0;
  OffsetChoice offset;
};

struct EvaluatedGrasp {
  std::size_t sample = 0;
  std::size_t session = 0;
  Prediction prediction;
};

struct ModelEvaluation {
  explicit ModelEvaluation(std::vector<std::string> classes) : confusion(std::move(classes)) {}
  // Over the classes of the model; `unknown` counts as wrong.
  ConfusionMatrix confusion;
  // Grasps that were classified, session after session.
  std::vector<EvaluatedGrasp> grasps;
  // Samples that adapted the model.
  std::vector<std::size_t> adapted;
  std::vector<SessionContext> sessions;
  // Number of grasps whose true class is among the three best.
  std::size_t top3 = 0;
  std::size_t sure = 0, sureRight = 0;
  // Number of grasps of which it can't be known yet whether their object is a class of the model.
  std::size_t notKnownYet = 0;
};

// Evaluates a model on samples with the classes of the model (samplesOf(table, model.classes)).
// Throws Error (a model that can't adapt; no grasp is left to classify).
ModelEvaluation evaluateModel(const TrainedModel& model,
                              const SampleSet& samples,
                              const std::vector<std::int64_t>& timesUs,
                              const EvaluationOptions& options = {});

// JSON with accuracy, interval, top3, coverage, accuracy_when_sure, classes, confusion, ..
// (docs/manual/commands.md, `palpate evaluate --model`).
Json jsonOf(const ModelEvaluation& evaluation);

// Name of a class of the model, or "unknown".
std::string labelOf(const TrainedModel& model, int label);
// JSON with file, begin, end, label, confidence, sure, membership, novelty, top: [{label, p}] with
// the best five classes (docs/manual/commands.md, `palpate classify`).
Json predictionJson(const TrainedModel& model, const FeatureRow& row, const Prediction& prediction);

}  // namespace palpate
