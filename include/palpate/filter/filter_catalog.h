// The filters there are, as data: name, options with ranges and defaults, what they do at borders,
// where they come from. The parser of filter texts, --help, the Filter dock and the docs all read
// this table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

enum class FilterDomain {
  kSpatial,        // one frame, the neighbours of a taxel
  kTemporal,       // one taxel, its frames
  kSpatioTemporal  // both
};

struct FilterOption {
  enum class Kind {
    kInteger,  // minimum..maximum
    kOdd,      // likewise, odd: 2 radius + 1
    kReal,     // minimum..maximum, finite
    kFlag,     // 0 or 1
    kChoice    // one of `choices`; the value is its index
  };
  std::string key;   // "size"
  std::string unit;  // "taxels", "frames", "counts", ...; empty: none
  Kind kind = Kind::kInteger;
  double minimum = 0.0;
  double maximum = 1.0;
  double defaultValue = 0.0;  // where it isn't given; NaN: automatic (`purpose` says how)
  std::vector<std::string> choices = {};
  std::string purpose;

  bool automatic() const noexcept { return defaultValue != defaultValue; }
};

struct FilterKind {
  std::string name;   // "median"
  std::string title;  // "Median"
  FilterDomain domain = FilterDomain::kSpatial;
  std::vector<FilterOption> options;
  std::string purpose;  // what it is good for, one sentence
  // what stands outside of the matrix, before the first and after the last frame
  std::string border;
  std::string source;  // chapter, equation, paper

  // Null: it has none of that name.
  const FilterOption* option(std::string_view key) const noexcept;
  std::string optionKeys() const;  // "size, masked"
};

// All, in the order in which they are offered.
std::span<const FilterKind> filterKinds();
// Throws std::invalid_argument, listing the known names.
const FilterKind& filterKind(std::string_view name);
std::string filterNames();  // "box, gaussian, ..."

}  // namespace palpate
