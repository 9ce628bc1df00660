// Series: rows of numbers with their own times beside the tactile frames. The joint angles and the
// temperatures of the hand are series, and so is what a load cell, a wrist or an IMU sends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate {

// Index of a series in a profile or a source. The first two are those of the hand, in every
// profile, also where they have no samples; others follow.
constexpr std::size_t kAngleSeries = 0;  // one column per axis [deg, sliding: mm]
// One column per temperature sensor [deg C]; 0 when the sensor has not reported yet (power-up).
constexpr std::size_t kTemperatureSeries = 1;
constexpr std::size_t kHandSeries = 2;

constexpr std::size_t kMaxSeries = 64;      // of a profile, those of the hand included
constexpr std::size_t kMaxColumns = 64;     // of a series
constexpr std::size_t kMaxSeriesName = 40;  // characters

// The role of series that are not recorded but computed of the frames (computed/computed_series.h).
inline constexpr const char* kComputedRole = "computed";

// One number of each sample of a series.
struct Column {
  std::string name;  // "fz"; unique in its series, without control characters
  std::string unit;  // "N", "deg", "m/s^2"; empty: none, or not known
  bool operator==(const Column&) const = default;
};

struct SeriesDescription {
  std::string name;  // unique in a profile: a small letter, then small letters, digits, "_"
  // What it means to the program: "joint_angles", "temperatures", "reference_force", "trigger";
  // empty: nothing in particular.
  std::string role;
  std::vector<Column> columns;  // at least one, except of a hand without axes or sensors
  std::string source;           // where it comes from, for people: "tcp:localhost:9871"; or empty
  bool operator==(const SeriesDescription&) const = default;
};

// One row of a series.
struct Sample {
  std::int64_t hostUs = 0;     // time of arrival [us since 1970]
  std::vector<double> values;  // one per column; NaN where a value is not known
  std::size_t series = kAngleSeries;
  std::optional<std::int64_t> deviceUs = std::nullopt;  // the sender's clock [us]
};

// Throws std::invalid_argument that names what is wrong with the name or the columns.
void validate(const SeriesDescription& description);
// A name that validate() takes, of any text: "Wrist Fz" gives "wrist_fz".
std::string seriesName(std::string_view text);

}  // namespace palpate
