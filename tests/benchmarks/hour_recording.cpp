#include "benchmarks/hour_recording.h"

#include <filesystem>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::benchmarks {

Profile hourOfFrames() {
  static const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "hour.palpate";
  if (!std::filesystem::exists(path)) {
    SyntheticOptions options;
    options.durationS = 3600.0;
    options.grasps = 900;
    options.noiseCounts = 3.0;
    saveRecording(synthesize(options), {}, path);
  }
  return openRecording(path);
}

void setTaxelBytes(benchmark::State& state, const Profile& profile) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * profile.numFrames() *
                                                    profile.layout().numCells() * 2));
}

}  // namespace palpate::benchmarks
