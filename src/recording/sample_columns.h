// What the forms of a file write of joint angles, temperatures and events: columns. Private to this
// module; inline, because the library of HDF5 files, which this module links, needs it, too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
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
inline std::vector<ExportedSeries::Column> angleColumns(const HandDescription& hand,
                                                        std::size_t width) {
  std::vector<ExportedSeries::Column> columns(width);
  for (std::size_t i = 0; i < std::min(width, hand.axes.size()); ++i)
    columns[i] = {hand.axes[i].name, hand.axes[i].unit()};
  return columns;
}
inline std::vector<ExportedSeries::Column> temperatureColumns(const HandDescription& hand,
                                                              std::size_t width) {
  std::vector<ExportedSeries::Column> columns(width, {"", "degC"});
  for (std::size_t i = 0; i < std::min(width, hand.temperatureSensors.size()); ++i)
    columns[i].name = hand.temperatureSensors[i].name;
  return columns;
}

inline std::vector<std::string> columnNames(const std::vector<ExportedSeries::Column>& columns) {
  std::vector<std::string> names;
  for (const ExportedSeries::Column& column : columns) names.push_back(column.name);
  return names;
}
inline std::vector<std::string> columnUnits(const std::vector<ExportedSeries::Column>& columns) {
  std::vector<std::string> units;
  for (const ExportedSeries::Column& column : columns) units.push_back(column.unit);
  return units;
}

// Joint angles or temperatures of a profile. Without samples the columns are those of the hand.
struct WrittenSamples {
  std::size_t count = 0;
  std::function<std::int64_t(std::size_t sample)> timeUs;  // [us since 1970]
  std::function<std::vector<double>(std::size_t sample)> values;
  std::vector<ExportedSeries::Column> columns;
};
// Throw Error where the first sample can't be read.
inline WrittenSamples writtenAngles(const Profile& profile) {
  const std::size_t count = profile.numAngles();
  const HandDescription& hand = profile.hand();
  return {count,
          [profile](std::size_t i) { return profile.angleTimeUs(i); },
          [profile](std::size_t i) { return profile.angles(i).deg; },
          angleColumns(hand, count > 0 ? profile.angles(0).deg.size() : hand.axes.size())};
}
inline WrittenSamples writtenTemperatures(const Profile& profile) {
  const std::size_t count = profile.numTemperatures();
  const HandDescription& hand = profile.hand();
  return {
      count,
      [profile](std::size_t i) { return profile.temperatureTimeUs(i); },
      [profile](std::size_t i) { return profile.temperatures(i).degC; },
      temperatureColumns(
          hand, count > 0 ? profile.temperatures(0).degC.size() : hand.temperatureSensors.size())};
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
