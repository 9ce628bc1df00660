#include "gui/appearance/display_units.h"

#include <numbers>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr const char* kAngleKey = "units/angle";
constexpr const char* kTemperatureKey = "units/temperature";
constexpr const char* kAreaKey = "units/area";
constexpr const char* kPressureKey = "units/pressure";

constexpr double kShownRadPerDeg = std::numbers::pi / 180.0;
constexpr double kKelvinAtZeroDegC = 273.15;
constexpr double kCm2PerMm2 = 0.01;
// 1 kPa = 1000 N/m^2 = 0.1 N/cm^2.
constexpr double kNewtonPerCm2PerKpa = 0.1;

template <class Units>
auto unitNamed(const Units& all, const QSettings& settings, const char* key) {
  const QString name = settings.value(key).toString();
  for (const auto unit : all)
    if (name == nameOf(unit)) return unit;
  return all.front();
}

}  // namespace

QString nameOf(AngleUnit unit) { return unit == AngleUnit::kRadian ? "rad" : "deg"; }
QString nameOf(TemperatureUnit unit) { return unit == TemperatureUnit::kKelvin ? "K" : "degC"; }
QString nameOf(AreaUnit unit) { return unit == AreaUnit::kSquareCentimetre ? "cm2" : "mm2"; }
QString nameOf(PressureUnit unit) {
  return unit == PressureUnit::kNewtonPerSquareCentimetre ? "N/cm2" : "kPa";
}

DisplayUnits loadDisplayUnits(const QSettings& settings) {
  return {.angle = unitNamed(kAllAngleUnits, settings, kAngleKey),
          .temperature = unitNamed(kAllTemperatureUnits, settings, kTemperatureKey),
          .area = unitNamed(kAllAreaUnits, settings, kAreaKey),
          .pressure = unitNamed(kAllPressureUnits, settings, kPressureKey)};
}

void saveDisplayUnits(const DisplayUnits& units, QSettings& settings) {
  settings.setValue(kAngleKey, nameOf(units.angle));
  settings.setValue(kTemperatureKey, nameOf(units.temperature));
  settings.setValue(kAreaKey, nameOf(units.area));
  settings.setValue(kPressureKey, nameOf(units.pressure));
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
