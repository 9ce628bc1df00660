// The catalogue of all filters as data: name, options with ranges and defaults, behaviour at
// borders, and source. The parser of filter texts, --help, the Filter dock and the documentation
// read this table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// Which values a filter combines.
enum class FilterDomain {
  kSpatial,        // uses one frame: the neighbours of a taxel
  kTemporal,       // uses one taxel over several frames
  kSpatioTemporal  // uses both
};

// One option of a filter.
struct FilterOption {
  enum class Kind {
    kInteger,  // minimum..maximum
    kOdd,      // odd integer minimum..maximum, 2 radius + 1
    kReal,     // minimum..maximum, finite
    kFlag,     // 0 or 1
    kChoice    // one of `choices`; the value is its index
  };
  std::string key;  // name in a filter text: "size"
  // "taxels", "frames", "counts", ...; empty when the option has no unit.
  std::string unit;
  Kind kind = Kind::kInteger;
  double minimum = 0.0;
  double maximum = 1.0;
  // Value when the option is not given; NaN means automatic (`purpose` says how).
  double defaultValue = 0.0;
  std::vector<std::string> choices = {};
  std::string purpose;

  bool automatic() const noexcept { return defaultValue != defaultValue; }
};

// One filter of the catalogue.
struct FilterKind {
  std::string name;   // name in a filter text: "median"
  std::string title;  // title in the window: "Median"
  FilterDomain domain = FilterDomain::kSpatial;
  std::vector<FilterOption> options;
  // What the filter is good for, one sentence.
  std::string purpose;
  // Which values the filter assumes outside of the matrix, before the first and after the last
  // frame.
  std::string border;
  std::string source;  // chapter, equation or paper

  // Returns null when the filter has no option of that name.
  const FilterOption* option(std::string_view key) const noexcept;
  std::string optionKeys() const;  // "size, masked"
};

// All filters, in the order in which the window and --help list them.
std::span<const FilterKind> filterKinds();
// Finds a filter by its name. Throws std::invalid_argument that lists the known names.
const FilterKind& filterKind(std::string_view name);
std::string filterNames();  // "box, gaussian, ..."

}  // namespace palpate
