// An open recording with everything that the window needs of it (timing, signals, maximum, events).
// The worker that opens the file creates it, and it never changes afterwards.
#pragma once

#include <QString>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/recording/recording.h>
#include <palpate/signals/characteristic_signals.h>
#include <palpate/signals/signal_overview.h>

namespace palpate::gui {

struct OpenedRecording {
  // Longer recordings (about 1 h 45 min of an SDH-2) are shown before all their frames have been
  // read, as are those with as much data in fewer frames: a file may have 64 matrices or 65,536
  // taxels. The constants are the limits in frames, frames x (matrices + 1), and frames x taxels.
  static constexpr std::size_t kLongFrom = 200'000;           // [frames]
  static constexpr std::size_t kLongFromRows = 1'600'000;     // [frames x (matrices + 1)]
  static constexpr std::size_t kLongFromPlaces = 97'200'000;  // [frames x taxels]

  std::filesystem::path path;
  Profile profile;
  // Of a long recording: from its summary, see timingNow().
  TimingReport timing;
  // Signals of every matrix; empty for a long recording.
  SignalTable table;
  // Signals of all matrices together, one per frame; empty for a long recording.
  std::vector<CharacteristicSignals> whole;
  // Time of each frame from the first one [s]; empty for a long recording.
  std::vector<double> timeS;
  // Largest value of all frames [counts].
  double maximum = 0.0;
  // False for a long recording without a summary.
  bool maximumKnown = true;
  // Number of frames with a taxel at or above saturation.
  std::size_t saturatedFrames = 0;
  // Per matrix: whether any frame has an active taxel.
  std::vector<bool> touched;
  // The events as stored in the file.
  EventsReport events;
  // Of events, those that aren't in the file: what was found to be lost of a damaged recording.
  std::vector<Event> notInFile = {};
  // The meta data, see recording.h; empty for a .dsa.
  RecordingMeta meta = {};
  // Why the events couldn't be read; empty: they were read.
  std::string eventsFailure;
  // What is missing of a damaged recording, of which only the readable part was opened; one line,
  // empty: nothing.
  std::string damage = {};
  // Of a long recording: the timeline fills it (compute()). Null: `table` has all signals.
  std::shared_ptr<SignalOverview> overview;

  bool isLong() const noexcept { return overview != nullptr; }
  // Values that need a pass over all frames; for a long recording an estimate until that pass is
  // done. Nothing: not known yet.
  const TimingReport& timingNow() const;
  std::optional<double> maximumNow() const;
  std::optional<std::size_t> saturatedFramesNow() const;
  // The frames of a long recording that can't be read because they are damaged; none until all have
  // been read. Of a short one they are left out when it is opened, see `damage`.
  const UnreadableSamples& unreadableNow() const;
  // Whether the frame at this time is one of them.
  bool unreadableAt(double seconds) const;

  // The signals of a matrix or, if matrix == numMatrices(), of the whole hand. Throws Error for a
  // frame of a long recording that can't be read.
  CharacteristicSignals at(std::size_t frame, std::size_t matrix) const;
  // Time from the first frame [s].
  double timeAt(std::size_t frame) const;
  double durationS() const;
  std::size_t numMatrices() const { return profile.layout().numMatrices(); }
  // First and last frame within a span [s]; nothing: the span contains no frame.
  std::optional<std::pair<std::size_t, std::size_t>> framesWithin(double fromS, double toS) const;
  // The gap that contains this time; null outside of gaps.
  const Gap* gapAt(double seconds) const;
  // Why there are no frames in this gap: what the recording notes about it, else "nothing was
  // recorded".
  QString reasonOf(const Gap& gap) const;
};

using OpenedRecordingPtr = std::shared_ptr<const OpenedRecording>;

// For readSeries(): -kEndOfTimeS to kEndOfTimeS covers any recording [s].
inline constexpr double kEndOfTimeS = std::numeric_limits<double>::max();

// The file name without its folder, as the window shows it.
QString fileNameOf(const OpenedRecording& recording);

// Computes everything that a recording, or the readable part of a damaged one, doesn't contain
// itself. Throws Cancelled.
OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                       Recording recording,
                                       const Progress& progress = {},
                                       std::size_t longFrom = OpenedRecording::kLongFrom);
// The same without events and meta data.
inline OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                              Profile profile,
                                              const Progress& progress = {},
                                              std::size_t longFrom = OpenedRecording::kLongFrom) {
  return makeOpenedRecording(
      std::move(path), Recording{.profile = std::move(profile)}, progress, longFrom);
}
// Whether the recording was never finished: its writer ended before it could.
bool isUnfinished(const OpenedRecording& recording);

}  // namespace palpate::gui
