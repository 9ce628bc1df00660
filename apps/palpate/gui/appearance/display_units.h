// The units in which the window shows angles, temperatures, areas and pressures. Everything is
// measured, computed and stored in the base units (deg, degC, mm^2, kPa); only what is shown is
// converted. Nothing that moves a hand, and no file, depends on this choice.
#pragma once

#include <QString>
#include <array>

#include <palpate/model/hand_description.h>

namespace palpate::gui {

enum class AngleUnit { kDegree, kRadian };
enum class TemperatureUnit { kCelsius, kKelvin };
enum class AreaUnit { kSquareMillimetre, kSquareCentimetre };
enum class PressureUnit { kKilopascal, kNewtonPerSquareCentimetre };
// In the order in which they are offered; the first one is the base unit and the default.
inline constexpr std::array kAllAngleUnits = {AngleUnit::kDegree, AngleUnit::kRadian};
inline constexpr std::array kAllTemperatureUnits = {TemperatureUnit::kCelsius,
                                                    TemperatureUnit::kKelvin};
inline constexpr std::array kAllAreaUnits = {AreaUnit::kSquareMillimetre,
                                             AreaUnit::kSquareCentimetre};
inline constexpr std::array kAllPressureUnits = {PressureUnit::kKilopascal,
                                                 PressureUnit::kNewtonPerSquareCentimetre};

struct DisplayUnits {
  AngleUnit angle = AngleUnit::kDegree;
  TemperatureUnit temperature = TemperatureUnit::kCelsius;
  AreaUnit area = AreaUnit::kSquareMillimetre;
  PressureUnit pressure = PressureUnit::kKilopascal;
  bool operator==(const DisplayUnits&) const = default;
};

// Names in the settings: "deg", "rad"; "degC", "K"; "mm2", "cm2"; "kPa", "N/cm2".
QString nameOf(AngleUnit unit);
QString nameOf(TemperatureUnit unit);
QString nameOf(AreaUnit unit);
QString nameOf(PressureUnit unit);

// From a base unit to the one that is shown: shown = factor * base + offset.
struct UnitConversion {
  double factor = 1.0;
  double offset = 0.0;
  // Decimals in addition to those of the base unit, so that as many digits are significant.
  int moreDecimals = 0;
  double of(double base) const noexcept { return factor * base + offset; }
  // The value in the base unit.
  double back(double shown) const noexcept { return (shown - offset) / factor; }
  // Of a difference of two values, or a standard deviation.
  double ofDifference(double base) const noexcept { return factor * base; }
  bool operator==(const UnitConversion&) const = default;
};

struct ShownUnit {
  // "°", "rad", "°C", "K", "mm²", "cm²", "kPa", "N/cm²"; or a unit that is shown as it is.
  QString symbol;
  UnitConversion conversion = {};
  // "31.4 °C", "304.6 K", "12.0°". `decimals`: of the value in its base unit.
  QString text(double base, int decimals) const;
  // The same without the symbol.
  QString number(double base, int decimals) const;
  bool operator==(const ShownUnit&) const = default;
};
ShownUnit shownUnit(AngleUnit unit);        // of degrees
ShownUnit shownUnit(TemperatureUnit unit);  // of degrees Celsius
ShownUnit shownUnit(AreaUnit unit);         // of mm^2
ShownUnit shownUnit(PressureUnit unit);     // of kPa
// Of the present value of an axis; one that slides is always shown in mm.
ShownUnit shownUnit(const AxisDescription& axis, const DisplayUnits& units);

}  // namespace palpate::gui
