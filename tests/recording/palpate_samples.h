// Profiles and writers for the tests of native recordings.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile.h"
#include "palpate/recording/palpate_writer.h"

namespace palpate::testing {

constexpr std::int64_t kSampleStartUs = 1'400'000'000'500'000;
constexpr std::int64_t kSampleStepUs = 33'000;

// The i-th frame of a made-up recording: its values tell which one it is.
inline TactileFrame sampleFrame(std::size_t i, bool floats = false) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = kSampleStartUs + static_cast<std::int64_t>(i) * kSampleStepUs;
  frame.deviceUs = static_cast<std::int64_t>(i) * 32'000 + 7'000;
  frame.values[0] = static_cast<float>(i % 4096);
  frame.values[1] = static_cast<float>(i / 4096);
  for (std::size_t k = 2; k < 80; ++k) {
    const auto mixed = static_cast<std::uint32_t>(i * 7919 + k * 104729) * 2654435761u;
    frame.values[k * 6] = static_cast<float>(mixed >> 20) + (floats ? 0.25F : 0.0F);
  }
  return frame;
}
inline Sample sampleAngles(std::size_t i) {
  Sample angles;
  angles.hostUs = kSampleStartUs + static_cast<std::int64_t>(i) * 9'000;
  for (int axis = 0; axis < 7; ++axis)
    angles.values.push_back(static_cast<double>(i) + 0.125 * axis + (i % 5 == 0 ? 0.1 : 0.0));
  return angles;
}
inline Sample sampleTemperatures(std::size_t i) {
  return {kSampleStartUs + static_cast<std::int64_t>(i) * 1'000'000,
          std::vector<double>(9, 20.0 + static_cast<double>(i)),
          kTemperatureSeries};
}

// Frames with their angles and temperatures.
inline void addSamples(PalpateWriter& writer, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) writer.addSample(sampleAngles(k));
    if (i % 30 == 0) writer.addSample(sampleTemperatures(i / 30));
    writer.addFrame(sampleFrame(i));
  }
}

inline void writeSamples(const std::filesystem::path& path,
                         std::size_t frames,
                         bool finish = true) {
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(path, sdh2().layout, {{"serial", "1D9B0057"}}, options);
  addSamples(writer, 0, frames);
  writer.addEvent({kSampleStartUs,
                   kSampleStartUs + 10,
                   "label",
                   3,
                   "f\xC3\xBC"
                   "r",
                   "{\"a\":1}"});
  writer.addEvent({kSampleStartUs + 5, kSampleStartUs + 5, "note", {}, "two\nlines", ""});
  writer.setCounter("lost", 4);
  if (finish)
    writer.finish();
  else
    writer.commit();
}

// All samples as bytes, in the form of independent_reader.py.
inline std::string dumped(const Profile& profile) {
  std::string out;
  const auto put = [&out](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
  };
  put(static_cast<std::int64_t>(profile.numFrames()));
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    put(frame.hostUs);
    put(frame.deviceUs.value_or(INT64_MIN));
    for (float value : frame.values) put(value);
  }
  put(static_cast<std::int64_t>(profile.numAngles()));
  for (std::size_t i = 0; i < profile.numAngles(); ++i) {
    put(profile.angleTimeUs(i));
    put(std::int64_t{INT64_MIN});
    for (double deg : profile.angles(i).values) put(deg);
  }
  put(static_cast<std::int64_t>(profile.numTemperatures()));
  for (std::size_t i = 0; i < profile.numTemperatures(); ++i) {
    put(profile.temperatureTimeUs(i));
    put(std::int64_t{INT64_MIN});
    for (double degC : profile.temperatures(i).values) put(degC);
  }
  return out;
}

}  // namespace palpate::testing
