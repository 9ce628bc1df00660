#include "gui/appearance/display_units.h"

#include <gtest/gtest.h>

#include <palpate/model/hand_file.h>

#include "gui/appearance/window_settings.h"
#include "testing/testing.h"

namespace palpate::gui::display_units_test {
namespace {

// The values are those of tables: pi/180, 273.15 K at 0 degC, 1 cm^2 = 100 mm^2, one standard
// atmosphere = 101.325 kPa = 10.1325 N/cm^2.
TEST(DisplayUnits, ConvertFromTheBaseUnits) {
  const auto angle = shownUnit(AngleUnit::kRadian).conversion;
  EXPECT_NEAR(angle.of(180.0), 3.141592653589793, 1e-12);
  EXPECT_NEAR(angle.of(57.29577951308232), 1.0, 1e-12);
  const auto temperature = shownUnit(TemperatureUnit::kKelvin).conversion;
  EXPECT_NEAR(temperature.of(0.01), 273.16, 1e-9) << "the triple point of water";
  EXPECT_NEAR(temperature.of(-273.15), 0.0, 1e-9);
  EXPECT_NEAR(shownUnit(AreaUnit::kSquareCentimetre).conversion.of(645.16), 6.4516, 1e-12)
      << "a square inch";
  EXPECT_NEAR(
      shownUnit(PressureUnit::kNewtonPerSquareCentimetre).conversion.of(101.325), 10.1325, 1e-9);
}

TEST(DisplayUnits, ADifferenceHasNoOffset) {
  EXPECT_EQ(shownUnit(TemperatureUnit::kKelvin).conversion.ofDifference(2.5), 2.5);
  EXPECT_NEAR(
      shownUnit(AngleUnit::kRadian).conversion.ofDifference(-90.0), -1.5707963267948966, 1e-12);
}

TEST(DisplayUnits, LeadBack) {
  for (const UnitConversion& each : {shownUnit(AngleUnit::kRadian).conversion,
                                     shownUnit(TemperatureUnit::kKelvin).conversion,
                                     shownUnit(AreaUnit::kSquareCentimetre).conversion,
                                     shownUnit(PressureUnit::kNewtonPerSquareCentimetre).conversion,
                                     UnitConversion()})
    EXPECT_NEAR(each.back(each.of(36.62)), 36.62, 1e-9);
}

TEST(DisplayUnits, AsTextWithAsManySignificantDigits) {
  EXPECT_EQ(shownUnit(AngleUnit::kDegree).text(-75.0, 1), "-75.0°");
  EXPECT_EQ(shownUnit(AngleUnit::kRadian).text(-75.0, 1), "-1.309 rad");
  EXPECT_NE(shownUnit(AngleUnit::kRadian).text(10.0, 1),
            shownUnit(AngleUnit::kRadian).text(10.1, 1));
  EXPECT_EQ(shownUnit(TemperatureUnit::kCelsius).text(36.62, 1), "36.6 °C");
  EXPECT_EQ(shownUnit(TemperatureUnit::kKelvin).text(36.62, 1), "309.8 K");
  EXPECT_EQ(shownUnit(AreaUnit::kSquareMillimetre).text(11.56, 0), "12 mm²");
  EXPECT_EQ(shownUnit(AreaUnit::kSquareCentimetre).text(11.56, 0), "0.12 cm²");
  EXPECT_EQ(shownUnit(PressureUnit::kKilopascal).text(101.325, 1), "101.3 kPa");
  EXPECT_EQ(shownUnit(PressureUnit::kNewtonPerSquareCentimetre).text(101.325, 1), "10.13 N/cm²");
}

TEST(DisplayUnits, AnAxisThatSlidesStaysInMillimetres) {
  const DisplayUnits units{.angle = AngleUnit::kRadian};
  EXPECT_EQ(shownUnit(builtInHand("parallel_gripper").axes[0], units).text(12.5, 1), "12.5 mm");
  EXPECT_EQ(shownUnit(builtInHand("sdh2").axes[0], units).text(90.0, 1), "1.571 rad");
  EXPECT_EQ(shownUnit(builtInHand("sdh2").axes[0], {}).text(90.0, 1), "90.0°");
}

class DisplayUnitsFileTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  QString ini_ = QString::fromStdString((folder_ / "a.ini").string());
};

TEST_F(DisplayUnitsFileTest, AreKeptUnderNamesThatReadWell) {
  ViewSettings view;
  view.units = {AngleUnit::kRadian,
                TemperatureUnit::kKelvin,
                AreaUnit::kSquareCentimetre,
                PressureUnit::kNewtonPerSquareCentimetre};
  {
    QSettings settings(ini_, QSettings::IniFormat);
    saveViewSettings(view, settings);
  }
  QSettings settings(ini_, QSettings::IniFormat);
  EXPECT_EQ(settings.value("units/angle").toString(), "rad");
  EXPECT_EQ(settings.value("units/temperature").toString(), "K");
  EXPECT_EQ(settings.value("units/area").toString(), "cm2");
  EXPECT_EQ(settings.value("units/pressure").toString(), "N/cm2");
  EXPECT_EQ(loadViewSettings(settings).units, view.units);
}

TEST_F(DisplayUnitsFileTest, NonsenseReadsAsTheDefaults) {
  testing::writeFile(folder_ / "a.ini",
                     "[units]\nangle=grad\ntemperature=degF\narea=\npressure=7\n");
  QSettings settings(ini_, QSettings::IniFormat);
  EXPECT_EQ(loadViewSettings(settings).units, DisplayUnits());
}

}  // namespace
}  // namespace palpate::gui::display_units_test
