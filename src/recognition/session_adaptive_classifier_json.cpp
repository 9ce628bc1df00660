// Converts a SessionAdaptiveClassifier and a SessionOffset to JSON and back.
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/session_adaptive_classifier.h"
#include "palpate/recognition/session_offset.h"

#include "json_numbers.h"

namespace palpate {
namespace {

namespace js = json_numbers;

constexpr std::int64_t kFormat = 1;

Json componentJson(const StudentTComponent& distribution) {
  return Json::object()
      .set("mean", js::of(distribution.mean))
      .set("scatter", js::of(distribution.scatter));
}

StudentTComponent componentFrom(const Json& json) {
  return {js::vector(json, "mean"), js::squareMatrix(json, "scatter")};
}

}  // namespace

Json sessionAdaptiveJson(const SessionAdaptiveClassifier& model) {
  const SessionAdaptiveParameters& data = model.data();
  Json classComponents = Json::array(), today = Json::array();
  for (const StudentTComponent& distribution : data.classComponents)
    classComponents.push(componentJson(distribution));
  for (const SessionComponent& component : data.today)
    today.push(componentJson(component.distribution)
                   .set("class", component.classIndex)
                   .set("count", component.count));
  Json out = Json::object();
  out.set("format", kFormat);
  out.set("features", js::of(data.features)).set("classes", js::of(data.classes));
  if (data.sizeColumn) out.set("size_column", *data.sizeColumn);
  out.set("degrees_of_freedom", data.degreesOfFreedom);
  out.set("new_scatter", data.fewShotScatterScale).set("seen_today", data.seenInSessionLogPrior);
  out.set("bells", std::move(classComponents)).set("pooled", js::of(data.pooled));
  out.set("background", componentJson(data.background)).set("today", std::move(today));
  return out;
}

SessionAdaptiveClassifier sessionAdaptiveFrom(const Json& json) {
  if (js::number(json, "format") != static_cast<double>(kFormat))
    throw Error("a model of another version of the program");
  SessionAdaptiveParameters data;
  data.features = js::texts(json, "features");
  useCurrentFeatureNames(data.features);
  data.classes = js::texts(json, "classes");
  if (json.contains("size_column")) data.sizeColumn = js::count(json, "size_column");
  data.degreesOfFreedom = js::number(json, "degrees_of_freedom");
  data.fewShotScatterScale = js::number(json, "new_scatter");
  data.seenInSessionLogPrior = js::number(json, "seen_today");
  data.pooled = js::squareMatrix(json, "pooled");
  data.background = componentFrom(js::member(json, "background"));
  const Json classComponents = js::list(json, "bells"), today = js::list(json, "today");
  for (std::size_t i = 0; i < classComponents.size(); ++i)
    data.classComponents.push_back(componentFrom(classComponents.at(i)));
  for (std::size_t i = 0; i < today.size(); ++i) {
    SessionComponent component;
    component.classIndex = js::count(today.at(i), "class");
    component.count = js::count(today.at(i), "count");
    component.distribution = componentFrom(today.at(i));
    data.today.push_back(std::move(component));
  }
  return SessionAdaptiveClassifier(std::move(data));
}

Json sessionOffsetJson(const SessionOffset& offset) {
  Json out = Json::object();
  out.set("mm", offset.mm).set("sd_mm", offset.sdMm);
  out.set("origin", offsetSourceName(offset.origin));
  out.set("grasps", offset.grasps).set("objects", offset.objects).set("trusted", offset.trusted);
  out.set("grid_mm", jsonList(offset.gridMm)).set("probability", jsonList(offset.probability));
  return out;
}

SessionOffset sessionOffsetFrom(const Json& json) {
  SessionOffset out;
  out.mm = js::number(json, "mm");
  out.sdMm = js::number(json, "sd_mm");
  const std::string origin = js::text(json, "origin");
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
  if (!known) js::refuse("origin", "isn't known to this version: '" + shortened(origin) + "'");
  out.grasps = js::count(json, "grasps");
  out.objects = js::count(json, "objects");
  out.trusted = js::flag(json, "trusted");
  const Eigen::VectorXd grid = js::vector(json, "grid_mm");
  const Eigen::VectorXd probability = js::vector(json, "probability");
  if (grid.size() == 0 || grid.size() != probability.size() || !(probability.minCoeff() >= 0.0) ||
      !(std::abs(probability.sum() - 1.0) < 1e-6))
    js::refuse("probability", "isn't a distribution over 'grid_mm'");
  out.gridMm.assign(grid.begin(), grid.end());
  out.probability.assign(probability.begin(), probability.end());
  return out;
}

}  // namespace palpate
