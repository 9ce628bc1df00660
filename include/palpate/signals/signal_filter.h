// Applies filters over time to the characteristic signals of matrices instead of to taxels: one
// series per signal and matrix (study, figure 2.1, smooths the mean of a matrix). It uses the same
// recipes, filter chain and gap rule as for frames; filters over space are not allowed. The command
// `signals` uses it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// Values by SignalKind; components are 0 where they aren't filtered. A filtered number of active
// taxels can be a fraction.
using SignalValues = std::array<double, static_cast<std::size_t>(SignalKind::kNorm) + 1>;

// Filters the characteristic signals of frames.
class SignalFilter {
 public:
  // Called for each filtered frame in order, with one row per matrix.
  using Emit = std::function<void(std::int64_t hostUs, std::span<const SignalValues> rows)>;

  // Throws std::invalid_argument when the recipe has a filter over space, or without a matrix.
  // `withComponents`: filters kX, kY, kZ and kNorm, too; the length is that of the filtered vector.
  SignalFilter(const Recipe& recipe,
               std::size_t numMatrices,
               Emit emit,
               bool withComponents = false);
  ~SignalFilter();
  SignalFilter(const SignalFilter&) = delete;
  SignalFilter& operator=(const SignalFilter&) = delete;

  // Takes the signals of the next frame, one row per matrix. Values are filtered as floats (7
  // digits). Throws std::invalid_argument for another number of rows.
  void push(std::int64_t hostUs, std::span<const CharacteristicSignals> rows);
  // Passes on the frames that the filters held back; call it after the last frame.
  void finish();

 private:
  class Impl;
  const std::unique_ptr<Impl> impl_;
};

// Throws Error when the recipe has a frequency that is not below half of the recording's rate (1 /
// median interval).
void requireBelowHalfRate(const Recipe& recipe,
                          const Profile& profile,
                          const std::filesystem::path& file);

}  // namespace palpate
