// One filter with its options, as text: "median:size=3,masked=1" (names and keys:
// filter_catalog.h). Order of the keys is free; what isn't given has its default. `matrices=1+3`
// restricts a filter to some matrices.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/filter/filter_catalog.h>

namespace palpate {

struct FilterStep {
  std::string name;  // of a FilterKind
  std::map<std::string, double, std::less<>>
      explicitOptions{};                // what differs from the default, by key
  std::vector<std::size_t> matrices{};  // wire order, ascending; empty: all
  bool enabled = true;                  // off: it stands in the chain and does nothing

  // Throws std::invalid_argument: unknown name or key (listing the known ones), a value out of
  // range, an even window, and what only fits together (order below window, search and patch).
  void validate() const;
  const FilterKind& kind() const { return filterKind(name); }
  // Given or default; NaN: automatic. Throws std::invalid_argument for a key it hasn't.
  double value(std::string_view key) const;
  int integer(std::string_view key) const { return static_cast<int>(value(key)); }
  bool flag(std::string_view key) const { return value(key) != 0.0; }
  // As value(); 0 where this kind of filter has no such key.
  double valueOrZero(std::string_view key) const;
  // Needs no later frame: can run live.
  bool causal() const;
  bool operator==(const FilterStep&) const = default;
};

// Reads and validates. Throws std::invalid_argument saying what is wrong and what would be right.
FilterStep parseFilterStep(std::string_view text);
// Shortest text that reads back as the same step (but for `enabled`): "median:size=5".
std::string filterText(const FilterStep& step);

}  // namespace palpate
