#include "palpate/recognition/answer_rows.h"

#include <cstddef>
#include <string>
#include <utility>

#include "palpate/recognition/session_offset.h"

namespace palpate {
namespace {

struct Answer {
  FeatureRow grasp;
  Prediction prediction;
  std::string label, truth = {};
  std::size_t session = 0;
};
using AnswerColumns = std::vector<ColumnOf<Answer>>;

AnswerColumns graspColumns() {
  return {
      columnOf<Answer>(
          "file", "", "the recording", [](const Answer& row) { return row.grasp.file.string(); }),
      columnOf<Answer>("begin",
                       "",
                       "first frame of the grasp",
                       [](const Answer& row) { return row.grasp.begin; }),
      columnOf<Answer>(
          "end", "", "last frame of the grasp", [](const Answer& row) { return row.grasp.end; })};
}

void appendAnswer(AnswerColumns& columns) {
  columns.push_back(columnOf<Answer>("label", "", "what the model calls it", &Answer::label));
  columns.push_back(columnOf<Answer>("confidence",
                                     "",
                                     "probability of the label among the classes, 0 to 1",
                                     [](const Answer& row) { return row.prediction.confidence; }));
  columns.push_back(
      columnOf<Answer>("sure", "", "whether it is right in 95 of 100 cases", [](const Answer& row) {
        return row.prediction.sure;
      }));
}

}  // namespace

std::unique_ptr<ResultTable> answerTable(const TrainedModel& model,
                                         const FeatureTable& table,
                                         std::span<const Prediction> predictions) {
  std::vector<Answer> rows;
  for (std::size_t i = 0; i < predictions.size(); ++i)
    rows.push_back({table.rows[i], predictions[i], labelOf(model, predictions[i].label)});
  AnswerColumns columns = graspColumns();
  appendAnswer(columns);
  columns.push_back(columnOf<Answer>(
      "membership", "", "whether the object is a class of the model", [](const Answer& row) {
        return membershipName(row.prediction.membership);
      }));
  return std::make_unique<RowTable<Answer>>("answers", std::move(columns), std::move(rows));
}

std::unique_ptr<ResultTable> verdictTable(const ModelEvaluation& evaluation,
                                          const FeatureTable& table,
                                          const SampleSet& samples) {
  const auto nameOf = [&](int label) {
    return label == Prediction::kUnknown ? "unknown"
                                         : samples.classes[static_cast<std::size_t>(label)];
  };
  std::vector<Answer> rows;
  for (const EvaluatedGrasp& one : evaluation.grasps)
    rows.push_back({table.rows[one.sample],
                    one.prediction,
                    nameOf(one.prediction.label),
                    nameOf(samples.y[one.sample]),
                    one.session});
  AnswerColumns columns = graspColumns();
  columns.push_back(columnOf<Answer>("class", "", "what is held", &Answer::truth));
  appendAnswer(columns);
  columns.push_back(finiteColumn<Answer>(
      "novelty", "", "distance from the grasps of the training", [](const Answer& row) {
        return row.prediction.novelty;
      }));
  columns.push_back(
      columnOf<Answer>("session", "", "number of the session, from 0", &Answer::session));
  return std::make_unique<RowTable<Answer>>("verdicts", std::move(columns), std::move(rows));
}

std::unique_ptr<ResultTable> classTable(const ConfusionMatrix& confusion) {
  using Class = ClassMetrics;
  return std::make_unique<RowTable<Class>>(
      "classes",
      std::vector<ColumnOf<Class>>{
          columnOf<Class>("class", "", "what is held", &Class::name),
          columnOf<Class>("precision", "", "part of its answers that are right", &Class::precision),
          columnOf<Class>("recall", "", "part of its grasps that are recognised", &Class::recall),
          columnOf<Class>("f", "", "harmonic mean of the two", &Class::f),
          columnOf<Class>("support", "", "number of its grasps", &Class::support)},
      confusion.classMetrics());
}

}  // namespace palpate
