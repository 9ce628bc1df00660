#include "python/arrays.h"

#include <algorithm>

#include <pybind11/stl.h>

namespace palpate::python {
namespace py = pybind11;
namespace {

void requireDimensions(const Numbers& array, const char* name, py::ssize_t dimensions) {
  if (array.ndim() == dimensions) return;
  throw py::value_error(std::string(name) + " has shape " + shapeText(array) + "; it takes " +
                        std::to_string(dimensions) +
                        (dimensions == 1 ? " dimension" : " dimensions"));
}

}  // namespace

std::string shapeText(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

std::vector<double> vectorOf(const Numbers& array, const char* name) {
  requireDimensions(array, name, 1);
  return {array.data(), array.data() + array.size()};
}

Eigen::MatrixXd matrixOf(const Numbers& array, const char* name) {
  requireDimensions(array, name, 2);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(array.data(), array.shape(0), array.shape(1));
}

std::vector<Eigen::Vector3d> pointsOf(const Numbers& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error(std::string(name) + " has shape " + shapeText(array) +
                          "; it takes (n, 3)");
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points.emplace_back(array.at(i, 0), array.at(i, 1), array.at(i, 2));
  return points;
}

DoubleArray arrayOf(const Eigen::MatrixXd& matrix) {
  return grid<double>(static_cast<std::size_t>(matrix.rows()),
                      static_cast<std::size_t>(matrix.cols()),
                      [&](std::size_t i, std::size_t j) {
                        return matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                      });
}

DoubleArray arrayOf(const Eigen::VectorXd& vector) {
  return DoubleArray(static_cast<py::ssize_t>(vector.size()), vector.data());
}

py::object words(const std::vector<std::string>& names, const std::vector<int>& codes) {
  return py::module_::import("numpy").attr("array")(py::cast(names)).attr("take")(arrayOf(codes));
}

std::size_t checkedIndex(const char* what, std::int64_t index, std::size_t count) {
  const auto number = static_cast<std::int64_t>(count);
  if (index < -number || index >= number)
    throw py::index_error("no " + std::string(what) + " " + std::to_string(index) + ", there are " +
                          std::to_string(count));
  return static_cast<std::size_t>(index < 0 ? index + number : index);
}

std::pair<std::size_t, std::size_t> sliceOf(std::int64_t start,
                                            std::optional<std::int64_t> stop,
                                            std::size_t count) {
  const auto number = static_cast<std::int64_t>(count);
  const auto place = [&](std::int64_t index) {
    return std::clamp<std::int64_t>(index < 0 ? index + number : index, 0, number);
  };
  const std::int64_t first = place(start);
  const std::int64_t last = std::max(first, place(stop.value_or(number)));
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

py::object toPython(const Json& json) {
  return py::module_::import("json").attr("loads")(json.text(-1));
}

Json toJson(const py::object& value) {
  return Json::parse(py::module_::import("json").attr("dumps")(value).cast<std::string>());
}

}  // namespace palpate::python
