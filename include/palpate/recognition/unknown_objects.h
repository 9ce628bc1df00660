// How well unknown objects are told from known ones: every class is taken out of the training in turn, and its grasps are strangers
// to a model of the others. Area under the curve (auroc, classification_report.h) of how strange grasps look.
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
  double auroc = 0.0;  // of this stranger against all known grasps
};

struct UnknownReport {
  double auroc = 0.0;                  // 0.5: no better than chance
  std::size_t known = 0, unknown = 0;  // grasps
  std::vector<UnknownClass> classes;
};

// The same day. Known ones: grasps of blocks that did not teach (protocol B), with the class in the model. Throws Error (less than
// three classes with two samples each), std::invalid_argument (options), Cancelled.
UnknownReport unknownWithin(const SampleSet& samples,
                            const PipelineOptions& options,
                            std::size_t blocks = 5,
                            const Progress& progress = {});

// Another day, with a session offset that ..
enum class StrangerOffset {
  kKnown,  // .. is known: here from the day's grasps, with the whole model. As a touch of the empty hand would tell
  kBatch,  // .. has to come from the day's grasps, strangers among them, with the model that lacks one
  kUnknown  // .. isn't known: summed over
};
// `later` with the classes of `training`; sessions: places in `later`, each with an offset of its own. Known ones: the session's
// grasps with the whole model. Only gauss knows offsets. Throws Error (other classes, nothing to examine), Cancelled.
UnknownReport unknownOnAnotherDay(const SampleSet& training,
                                  const SampleSet& later,
                                  const std::vector<std::vector<std::size_t>>& sessions,
                                  StrangerOffset offset,
                                  const Progress& progress = {});

// {auroc, known_grasps, unknown_grasps, classes[{name, grasps, auroc}]}
Json jsonOf(const UnknownReport& report);

}  // namespace palpate
