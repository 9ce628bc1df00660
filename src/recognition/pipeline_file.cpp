// Converts a fitted ClassifierPipeline to JSON and back (the functions of classifier_pipeline.h).
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recognition/classifier_pipeline.h"

#include "json_numbers.h"

namespace palpate {
namespace {
namespace js = json_numbers;

[[noreturn]] void refusePipelineFile(const std::string& what) { throw Error("model: " + what); }

Json jsonOf(const GaussianClassifier& gaussian) {
  Json classes = Json::array();
  for (const GaussianClassifier::Class& one : gaussian.classes) {
    Json entry = Json::object().set("present", one.present);
    if (one.present)
      entry.set("mean", js::of(one.mean))
          .set("whitening", js::of(one.whitening))
          .set("log_determinant", one.logDeterminant);
    classes.push(std::move(entry));
  }
  return classes;
}

GaussianClassifier gaussianFrom(const Json& json,
                                std::string_view key,
                                std::size_t numClasses,
                                Eigen::Index features) {
  const Json list = js::member(json, key);
  if (!list.isArray() || list.size() != numClasses)
    refusePipelineFile("'" + shortened(key) + "' hasn't one entry per class");
  GaussianClassifier gaussian;
  gaussian.classes.resize(numClasses);
  for (std::size_t c = 0; c < numClasses; ++c) {
    const Json entry = list.at(c);
    GaussianClassifier::Class& one = gaussian.classes[c];
    one.present = js::flag(entry, "present");
    if (!one.present) continue;
    one.mean = js::vector(entry, "mean", features);
    one.whitening = js::matrix(entry, "whitening", features, features);
    one.logDeterminant = js::number(entry, "log_determinant");
  }
  return gaussian;
}

Json jsonOf(const SupportVectorMachine& svm) {
  Json pairs = Json::array();
  for (const auto& [first, second] : svm.pairs) pairs.push(Json::array().push(first).push(second));
  return Json::object()
      .set("pairs", std::move(pairs))
      .set("weights", js::of(svm.weights))
      .set("offsets", js::of(svm.offsets));
}

SupportVectorMachine svmFrom(const Json& json, std::size_t numClasses, Eigen::Index features) {
  SupportVectorMachine svm;
  svm.numClasses = numClasses;
  const Json pairs = js::member(json, "pairs");
  if (!pairs.isArray() || pairs.size() == 0) refusePipelineFile("'pairs' is empty");
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const Json pair = pairs.at(p);
    if (pair.size() != 2) refusePipelineFile("'pairs' holds something that is not a pair");
    const auto first = pair.at(0).asInteger(), second = pair.at(1).asInteger();
    if (first < 0 || second <= first || static_cast<std::size_t>(second) >= numClasses)
      refusePipelineFile("'pairs' names a class that isn't there");
    svm.pairs.emplace_back(static_cast<int>(first), static_cast<int>(second));
  }
  const auto count = static_cast<Eigen::Index>(svm.pairs.size());
  svm.weights = js::matrix(json, "weights", count, features);
  svm.offsets = js::vector(json, "offsets", count);
  return svm;
}

Json jsonOf(const std::vector<Sigmoid>& sigmoids) {
  return jsonList(sigmoids,
                  [](const Sigmoid& one) { return Json::array().push(one.a).push(one.b); });
}

std::vector<Sigmoid> sigmoidsFrom(const Json& json, std::size_t pairs) {
  const Eigen::MatrixXd table = js::matrix(json, "sigmoids", static_cast<Eigen::Index>(pairs), 2);
  std::vector<Sigmoid> sigmoids;
  for (Eigen::Index p = 0; p < table.rows(); ++p) sigmoids.push_back({table(p, 0), table(p, 1)});
  return sigmoids;
}

}  // namespace

Json jsonOf(const ClassifierPipeline& pipeline) {
  if (pipeline.sessionAdaptive)
    return Json::object()
        .set("classifier", classifierName(pipeline.classifier))
        .set("classes", pipeline.numClasses)
        .set("day", sessionAdaptiveJson(*pipeline.sessionAdaptive));
  Json json = Json::object()
                  .set("classifier", classifierName(pipeline.classifier))
                  .set("classes", pipeline.numClasses)
                  .set("features", static_cast<std::size_t>(pipeline.standardisation.mean.size()))
                  .set("mean", js::of(pipeline.standardisation.mean))
                  .set("scale", js::of(pipeline.standardisation.scale));
  if (pipeline.discriminant)
    json.set(
        "discriminant",
        Json::object()
            .set("components", static_cast<std::size_t>(pipeline.discriminant->directions.cols()))
            .set("mean", js::of(pipeline.discriminant->mean))
            .set("directions", js::of(pipeline.discriminant->directions))
            .set("separation", js::of(pipeline.discriminant->separation))
            .set("shrinkage", pipeline.discriminant->shrinkage));
  if (pipeline.classifier == ClassifierKind::kSvm)
    json.set("svm", jsonOf(pipeline.svm));
  else
    json.set("gaussians", jsonOf(pipeline.gaussian));
  json.set("calibrated", pipeline.calibrated);
  if (pipeline.calibrated)
    json.set("sigmoids", jsonOf(pipeline.sigmoids))
        .set("exponent", pipeline.exponent)
        .set("novelty", jsonOf(pipeline.novelty));
  return json;
}

ClassifierPipeline pipelineFrom(const Json& json) {
  ClassifierPipeline pipeline;
  const std::string name = js::text(json, "classifier");
  const auto kind = classifierNamed(name);
  if (!kind)
    refusePipelineFile("its classifier '" + shortened(name) + "' isn't known to this version");
  pipeline.classifier = *kind;
  pipeline.numClasses = js::count(json, "classes");
  if (*kind == ClassifierKind::kGauss) {
    pipeline.sessionAdaptive = sessionAdaptiveFrom(js::member(json, "day"));
    if (pipeline.sessionAdaptive->numClasses() != pipeline.numClasses)
      refusePipelineFile("'day' has other classes");
    pipeline.calibrated = true;
    return pipeline;
  }
  const auto features = static_cast<Eigen::Index>(js::count(json, "features"));
  if (pipeline.numClasses < 2 || features < 1)
    refusePipelineFile("it has no classes or no features");
  pipeline.standardisation.mean = js::vector(json, "mean", features);
  pipeline.standardisation.scale = js::vector(json, "scale", features);
  Eigen::Index inner = features;
  if (json.contains("discriminant")) {
    const Json part = json.at("discriminant");
    inner = static_cast<Eigen::Index>(js::count(part, "components"));
    if (inner < 1 || inner > features) refusePipelineFile("'components' is out of range");
    DiscriminantAnalysis discriminant;
    discriminant.mean = js::vector(part, "mean", features);
    discriminant.directions = js::matrix(part, "directions", features, inner);
    discriminant.separation = js::vector(part, "separation", inner);
    discriminant.shrinkage = js::number(part, "shrinkage");
    pipeline.discriminant = std::move(discriminant);
  }
  if (*kind == ClassifierKind::kSvm)
    pipeline.svm = svmFrom(js::member(json, "svm"), pipeline.numClasses, inner);
  else
    pipeline.gaussian = gaussianFrom(json, "gaussians", pipeline.numClasses, inner);
  pipeline.calibrated = js::flag(json, "calibrated");
  if (pipeline.calibrated) {
    pipeline.sigmoids = sigmoidsFrom(json, pipeline.svm.pairs.size());
    pipeline.exponent = js::number(json, "exponent");
    if (!(pipeline.exponent > 0.0)) refusePipelineFile("'exponent' must be above 0");
    pipeline.novelty = gaussianFrom(json, "novelty", pipeline.numClasses, inner);
  }
  return pipeline;
}

}  // namespace palpate
