// What validate() of an Options struct does with each of its fields.
#pragma once

#include <stdexcept>
#include <string>

namespace palpate {

// Throws std::invalid_argument "OPTIONS: FIELD is VALUE" unless a field is good.
struct OptionCheck {
  const char* options;  // name of the struct

  void operator()(bool good, const char* field, double value) const {
    if (!good)
      throw std::invalid_argument(std::string(options) + ": " + field + " is " +
                                  std::to_string(value));
  }
};

}  // namespace palpate
