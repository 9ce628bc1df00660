#include "palpate/recognition/model_evaluation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

// Number of classes that are listed for a prediction.
constexpr std::size_t kTop = 5;

constexpr double kFarthestMm = 20.0;

Json intervalJson(std::size_t part, std::size_t whole) {
  const BinomialInterval interval = wilsonInterval(part, whole);
  return Json::array().push(interval.low).push(interval.high);
}

Json share(std::size_t part, std::size_t whole) {
  return whole == 0 ? Json() : Json(static_cast<double>(part) / static_cast<double>(whole));
}

// Returns the first `perClass` grasps of each class in time.
std::vector<std::size_t> firstOfClasses(const std::vector<std::size_t>& session,
                                        const SampleSet& samples,
                                        std::size_t perClass) {
  std::vector<std::size_t> taken(samples.numClasses(), 0), first;
  for (const std::size_t i : session)
    if (taken[static_cast<std::size_t>(samples.y[i])]++ < perClass) first.push_back(i);
  return first;
}

// Context of a session in which some grasps are labelled.
SessionContext adaptedUse(const TrainedModel& adapted,
                          const Eigen::MatrixXd& x,
                          const OffsetChoice& choice) {
  SessionContext use;
  use.offset = adapted.offset;
  if (choice.kind == OffsetChoice::Kind::kBatch)
    use.offset = offsetFromBatch(*adapted.pipeline.sessionAdaptive, x, adapted.offset);
  if (choice.kind == OffsetChoice::Kind::kGiven) use.offset = givenOffset(choice.mm);
  if (!use.offset.trusted) use.warnings.push_back("no answer is sure: " + use.offset.text());
  return use;
}

// Adds a warning where it can't be known yet whether the objects are classes of the model.
void warnNotKnownYet(const TrainedModel& model,
                     const std::vector<Prediction>& predictions,
                     SessionContext& use) {
  const auto count = std::count_if(predictions.begin(), predictions.end(), [](const auto& one) {
    return one.membership == Membership::kNotKnownYet;
  });
  if (count > 0)
    use.warnings.push_back(std::to_string(count) + " of " + std::to_string(predictions.size()) +
                           (predictions.size() == 1 ? " grasp: " : " grasps: ") +
                           notKnownYetText(model, use.offset));
}

Json offsetJson(const SessionOffset& offset) {
  return Json::object()
      .set("mm", offset.mm)
      .set("sd_mm", offset.sdMm)
      .set("origin", offsetSourceName(offset.origin))
      .set("grasps", offset.grasps)
      .set("objects", offset.objects)
      .set("trusted", offset.trusted);
}

}  // namespace

OffsetChoice OffsetChoice::from(const std::string& text) {
  if (text == "model") return {Kind::kModel, 0.0};
  if (text == "none") return {Kind::kNone, 0.0};
  if (text == "batch") return {Kind::kBatch, 0.0};
  const auto mm = parseDouble(text);
  if (!mm || std::abs(*mm) > kFarthestMm)
    throw std::invalid_argument(
        "'" + shortened(text) +
        "' is neither model, none, batch nor a number of mm from -20 to 20");
  return {Kind::kGiven, *mm};
}

SessionContext sessionFor(const TrainedModel& model,
                          const Eigen::MatrixXd& x,
                          const std::vector<std::int64_t>& timesUs,
                          const OffsetChoice& choice) {
  SessionContext use;
  use.sameSession =
      !timesUs.empty() && std::all_of(timesUs.begin(), timesUs.end(), [&](std::int64_t timeUs) {
        return model.sameSession(timeUs);
      });
  if (!model.adaptsToSession()) {
    if (choice.kind == OffsetChoice::Kind::kBatch || choice.kind == OffsetChoice::Kind::kGiven)
      throw Error("a model of classifier " +
                  std::string(classifierName(model.pipeline.classifier)) +
                  " has no session offset: train one with --classifier gauss");
    if (!use.sameSession)
      use.warnings.emplace_back(
          "no answer is sure: these grasps are not of the session the model was trained in");
    return use;
  }
  switch (choice.kind) {
    case OffsetChoice::Kind::kModel:
      use.offset = model.offset;
      if (use.offset.origin != OffsetSource::kNone && use.offset.trusted && !use.sameSession) {
        use.offset.trusted = false;
        use.warnings.emplace_back(
            "no answer is sure: the model was adapted in another session; adapt it again, or use "
            "--session-offset batch");
      } else if (use.offset.origin == OffsetSource::kNone && !use.sameSession) {
        // Without recordings and their times the session of the training isn't known.
        if (!timesUs.empty() && !model.inputs.empty()) use.offset = unknownOffset();
        use.warnings.emplace_back(
            "no answer is sure: not the session of the training, and its offset isn't known; adapt "
            "the model, or use --session-offset batch");
      } else if (use.offset.origin != OffsetSource::kNone && !use.offset.trusted) {
        use.warnings.push_back("no answer is sure: " + use.offset.text());
      }
      break;
    case OffsetChoice::Kind::kNone:
      use.offset = unknownOffset();
      break;
    case OffsetChoice::Kind::kBatch:
      use.offset =
          x.rows() == 0 ? unknownOffset() : offsetFromBatch(*model.pipeline.sessionAdaptive, x);
      if (!use.offset.trusted)
        use.warnings.push_back("no answer is sure: the offset is based on " +
                               std::to_string(use.offset.objects) +
                               (use.offset.objects == 1 ? " object" : " objects") +
                               " (two different ones and a small error are needed)");
      break;
    case OffsetChoice::Kind::kGiven:
      use.offset = givenOffset(choice.mm);
      break;
  }
  return use;
}

Classification classifyTable(const TrainedModel& model,
                             const FeatureTable& table,
                             const OffsetChoice& choice) {
  requireFits(model, table);
  const Eigen::MatrixXd x = valuesOf(table);
  Classification result;
  result.use = sessionFor(model, x, timesOf(table), choice);
  result.predictions = classifyRows(model, x, result.use.offset, result.use.sameSession);
  warnNotKnownYet(model, result.predictions, result.use);
  return result;
}

std::vector<std::vector<std::size_t>> sessionsOf(const std::vector<std::int64_t>& timesUs,
                                                 double pauseS) {
  std::vector<std::size_t> order(timesUs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return timesUs[a] < timesUs[b];
  });
  std::vector<std::vector<std::size_t>> sessions;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool paused =
        k > 0 && static_cast<double>(timesUs[order[k]] - timesUs[order[k - 1]]) > pauseS * 1e6;
    if (k == 0 || paused) sessions.emplace_back();
    sessions.back().push_back(order[k]);
  }
  return sessions;
}

ModelEvaluation evaluateModel(const TrainedModel& model,
                              const SampleSet& samples,
                              const std::vector<std::int64_t>& timesUs,
                              const EvaluationOptions& options) {
  samples.validate();
  if (timesUs.size() != samples.numSamples() || samples.classes != model.classes)
    throw std::invalid_argument("evaluateModel: times or classes don't belong to the samples");
  ModelEvaluation evaluation(model.classes);
  for (const std::vector<std::size_t>& session : sessionsOf(timesUs)) {
    const std::vector<std::size_t> labelled =
        firstOfClasses(session, samples, options.adaptPerClass);
    std::vector<std::size_t> rest;
    for (const std::size_t i : session)
      if (std::find(labelled.begin(), labelled.end(), i) == labelled.end()) rest.push_back(i);
    evaluation.adapted.insert(evaluation.adapted.end(), labelled.begin(), labelled.end());
    const Eigen::MatrixXd x = samples.rows(rest).x;
    std::vector<std::int64_t> times;
    for (const std::size_t i : rest) times.push_back(timesUs[i]);
    std::vector<Prediction> predictions;
    if (labelled.empty()) {
      evaluation.sessions.push_back(sessionFor(model, x, times, options.offset));
      const SessionContext& use = evaluation.sessions.back();
      predictions = classifyRows(model, x, use.offset, use.sameSession);
    } else {
      TrainedModel adapted = model;
      adaptModel(adapted, samples.rows(labelled));
      evaluation.sessions.push_back(adaptedUse(adapted, x, options.offset));
      predictions = classifyRows(adapted, x, evaluation.sessions.back().offset, false);
    }
    warnNotKnownYet(model, predictions, evaluation.sessions.back());
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const int truth = samples.y[rest[k]];
      Prediction& prediction = predictions[k];
      evaluation.confusion.add(truth, prediction.label);
      const auto top =
          prediction.ranking.begin() +
          static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, prediction.ranking.size()));
      evaluation.top3 += std::find(prediction.ranking.begin(), top, truth) != top ? 1 : 0;
      evaluation.notKnownYet += prediction.membership == Membership::kNotKnownYet ? 1 : 0;
      evaluation.sure += prediction.sure ? 1 : 0;
      evaluation.sureRight += prediction.sure && prediction.label == truth ? 1 : 0;
      evaluation.grasps.push_back({rest[k], evaluation.sessions.size() - 1, std::move(prediction)});
    }
  }
  if (evaluation.grasps.empty())
    throw Error("no grasp is left to test: all " + std::to_string(samples.numSamples()) +
                " adapt the model");
  return evaluation;
}

Json jsonOf(const ModelEvaluation& evaluation) {
  const std::size_t all = evaluation.confusion.total(), right = evaluation.confusion.right();
  const Json confusion = evaluation.confusion.confusionJson();
  Json sessions = Json::array(), warnings = Json::array();
  for (const SessionContext& session : evaluation.sessions) {
    sessions.push(offsetJson(session.offset));
    for (const std::string& warning : session.warnings) warnings.push(warning);
  }
  return Json::object()
      .set("accuracy", evaluation.confusion.accuracy())
      .set("interval", intervalJson(right, all))
      .set("grasps", all)
      .set("right", right)
      .set("top3", share(evaluation.top3, all))
      .set("coverage", share(evaluation.sure, all))
      .set("accuracy_when_sure", share(evaluation.sureRight, evaluation.sure))
      .set("interval_when_sure", intervalJson(evaluation.sureRight, evaluation.sure))
      .set("not_known_yet", evaluation.notKnownYet)
      .set("adapted_by", evaluation.adapted.size())
      .set("sessions", std::move(sessions))
      .set("warnings", std::move(warnings))
      .set("classes", evaluation.confusion.classesJson())
      .set("confusion", confusion.at("counts"))
      .set("confusion_labels", confusion.at("labels"));
}

std::string labelOf(const TrainedModel& model, int label) {
  return label == Prediction::kUnknown ? "unknown" : model.classes[static_cast<std::size_t>(label)];
}

Json predictionJson(const TrainedModel& model,
                    const FeatureRow& row,
                    const Prediction& prediction) {
  Json top = Json::array();
  for (std::size_t k = 0; k < std::min(kTop, prediction.ranking.size()); ++k)
    top.push(Json::object()
                 .set("label", labelOf(model, prediction.ranking[k]))
                 .set("p", prediction.p[k]));
  return Json::object()
      .set("file", row.file.string())
      .set("begin", row.begin)
      .set("end", row.end)
      .set("label", labelOf(model, prediction.label))
      .set("confidence", prediction.confidence)
      .set("sure", prediction.sure)
      .set("membership", membershipName(prediction.membership))
      .set("novelty", prediction.novelty)
      .set("top", std::move(top));
}

}  // namespace palpate
