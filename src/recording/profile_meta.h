// Metadata common to all file formats (docs/notes/palpate_format.md, "meta").
// Private to this module; inline, because the library of HDF5 files, which this module links, needs
// it, too.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile.h"
#include "palpate/recording/recording_data.h"

namespace palpate {

// Keys and values to be written: `said`, which was said of the recording before, and what the
// profile says by itself (`info` and `hand`), which takes precedence. Left out is what
// belongs to the file that it was read from: its form, the numbers of its samples.
inline RecordingMeta writtenMeta(const ProfileInfo& info,
                                 const HandDescription& hand,
                                 const RecordingMeta& said) {
  RecordingMeta meta;
  if (!info.serial.empty()) meta["serial"] = info.serial;
  if (!info.firmware.empty()) meta["firmware"] = info.firmware;
  if (!info.sensorRevision.empty()) meta["sensor_revision"] = info.sensorRevision;
  meta.merge(handMeta(hand));
  for (const auto& [key, value] : said)
    // The texts of a hand belong together.
    if (key != "hand_json" && key != "hand_urdf") meta.try_emplace(key, value);
  for (const char* key : {"format",
                          "finished",
                          "value_type",
                          kTouchRulesKey,
                          "frames",
                          "angle_samples",
                          "temperature_samples",
                          "seconds"})
    meta.erase(key);
  for (std::size_t stream = 1 + kHandSeries; stream <= kMaxSeries; ++stream)
    meta.erase("samples_" + std::to_string(stream));
  return meta;
}

// What `meta`, which writtenMeta() made, says of the profile; empty keys are
// taken out. `format` as in ProfileInfo.
inline ProfileInfo readInfo(RecordingMeta& meta, const char* format, bool counts) {
  ProfileInfo info;
  info.format = format;
  info.serial = meta["serial"];
  info.firmware = meta["firmware"];
  info.sensorRevision = meta["sensor_revision"];
  for (const char* key : {"serial", "firmware", "sensor_revision"})
    if (meta[key].empty()) meta.erase(key);
  info.valueType = counts ? ValueType::kCounts : ValueType::kFloat;
  return info;
}

// A profile whose further series a file describes. Throws FormatError where they are not valid.
inline Profile recordedProfile(const std::filesystem::path& path,
                               ProfileInfo info,
                               HandDescription hand,
                               std::shared_ptr<const ProfileStorage> storage,
                               std::vector<SeriesDescription> further) {
  try {
    return {std::move(info), std::move(hand), std::move(storage), std::move(further)};
  } catch (const std::invalid_argument& error) {
    throw FormatError(path, std::string("its series are damaged: ") + error.what());
  }
}

}  // namespace palpate
