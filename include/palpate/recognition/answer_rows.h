// What a model answers, and how often that is right, as result tables. docs/manual/tables.md
// explains the columns.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <palpate/core/result_table.h>
#include <palpate/recognition/classification_report.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recognition/model_evaluation.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/trained_model.h>

namespace palpate {

// The table "answers": a row for each grasp of `table`, which has a prediction.
std::unique_ptr<ResultTable> answerTable(const TrainedModel& model,
                                         const FeatureTable& table,
                                         std::span<const Prediction> predictions);
// The table "verdicts": a row for each grasp that was tested, with its true class.
std::unique_ptr<ResultTable> verdictTable(const ModelEvaluation& evaluation,
                                          const FeatureTable& table,
                                          const SampleSet& samples);
// The table "classes".
std::unique_ptr<ResultTable> classTable(const ConfusionMatrix& confusion);

}  // namespace palpate
