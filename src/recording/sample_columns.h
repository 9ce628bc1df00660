// What the forms of a file write of series and events: columns. Private to this module; inline,
// because the library of HDF5 files, which this module links, needs it, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "palpate/model/event.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile.h"
#include "palpate/recording/exported_series.h"

namespace palpate {

// The columns of samples of `width` values; what the hand doesn't describe has no name, and an axis
// no unit.
inline std::vector<Column> angleColumns(const HandDescription& hand, std::size_t width) {
  std::vector<Column> columns(width);
  for (std::size_t i = 0; i < std::min(width, hand.axes.size()); ++i)
    columns[i] = {hand.axes[i].name, hand.axes[i].unit()};
  return columns;
}
inline std::vector<Column> temperatureColumns(const HandDescription& hand, std::size_t width) {
  std::vector<Column> columns(width, {"", "degC"});
  for (std::size_t i = 0; i < std::min(width, hand.temperatureSensors.size()); ++i)
    columns[i].name = hand.temperatureSensors[i].name;
  return columns;
}

inline std::vector<std::string> columnNames(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}
inline std::vector<std::string> columnUnits(const std::vector<Column>& columns) {
  std::vector<std::string> units;
  for (const Column& column : columns) units.push_back(column.unit);
  return units;
}

constexpr std::int64_t kNoSampleDeviceTime = std::numeric_limits<std::int64_t>::min();

// The samples of a series of a profile. Without samples the columns are those of its description.
struct WrittenSamples {
  std::size_t count = 0;
  std::function<std::int64_t(std::size_t sample)> timeUs;  // [us since 1970]
  std::function<std::vector<double>(std::size_t sample)> values;
  std::vector<Column> columns;
  // The sender's clock [us]; of a sample without it kNoSampleDeviceTime. Null where no sample has
  // it, and of the hand's series.
  std::function<std::int64_t(std::size_t sample)> deviceUs = nullptr;
};
// Throws Error where a sample can't be read: of the hand's series the first one.
inline WrittenSamples writtenSamples(const Profile& profile, std::size_t series) {
  const std::size_t count = profile.numSamples(series);
  std::vector<Column> columns = profile.series()[series].columns;
  if (count > 0 && series == kAngleSeries)
    columns = angleColumns(profile.hand(), profile.angles(0).values.size());
  if (count > 0 && series == kTemperatureSeries)
    columns = temperatureColumns(profile.hand(), profile.temperatures(0).values.size());
  WrittenSamples written{
      count,
      [profile, series](std::size_t i) { return profile.sampleTimeUs(series, i); },
      [profile, series](std::size_t i) { return profile.sample(series, i).values; },
      std::move(columns)};
  if (series < kHandSeries) return written;
  for (std::size_t i = 0; i < count && !written.deviceUs; ++i)
    if (profile.sample(series, i).deviceUs)
      written.deviceUs = [profile, series](std::size_t sample) {
        return profile.sample(series, sample).deviceUs.value_or(kNoSampleDeviceTime);
      };
  return written;
}

// Whether values may be those of a sample: finite, or of a further series not known (NaN).
inline bool areSampleValues(std::size_t series, std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return std::isfinite(value) || (series >= kHandSeries && std::isnan(value));
  });
}

// Event; `matrices` has the value `noMatrix` where an event belongs to no single one.
template <typename Matrix>
struct EventColumns {
  EventColumns(std::span<const Event> events, Matrix noMatrix) {
    for (const Event& event : events) {
      timesUs.push_back(event.tUs);
      endsUs.push_back(event.t1Us);
      kinds.push_back(event.kind);
      matrices.push_back(event.matrix ? static_cast<Matrix>(*event.matrix) : noMatrix);
      texts.push_back(event.text);
      jsons.push_back(event.json);
    }
  }
  std::vector<std::int64_t> timesUs;
  std::vector<std::int64_t> endsUs;
  std::vector<std::string> kinds;
  std::vector<Matrix> matrices;
  std::vector<std::string> texts;
  std::vector<std::string> jsons;
};

}  // namespace palpate
