#include "json_numbers.h"

#include <cmath>

#include "palpate/core/error.h"

namespace palpate::json_numbers {
namespace {

[[noreturn]] void refuseJsonNumbers(std::string_view key, const std::string& what) {
  throw Error("model: '" + std::string(key) + "' " + what);
}

double finite(const Json& value, std::string_view key) {
  if (!value.isNumber()) refuseJsonNumbers(key, "holds something that isn't a number");
  const double number = value.asDouble();
  if (!std::isfinite(number)) refuseJsonNumbers(key, "holds something that isn't a number");
  return number;
}

void requireSize(std::size_t found, Eigen::Index wanted, std::string_view key) {
  if (wanted >= 0 && found != static_cast<std::size_t>(wanted))
    refuseJsonNumbers(
        key, "has " + std::to_string(found) + " entries instead of " + std::to_string(wanted));
}

}  // namespace

Json of(const Eigen::VectorXd& vector) {
  Json list = Json::array();
  for (const double value : vector) list.push(value);
  return list;
}

Json of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    rows.push(of(Eigen::VectorXd(matrix.row(i).transpose())));
  return rows;
}

Json of(const std::vector<std::string>& texts) { return jsonList(texts); }

Json member(const Json& object, std::string_view key) {
  if (!object.isObject() || !object.contains(key)) refuseJsonNumbers(key, "is missing");
  return object.at(key);
}

double number(const Json& object, std::string_view key) { return finite(member(object, key), key); }

bool flag(const Json& object, std::string_view key) {
  const Json value = member(object, key);
  if (!value.isBool()) refuseJsonNumbers(key, "is neither true nor false");
  return value.asBool();
}

std::string text(const Json& object, std::string_view key) {
  const Json value = member(object, key);
  if (!value.isString()) refuseJsonNumbers(key, "isn't a text");
  return value.asString();
}

std::size_t count(const Json& object, std::string_view key) {
  const double value = number(object, key);
  if (value < 0.0 || value > 1e9 || value != std::floor(value))
    refuseJsonNumbers(key, "isn't a count");
  return static_cast<std::size_t>(value);
}

Eigen::VectorXd vector(const Json& object, std::string_view key, Eigen::Index size) {
  const Json list = member(object, key);
  if (!list.isArray()) refuseJsonNumbers(key, "isn't a list");
  requireSize(list.size(), size, key);
  Eigen::VectorXd result(static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = finite(list.at(i), key);
  return result;
}

Eigen::MatrixXd matrix(const Json& object,
                       std::string_view key,
                       Eigen::Index rows,
                       Eigen::Index columns) {
  const Json list = member(object, key);
  if (!list.isArray()) refuseJsonNumbers(key, "isn't a list");
  requireSize(list.size(), rows, key);
  // The sizes are checked before memory is allocated, because a small damaged file may declare a
  // large matrix.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json row = list.at(i);
    if (!row.isArray()) refuseJsonNumbers(key, "has a row that isn't a list");
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

std::vector<std::string> texts(const Json& object, std::string_view key) {
  const Json list = member(object, key);
  if (!list.isArray()) refuseJsonNumbers(key, "isn't a list");
  std::vector<std::string> result;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list.at(i).isString()) refuseJsonNumbers(key, "holds something that isn't a text");
    result.push_back(list.at(i).asString());
  }
  return result;
}

}  // namespace palpate::json_numbers
