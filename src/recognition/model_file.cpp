// Reads and writes a trained model as a JSON file (the functions of trained_model.h).
#include <cstdint>
#include <exception>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/text_file.h"
#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/trained_model.h"

#include "json_numbers.h"

namespace palpate {
namespace {
namespace js = json_numbers;
namespace fs = std::filesystem;

constexpr const char* kKind = "palpate recognition model";

Json jsonOf(const std::vector<ModelInput>& inputs) {
  return jsonList(inputs, [](const ModelInput& input) {
    return Json::object()
        .set("file", input.file)
        .set("sha256", input.sha256)
        .set("class", input.className)
        .set("grasps", input.grasps)
        .set("first_us", input.firstUs)
        .set("last_us", input.lastUs);
  });
}

std::vector<ModelInput> inputsFrom(const Json& json, std::string_view key) {
  const Json list = js::list(json, key);
  std::vector<ModelInput> inputs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json one = list.at(i);
    inputs.push_back({js::text(one, "file"),
                      js::text(one, "sha256"),
                      js::text(one, "class"),
                      js::count(one, "grasps"),
                      static_cast<std::int64_t>(js::number(one, "first_us")),
                      static_cast<std::int64_t>(js::number(one, "last_us"))});
  }
  return inputs;
}

// Key of the zero in format 1, which stored it among the options.
constexpr const char* kZeroInOptions = "empty_hand_zero";

Json jsonOf(const std::optional<EmptyHandZero>& zero) {
  return zero ? emptyHandZeroJson(*zero) : Json();
}

std::optional<EmptyHandZero> zeroFrom(const Json& json, std::string_view key) {
  const Json zero = js::member(json, key);
  if (zero.isNull()) return std::nullopt;
  return emptyHandZeroFrom(zero);
}

void requireAgreement(const TrainedModel& model) {
  const ClassifierPipeline& pipeline = model.pipeline;
  const auto features = static_cast<std::size_t>(
      pipeline.sessionAdaptive ? pipeline.sessionAdaptive->numFeatures()
                               : static_cast<std::size_t>(pipeline.standardisation.mean.size()));
  if (features != model.features.size() || pipeline.numClasses != model.classes.size())
    throw Error("model: its classifier has different classes or features than it names");
  if (pipeline.sessionAdaptive && (pipeline.sessionAdaptive->data().features != model.features ||
                                   pipeline.sessionAdaptive->data().classes != model.classes))
    throw Error("model: its classifier names other classes or features");
  if (!pipeline.calibrated) throw Error("model: its probabilities aren't calibrated");
}

}  // namespace

Json jsonOf(const TrainedModel& model) {
  return Json::object()
      .set("kind", kKind)
      .set("format_version", TrainedModel::kFormatVersion)
      .set("program_version", model.programVersion)
      .set("made_at", model.madeAt)
      .set("sensor", model.sensor)
      .set("feature_set", featureSetName(model.set))
      .set("features", js::of(model.features))
      .set("classes", js::of(model.classes))
      .set("options", model.options)
      .set("validation", model.validation)
      .set("sure_confidence", model.minSureConfidence)
      .set("most_novelty", model.maxNovelty)
      .set("session_offset", sessionOffsetJson(model.offset))
      .set("training_zero", jsonOf(model.trainingZero))
      .set("today_zero", jsonOf(model.sessionZero))
      .set("inputs", jsonOf(model.inputs))
      .set("adapted_from", jsonOf(model.adaptedFrom))
      .set("pipeline", jsonOf(model.pipeline));
}

TrainedModel trainedModelFrom(const Json& json) {
  if (!json.isObject() || !json.at("kind").isString() || json.at("kind").asString() != kKind)
    throw Error("this isn't a recognition model of palpate");
  const std::size_t version = js::count(json, "format_version");
  if (version < 1 || version > TrainedModel::kFormatVersion)
    throw Error("model: its format version is " + std::to_string(version) +
                ", this program reads up to " + std::to_string(TrainedModel::kFormatVersion) +
                ": train it again, or update palpate");
  TrainedModel model;
  model.programVersion = js::text(json, "program_version");
  model.madeAt = js::text(json, "made_at");
  model.sensor = js::text(json, "sensor");
  const std::string set = js::text(json, "feature_set");
  const auto known = featureSetNamed(set);
  if (!known)
    throw Error("model: its feature set '" + shortened(set) + "' isn't known to this version");
  model.set = *known;
  model.features = js::texts(json, "features");
  useCurrentFeatureNames(model.features);
  model.classes = js::texts(json, "classes");
  model.options = js::member(json, "options");
  model.validation = js::member(json, "validation");
  if (!model.options.isObject()) throw Error("model: 'options' isn't an object");
  model.minSureConfidence = js::number(json, "sure_confidence");
  model.maxNovelty = js::number(json, "most_novelty");
  model.offset = sessionOffsetFrom(js::member(json, "session_offset"));
  if (version >= 2) {
    model.trainingZero = zeroFrom(json, "training_zero");
    model.sessionZero = zeroFrom(json, "today_zero");
  } else if (model.options.isObject() && model.options.contains(kZeroInOptions)) {
    model.trainingZero = emptyHandZeroFrom(model.options.at(kZeroInOptions));
  }
  model.inputs = inputsFrom(json, "inputs");
  model.adaptedFrom = inputsFrom(json, "adapted_from");
  model.pipeline = pipelineFrom(js::member(json, "pipeline"));
  requireAgreement(model);
  return model;
}

TrainedModel loadModel(const fs::path& path) {
  // The largest one of the study's 36 objects has 0.3 MB.
  constexpr std::uint64_t kMaxBytes = 32u << 20;
  const std::string text = readTextFile(path, kMaxBytes);
  Json json;
  try {
    json = Json::parse(text);
  } catch (const std::exception& error) {
    throw FormatError(path, std::string("is not a model file: ") + error.what());
  }
  try {
    return trainedModelFrom(json);
  } catch (const std::exception& error) {
    throw FormatError(path, error.what());
  }
}

void saveModel(const TrainedModel& model, const fs::path& path, Overwrite overwrite) {
  OutputFile file(path, overwrite);
  file.write(jsonOf(model).text(-1) + "\n");
  file.commit();
}

}  // namespace palpate
