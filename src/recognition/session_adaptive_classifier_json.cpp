// The file form of the model and the offset of a session.
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/recognition/session_adaptive_classifier.h"
#include "palpate/recognition/session_offset.h"

namespace palpate {
namespace {

constexpr std::int64_t kFormat = 1;

Json dayJsonOf(const Eigen::VectorXd& vector) {
  Json out = Json::array();
  for (const double value : vector) out.push(value);
  return out;
}

Json dayJsonOf(const Eigen::MatrixXd& matrix) {
  Json out = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    out.push(dayJsonOf(Eigen::VectorXd(matrix.row(row).transpose())));
  return out;
}

Json dayJsonOf(const std::vector<std::string>& texts) { return jsonList(texts); }

Json dayJsonOf(const StudentTComponent& distribution) {
  return Json::object()
      .set("mean", dayJsonOf(distribution.mean))
      .set("scatter", dayJsonOf(distribution.scatter));
}

Json needed(const Json& json, const char* key) {
  if (!json.isObject() || !json.contains(key))
    throw Error(std::string("a damaged model: '") + key + "' is missing");
  return json.at(key);
}

double dayModelJsonNumberIn(const Json& json, const char* key) {
  const Json value = needed(json, key);
  if (!value.isNumber() || !std::isfinite(value.asDouble()))
    throw Error(std::string("a damaged model: '") + key + "' is no number");
  return value.asDouble();
}

std::size_t countIn(const Json& json, const char* key) {
  const double value = dayModelJsonNumberIn(json, key);
  if (!(value >= 0.0 && value <= 1e9 && value == std::floor(value)))
    throw Error(std::string("a damaged model: '") + key + "' is no number of things");
  return static_cast<std::size_t>(value);
}

Eigen::VectorXd vectorIn(const Json& array, const char* key) {
  if (!array.isArray()) throw Error(std::string("a damaged model: '") + key + "' is no list");
  Eigen::VectorXd out(static_cast<Eigen::Index>(array.size()));
  for (std::size_t i = 0; i < array.size(); ++i) {
    const Json value = array.at(i);
    if (!value.isNumber())
      throw Error(std::string("a damaged model: '") + key + "' holds what is no number");
    out[static_cast<Eigen::Index>(i)] = value.asDouble();
  }
  return out;
}

Eigen::MatrixXd matrixIn(const Json& json, const char* key) {
  const Json array = needed(json, key);
  if (!array.isArray() || array.size() == 0)
    throw Error(std::string("a damaged model: '") + key + "' is no matrix");
  const auto size = static_cast<Eigen::Index>(array.size());
  // Before anything is allocated by it: a small file may claim a large matrix.
  for (std::size_t row = 0; row < array.size(); ++row)
    if (array.at(row).size() != array.size())
      throw Error(std::string("a damaged model: '") + key + "' is no square matrix");
  Eigen::MatrixXd out(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    const Eigen::VectorXd values = vectorIn(array.at(static_cast<std::size_t>(row)), key);
    out.row(row) = values.transpose();
  }
  return out;
}

std::vector<std::string> textsIn(const Json& json, const char* key) {
  const Json array = needed(json, key);
  if (!array.isArray()) throw Error(std::string("a damaged model: '") + key + "' is no list");
  std::vector<std::string> out;
  for (std::size_t i = 0; i < array.size(); ++i) out.push_back(array.at(i).asString());
  return out;
}

StudentTComponent bellIn(const Json& json) {
  return {vectorIn(needed(json, "mean"), "mean"), matrixIn(json, "scatter")};
}

}  // namespace

Json sessionAdaptiveJson(const SessionAdaptiveClassifier& model) {
  const SessionAdaptiveParameters& data = model.data();
  Json classComponents = Json::array(), today = Json::array();
  for (const StudentTComponent& distribution : data.classComponents)
    classComponents.push(dayJsonOf(distribution));
  for (const SessionComponent& component : data.today)
    today.push(dayJsonOf(component.distribution)
                   .set("class", component.classIndex)
                   .set("count", component.count));
  Json out = Json::object();
  out.set("format", kFormat);
  out.set("features", dayJsonOf(data.features)).set("classes", dayJsonOf(data.classes));
  if (data.sizeColumn) out.set("size_column", *data.sizeColumn);
  out.set("degrees_of_freedom", data.degreesOfFreedom);
  out.set("new_scatter", data.fewShotScatterScale).set("seen_today", data.seenInSessionLogPrior);
  out.set("bells", classComponents).set("pooled", dayJsonOf(data.pooled));
  out.set("background", dayJsonOf(data.background)).set("today", today);
  return out;
}

SessionAdaptiveClassifier sessionAdaptiveFrom(const Json& json) {
  if (dayModelJsonNumberIn(json, "format") != static_cast<double>(kFormat))
    throw Error("a model of another version of the program");
  SessionAdaptiveParameters data;
  data.features = textsIn(json, "features");
  data.classes = textsIn(json, "classes");
  if (json.contains("size_column")) data.sizeColumn = countIn(json, "size_column");
  data.degreesOfFreedom = dayModelJsonNumberIn(json, "degrees_of_freedom");
  data.fewShotScatterScale = dayModelJsonNumberIn(json, "new_scatter");
  data.seenInSessionLogPrior = dayModelJsonNumberIn(json, "seen_today");
  data.pooled = matrixIn(json, "pooled");
  data.background = bellIn(needed(json, "background"));
  const Json classComponents = needed(json, "bells"), today = needed(json, "today");
  if (!classComponents.isArray() || !today.isArray())
    throw Error("a damaged model: 'bells' or 'today' is no list");
  for (std::size_t i = 0; i < classComponents.size(); ++i)
    data.classComponents.push_back(bellIn(classComponents.at(i)));
  for (std::size_t i = 0; i < today.size(); ++i) {
    SessionComponent component;
    component.classIndex = countIn(today.at(i), "class");
    component.count = countIn(today.at(i), "count");
    component.distribution = bellIn(today.at(i));
    data.today.push_back(std::move(component));
  }
  return SessionAdaptiveClassifier(std::move(data));
}

Json sessionOffsetJson(const SessionOffset& offset) {
  Json out = Json::object();
  out.set("mm", offset.mm).set("sd_mm", offset.sdMm);
  out.set("origin", offsetSourceName(offset.origin));
  out.set("grasps", offset.grasps).set("objects", offset.objects).set("trusted", offset.trusted);
  Json grid = Json::array(), probability = Json::array();
  for (const double mm : offset.gridMm) grid.push(mm);
  for (const double p : offset.probability) probability.push(p);
  return out.set("grid_mm", grid).set("probability", probability);
}

SessionOffset sessionOffsetFrom(const Json& json) {
  SessionOffset out;
  out.mm = dayModelJsonNumberIn(json, "mm");
  out.sdMm = dayModelJsonNumberIn(json, "sd_mm");
  const std::string origin = needed(json, "origin").asString();
  bool known = false;
  for (const OffsetSource one : {OffsetSource::kNone,
                                 OffsetSource::kUnknown,
                                 OffsetSource::kGiven,
                                 OffsetSource::kBatch,
                                 OffsetSource::kReferences,
                                 OffsetSource::kEmptyHand})
    if (offsetSourceName(one) == origin) {
      out.origin = one;
      known = true;
    }
  if (!known) throw Error("a damaged model: an offset of origin '" + origin + "'");
  out.grasps = countIn(json, "grasps");
  out.objects = countIn(json, "objects");
  out.trusted = needed(json, "trusted").asBool();
  const Eigen::VectorXd grid = vectorIn(needed(json, "grid_mm"), "grid_mm");
  const Eigen::VectorXd probability = vectorIn(needed(json, "probability"), "probability");
  if (grid.size() == 0 || grid.size() != probability.size() || !(probability.minCoeff() >= 0.0) ||
      !(std::abs(probability.sum() - 1.0) < 1e-6))
    throw Error("a damaged model: the distribution of the offset");
  out.gridMm.assign(grid.begin(), grid.end());
  out.probability.assign(probability.begin(), probability.end());
  return out;
}

}  // namespace palpate
