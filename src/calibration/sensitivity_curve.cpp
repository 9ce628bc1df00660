#include "palpate/calibration/sensitivity_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/core/number_text.h"

namespace palpate {

SensitivityCurve fitSensitivityCurve(std::span<const SensitivityPoint> points,
                                     double thresholdCounts) {
  SensitivityCurve curve;
  curve.points.assign(points.begin(), points.end());
  double n = 0.0, x = 0.0, y = 0.0;
  for (SensitivityPoint& p : curve.points) {
    p.used = p.used && std::isfinite(p.sensitivity) && std::isfinite(p.staticResponseCounts);
    if (!p.used) continue;
    n += 1.0;
    x += p.sensitivity;
    y += p.staticResponseCounts;
  }
  const auto left = static_cast<double>(curve.points.size()) - n;
  if (left > 0.0) curve.notes.push_back(fixedText(left, 0) + " steps are left out");
  double xx = 0.0, yy = 0.0, xy = 0.0;
  if (n > 0.0) {
    x /= n;
    y /= n;
  }
  for (const SensitivityPoint& p : curve.points) {
    if (!p.used) continue;
    xx += (p.sensitivity - x) * (p.sensitivity - x);
    yy += (p.staticResponseCounts - y) * (p.staticResponseCounts - y);
    xy += (p.sensitivity - x) * (p.staticResponseCounts - y);
  }
  if (!(xx > 0.0)) {
    curve.notes.push_back(n < 2.0 ? "a line takes two steps at different sensitivities"
                                  : "one sensitivity only: no line");
    return curve;
  }
  curve.valid = true;
  curve.slope = xy / xx;
  curve.offset = y - curve.slope * x;
  const double squares = std::max(yy - curve.slope * xy, 0.0);
  curve.r2 = yy > 0.0 ? 1.0 - squares / yy : 1.0;
  curve.zeroSensitivity = -curve.offset / curve.slope;
  const double variance = n > 2.0 ? squares / (n - 2.0) : std::numeric_limits<double>::quiet_NaN();
  curve.slopeSd = std::sqrt(variance / xx);
  curve.offsetSd = std::sqrt(variance * (1.0 / n + x * x / xx));
  if (n < 3.0) curve.notes.push_back("two steps: nothing is known about the error");
  std::string why =
      "offset " + fixedText(curve.offset, 1) + " counts: the threshold" +
      (thresholdCounts > 0.0 ? " of " + fixedText(thresholdCounts, 0) : std::string()) +
      " is subtracted from every active taxel, less what it reads at rest";
  if (thresholdCounts > 0.0 && curve.offset < 0.0)
    why += "; the mean over the active taxels of the filtered matrix leaves " +
           fixedText(-100.0 * curve.offset / thresholdCounts, 0) +
           " % of it, since weak taxels drop out with it";
  if (curve.offset < 0.0)
    why += "; below a sensitivity of " + fixedText(std::max(curve.zeroSensitivity, 0.0), 2) +
           " this load reads 0";
  curve.notes.push_back(std::move(why));
  return curve;
}

Json jsonOf(const SensitivityCurve& curve) {
  Json points = Json::array();
  for (const SensitivityPoint& p : curve.points) {
    Json point = Json::object();
    point.set("sensitivity", p.sensitivity).set("K", p.staticResponseCounts).set("used", p.used);
    if (!p.note.empty()) point.set("note", p.note);
    points.push(std::move(point));
  }
  const auto known = [&](double value) { return curve.valid ? Json(value) : Json(); };
  return Json::object()
      .set("points", std::move(points))
      .set("slope", known(curve.slope))
      .set("offset", known(curve.offset))
      .set("r2", known(curve.r2))
      .set("slope_sd", known(curve.slopeSd))
      .set("offset_sd", known(curve.offsetSd))
      .set("zero_sensitivity", known(curve.zeroSensitivity))
      .set("valid", curve.valid)
      .set("notes", jsonList(curve.notes));
}

}  // namespace palpate
