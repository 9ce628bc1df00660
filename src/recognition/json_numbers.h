// Reads and writes the vectors and matrices of a model file as arrays of numbers. The conversions
// of pipelines, classifiers and models to JSON use it. The reading functions throw Error naming the
// key when a value is missing, is not finite or has a wrong size, so that a damaged model is never
// used.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "palpate/core/json.h"

namespace palpate::json_numbers {

Json of(const Eigen::VectorXd& vector);
// An array of rows.
Json of(const Eigen::MatrixXd& matrix);
Json of(const std::vector<std::string>& texts);

// Throws the Error that all functions here throw about a damaged member: "model: 'key' what".
[[noreturn]] void refuse(std::string_view key, const std::string& what);

// A finite number.
double number(const Json& object, std::string_view key);
bool flag(const Json& object, std::string_view key);
std::string text(const Json& object, std::string_view key);
// An integer, 0..1e9.
std::size_t count(const Json& object, std::string_view key);
// A member that must exist.
Json member(const Json& object, std::string_view key);
// A member that must be an array.
Json list(const Json& object, std::string_view key);
// If `size` is below 0, any size is accepted.
Eigen::VectorXd vector(const Json& object, std::string_view key, Eigen::Index size = -1);
Eigen::MatrixXd matrix(const Json& object,
                       std::string_view key,
                       Eigen::Index rows,
                       Eigen::Index columns);
// A matrix of any size with as many columns as rows, at least one.
Eigen::MatrixXd squareMatrix(const Json& object, std::string_view key);
std::vector<std::string> texts(const Json& object, std::string_view key);

}  // namespace palpate::json_numbers
