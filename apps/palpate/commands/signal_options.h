// A signal of a recording, or a formula over signals, as the user types it for a command.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/signals/formula.h>
#include <palpate/signals/profile_series.h>

namespace palpate::commands {

// The names of signals, for a help text.
inline constexpr const char* kSignalNames =
    "m1_mean, hand_sum, m5_x2_y9 (matrix, column, row), angle3, temperature4; of a series its name "
    "and column, such as wrist_fz; computed from the frames m1_centroid_x_mm, m1_slip_mm, "
    "m1_force_n and others";

// Either is set.
struct TypedSignal {
  std::optional<SeriesChoice> choice = {};
  std::optional<Formula> formula = {};
};

// The taxel of matrix m. Throws Error that names the taxels which exist.
SeriesChoice taxelOf(const SensorLayout& layout,
                     std::size_t m,
                     std::int64_t x,
                     std::int64_t y,
                     const std::string& file);

// Throws UsageError, which begins with `option`, for a text that is neither a name
// (signals/signal_name.h) nor a formula; Error when the hand has no such matrix or taxel.
TypedSignal typedSignal(const std::string& text,
                        const Profile& profile,
                        const std::string& file,
                        const std::string& option);

// The names of the signals in it.
std::vector<std::string> namesOf(const TypedSignal& signal, const SensorLayout& layout);

// The series within fromS..toS, and perhaps its neighbours. Throws Error (the recording doesn't
// have the signal; a frame that can't be read) and Cancelled.
Series typedSeries(const Profile& profile,
                   const TypedSignal& signal,
                   double fromS,
                   double toS,
                   const std::string& file,
                   const Progress& progress);

}  // namespace palpate::commands
