// The names of the signals of a recording, as formulas, the commands `derive`, `spectrum` and
// `compare`, and the window write them (docs/manual/columns.md, "Names of signals"):
//   m1_mean      mean of matrix 1; also filtered_mean, min, max, sum, active, area_mm2
//   m1_x         with readings: their sum along x; also y, z, and norm, the length of the three
//   hand_sum     the same of the whole hand
//   m5_x2_y9     taxel of matrix 5 in column 2, row 9
//   angle3       joint angle 3 [deg]
//   temperature4 temperature sensor 4 [deg C]
//   wrist_fz     column fz of the further series "wrist", in the unit of the column; what is no
//                letter or digit in the name of a column is written _
// The older spelling 1:mean, hand:sum and 5:2:9 (matrix, column, row) means the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <palpate/model/matrix_layout.h>
#include <palpate/model/profile.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

// A name taken apart; whether a recording has that signal is another question.
struct SignalName {
  // kMatrix, kTaxels (one taxel), kAngle or kTemperature.
  SeriesChoice::Kind kind = SeriesChoice::Kind::kMatrix;
  // Number of the matrix, joint or sensor, >= 0; empty: the whole hand.
  std::optional<std::int64_t> index = {};
  // For kMatrix.
  SignalKind signal = SignalKind::kMean;
  // Column and row of the taxel, >= 0.
  std::int64_t x = 0;
  std::int64_t y = 0;
  bool operator==(const SignalName&) const = default;
};
// Nothing when the text is no name of a signal.
std::optional<SignalName> parseSignalName(std::string_view text);

// The signal of that name; nothing when it is no name, or names a matrix or a taxel that the layout
// doesn't have. Whether the profile has the signal is another question: hasSeries().
std::optional<SeriesChoice> signalNamed(std::string_view name, const SensorLayout& layout);

// The same; a column of a further series, too, unless the name means a signal of the hand. Of two
// columns with one name it is the first.
std::optional<SeriesChoice> signalNamed(std::string_view name, const Profile& profile);

// The name of a signal; empty when it has none: a group of several taxels, a force.
std::string nameOf(const SeriesChoice& choice, const SensorLayout& layout);

// A formula in which 1:mean and hand:sum are written m1_mean and hand_sum, as the parser of
// formulas needs it. Taxels (5:2:9) are left as they are, because c ? 5 : 2 is a formula, too.
std::string withSignalNames(const std::string& formula);

}  // namespace palpate
