// Measures how well grasps of unknown objects are detected. Each class in turn is removed from the
// training samples; its grasps are then unknown objects for a classifier of the remaining classes.
// The result is the area under the receiver operating characteristic (classification_report.h) of
// the novelty scores. `palpate evaluate --unknown` prints it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/recognition/classifier_pipeline.h>
#include <palpate/recognition/sample_set.h>

namespace palpate {

struct UnknownClass {
  std::string name;
  std::size_t grasps = 0;
  // Area under the curve for the grasps of this class against all grasps of known classes.
  double auroc = 0.0;
};

struct UnknownReport {
  // 0.5 is no better than chance.
  double auroc = 0.0;
  // Number of grasps.
  std::size_t known = 0, unknown = 0;
  std::vector<UnknownClass> classes;
};

// Evaluates within the session of training. Grasps of known classes come from test blocks (protocol
// B) and are scored by a classifier that knows their class. Throws Error (fewer than three classes
// with two samples each), std::invalid_argument (options), Cancelled.
UnknownReport unknownWithin(const SampleSet& samples,
                            const PipelineOptions& options,
                            std::size_t blocks = 5,
                            const Progress& progress = {});

// How the offset of another session is obtained.
enum class UnknownClassOffset {
  // Estimated from all grasps of the session with a classifier of all classes, and used as an
  // offset that the empty hand gave; this simulates a zero adjustment of the empty hand.
  kKnown,
  // Estimated from all grasps of the session, those of the unknown object included, with the
  // classifier that lacks its class.
  kBatch,
  // Not estimated: the probabilities are marginalised over the prior distribution of the offset.
  kUnknown
};
// Evaluates on other sessions. `later` has the classes of `training`; `sessions` are lists of
// indices into `later`, each with its own offset. Grasps of known classes are scored with the
// classifier of all classes. Only gauss uses offsets. Throws Error (other classes, no grasp to
// score), Cancelled.
UnknownReport unknownInLaterSession(const SampleSet& training,
                                    const SampleSet& later,
                                    const std::vector<std::vector<std::size_t>>& sessions,
                                    UnknownClassOffset offset,
                                    const Progress& progress = {});

// JSON with auroc, known_grasps, unknown_grasps, classes[{name, grasps, auroc}].
Json jsonOf(const UnknownReport& report);

}  // namespace palpate
