// import palpate
#include "palpate/core/error.h"

#include "python/bindings.h"

namespace py = pybind11;

PYBIND11_MODULE(palpate, module) {
  module.doc() =
      "Palpate: recordings of robot hands that feel, as NumPy arrays.\n\n"
      "    import palpate\n"
      "    profile = palpate.load('foam_ball.dsa')\n"
      "    profile.matrix(1).max(axis=(1, 2))   # largest value of finger 0 distal, per frame\n";
  // what() of every failure is one line that says what, where and what to do.
  py::register_exception<palpate::Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr pending) {
    try {
      if (pending) std::rethrow_exception(pending);
    } catch (const palpate::FormatError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const palpate::FileError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    }
  });
  palpate::python::bindProfile(module);
}
