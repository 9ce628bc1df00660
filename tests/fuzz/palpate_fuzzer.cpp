// Fuzzes the reader of native recordings and the salvage with files of any kind. Beyond not
// crashing: what is read is finite and strictly ordered, and salvage gives at least what the reader
// gives.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/second_summary.h"

namespace {

using palpate::Profile;

void require(bool condition) {
  if (!condition) std::abort();
}

void requireSane(const Profile& profile) {
  palpate::TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    for (const float value : frame.values) require(std::isfinite(value));
    require(i == 0 || profile.frameTimeUs(i) > profile.frameTimeUs(i - 1));
  }
  for (std::size_t series = 0; series < profile.series().size(); ++series)
    for (std::size_t i = 0; i < profile.numSamples(series); ++i) {
      // Only in series beside those of the hand may a value be missing.
      for (const double value : profile.sample(series, i).values)
        require(std::isfinite(value) || (series >= palpate::kHandSeries && std::isnan(value)));
      require(i == 0 || profile.sampleTimeUs(series, i) > profile.sampleTimeUs(series, i - 1));
    }
}

// A file of this process, in memory where the system has such a folder.
const std::filesystem::path& inputPath() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto folder =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    return folder / ("palpate-fuzz-" + std::to_string(getpid()) + ".palpate");
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto& path = inputPath();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  std::size_t frames = 0;
  try {
    const Profile profile = palpate::readPalpate(path).profile;
    requireSane(profile);
    frames = profile.numFrames();
  } catch (const palpate::FormatError&) {
  } catch (const palpate::FileError&) {
  }
  try {
    palpate::readSeconds(path);
  } catch (const palpate::FormatError&) {
  } catch (const palpate::FileError&) {
  }
  const palpate::PalpateRecovery recovery = palpate::recoverPalpateProfile(path);
  if (recovery.profile) requireSane(*recovery.profile);
  require(recovery.frames >= frames);
  std::filesystem::remove(path);
  return 0;
}
