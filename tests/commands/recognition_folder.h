// Folders of recordings as train, evaluate, adapt and classify take them: made-up grasps of things
// that differ in size.
#pragma once

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "recognition/pinch_profile.h"
#include "testing/awaited.h"
#include "testing/background_program.h"

namespace palpate::testing {

constexpr std::int64_t kOneDayUs = 24LL * 3600 * 1'000'000;

// One recording with so many grasps of a thing of `gapMm`: sizes scatter by .3 mm, forces by 5 %.
inline void saveGrasps(const std::filesystem::path& path,
                       double gapMm,
                       int grasps,
                       unsigned seed,
                       std::int64_t startUs = kPinchStartUs) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  ProfileBuilder builder(sdh2().layout);
  std::int64_t nowUs = startUs;
  const auto add = [&](double gap, double force) {
    TactileFrame frame(sdh2().layout);
    if (force > 0.0)
      for (int y = 8; y < 12; ++y)
        for (int x = 1; x < 5; ++x) {
          const double near = 1.0 / (1.0 + (y - 10) * (y - 10) + (x - 2) * (x - 2));
          frame.matrix(1)(y, x) = static_cast<float>(std::round(1500.0 * force * near));
          frame.matrix(5)(y, 5 - x) = static_cast<float>(std::round(600.0 * force * near));
        }
    builder.addFrame(nowUs, frame.values);
    builder.addAngles(nowUs, anglesForGap(gap));
    nowUs += kPinchPeriodUs;
  };
  for (int g = 0; g < grasps; ++g) {
    const double gap = gapMm + 0.3 * normal(random), force = 1.0 + 0.05 * normal(random);
    for (int i = 0; i < 10; ++i) add(gap + 10.0 - i, 0.0);
    for (int i = 0; i < 30; ++i)
      add(gap, force * std::min(1.0, 0.2 + 0.1 * i) + 0.01 * normal(random));
    for (int i = 0; i < 5; ++i) add(gap + 10.0, 0.0);
  }
  std::filesystem::create_directories(path.parent_path());
  saveRecording(builder.finish({}), {}, path);
}

struct MadeThing {
  const char* folder;
  double gapMm;
};
constexpr MadeThing kThings[] = {
    {"pen", 8.0}, {"small_box", 16.0}, {"golf_ball", 24.0}, {"bottle", 32.0}};

// A folder per thing, read `offsetMm` too wide.
inline void saveThings(const std::filesystem::path& folder,
                       int grasps,
                       unsigned seed,
                       double offsetMm = 0.0,
                       std::int64_t startUs = kPinchStartUs) {
  for (const MadeThing& thing : kThings)
    saveGrasps(folder / thing.folder / "a.dsa", thing.gapMm + offsetMm, grasps, ++seed, startUs);
}

// Ctrl-C as soon as the program listens for it (a caught signal of its status), at whatever it is.
// Its exit code.
inline int interruptAtWork(BackgroundProgram& program) {
  const auto listens = [&] {
    std::ifstream status("/proc/" + std::to_string(program.pid()) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind("SigCgt:", 0) == 0)
        return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
    return false;
  };
  EXPECT_TRUE(awaited(listens));
  program.signal(SIGINT);
  return program.wait();
}

// The pads of the empty hand touch, and the joints say `gapMm`; the same again `touches` times.
inline void saveTouches(const std::filesystem::path& path,
                        double gapMm,
                        int touches = 2,
                        std::int64_t startUs = kPinchStartUs) {
  saveGrasps(path, gapMm, touches, 7, startUs);
}

// A model of the four things, of the day on which all of these recordings begin if nothing else is
// said.
class ModelFolder : public ::testing::Test {
 protected:
  static constexpr std::int64_t kLaterUs = kPinchStartUs + 70 * kOneDayUs;
  void SetUp() override {
    saveThings(folder_ / "all", 10, 1);
    saveTouches(folder_ / "touch.dsa", -1.0);
    ASSERT_EQ(
        palpate(
            {"train", folder_ / "all", "-o", model(), "--empty-hand-zero", folder_ / "touch.dsa"})
            .exitCode,
        0);
  }
  std::string model() const { return folder_ / "m.json"; }
  TemporaryFolder folder_;
};

}  // namespace palpate::testing
