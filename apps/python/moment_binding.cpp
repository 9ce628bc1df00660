// Binds palpate.chebyshev_moments(), chebyshev_invariants() and chebyshev_picture().
#include <string>

#include "palpate/recognition/chebyshev_moments.h"

#include "python/arrays.h"
#include "python/bindings.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

Eigen::MatrixXd squareOf(const Numbers& picture) {
  Eigen::MatrixXd square = matrixOf(picture, "picture");
  if (square.rows() != square.cols() || square.size() == 0)
    throw py::value_error("picture has shape " + shapeText(picture) +
                          "; it takes a square: in_square() makes one");
  return square;
}

DoubleArray moments(const Numbers& picture, int order) {
  const Eigen::MatrixXd square = squareOf(picture);
  return arrayOf(
      chebyshevMoments(square, ChebyshevPolynomials(static_cast<int>(square.rows()), order)));
}

py::dict invariants(const Numbers& picture, int order, const std::string& angle) {
  const Eigen::MatrixXd square = squareOf(picture);
  const ChebyshevInvariants found =
      chebyshevInvariants(square,
                          ChebyshevPolynomials(static_cast<int>(square.rows()), order),
                          choice<ImageOrientation>("angle",
                                                   angle,
                                                   {{"none", ImageOrientation::kNone},
                                                    {"study", ImageOrientation::kStudy},
                                                    {"resolved", ImageOrientation::kResolved}}));
  py::dict result;
  result["empty"] = found.empty;
  result["angle_determined"] = found.angleDetermined;
  result["centroid"] = py::make_tuple(found.centroidX, found.centroidY);
  result["angle_rad"] = found.angleRad;
  const auto size = static_cast<Eigen::Index>(order + 1);
  result["moments"] =
      arrayOf(found.moments.size() > 0 ? found.moments
                                       : Eigen::MatrixXd(Eigen::MatrixXd::Zero(size, size)));
  return result;
}

DoubleArray picture(const Numbers& given, int size) {
  const Eigen::MatrixXd square = matrixOf(given, "moments");
  if (square.rows() != square.cols() || square.size() == 0)
    throw py::value_error("moments has shape " + shapeText(given) +
                          "; it takes (order + 1, order + 1)");
  return arrayOf(
      reconstructImage(square, ChebyshevPolynomials(size, static_cast<int>(square.rows()) - 1)));
}

double error(const Numbers& original, const Numbers& approximation) {
  const Eigen::MatrixXd a = matrixOf(original, "picture"),
                        b = matrixOf(approximation, "approximation");
  if (a.rows() != b.rows() || a.cols() != b.cols())
    throw py::value_error("picture and approximation have different shapes");
  return reconstructionError(a, b);
}

}  // namespace

void bindMoments(py::module_& module) {
  module.def("chebyshev_moments",
             &moments,
             py::arg("picture"),
             py::arg("order"),
             "Discrete orthonormal Chebyshev moments of a square picture (N, N), row = y: (order "
             "+ 1, order + 1), [p][q], p belongs to x. order 0..min(N - 1, 32).");
  module.def("chebyshev_invariants",
             &invariants,
             py::arg("picture"),
             py::arg("order"),
             py::kw_only(),
             py::arg("angle") = "study",
             "The same, invariant to shift and turn: dict moments (order + 1, order + 1), "
             "centroid (x, y) [pixels], angle_rad, angle_determined (the picture has an axis), "
             "empty. angle: 'none' (shift only), 'study' (-45..45 deg), 'resolved' (long axis "
             "along x, longer tail to rising x).");
  module.def("chebyshev_picture",
             &picture,
             py::arg("moments"),
             py::arg("size"),
             "The picture (size, size) that moments describe.");
  module.def("picture_error",
             &error,
             py::arg("picture"),
             py::arg("approximation"),
             "sqrt(sum (picture - approximation)^2 / sum picture^2); both of the same shape.");
  module.def(
      "in_square",
      [](const Numbers& values, int size, int above, int left) {
        return arrayOf(padToSquare(matrixOf(values, "values"), size, above, left));
      },
      py::arg("values"),
      py::arg("size") = 14,
      py::arg("above") = 0,
      py::arg("left") = 4,
      "A matrix (rows, columns) placed in a square picture, below `above` empty rows and right of "
      "`left` empty columns (default: as in the study): (size, size). ValueError when it doesn't "
      "fit.");
}

}  // namespace palpate::python
