// The ranges of the fields of an Options struct and the words of its enums, for validate(), the
// command line, its help, the window and Python; and what validate() does with each field.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <palpate/core/number_text.h>

namespace palpate {

// Both ends inclusive; a value that is not a number is outside.
struct OptionRange {
  double minimum;
  double maximum;
  const char* unit = "";
  constexpr bool contains(double value) const { return value >= minimum && value <= maximum; }
};

// A value of an enum and its word. One array of them, beside the enum, serves all texts.
template <typename T>
using OptionWord = std::pair<const char*, T>;

// Throws std::invalid_argument "OPTIONS: FIELD is VALUE" unless a field is good, or in its range.
struct OptionCheck {
  const char* options;  // name of the struct

  void operator()(bool good, const char* field, double value) const {
    if (!good)
      throw std::invalid_argument(std::string(options) + ": " + field + " is " +
                                  std::to_string(value));
  }
  void operator()(const OptionRange& range, const char* field, double value) const {
    if (!range.contains(value))
      throw std::invalid_argument(std::string(options) + ": " + field + " is " + numberText(value) +
                                  ", not " + numberText(range.minimum) + ".." +
                                  numberText(range.maximum));
  }
};

}  // namespace palpate
