#include "json_numbers.h"

#include <cmath>
#include <span>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate::json_numbers {
namespace {

double finite(const Json& value, std::string_view key) {
  if (!value.isNumber()) refuse(key, "holds something that isn't a number");
  const double number = value.asDouble();
  if (!std::isfinite(number)) refuse(key, "holds something that isn't a number");
  return number;
}

void requireSize(std::size_t found, Eigen::Index wanted, std::string_view key) {
  if (wanted >= 0 && found != static_cast<std::size_t>(wanted))
    refuse(key, "has " + std::to_string(found) + " entries instead of " + std::to_string(wanted));
}

Eigen::MatrixXd matrixIn(const Json& list,
                         std::string_view key,
                         Eigen::Index rows,
                         Eigen::Index columns) {
  requireSize(list.size(), rows, key);
  // The sizes are checked before memory is allocated, because a small damaged file may declare a
  // large matrix.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json row = list.at(i);
    if (!row.isArray()) refuse(key, "has a row that isn't a list");
    requireSize(row.size(), columns, key);
  }
  Eigen::MatrixXd result(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Json row = list.at(static_cast<std::size_t>(i));
    for (Eigen::Index j = 0; j < columns; ++j)
      result(i, j) = finite(row.at(static_cast<std::size_t>(j)), key);
  }
  return result;
}

}  // namespace

void refuse(std::string_view key, const std::string& what) {
  throw Error("model: '" + shortened(key) + "' " + what);
}

Json of(const Eigen::VectorXd& vector) {
  return Json::array(std::span(vector.data(), static_cast<std::size_t>(vector.size())));
}

Json of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    rows.push(of(Eigen::VectorXd(matrix.row(i).transpose())));
  return rows;
}

Json of(const std::vector<std::string>& texts) { return jsonList(texts); }

Json member(const Json& object, std::string_view key) {
  if (!object.isObject() || !object.contains(key)) refuse(key, "is missing");
  return object.at(key);
}

Json list(const Json& object, std::string_view key) {
  Json value = member(object, key);
  if (!value.isArray()) refuse(key, "isn't a list");
  return value;
}

double number(const Json& object, std::string_view key) { return finite(member(object, key), key); }

bool flag(const Json& object, std::string_view key) {
  const Json value = member(object, key);
  if (!value.isBool()) refuse(key, "is neither true nor false");
  return value.asBool();
}

std::string text(const Json& object, std::string_view key) {
  const Json value = member(object, key);
  if (!value.isString()) refuse(key, "isn't a text");
  return value.asString();
}

std::size_t count(const Json& object, std::string_view key) {
  const double value = number(object, key);
  if (value < 0.0 || value > 1e9 || value != std::floor(value)) refuse(key, "isn't a count");
  return static_cast<std::size_t>(value);
}

Eigen::VectorXd vector(const Json& object, std::string_view key, Eigen::Index size) {
  const Json values = list(object, key);
  requireSize(values.size(), size, key);
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = finite(values.at(i), key);
  return result;
}

Eigen::MatrixXd matrix(const Json& object,
                       std::string_view key,
                       Eigen::Index rows,
                       Eigen::Index columns) {
  return matrixIn(list(object, key), key, rows, columns);
}

Eigen::MatrixXd squareMatrix(const Json& object, std::string_view key) {
  const Json rows = list(object, key);
  if (rows.size() == 0) refuse(key, "has no rows");
  const auto size = static_cast<Eigen::Index>(rows.size());
  return matrixIn(rows, key, size, size);
}

std::vector<std::string> texts(const Json& object, std::string_view key) {
  const Json items = list(object, key);
  std::vector<std::string> result;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items.at(i).isString()) refuse(key, "holds something that isn't a text");
    result.push_back(items.at(i).asString());
  }
  return result;
}

}  // namespace palpate::json_numbers
