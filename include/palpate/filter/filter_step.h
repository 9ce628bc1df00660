// One filter with its options: one step of a recipe. As text it is written "median:size=3,masked=1"
// (names and keys: filter_catalog.h). The keys may have any order; a missing key has its default.
// `matrices=1+3` restricts a filter to some matrices. The filter "baseline" may have its rest with
// it: "baseline:rest=3/2.5/0,noise=0.5/1/0".
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/filter/butterworth.h>
#include <palpate/filter/filter_catalog.h>
#include <palpate/model/touch.h>

namespace palpate {

// One filter with its options.
struct FilterStep {
  std::string name;  // name of a FilterKind
  // Options that differ from the default, by key.
  std::map<std::string, double, std::less<>> explicitOptions{};
  // Matrices to filter, in wire order, ascending; empty means all.
  std::vector<std::size_t> matrices{};
  bool enabled = true;  // a disabled step stays in the recipe and does nothing
  // Of "baseline": the values at rest, one per place of the layout. Without it they are taken from
  // the recording (filtered_profile.h, withRest()), and the step is not causal.
  std::optional<Baseline> rest{};

  // Throws std::invalid_argument for an unknown name or key (listing the known ones), a value out
  // of range, an even window, and options that contradict each other (the order must be below the
  // window; search and patch must fit together;
  // the lower edge of a band must be below the upper one).
  void validate() const;
  // Also throws std::invalid_argument when a frequency is at or above half of the rate of the
  // frames [Hz]. A rate of 0 is not known and checks nothing.
  void validateForRate(double rateHz) const;
  const FilterKind& kind() const { return filterKind(name); }
  // Returns the given value or the default; NaN means automatic. Throws std::invalid_argument for a
  // key that the filter does not have.
  double value(std::string_view key) const;
  int integer(std::string_view key) const { return static_cast<int>(value(key)); }
  bool flag(std::string_view key) const { return value(key) != 0.0; }
  // Returns value(), or 0 when this filter has no such key.
  double valueOrZero(std::string_view key) const;
  // Whether an option has an effect: where the rest is given, the span to take it from has none.
  bool uses(const FilterOption& option) const;
  // Returns whether the filter needs no later frame and can therefore run live.
  bool causal() const;
  bool operator==(const FilterStep&) const = default;
};

// The band and order of a Butterworth filter; empty for other filters.
std::optional<ButterworthOptions> butterworthOf(const FilterStep& step);

// Parses and validates a text. Throws std::invalid_argument that says what is wrong and what is
// allowed.
FilterStep parseFilterStep(std::string_view text);
// Returns the shortest text that parses to the same step, except for `enabled`: "median:size=5".
std::string filterText(const FilterStep& step);
// Returns the text with the value of every option, also of those that have their default, so that
// it says what was done: "low-pass:cutoff=10,order=2". Of a rest only the size: "rest=486 values".
std::string fullFilterText(const FilterStep& step);
// The same as filterText(), with the rest as in fullFilterText(): for people.
std::string shownFilterText(const FilterStep& step);

}  // namespace palpate
