// A trained model at work on other recordings: which session offset applies, and how well it does
// (protocol X). Nothing is counted that adapted it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/recognition/classification_report.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/session_offset.h>
#include <palpate/recognition/trained_model.h>

namespace palpate {

// Where the session offset comes from.
struct OffsetChoice {
  enum class Kind {
    kModel,  // what `adapt` stored; 0 in a fresh model
    kNone,   // nothing is assumed: classes are judged by summing over all offsets
    kBatch,  // from all grasps of the session, unlabelled
    kGiven   // `mm`
  };
  Kind kind = Kind::kModel;
  double mm = 0.0;
  // "model", "none", "batch", a number [mm, -20 .. 20]. Throws std::invalid_argument naming them.
  static OffsetChoice from(const std::string& text);
};

// What a session is judged with.
struct SessionContext {
  SessionOffset offset;
  bool sameSession = false;           // as the model's training, as far as times tell
  std::vector<std::string> warnings;  // a line each: why nothing will be sure
};

// x: the session's grasps, all of them; timesUs: host times of each. A classifier that doesn't
// carry over has no offset: anything but model and none throws Error.
SessionContext sessionFor(const TrainedModel& model,
                          const Eigen::MatrixXd& x,
                          const std::vector<std::int64_t>& timesUs,
                          const OffsetChoice& choice);

// What a model says of every row of a table, all of one session.
struct Classification {
  SessionContext use;
  std::vector<Prediction> predictions;  // one per row
};
// Throws Error: the table doesn't fit the model, or the model has no use for such an offset.
Classification classifyTable(const TrainedModel& model,
                             const FeatureTable& table,
                             const OffsetChoice& choice);

// Grasps that belong to one session, in order of time: a pause of more than `pauseS` [s] begins
// another.
std::vector<std::vector<std::size_t>> sessionsOf(const std::vector<std::int64_t>& timesUs,
                                                 double pauseS = 8.0 * 3600.0);

struct EvaluationOptions {
  // the first so many in time of each class and session are labelled
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
  ConfusionMatrix confusion;           // of the model's classes; `unknown` counts as wrong
  std::vector<EvaluatedGrasp> grasps;  // that count, session after session
  std::vector<std::size_t> adapted;    // that taught
  std::vector<SessionContext> sessions;
  std::size_t top3 = 0;  // the truth is among the three best
  std::size_t sure = 0, sureRight = 0;
};

// `samples` with the model's classes (samplesOf(table, model.classes)). Throws Error (a model that
// can't adapt; nothing is left to examine).
ModelEvaluation evaluateModel(const TrainedModel& model,
                              const SampleSet& samples,
                              const std::vector<std::int64_t>& timesUs,
                              const EvaluationOptions& options = {});

// accuracy, interval, top3, coverage, accuracy_when_sure, classes, confusion, .. (interfaces of
// `palpate evaluate --model`).
Json jsonOf(const ModelEvaluation& evaluation);

// The model's class, or "unknown".
std::string labelOf(const TrainedModel& model, int label);
// file, begin, end, label, confidence, sure, novelty, top: [{label, p}], the best five (interfaces
// of `palpate classify`).
Json predictionJson(const TrainedModel& model, const FeatureRow& row, const Prediction& prediction);

}  // namespace palpate
