// A recording that is open, with all that the window wants to know about it: made once, in the
// worker that opens it, and never changed.
#pragma once

#include <QString>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/recording/recording_event.h>
#include <palpate/signals/characteristic_signals.h>
#include <palpate/signals/signal_overview.h>

namespace palpate::gui {

struct OpenedRecording {
  // Longer ones (an hour and three quarters of a hand) aren't read through before they are shown,
  // nor are those whose matrices make as much of fewer frames: a file may claim 64 matrices or
  // 65,536 places.
  static constexpr std::size_t kLongFrom = 200'000;           // frames
  static constexpr std::size_t kLongFromRows = 1'600'000;     // frames x (matrices + 1)
  static constexpr std::size_t kLongFromPlaces = 97'200'000;  // frames x places

  std::filesystem::path path;
  Profile profile;
  TimingReport timing;                       // of a long one: from its summary, see timingNow()
  SignalTable table;                         // of every matrix; empty of a long one
  std::vector<CharacteristicSignals> whole;  // of all matrices together, one per frame; likewise
  std::vector<double> timeS;                 // from the first frame, one per frame [s]; likewise
  std::vector<std::size_t> gapFrames;        // last frame before each gap
  double maximum = 0.0;                      // largest value of all frames [counts]
  bool maximumKnown = true;                  // false: of a long one without a summary
  std::size_t saturatedFrames = 0;           // frames with a taxel at or above saturation
  std::vector<bool> touched;                 // per matrix: has an active taxel in some frame
  EventsReport events;                       // as the file has them
  std::map<std::string, std::string> meta = {};  // recording_meta.h; empty of a .dsa
  std::string eventsFailure;                     // why they could not be read; empty: they could
  // Of a long one: filled by whoever shows it (compute()); null: the table has everything.
  std::shared_ptr<SignalOverview> overview;

  bool isLong() const noexcept { return overview != nullptr; }
  // What only a pass over all frames tells; of a long one first an estimate. Nothing: not known
  // yet.
  const TimingReport& timingNow() const;
  std::optional<double> maximumNow() const;
  std::optional<std::size_t> saturatedFramesNow() const;

  // The signals of a matrix, or (matrix == number of matrices) of the whole.
  CharacteristicSignals at(std::size_t frame, std::size_t matrix) const;
  double timeAt(std::size_t frame) const;  // from the first frame [s]
  double durationS() const;
  std::size_t numMatrices() const { return profile.layout().numMatrices(); }
  // First and last frame within a span; nothing: none lies in it.
  std::optional<std::pair<std::size_t, std::size_t>> framesWithin(double fromS, double toS) const;
  // The gap that a time lies in; nothing outside of gaps.
  const Gap* gapAt(double seconds) const;
};

using OpenedRecordingPtr = std::shared_ptr<const OpenedRecording>;

// Of readSeries(): -kEndOfTimeS to kEndOfTimeS is all of any recording [s].
inline constexpr double kEndOfTimeS = std::numeric_limits<double>::max();

// As the window calls it: without its folder.
QString fileNameOf(const OpenedRecording& recording);

// Computes what isn't in the profile itself. Throws Cancelled.
OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                       Profile profile,
                                       const Progress& progress = {},
                                       std::size_t longFrom = OpenedRecording::kLongFrom);

}  // namespace palpate::gui
