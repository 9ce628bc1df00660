#include "gui/appearance/display_units.h"

#include <numbers>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr double kShownRadPerDeg = std::numbers::pi / 180.0;
constexpr double kKelvinAtZeroDegC = 273.15;
constexpr double kCm2PerMm2 = 0.01;
// 1 kPa = 1000 N/m^2 = 0.1 N/cm^2.
constexpr double kNewtonPerCm2PerKpa = 0.1;

}  // namespace

QString nameOf(AngleUnit unit) { return unit == AngleUnit::kRadian ? "rad" : "deg"; }
QString nameOf(TemperatureUnit unit) { return unit == TemperatureUnit::kKelvin ? "K" : "degC"; }
QString nameOf(AreaUnit unit) { return unit == AreaUnit::kSquareCentimetre ? "cm2" : "mm2"; }
QString nameOf(PressureUnit unit) {
  return unit == PressureUnit::kNewtonPerSquareCentimetre ? "N/cm2" : "kPa";
}

QString ShownUnit::number(double base, int decimals) const {
  return figure(conversion.of(base), decimals + conversion.moreDecimals);
}

QString ShownUnit::text(double base, int decimals) const {
  // The sign of degrees follows the number directly.
  return number(base, decimals) + (symbol == "°" ? "" : " ") + symbol;
}

// 0.1 deg is 0.0017 rad, 1 mm^2 is 0.01 cm^2, 0.1 kPa is 0.01 N/cm^2.
ShownUnit shownUnit(AngleUnit unit) {
  if (unit == AngleUnit::kRadian) return {"rad", {.factor = kShownRadPerDeg, .moreDecimals = 2}};
  return {"°"};
}

ShownUnit shownUnit(TemperatureUnit unit) {
  if (unit == TemperatureUnit::kKelvin) return {"K", {.offset = kKelvinAtZeroDegC}};
  return {"°C"};
}

ShownUnit shownUnit(AreaUnit unit) {
  if (unit == AreaUnit::kSquareCentimetre)
    return {"cm²", {.factor = kCm2PerMm2, .moreDecimals = 2}};
  return {"mm²"};
}

ShownUnit shownUnit(PressureUnit unit) {
  if (unit == PressureUnit::kNewtonPerSquareCentimetre)
    return {"N/cm²", {.factor = kNewtonPerCm2PerKpa, .moreDecimals = 1}};
  return {"kPa"};
}

ShownUnit shownUnit(const AxisDescription& axis, const DisplayUnits& units) {
  return axis.isSliding ? ShownUnit{"mm"} : shownUnit(units.angle);
}

}  // namespace palpate::gui
