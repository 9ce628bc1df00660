// What the benchmarks of growth (docs/notes/growth.md) share: recordings of any length, and the
// memory that a piece of work takes.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

#include "palpate/device/sdh2.h"
#include <palpate/model/hand_description.h>
#include <palpate/recording/palpate_writer.h>

namespace palpate::testing {

// The highest memory of this process since the last call [MB].
inline double takePeakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double peak = static_cast<double>(usage.ru_maxrss) / 1024.0;
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.starts_with("VmHWM:")) peak = std::stod(line.substr(6)) / 1024.0;
  std::ofstream("/proc/self/clear_refs") << "5";
  return peak;
}

// How much higher the memory rose than it was before [MB].
class PeakRise {
 public:
  PeakRise() {
    malloc_trim(0);  // what was freed before is no memory that can be taken again unseen
    takePeakMb();
    before_ = takePeakMb();
  }
  double take() const { return std::max(takePeakMb() - before_, 0.0); }

 private:
  double before_ = 0.0;
};

// Frames of a hand that holds something now and then, 30 a second.
inline void writeRecordingOf(int numFrames, const std::filesystem::path& path) {
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(path, sdh2().layout, {}, options);
  TactileFrame frame(sdh2().layout);
  std::mt19937 random(1);
  for (int i = 0; i < numFrames; ++i) {
    frame.hostUs = 1'400'000'000'000'000 + i * 33'333LL;
    std::fill(frame.values.begin(), frame.values.end(), 0.0F);
    if (i % 1000 < 600)
      for (std::size_t k = 0; k < 60; ++k)
        frame.values[k * 8 + k % 3] = static_cast<float>(random() % 2000);
    writer.addFrame(frame);
  }
  writer.finish();
}

}  // namespace palpate::testing
