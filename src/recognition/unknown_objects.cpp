#include "palpate/recognition/unknown_objects.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/parallel.h"
#include "palpate/core/progress.h"
#include "palpate/recognition/classification_report.h"
#include "palpate/recognition/cross_validation.h"
#include "palpate/recognition/session_offset.h"

namespace palpate {
namespace {

// Returns the samples without class `taken` and without classes that have no samples.
SampleSet without(const SampleSet& samples, int taken) {
  const std::vector<std::size_t> counts = samples.counts();
  std::vector<int> number(samples.numClasses(), -1);
  SampleSet rest;
  rest.features = samples.features;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c] == 0 || static_cast<int>(c) == taken) continue;
    number[c] = static_cast<int>(rest.classes.size());
    rest.classes.push_back(samples.classes[c]);
  }
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < samples.y.size(); ++i)
    if (number[static_cast<std::size_t>(samples.y[i])] >= 0) rows.push_back(i);
  const SampleSet part = samples.rows(rows);
  rest.x = part.x;
  for (const int c : part.y) rest.y.push_back(number[static_cast<std::size_t>(c)]);
  return rest;
}

constexpr int kNone = -1;

std::vector<std::size_t> rowsOf(const SampleSet& samples, int wanted) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < samples.y.size(); ++i)
    if (samples.y[i] == wanted) rows.push_back(i);
  return rows;
}

UnknownReport unknownObjectsReportOf(const SampleSet& samples,
                                     const std::vector<double>& known,
                                     const std::vector<std::vector<double>>& ofClass) {
  UnknownReport report;
  std::vector<double> unknown;
  for (std::size_t c = 0; c < ofClass.size(); ++c) {
    if (ofClass[c].empty()) continue;
    unknown.insert(unknown.end(), ofClass[c].begin(), ofClass[c].end());
    report.classes.push_back({samples.classes[c], ofClass[c].size(), auroc(ofClass[c], known)});
  }
  report.known = known.size();
  report.unknown = unknown.size();
  if (known.empty() || unknown.empty()) throw Error("unknown objects: no grasp to test");
  report.auroc = auroc(unknown, known);
  return report;
}

void requireThreeClasses(const SampleSet& samples) {
  const std::vector<std::size_t> counts = samples.counts();
  if (std::count_if(counts.begin(), counts.end(), [](std::size_t count) { return count >= 2; }) < 3)
    throw Error("unknown objects: at least three classes with two grasps each are needed");
}

SessionOffset offsetOf(const SessionAdaptiveClassifier& model,
                       const Eigen::MatrixXd& sessionSamples,
                       UnknownClassOffset kind) {
  if (kind == UnknownClassOffset::kUnknown) return unknownOffset();
  const SessionOffset batch = offsetFromBatch(model, sessionSamples);
  if (kind == UnknownClassOffset::kBatch) return batch;
  constexpr double kMinSdMm = 0.05;
  return measuredOffset(batch.mm, std::max(batch.sdMm, kMinSdMm), OffsetSource::kEmptyHand);
}

}  // namespace

UnknownReport unknownWithin(const SampleSet& samples,
                            const PipelineOptions& options,
                            std::size_t blocks,
                            const Progress& progress) {
  PipelineOptions used = options;
  // The distance does not depend on the number of blocks.
  if (used.calibrationBlocks == 0) used.calibrationBlocks = 2;
  used.validate();
  requireThreeClasses(samples);
  // Fraction of the work, for the progress.
  constexpr double kKnownPart = 0.15;
  const auto part = [&](double from, double to) {
    return progress ? Progress([&progress, from, to](double fraction) {
      return progress(from + (to - from) * fraction);
    })
                    : Progress();
  };
  const SampleSet present = without(samples, kNone);
  std::vector<double> known;
  for (const TestPrediction& one :
       crossValidate(present, used, blockSplits(present.y, blocks), 0, part(0.0, kKnownPart))
           .testPredictions)
    known.push_back(one.novelty);
  std::vector<std::vector<double>> ofClass(present.numClasses());
  forEachInParallel(
      ofClass.size(),
      [&](std::size_t c) {
        const auto pipeline = ClassifierPipeline::of(without(present, static_cast<int>(c)), used);
        const Eigen::VectorXd novelty =
            pipeline.noveltyScores(present.rows(rowsOf(present, static_cast<int>(c))).x);
        ofClass[c].assign(novelty.begin(), novelty.end());
      },
      part(kKnownPart, 1.0));
  return unknownObjectsReportOf(present, known, ofClass);
}

UnknownReport unknownInLaterSession(const SampleSet& training,
                                    const SampleSet& later,
                                    const std::vector<std::vector<std::size_t>>& sessions,
                                    UnknownClassOffset offset,
                                    const Progress& progress) {
  if (later.classes != training.classes || later.features != training.features)
    throw Error(
        "unknown objects: the other session has other classes or features than the training");
  requireThreeClasses(training);
  PipelineOptions options;
  options.classifier = ClassifierKind::kGauss;
  const auto modelOf = [&](int taken) {
    return *ClassifierPipeline::of(without(training, taken), options).sessionAdaptive;
  };
  const SessionAdaptiveClassifier whole = modelOf(kNone);
  std::vector<double> known;
  std::vector<std::vector<double>> ofClass(later.numClasses());
  const auto strangeness = [](const SessionAdaptiveClassifier& model,
                              const Eigen::MatrixXd& x,
                              const SessionOffset& with,
                              std::vector<double>& out) {
    for (const OpenSetPrediction& prediction : predictAll(model, x, with))
      out.push_back(-prediction.logLikelihoodRatio);
  };
  std::vector<std::pair<std::size_t, int>> unknownClasses;
  for (std::size_t s = 0; s < sessions.size(); ++s)
    for (std::size_t c = 0; c < later.numClasses(); ++c)
      if (!rowsOf(later.rows(sessions[s]), static_cast<int>(c)).empty())
        unknownClasses.emplace_back(s, static_cast<int>(c));
  for (const auto& session : sessions) {
    const Eigen::MatrixXd x = later.rows(session).x;
    strangeness(whole, x, offsetOf(whole, x, offset), known);
  }
  for (std::size_t k = 0; k < unknownClasses.size(); ++k) {
    reportProgress(progress, k, unknownClasses.size());
    const auto [session, c] = unknownClasses[k];
    const SampleSet sessionSamples = later.rows(sessions[session]);
    const SessionAdaptiveClassifier rest = modelOf(c);
    strangeness(
        rest,
        sessionSamples.rows(rowsOf(sessionSamples, c)).x,
        offsetOf(offset == UnknownClassOffset::kKnown ? whole : rest, sessionSamples.x, offset),
        ofClass[static_cast<std::size_t>(c)]);
  }
  return unknownObjectsReportOf(later, known, ofClass);
}

Json jsonOf(const UnknownReport& report) {
  Json classes = jsonList(report.classes, [](const UnknownClass& one) {
    return Json::object().set("name", one.name).set("grasps", one.grasps).set("auroc", one.auroc);
  });
  return Json::object()
      .set("auroc", report.auroc)
      .set("known_grasps", report.known)
      .set("unknown_grasps", report.unknown)
      .set("classes", std::move(classes));
}

}  // namespace palpate
