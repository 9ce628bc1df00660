// The Python module `palpate`: registers all parts and translates exceptions.
#include <string>

#include <pybind11/eval.h>

#include "palpate/core/error.h"

#include "python/bindings.h"
#include "python/module_source.h"

namespace py = pybind11;

namespace {

// Replaces command-line options in error messages by Python arguments.
std::string forPython(std::string text) {
  const std::string option = "--force";
  if (const auto at = text.find(option); at != std::string::npos)
    text.replace(at, option.size(), "force=True");
  return text;
}

void translate(std::exception_ptr pending) {
  try {
    if (pending) std::rethrow_exception(pending);
  } catch (const palpate::FormatError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const palpate::FileError& error) {
    PyErr_SetString(PyExc_OSError, forPython(error.what()).c_str());
    // A value inside an argument has the wrong type: an item of a list, an entry of a dict.
  } catch (const py::cast_error&) {
    PyErr_SetString(PyExc_TypeError,
                    "an argument has a value of the wrong type, in a list or a dict: see help() of "
                    "the function");
  }
}

}  // namespace

PYBIND11_MODULE(palpate, module) {
  module.doc() =
      "Palpate: recordings of tactile robot hands, as NumPy arrays.\n\n"
      "    import palpate\n"
      "    profile = palpate.load('foam_ball.dsa')\n"
      "    profile.matrix(1).max(axis=(1, 2))   # largest value of finger 0 distal, per frame\n\n"
      "A Table is a dict of arrays of the same length, some of them with a value per matrix or "
      "axis, with units: table.to_pandas() has a column for each. A report "
      "is a dict with the keys that the command of the same name prints. Taxels are those of the "
      "pitch (3.4 mm), x = column, y = row, row 0 at the fingertip. Wrong values raise ValueError "
      "or IndexError, wrong types TypeError, files OSError (can't be read or written) or "
      "ValueError (damaged), everything else palpate.Error: one line that says what to do.";
  module.attr("__version__") = PALPATE_VERSION;
  py::register_exception<palpate::Error>(module, "Error", PyExc_RuntimeError).attr("__doc__") =
      "Raised where something can't be done: one line that says what, and what to do.";
  py::register_exception_translator(&translate);
  using namespace palpate::python;
  bindProfile(module);
  bindRecordings(module);
  bindArrays(module);
  bindHands(module);
  bindFilters(module);
  bindCalibration(module);  // derive() takes a Calibration
  bindSignals(module);
  bindKinematics(module);
  bindContact(module);
  bindSlip(module);
  bindSteps(module);
  bindMoments(module);
  bindFeatures(module);
  bindModels(module);
  bindTraining(module);
  bindEmulator(module);
  bindCommands(module);
  py::exec(kPythonSource, module.attr("__dict__"));
}
