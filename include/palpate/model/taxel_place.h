// A place of one matrix.
#pragma once

#include <cstddef>

namespace palpate {

struct TaxelPlace {
  std::size_t matrix = 0;
  int y = 0;
  int x = 0;
  bool operator==(const TaxelPlace&) const = default;
};

}  // namespace palpate
