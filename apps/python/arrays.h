// Conversions that all Python bindings share: NumPy arrays, JSON as Python objects, and names of
// choices.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "palpate/core/json.h"
#include "palpate/core/option_check.h"
#include "palpate/core/time.h"

namespace palpate::python {

using DoubleArray = pybind11::array_t<double, pybind11::array::c_style>;
using FloatArray = pybind11::array_t<float, pybind11::array::c_style>;
using TimeArray = pybind11::array_t<std::int64_t, pybind11::array::c_style>;
// For arguments: any array or list of numbers.
using Floats = pybind11::array_t<float, pybind11::array::c_style | pybind11::array::forcecast>;
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// What was given as an array; raises TypeError that names the argument.
template <typename Array>
Array ensured(const pybind11::handle& given, const char* name) {
  const auto array = Array::ensure(given);
  if (array) return array;
  PyErr_Clear();
  throw pybind11::type_error(std::string(name) + " takes numbers");
}
// These functions raise ValueError that names the argument and the required shape.
std::vector<double> vectorOf(const Numbers& array, const char* name);
// Shape (rows, columns).
Eigen::MatrixXd matrixOf(const Numbers& array, const char* name);
// Shape (k, 3): one point per row.
std::vector<Eigen::Vector3d> pointsOf(const Numbers& array, const char* name);
// The shape as text: "(3, 4)".
std::string shapeText(const pybind11::array& array);

DoubleArray arrayOf(const Eigen::MatrixXd& matrix);
DoubleArray arrayOf(const Eigen::VectorXd& vector);
template <typename T>
pybind11::array_t<T> arrayOf(const std::vector<T>& values) {
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

// An array of `count` values of(i).
template <typename T, typename Of>
pybind11::array_t<T> column(std::size_t count, const Of& of) {
  pybind11::array_t<T> array(static_cast<pybind11::ssize_t>(count));
  T* out = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<T>(of(i));
  return array;
}
// An array of shape (rows, columns) with the values of(i, j).
template <typename T, typename Of>
pybind11::array_t<T> grid(std::size_t rows, std::size_t columns, const Of& of) {
  pybind11::array_t<T> array({rows, columns});
  T* out = array.mutable_data();
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) *out++ = static_cast<T>(of(i, j));
  return array;
}
// A list of of(each).
template <typename All, typename Of>
pybind11::list listOf(const All& all, const Of& of) {
  pybind11::list list;
  for (const auto& each : all) list.append(of(each));
  return list;
}
// The member `of` of each: names, mostly.
template <typename T, typename Member>
std::vector<Member> membersOf(const std::vector<T>& all, Member T::*of) {
  std::vector<Member> members;
  for (const T& each : all) members.push_back(each.*of);
  return members;
}
// An array of texts: names[codes[i]].
pybind11::object words(const std::vector<std::string>& names, const std::vector<int>& codes);

// Checks a Python index (negative: from the end) of one of `count` elements; raises IndexError.
std::size_t checkedIndex(const char* what, std::int64_t index, std::size_t count);
// Converts start and stop as NumPy slices do: negative from the end, clamped.
std::pair<std::size_t, std::size_t> sliceOf(std::int64_t start,
                                            std::optional<std::int64_t> stop,
                                            std::size_t count);

// Converts JSON to None, numbers, texts, lists and dicts.
pybind11::object toPython(const Json& json);
// Converts the value to JSON; raises TypeError for types that JSON does not have.
Json toJson(const pybind11::object& value);

// The value of `all` whose name is `word`; raises ValueError that lists the names.
template <typename All, typename NameOf>
auto named(const char* argument, const std::string& word, const All& all, const NameOf& nameOf) {
  std::string list;
  for (const auto& each : all) {
    const std::string name(nameOf(each));
    if (word == name) return each;
    list += (list.empty() ? "" : ", ") + name;
  }
  throw std::invalid_argument(std::string(argument) + " is '" + word + "'; it is one of " + list);
}
template <typename T>
T choice(const char* name, const std::string& word, std::span<const OptionWord<T>> known) {
  return named(name, word, known, [](const OptionWord<T>& each) { return each.first; }).second;
}
template <typename T>
T choice(const char* name, const std::string& word, std::initializer_list<OptionWord<T>> known) {
  return choice<T>(name, word, std::span(known.begin(), known.size()));
}

}  // namespace palpate::python
