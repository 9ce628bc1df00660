// Makes synthetic frames of one matrix for the slip tests.
#pragma once

#include <vector>

#include "palpate/laboratory/synthetic_slip.h"

namespace palpate::testing {

inline ConstMatrixMap viewOf(const MatrixValues& values) {
  return {values.data(), values.rows(), values.cols()};
}

// Readings of a contact: without noise, threshold and rounding, or as the sensor would give them.
inline MatrixValues idealReading(const SyntheticContact& contact, const SyntheticSensor& sensor) {
  MatrixValues values(sensor.layout.rows, sensor.layout.columns);
  idealCounts(contact, sensor, MatrixMap(values.data(), values.rows(), values.cols()));
  return values;
}
inline MatrixValues reading(SyntheticSlip& slip, const SyntheticContact& contact) {
  MatrixValues values(slip.sensor().layout.rows, slip.sensor().layout.columns);
  slip.read(contact, MatrixMap(values.data(), values.rows(), values.cols()));
  return values;
}

}  // namespace palpate::testing
