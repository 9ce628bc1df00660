// The command `palpate evaluate PATH` measures how well grasps are recognised, by cross-validation
// or with a model on other recordings.
#include <algorithm>
#include <array>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/recognition/answer_rows.h"
#include "palpate/recognition/cross_validation.h"
#include "palpate/recognition/model_evaluation.h"
#include "palpate/recognition/model_search.h"
#include "palpate/recognition/unknown_objects.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

constexpr std::size_t kBlocks = 5;
constexpr OptionRange kSplits{1, 100'000};

struct SetChoice {
  // Empty: that of the hand of the recordings.
  std::optional<FeatureSet> set;
  StudyPart part = StudyPart::kAll;
};

// A feature set, or a part of the study's.
const std::array<OptionWord<SetChoice>, 7> kSetWords{
    {{"diameter", {FeatureSet::kStudy, StudyPart::kDiameter}},
     {"first4", {FeatureSet::kStudy, StudyPart::kFirst4}},
     {"moments", {FeatureSet::kStudy, StudyPart::kMoments}},
     {"study", {FeatureSet::kStudy}},
     {"best", {FeatureSet::kBest}},
     {"session", {FeatureSet::kSession}},
     {"statistics", {FeatureSet::kStatistics}}}};
constexpr std::array<OptionWord<bool>, 2> kBlocksWords{{{"S", false}, {"B", true}}};

// What --model doesn't go with.
struct CrossValidation {
  std::optional<SetChoice> set = {};
  bool blocks = false;
  std::size_t numSplits = 10;
  std::uint64_t seed = 0;
};

Json coverageJson(const std::vector<CoveragePoint>& curve) {
  return jsonList(curve, [](const CoveragePoint& point) {
    return Json::object()
        .set("confidence", point.confidence)
        .set("coverage", point.coverage)
        .set("accuracy", point.accuracy);
  });
}

void addConfidence(const SampleSet& samples, const ValidationReport& report, Json& json) {
  std::vector<ScoredPrediction> answers;
  for (const TestPrediction& one : report.testPredictions)
    answers.push_back({one.confidence, one.called == samples.y[one.sample]});
  json.set("calibration_error", expectedCalibrationError(answers))
      .set("sure_confidence", confidenceThreshold(answers))
      .set("coverage", coverageJson(coverageCurve(answers)));
}

Json weightsJson(const SampleSet& samples, const PipelineOptions& options) {
  const Eigen::VectorXd weights = ClassifierPipeline::of(samples, options).featureWeights();
  Json json = Json::object();
  for (std::size_t j = 0; j < samples.numFeatures(); ++j)
    json.set(samples.features[j], weights[static_cast<Eigen::Index>(j)]);
  return json;
}

Json curveJson(const std::vector<LearningPoint>& curve) {
  return jsonList(curve, [](const LearningPoint& point) {
    return Json::object()
        .set("per_class", point.perClass)
        .set("train_grasps", point.trainSamples)
        .set("accuracy_mean", point.accuracyMean)
        .set("accuracy_sd", point.accuracySd);
  });
}

Json eliminationJson(const SampleSet& samples, const std::vector<EliminationStep>& steps) {
  return jsonList(steps, [&](const EliminationStep& step) {
    return Json::object()
        .set("features", step.features)
        .set("accuracy_mean", step.accuracyMean)
        .set("accuracy_sd", step.accuracySd)
        .set("then_dropped", samples.features[step.dropped]);
  });
}

std::vector<std::size_t> curveSizes(const SampleSet& samples) {
  const std::vector<std::size_t> counts = samples.counts();
  const std::size_t most = *std::max_element(counts.begin(), counts.end()) * 4 / 5;
  std::vector<std::size_t> sizes;
  for (const std::size_t size : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64})
    if (size <= most) sizes.push_back(size);
  return sizes;
}

// The recognition of unknown objects from the same session; with --later also from another session,
// with what is known about its offset.
Json unknownJson(const CommandLine& given,
                 const SampleSet& samples,
                 const PipelineOptions& options,
                 FeatureSet set) {
  const auto later = given.text("later");
  FeatureTable other;
  if (later) other = extractFeatureTable(given, {*later}, set);
  Json json;
  runInterruptibly(given, "unknown objects", [&](const Progress& progress) {
    json = jsonOf(unknownWithin(samples, options, kBlocks, progress));
    if (!later) return;
    const SampleSet day = samplesOf(other, samples.classes);
    const auto sessions = sessionsOf(timesOf(other));
    const auto with = [&](UnknownClassOffset offset) {
      return jsonOf(unknownInLaterSession(samples, day, sessions, offset, progress));
    };
    json.set("another_day",
             Json::object()
                 .set("sessions", sessions.size())
                 .set("offset_known", with(UnknownClassOffset::kKnown))
                 .set("offset_from_batch", with(UnknownClassOffset::kBatch))
                 .set("offset_unknown", with(UnknownClassOffset::kUnknown)));
  });
  return json;
}

PipelineOptions pipelineGiven(const CommandLine& given, FeatureSet set) {
  PipelineOptions options;
  if (set == FeatureSet::kBest && !given.has("lda"))
    options.classifier = ClassifierKind::kGauss;  // as in train
  takePipelineOptions(given, options);
  if (given.has("confidence")) options.calibrationBlocks = kBlocks;
  return options;
}

// JSON, or the table to a file of -o that ends in .csv.
int printResult(const CommandLine& given,
                const Json& json,
                ResultTable& table,
                const FeatureTable& features) {
  if (given.has("output") && formOf(given) == TableForm::kCsv)
    return std::max(writeTable(given, table), codeFor(features));
  printJson(given, json);
  return codeFor(features);
}

int crossValidation(const CommandLine& given, const CrossValidation& how) {
  const SetChoice choice = how.set.value_or(SetChoice{});
  PipelineOptions options = pipelineGiven(given, choice.set.value_or(FeatureSet::kBest));
  if (given.has("later") && !given.has("unknown")) throw UsageError("--later needs --unknown");
  if (given.has("later") && options.classifier != ClassifierKind::kGauss)
    throw UsageError(
        "--later needs --classifier gauss, the one that knows the offset of another session");

  const FeatureTable table = extractFeatureTable(given, {given.words().front()}, choice.set);
  SampleSet samples = samplesOf(table);
  if (choice.part != StudyPart::kAll) samples = studyPart(samples, choice.part);
  options = pipelineGiven(given, table.set);
  sayNotes(given, table.set, samples);
  requireLearnable(samples);
  const auto splits = how.blocks ? blockSplits(samples.y, kBlocks)
                                 : stratifiedSplits(samples.y, how.numSplits, how.seed);
  ValidationReport report(samples.classes);
  std::vector<LearningPoint> curve;
  std::vector<EliminationStep> steps;
  runInterruptibly(given, "cross-validation", [&](const Progress& progress) {
    report = crossValidate(samples, options, splits, 0, progress);
    if (given.has("learning-curve"))
      curve = learningCurve(
          samples, options, curveSizes(samples), how.numSplits, how.seed, 0, progress);
    if (given.has("eliminate")) steps = eliminateFeatures(samples, options, splits, 0, progress);
  });
  const Json confusion = report.confusion.confusionJson();
  Json accuracies = jsonList(report.accuracies);
  Json json = Json::object()
                  .set("accuracy_mean", report.accuracyMean)
                  .set("accuracy_sd", report.accuracySd)
                  .set("top3", report.top3)
                  .set("protocol", how.blocks ? "B" : "S")
                  .set("set", given.text("set").value_or(std::string(featureSetName(table.set))))
                  .set("pipeline", jsonOf(options))
                  .set("seed", how.blocks ? Json() : Json(static_cast<std::int64_t>(how.seed)))
                  .set("splits", splits.size())
                  .set("grasps", samples.numSamples())
                  .set("accuracies", std::move(accuracies))
                  .set("classes", report.confusion.classesJson())
                  .set("confusion", confusion.at("counts"))
                  .set("confusion_labels", confusion.at("labels"));
  if (given.has("confidence")) addConfidence(samples, report, json);
  if (given.has("weights")) json.set("weights", weightsJson(samples, options));
  if (given.has("learning-curve")) json.set("learning_curve", curveJson(curve));
  if (given.has("eliminate")) json.set("elimination", eliminationJson(samples, steps));
  if (given.has("unknown")) json.set("unknown", unknownJson(given, samples, options, table.set));
  return printResult(given, json, *classTable(report.confusion), table);
}

Json answersJson(const ModelEvaluation& evaluation,
                 const FeatureTable& table,
                 const SampleSet& samples) {
  Json list = Json::array();
  for (const EvaluatedGrasp& one : evaluation.grasps) {
    const FeatureRow& row = table.rows[one.sample];
    const int label = one.prediction.label;
    list.push(Json::object()
                  .set("file", row.file.string())
                  .set("begin", row.begin)
                  .set("end", row.end)
                  .set("class", samples.classes[static_cast<std::size_t>(samples.y[one.sample])])
                  .set("label",
                       label == Prediction::kUnknown
                           ? std::string("unknown")
                           : samples.classes[static_cast<std::size_t>(label)])
                  .set("confidence", one.prediction.confidence)
                  .set("sure", one.prediction.sure)
                  .set("novelty", one.prediction.novelty)
                  .set("session", one.session));
  }
  return list;
}

int withModel(const CommandLine& given, EvaluationOptions options) {
  for (const char* option : {"set",
                             "lda",
                             "classifier",
                             "protocol",
                             "splits",
                             "seed",
                             "c",
                             "shrinkage",
                             "unknown",
                             "later"})
    if (given.has(option))
      throw UsageError(std::string("--") + option +
                       " can't be used with --model, which has its own");
  try {
    if (const auto text = given.text("session-offset")) options.offset = OffsetChoice::from(*text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--session-offset: ") + error.what());
  }
  const TrainedModel model = loadModel(*given.text("model"));
  const FeatureTable table = extractFeatureTable(given, {given.words().front()}, model.set);
  requireFits(model, table);
  const SampleSet samples = samplesOf(table, model.classes);
  const ModelEvaluation evaluation = evaluateModel(model, samples, timesOf(table), options);
  for (const SessionContext& session : evaluation.sessions)
    for (const std::string& warning : session.warnings) sayLine(warning);
  Json json = jsonOf(evaluation);
  std::vector<ScoredPrediction> answers;
  for (const EvaluatedGrasp& one : evaluation.grasps)
    answers.push_back({one.prediction.confidence, one.prediction.label == samples.y[one.sample]});
  json.set("calibration_error", expectedCalibrationError(answers))
      .set("coverage_curve", coverageJson(coverageCurve(answers)))
      .set("verdicts", answersJson(evaluation, table, samples));
  return printResult(given, json, *verdictTable(evaluation, table, samples), table);
}

}  // namespace

int evaluateCommand(const Arguments& words) {
  CrossValidation how;
  EvaluationOptions evaluation;
  std::vector<OptionSpec> options = {
      boundChoice("set", "SET", "", how.set, kSetWords, kDefaultFeatureSetText),
      boundChoice("protocol",
                  "P",
                  "S: stratified shuffles; B: five contiguous blocks per class",
                  how.blocks,
                  kBlocksWords),
      bound("splits", "N", "splits of protocol S", how.numSplits, kSplits),
      bound("seed", "N", "seed of protocol S", how.seed, kSeedOption),
      {"confidence",
       "",
       "also calibrate probabilities: add their calibration error and the coverage curve"},
      {"weights", "", "add how much the classifier depends on each feature"},
      {"learning-curve", "", "add the accuracy for different numbers of training grasps per class"},
      {"eliminate", "", "add recursive feature elimination"},
      {"unknown", "", "add how well unknown objects are detected: each class left out in turn"},
      {"later", "PATH2", "with --unknown: the same on these grasps of another session (gauss)"},
      {"model", "M.json", "test this model instead (protocol X)"},
      bound("adapt",
            "K",
            "adapt it with the first K grasps of each class and session, which are not tested",
            evaluation.adaptPerClass,
            EvaluationOptions::kAdaptPerClass),
      {"session-offset",
       "WHICH",
       "model (default: what adapt stored), none (all offsets are averaged), batch, or mm"},
      {"json", "", "no effect: it always prints JSON"}};
  for (OptionSpec& one : pipelineOptionSpecs()) options.insert(options.begin() + 1, std::move(one));
  const CommandLine given(
      {.synopsis =
           "palpate evaluate PATH [--set SET] [--lda N] [--classifier NAME] [--protocol S|B] "
           "..\n       palpate evaluate --model M.json PATH [--adapt K] [--session-offset "
           "model|none|batch|MM]",
       .purpose =
           "Measures how well grasps are recognised and prints the result as JSON. PATH: a folder "
           "with a folder of recordings per class.\n\nWithout --model it uses cross-validation: "
           "everything (scaling, discriminant analysis, classifier) is fitted to the training part "
           "of each split alone. The default classifier is svm with C = 100, for the set best it "
           "is gauss, as in `train`; by default without discriminant analysis. Both protocols stay "
           "within the recordings: they don't show the accuracy in another session.\n\nWith "
           "--model it tests the model on other recordings. The candidates are all classes of the "
           "model; the answer unknown counts as wrong. Grasps more than 8 hours apart are "
           "different sessions, and each session has its own offset.\n\nWith -o OUT.csv it writes "
           "a "
           "table instead: the figures of each class, or with --model the answer to each grasp.",
       .options = withOutputOptions(std::move(options), "OUT.json|OUT.csv"),
       .example = "palpate evaluate recordings --set study --lda 14 --splits 50",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  formOf(given);
  if (given.has("model")) return withModel(given, std::move(evaluation));
  for (const char* option : {"adapt", "session-offset"})
    if (given.has(option)) throw UsageError(std::string("--") + option + " needs --model");
  return crossValidation(given, how);
}

}  // namespace palpate::commands
