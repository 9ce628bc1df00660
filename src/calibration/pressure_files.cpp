// Writes and reads the pressure model as JSON (pressure_model.h).
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "palpate/calibration/pressure_model.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

std::vector<std::string> pressureFilesTextsOf(const Json& list) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list.at(i).isString()) texts.push_back(list.at(i).asString());
  return texts;
}

Json jsonOf(const Surface& surface) {
  Json c = Json::array(), terms = Json::array(), covariance = Json::array(), hull = Json::array();
  for (Eigen::Index k = 0; k < surface.c.size(); ++k) {
    const SurfaceTerm& term = surface.terms[static_cast<std::size_t>(k)];
    c.push(surface.c[k]);
    terms.push(Json::array().push(term.byX).push(term.byT));
    Json row = Json::array();
    for (Eigen::Index j = 0; j < surface.c.size(); ++j) row.push(surface.covariance(k, j));
    covariance.push(std::move(row));
  }
  for (const SurfacePoint& corner : surface.hull)
    hull.push(Json::array().push(corner.x).push(corner.t));
  return Json::object()
      .set("c", std::move(c))
      .set("rmse_kpa", surface.rmse)
      .set("loo_rmse_kpa", surface.looRmse)
      .set("residual_sd", surface.residualSd)
      .set("valid", surface.valid)
      .set("points", surface.numPoints)
      .set("kept_terms", surface.numTerms)
      .set("terms", std::move(terms))
      .set("covariance", std::move(covariance))
      .set("valid_range_hull", std::move(hull))
      .set("notes", jsonList(surface.notes));
}

double numberAt(const Json& json, const std::string& key, const std::string& where) {
  const Json value = json.at(key);
  if (value.isNull() && json.contains(key)) return std::numeric_limits<double>::quiet_NaN();
  if (!value.isNumber())
    throw Error("pressure model: " + where + " lacks the number '" + shortened(key) + "'");
  return value.asDouble();
}

Surface surfaceFrom(const Json& json, const std::string& where) {
  const auto fail = [&](const char* what) { throw Error("pressure model: " + where + " " + what); };
  if (!json.isObject()) fail("is missing");
  Surface surface;
  const Json c = json.at("c"), terms = json.at("terms"), covariance = json.at("covariance"),
             hull = json.at("valid_range_hull");
  if (!c.isArray() || c.size() == 0 || c.size() > 12) fail("lacks its coefficients 'c'");
  if (terms.size() != c.size() || covariance.size() != c.size())
    fail("has terms or covariance of a different number than c");
  const auto p = static_cast<Eigen::Index>(c.size());
  surface.c.resize(p);
  surface.covariance.resize(p, p);
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Json term = terms.at(k), row = covariance.at(k);
    if (term.size() != 2 || row.size() != c.size())
      fail("has a term or a row of covariance of the wrong size");
    surface.c[static_cast<Eigen::Index>(k)] = c.at(k).asDouble();
    const auto x = term.at(0).asInteger(), t = term.at(1).asInteger();
    if (x < 0 || t < 0 || x > 4 || t > 4) fail("has a term beyond the fourth degree");
    surface.terms.push_back({static_cast<int>(x), static_cast<int>(t)});
    for (std::size_t j = 0; j < c.size(); ++j)
      surface.covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) =
          row.at(j).isNumber() ? row.at(j).asDouble() : std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (hull.at(i).size() != 2) fail("has a corner of its range without two numbers");
    surface.hull.push_back({hull.at(i).at(0).asDouble(), hull.at(i).at(1).asDouble(), 0.0});
  }
  surface.rmse = numberAt(json, "rmse_kpa", where);
  surface.looRmse = numberAt(json, "loo_rmse_kpa", where);
  surface.residualSd = numberAt(json, "residual_sd", where);
  surface.numPoints = static_cast<std::size_t>(
      std::max(json.at("points").isNumber() ? json.at("points").asDouble() : 0.0, 0.0));
  surface.numTerms = static_cast<std::size_t>(
      std::max(json.at("kept_terms").isNumber() ? json.at("kept_terms").asDouble() : 0.0, 0.0));
  surface.valid = json.at("valid").isBool() && json.at("valid").asBool();
  surface.notes = pressureFilesTextsOf(json.at("notes"));
  return surface;
}

}  // namespace

Json jsonOf(const PressureModel& model) {
  Json drift = jsonOf(model.driftOfGain);
  return Json::object()
      .set("K", jsonOf(model.gain))
      .set("m", jsonOf(model.drift))
      .set("drift_of_K", std::move(drift))
      .set("choices", model.options.study ? "study" : "default")
      .set("assumed_temperature_c", model.options.assumedDegC)
      .set("assumed_temperature_sd_c", model.options.assumedSdDegC)
      .set("stamp_area_mm2", model.options.indenterAreaMm2)
      .set("area_share", model.areaFraction)
      .set("area_share_sd", model.areaFractionSd)
      .set("steady_s", model.steadyS)
      .set("creep_measured_s", model.creepMeasuredS)
      .set("notes", jsonList(model.notes));
}

PressureModel pressureModelFrom(const Json& json) {
  if (!json.isObject()) throw Error("pressure model: not a JSON object");
  PressureModel model;
  model.gain = surfaceFrom(json.at("K"), "K");
  model.drift = surfaceFrom(json.at("m"), "m");
  model.driftOfGain = surfaceFrom(json.at("drift_of_K"), "drift_of_K");
  model.options.study = json.at("choices").isString() && json.at("choices").asString() == "study";
  model.options.assumedDegC = numberAt(json, "assumed_temperature_c", "the model");
  model.options.assumedSdDegC = numberAt(json, "assumed_temperature_sd_c", "the model");
  model.options.indenterAreaMm2 = numberAt(json, "stamp_area_mm2", "the model");
  model.areaFraction = numberAt(json, "area_share", "the model");
  model.areaFractionSd = numberAt(json, "area_share_sd", "the model");
  model.steadyS = numberAt(json, "steady_s", "the model");
  // Older files don't have it.
  if (json.contains("creep_measured_s"))
    model.creepMeasuredS = numberAt(json, "creep_measured_s", "the model");
  model.notes = pressureFilesTextsOf(json.at("notes"));
  model.options.validate();
  if (!(model.areaFraction > 0.0) || !(model.areaFractionSd >= 0.0) || !(model.steadyS >= 0.0) ||
      !(model.creepMeasuredS >= 0.0))
    throw Error(
        "pressure model: area_share must be above 0, its sd, steady_s and creep_measured_s not "
        "below");
  return model;
}

}  // namespace palpate
