// Vectors and matrices of a model file: arrays of numbers, checked on the way back. A model that is
// damaged must not classify by nonsense: all of these throw Error naming the key.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "palpate/core/json.h"

namespace palpate::json_numbers {

Json of(const Eigen::VectorXd& vector);
Json of(const Eigen::MatrixXd& matrix);  // array of rows
Json of(const std::vector<std::string>& texts);

double number(const Json& object, std::string_view key);  // finite
bool flag(const Json& object, std::string_view key);
std::string text(const Json& object, std::string_view key);
std::size_t count(const Json& object, std::string_view key);  // 0 .. 1e9
Json member(const Json& object, std::string_view key);        // must be there
// `size` below 0: any.
Eigen::VectorXd vector(const Json& object, std::string_view key, Eigen::Index size = -1);
Eigen::MatrixXd matrix(const Json& object,
                       std::string_view key,
                       Eigen::Index rows,
                       Eigen::Index columns);
std::vector<std::string> texts(const Json& object, std::string_view key);

}  // namespace palpate::json_numbers
