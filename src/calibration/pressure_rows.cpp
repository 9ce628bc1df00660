#include "palpate/calibration/pressure_rows.h"

namespace palpate {

std::vector<ColumnOf<MatrixRow<TouchedPressure>>> pressureColumns() {
  using Row = TouchedPressure;
  const auto force = [](const char* name, const char* meaning, double MatrixPressure::*of) {
    return columnOf<Row>(name, "N", meaning, [of](const Row& row) {
      return knownIf(row.areaKnown, row.pressure.*of);
    });
  };
  return matrixRowColumns<Row>(
      {columnOf<Row>("active",
                     "taxels",
                     "touched taxels",
                     [](const Row& row) { return row.pressure.active; }),
       finiteColumn<Row>("K",
                         "counts",
                         "filtered mean, at the settings of the calibration and without creep",
                         [](const Row& row) { return row.pressure.staticResponseCounts; }),
       finiteColumn<Row>("pressure_kpa",
                         "kPa",
                         "pressure of the contact",
                         [](const Row& row) { return row.pressure.kpa; }),
       finiteColumn<Row>("pressure_sd_kpa",
                         "kPa",
                         "its standard deviation",
                         [](const Row& row) { return row.pressure.sdKpa; }),
       force("force_n", "force on the matrix", &MatrixPressure::forceN),
       force("force_sd_n", "its standard deviation", &MatrixPressure::sdForceN),
       columnOf<Row>("in_range",
                     "",
                     "whether the pressure is within the measured range",
                     [](const Row& row) { return row.pressure.inRange; }),
       columnOf<Row>("temperature_known",
                     "",
                     "whether the temperature is known",
                     [](const Row& row) { return row.pressure.temperatureKnown; }),
       columnOf<Row>("saturated",
                     "",
                     "whether a taxel is saturated: the pressure is higher",
                     [](const Row& row) { return row.pressure.saturated; })});
}

void appendPressures(std::size_t frame,
                     const PressureFrame& pressures,
                     std::vector<MatrixRow<TouchedPressure>>& rows) {
  for (std::size_t m = 0; m < pressures.matrices.size(); ++m)
    if (pressures.matrices[m].active > 0)
      rows.push_back({frame, pressures.hostUs, m, {pressures.matrices[m], pressures.areaKnown}});
}

}  // namespace palpate
