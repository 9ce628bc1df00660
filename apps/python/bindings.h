// The parts of the Python module `palpate`; each has its own source file.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindProfile(pybind11::module_& module);      // Profile
void bindRecordings(pybind11::module_& module);   // load, verify, recover, events, ..
void bindArrays(pybind11::module_& module);       // from_arrays
void bindHands(pybind11::module_& module);        // Hand, hands, record
void bindFilters(pybind11::module_& module);      // filter, filters, recipes, ghosts, ..
void bindSignals(pybind11::module_& module);      // signals, spectrum, ..
void bindKinematics(pybind11::module_& module);   // kinematics, preshape, bounding_sphere, ..
void bindContact(pybind11::module_& module);      // contact, object_size
void bindSlip(pybind11::module_& module);         // slip, slip_segments, slip_benchmark, ..
void bindSteps(pybind11::module_& module);        // fit_step, calibrate_step, ..
void bindCalibration(pybind11::module_& module);  // Calibration, calibrate_pressure, ..
void bindMoments(pybind11::module_& module);      // chebyshev_moments, ..
void bindFeatures(pybind11::module_& module);     // grasps, features, Features
void bindModels(pybind11::module_& module);       // Model
void bindTraining(pybind11::module_& module);     // train, evaluate
void bindEmulator(pybind11::module_& module);     // synthesize, emulate, ..
void bindCommands(pybind11::module_& module);     // compare, labels, convert, render

}  // namespace palpate::python
