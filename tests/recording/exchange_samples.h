// Recordings for the tests of HDF5 and MCAP, and what both forms have to do alike.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <palpate/core/error.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recording/event_store.h>
#include <palpate/recording/recording.h>

#include "imports/import_samples.h"
#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::testing {

inline std::shared_ptr<const SensorLayout> maskedPads() {
  MatrixLayout first = MatrixLayout::full(3, 5, 1.25);
  first.staticMask[4] = 0;
  first.dynamicMask[7] = 0;
  first.uniqueId = "28FF";
  return std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{first, MatrixLayout::full(1, 2, 7.1)});
}

// Two pads and four axes. Every third frame is filtered, some values of which are below zero.
inline Profile randomProfile(std::uint32_t seed, bool floats, std::size_t frames) {
  std::mt19937 random(seed);
  const auto layout = maskedPads();
  ProfileBuilder builder(layout);
  std::int64_t timeUs = 1'600'000'000'000'000;
  for (std::size_t i = 0; i < frames; ++i) {
    TactileFrame frame(layout);
    frame.hostUs = timeUs += 1 + random() % 50'000;
    if (i > 10 && random() % 4 != 0) frame.deviceUs = 1000 * static_cast<std::int64_t>(random());
    for (float& value : frame.values)
      value = random() % 3 == 0 ? static_cast<float>(random() % 4096) : 0.0F;
    if (floats && i % 3 == 0) {
      std::vector<float> all;
      std::vector<bool> active;
      for (std::size_t k = 0; k < frame.values.size(); ++k) {
        all.push_back(static_cast<float>(random() % 2000) / 7.0F - 40.0F);
        active.push_back(random() % 2 == 0);
      }
      frame.setFiltered(std::move(all), active);
    }
    builder.addFrame(frame);
    const double x = static_cast<double>(i);
    if (i % 2 == 0) builder.addAngles(frame.hostUs, std::vector<double>{0.1 * x, -3.0, 1.0 / 3, 7});
    if (i % 100 == 0) builder.addTemperatures(frame.hostUs, std::vector<double>{20.5, 0.1 * x});
  }
  ProfileInfo info;
  info.serial = "12AB";
  info.firmware = "2.9";
  return builder.finish(std::move(info));
}

inline void expectSame(const Profile& a, const Profile& b) {
  ASSERT_EQ(a.numFrames(), b.numFrames());
  ASSERT_EQ(a.numAngles(), b.numAngles());
  ASSERT_EQ(a.numTemperatures(), b.numTemperatures());
  EXPECT_TRUE(a.layout() == b.layout());
  for (std::size_t m = 0; m < a.layout().numMatrices(); ++m)
    EXPECT_EQ(a.layout().matrix(m).uniqueId, b.layout().matrix(m).uniqueId);
  EXPECT_EQ(a.hand().name, b.hand().name);
  EXPECT_EQ(a.info().valueType, b.info().valueType);
  EXPECT_EQ(a.info().serial, b.info().serial);
  EXPECT_EQ(a.info().firmware, b.info().firmware);
  for (std::size_t i = 0; i < a.numFrames(); ++i) {
    const TactileFrame x = a.frame(i);
    const TactileFrame y = b.frame(i);
    ASSERT_EQ(x.hostUs, y.hostUs) << i;
    ASSERT_EQ(x.deviceUs, y.deviceUs) << i;
    ASSERT_TRUE(x.values == y.values) << i;
    ASSERT_TRUE(x.filtered == y.filtered) << i;
  }
  for (std::size_t i = 0; i < a.numAngles(); ++i) {
    ASSERT_EQ(a.angleTimeUs(i), b.angleTimeUs(i));
    ASSERT_EQ(a.angles(i).values, b.angles(i).values);
  }
  for (std::size_t i = 0; i < a.numTemperatures(); ++i) {
    ASSERT_EQ(a.temperatureTimeUs(i), b.temperatureTimeUs(i));
    ASSERT_EQ(a.temperatures(i).values, b.temperatures(i).values);
  }
}

// What opening a file says, in one line; empty when it opens.
inline std::string openingError(const std::filesystem::path& path) {
  const std::string line = errorOf([&] { openRecording(path); });
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  return line;
}

inline void expectOpeningError(const std::filesystem::path& path, const std::string& words) {
  const std::string error = openingError(path);
  EXPECT_NE(error.find(words), std::string::npos) << path << ": " << error;
}

// A native recording with its meta and events, saved under this name and back.
inline void expectNativeComesBackFrom(const std::string& name) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 3000);
  const Profile profile = openRecording(folder / "a.palpate");
  SaveExtras extras;
  extras.meta = readRecordingMeta(folder / "a.palpate");
  extras.meta["settings"] = "[{\"sensitivity\":0.5}]";
  const auto events = readEvents(folder / "a.palpate").events;
  saveRecording(profile, events, folder / name, Overwrite::kRefuse, {}, extras);
  EXPECT_EQ(dumped(openRecording(folder / name)), dumped(profile));
  EXPECT_EQ(readEvents(folder / name).events, events);
  SaveExtras back;
  back.meta = readRecordingMeta(folder / name);
  saveRecording(openRecording(folder / name),
                readEvents(folder / name).events,
                folder / "b.palpate",
                Overwrite::kRefuse,
                {},
                back);
  EXPECT_EQ(dumped(openRecording(folder / "b.palpate")), dumped(profile));
  EXPECT_EQ(readEvents(folder / "b.palpate").events, events);
  // This source doesn't name its hand; a conversion does.
  auto meta = readRecordingMeta(folder / "b.palpate");
  for (const char* key : {"hand", "hand_json", "hand_urdf"}) EXPECT_EQ(meta.erase(key), 1u) << key;
  EXPECT_EQ(meta, extras.meta);
}

using WriteProfile = std::function<void(const Profile&, const std::filesystem::path&)>;

// Of PALPATE_RECORDINGS; skips the test when there are none.
inline void expectRealRecordingsComeBack(const std::string& name, const WriteProfile& write) {
  const auto recordings = recordingsFolder();
  if (!recordings) GTEST_SKIP() << "no recordings: set PALPATE_RECORDINGS";
  const TemporaryFolder folder;
  std::size_t tried = 0;
  for (const auto& file : recordingsToTry(*recordings)) {
    if (++tried > 12 && !exhaustive()) break;
    const Profile profile = openRecording(file);
    write(profile, folder / name);
    SCOPED_TRACE(file.string());
    expectSame(profile, openRecording(folder / name));
  }
  EXPECT_GT(tried, 0u);
}

inline void expectThreadsReadAtOnce(const std::string& name, const WriteProfile& write) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(5, true, 2600);
  write(profile, folder / name);
  const Profile read = openRecording(folder / name);
  std::vector<std::jthread> threads;
  std::array<int, 4> wrong{};
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < 2600; i += 7) {
        const std::size_t k = (i * 977) % 2600;
        if (!(read.frame(k).values == profile.frame(k).values)) ++wrong[t];
        if (read.angles(k / 2).values != profile.angles(k / 2).values) ++wrong[t];
      }
    });
  threads.clear();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

inline void expectFullDiskLeavesNothing(const std::string& name, const WriteProfile& write) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 20'000);
  for (const rlim_t bytes : {0, 2'000, 50'000, 200'000}) {
    const auto full = [&] {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{bytes, bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      try {
        write(profile, folder / name);
      } catch (const FileError& error) {
        ::_exit(std::string(error.what()).find("File too large") != std::string::npos ? 7 : 8);
      }
      ::_exit(0);
    };
    EXPECT_EXIT(full(), ::testing::ExitedWithCode(7), "") << bytes;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << bytes;
  }
  write(profile, folder / name);
  EXPECT_GT(std::filesystem::file_size(folder / name), 200'000u);
}

}  // namespace palpate::testing
