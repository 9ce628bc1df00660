#include "palpate/recognition/trained_model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/hash.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/recognition/cross_validation.h"

namespace palpate {
namespace {

constexpr std::int64_t kHalfDayUs = 12LL * 3600 * 1'000'000;
constexpr std::size_t kBlocks = 5;
// Fraction of known grasps that are not classified as unknown.
constexpr double kKnownShare = 0.99;

bool within(const std::vector<ModelInput>& inputs, std::int64_t timeUs) {
  return std::any_of(inputs.begin(), inputs.end(), [&](const ModelInput& input) {
    return timeUs >= input.firstUs - kHalfDayUs && timeUs <= input.lastUs + kHalfDayUs;
  });
}

// Sets the confidence above which results are sure and the novelty above which they are unknown,
// from grasps that were not used for training.
void setThresholds(const SampleSet& samples, const ValidationReport& report, TrainedModel& model) {
  std::vector<ScoredPrediction> answers;
  std::vector<double> novelty;
  for (const TestPrediction& one : report.testPredictions) {
    answers.push_back({one.confidence, one.called == samples.y[one.sample]});
    novelty.push_back(one.novelty);
  }
  std::sort(novelty.begin(), novelty.end());
  const auto last = static_cast<std::size_t>(kKnownShare * static_cast<double>(novelty.size() - 1));
  model.maxNovelty = novelty[last];
  model.minSureConfidence = confidenceThreshold(answers);
}

Json validationJson(const ValidationReport& report) {
  return Json::object()
      .set("protocol", "B")
      .set("accuracy_mean", report.accuracyMean)
      .set("accuracy_sd", report.accuracySd)
      .set("top3", report.top3)
      .set("grasps", report.testPredictions.size());
}

void requireCarriesOver(const TrainedModel& model) {
  if (!model.adaptsToSession())
    throw Error("a model of classifier " + std::string(classifierName(model.pipeline.classifier)) +
                " can't be adapted to a session: train one with --classifier gauss");
}

Prediction predictionOf(const OpenSetPrediction& day) {
  Prediction prediction;
  for (const std::size_t c : day.ranking) {
    prediction.ranking.push_back(static_cast<int>(c));
    prediction.p.push_back(day.probability[static_cast<Eigen::Index>(c)]);
  }
  prediction.label = day.unknown ? Prediction::kUnknown : prediction.ranking.front();
  prediction.confidence = prediction.p.front();
  prediction.sure = day.sure;
  prediction.membership = day.membership;
  prediction.novelty = -day.logLikelihoodRatio;
  return prediction;
}

}  // namespace

bool TrainedModel::sameSession(std::int64_t timeUs) const noexcept {
  if (offset.origin == OffsetSource::kNone) return within(inputs, timeUs);
  return within(adaptedFrom, timeUs) ||
         (sessionZero && std::abs(timeUs - sessionZero->timeUs) <= kHalfDayUs);
}

std::vector<ModelInput> inputsOf(const FeatureTable& table, const Progress& progress) {
  std::vector<ModelInput> inputs;
  std::map<std::string, std::size_t> place;
  for (const FeatureRow& row : table.rows) {
    const std::string name = row.file.string();
    const auto [at, isNew] = place.emplace(name, inputs.size());
    if (isNew) inputs.push_back({name, "", row.className, 0, row.timeUs, row.timeUs});
    ModelInput& input = inputs[at->second];
    ++input.grasps;
    input.firstUs = std::min(input.firstUs, row.timeUs);
    input.lastUs = std::max(input.lastUs, row.timeUs);
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    reportProgress(progress, i, inputs.size());
    inputs[i].sha256 = sha256OfFile(inputs[i].file);
  }
  return inputs;
}

TrainedModel trainModel(const SampleSet& samples,
                        FeatureSet set,
                        const std::string& sensor,
                        PipelineOptions options,
                        const Progress& progress) {
  if (options.calibrationBlocks == 0) options.calibrationBlocks = kBlocks;
  TrainedModel model;
  model.sensor = sensor;
  model.set = set;
  model.features = samples.features;
  model.classes = samples.classes;
  model.pipeline = ClassifierPipeline::of(samples, options);
  // With too few grasps for blocks the model is still made, but its results are never sure.
  const auto splits = blockSplits(samples.y, options.calibrationBlocks);
  const auto reports = splits.empty() ? std::vector<ValidationReport>()
                                      : crossValidateAll(samples, {options}, splits, 0, progress);
  if (reports.empty() || reports.front().testPredictions.empty()) {
    model.maxNovelty = 1e9;
    return model;
  }
  setThresholds(samples, reports.front(), model);
  model.validation = validationJson(reports.front());
  return model;
}

std::vector<Prediction> classifyRows(const TrainedModel& model,
                                     const Eigen::MatrixXd& x,
                                     const SessionOffset& offset,
                                     bool sameSession) {
  std::vector<Prediction> predictions;
  if (x.rows() == 0) return predictions;
  if (model.pipeline.sessionAdaptive) {
    SessionOffset used = offset;
    if (used.origin == OffsetSource::kNone && sameSession) used.trusted = true;
    for (const OpenSetPrediction& day : predictAll(*model.pipeline.sessionAdaptive, x, used))
      predictions.push_back(predictionOf(day));
    return predictions;
  }
  const Eigen::MatrixXd p = model.pipeline.probabilities(x);
  const Eigen::VectorXd novelty = model.pipeline.noveltyScores(x);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    Prediction prediction;
    prediction.ranking = rankedClasses(p.row(i).transpose());
    for (const int c : prediction.ranking) prediction.p.push_back(p(i, c));
    prediction.novelty = novelty[i];
    prediction.confidence = prediction.p.front();
    const bool known = novelty[i] <= model.maxNovelty;
    prediction.label = known ? prediction.ranking.front() : Prediction::kUnknown;
    prediction.sure = known && sameSession && prediction.confidence >= model.minSureConfidence;
    prediction.membership = known ? Membership::kKnown : Membership::kUnknown;
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

std::string notKnownYetText(const TrainedModel& model, const SessionOffset& offset) {
  std::string touch = model.trainingZero ? "measure the zero of the empty hand, or " : "";
  const auto reference = model.pipeline.sessionAdaptive
                             ? bestReference(*model.pipeline.sessionAdaptive)
                             : std::optional<OffsetReference>();
  touch += "label grasps of two objects that differ in size";
  if (reference)
    touch += "; one of '" + shortened(model.classes[reference->classIndex]) +
             "' determines the offset best, to +- " + fixedText(reference->sdMm, 1) + " mm";
  const double sdMm = offset.origin == OffsetSource::kBatch ? unknownOffset().sdMm : offset.sdMm;
  return "it can't be known yet whether the object is one of the trained ones, because the session "
         "offset is not known (+- " +
         fixedText(sdMm, 1) + " mm): " + touch;
}

void requireFits(const TrainedModel& model, const FeatureTable& table) {
  if (!table.sensor.empty() && table.sensor != model.sensor)
    throw Error("the model was trained on another sensor: " + model.sensor + "; this one has " +
                table.sensor);
  if (table.names != model.features)
    throw Error("the model's features aren't those that this version computes for the set '" +
                std::string(featureSetName(model.set)) + "': train it again");
}

void adaptModel(TrainedModel& model, const SampleSet& today, const SessionOffset& before) {
  requireCarriesOver(model);
  if (today.numSamples() == 0) throw Error("there is no grasp to adapt to");
  SessionAdaptiveClassifier& day = *model.pipeline.sessionAdaptive;
  model.offset = offsetFromReferences(day, today.x, today.y, before);
  day.addSessionComponents(today.x, today.y, model.offset.mm);
}

SessionOffset offsetOfEmptyHand(const TrainedModel& model, const EmptyHandZero& today) {
  requireCarriesOver(model);
  if (!today.problem.empty()) throw Error(today.problem);
  if (!model.trainingZero)
    throw Error(
        "the model has no zero of the empty hand to compare with: record the empty hand in the "
        "session of the training (palpate train --empty-hand-zero, or Zero before Train)");
  return emptyHandOffset(today, *model.trainingZero);
}

void resetSession(TrainedModel& model) {
  model.offset = noOffset();
  model.sessionZero.reset();
  model.adaptedFrom.clear();
  if (!model.pipeline.sessionAdaptive) return;
  SessionAdaptiveParameters data = model.pipeline.sessionAdaptive->data();
  data.today.clear();
  model.pipeline.sessionAdaptive = SessionAdaptiveClassifier(std::move(data));
}

void adaptToEmptyHand(TrainedModel& model, const EmptyHandZero& today) {
  model.offset = offsetOfEmptyHand(model, today);
  model.sessionZero = today;
}

}  // namespace palpate
