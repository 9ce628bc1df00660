// Pressures and forces as result tables. docs/manual/forces.md explains the columns.
#pragma once

#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/core/result_table.h>
#include <palpate/model/matrix_rows.h>

namespace palpate {

// A matrix that is touched; forces where the calibration knows the area of its indenter.
struct TouchedPressure {
  MatrixPressure pressure;
  bool areaKnown = false;
};
// Of the table "pressures": frame, time, matrix and its pressure.
std::vector<ColumnOf<MatrixRow<TouchedPressure>>> pressureColumns();
// Appends a row for each matrix that is touched.
void appendPressures(std::size_t frame,
                     const PressureFrame& pressures,
                     std::vector<MatrixRow<TouchedPressure>>& rows);

}  // namespace palpate
