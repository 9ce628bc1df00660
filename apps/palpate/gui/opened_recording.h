// A recording that is open, with all that the window wants to know about it: made once, in the
// worker that opens it, and never changed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/characteristic_signals.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>

namespace palpate::gui {

struct OpenedRecording {
  std::filesystem::path path;
  Profile profile;
  TimingReport timing;
  SignalTable table;                         // of every matrix
  std::vector<CharacteristicSignals> whole;  // of all matrices together, one per frame
  std::vector<double> timeS;                 // from the first frame, one per frame [s]
  std::vector<std::size_t> gapFrames;        // last frame before each gap
  double maximum = 0.0;                      // largest value of all frames [counts]
  std::size_t saturatedFrames = 0;           // frames with a taxel at or above saturation
  std::vector<bool> touched;                 // per matrix: has an active taxel in some frame

  // The signals of a matrix, or (matrix == number of matrices) of the whole.
  const CharacteristicSignals& at(std::size_t frame, std::size_t matrix) const;
  std::size_t numMatrices() const { return profile.layout().numMatrices(); }
  // The gap that a time lies in; nothing outside of gaps.
  const Gap* gapAt(double seconds) const;
};

using OpenedRecordingPtr = std::shared_ptr<const OpenedRecording>;

// Computes what isn't in the profile itself. Throws Cancelled.
OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                       Profile profile,
                                       const Progress& progress = {});

}  // namespace palpate::gui
