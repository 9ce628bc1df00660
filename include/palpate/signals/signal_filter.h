// Filters over time on the characteristic signals of matrices, instead of on taxels: one series per
// signal and matrix (study, figure 2.1, smooths the mean of a matrix). The same recipes, the same
// chain, the same gaps; filters that look at neighbours have no place here.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <palpate/filter/recipe.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// In the order of kAllSignalKinds. Filtered numbers of taxels are fractions.
using SignalValues = std::array<double, kAllSignalKinds.size()>;

class SignalFilter {
 public:
  // Told of each frame, in order; one row per matrix.
  using Emit = std::function<void(std::int64_t hostUs, std::span<const SignalValues> rows)>;

  // Throws std::invalid_argument: a filter over space is in the recipe; no matrix.
  SignalFilter(const Recipe& recipe, std::size_t numMatrices, Emit emit);
  ~SignalFilter();
  SignalFilter(const SignalFilter&) = delete;
  SignalFilter& operator=(const SignalFilter&) = delete;

  // One row per matrix. Values go through as floats (7 digits). Throws std::invalid_argument for
  // another number.
  void push(std::int64_t hostUs, std::span<const CharacteristicSignals> rows);
  void restart();
  // No more frames: what was held back comes out.
  void finish();

 private:
  class Impl;
  const std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
