// A long recording that is small in bytes, for tests of damage to single blocks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/model/profile.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_writer.h"

#include "testing/testing.h"

namespace palpate::testing {

// Stamps that are not evenly spaced, 5 ms apart on average: where a block is damaged they are
// estimated.
inline std::int64_t longStampUs(std::size_t frame) {
  return 1'400'000'000'000'000 + static_cast<std::int64_t>(frame * 5'000 + frame % 7 * 300);
}
inline float longValue(std::size_t frame) { return static_cast<float>(1 + frame % 1'000); }

// A pad of one taxel in blocks of some hundred frames. With `withSamples`, angles of two axes at
// every frame, and a temperature at every hundredth.
inline void writeLong(const std::filesystem::path& path, std::size_t frames, bool withSamples) {
  PalpateWriterOptions options;
  options.synced = false;
  options.commitIntervalUs = 1'000'000'000;  // full blocks
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  PalpateWriter writer(path, layout, {}, options);
  TactileFrame frame(layout);
  for (std::size_t i = 0; i < frames; ++i) {
    frame.hostUs = longStampUs(i);
    frame.values[0] = longValue(i);
    if (withSamples) writer.addSample({frame.hostUs, {static_cast<double>(i % 90), 1.5}});
    if (withSamples && i % 100 == 0) writer.addSample({frame.hostUs, {20.0}, kTemperatureSeries});
    writer.addFrame(frame);
  }
  writer.finish();
}

// Changes a byte of the first block of frames behind this share of the file, and returns its
// frames.
inline UnreadableSamples::Run damageBlock(const std::filesystem::path& path, double share) {
  constexpr std::size_t kPage = 4096;
  const std::string sound = readFile(path);
  const auto from = static_cast<std::size_t>(share * static_cast<double>(sound.size() / kPage));
  for (std::size_t page = from; page < sound.size() / kPage; ++page) {
    std::string bytes = sound;
    bytes[page * kPage + kPage / 2] ^= 0x5a;
    writeFile(path, bytes);
    try {
      const Profile profile = readPalpate(path).profile;
      UnreadableSamples unreadable;
      TactileFrame frame;
      for (std::size_t i = 0; i < profile.numFrames(); ++i)
        profile.readFrame(i, frame, &unreadable);
      if (unreadable.runs.size() == 1) return unreadable.runs.front();
    } catch (const FormatError&) {
      // A page of another table.
    }
  }
  ADD_FAILURE() << "no block of frames behind " << share;
  return {};
}

}  // namespace palpate::testing
