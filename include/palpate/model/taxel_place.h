// Place of a taxel in a sensor: the matrix, and row and column in it.
#pragma once

#include <cstddef>

namespace palpate {

// Matrix, row (y) and column (x), each counted from 0.
struct TaxelPlace {
  std::size_t matrix = 0;
  int y = 0;
  int x = 0;
  bool operator==(const TaxelPlace&) const = default;
};

}  // namespace palpate
