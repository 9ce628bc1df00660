// Health of the connection from the hand to the disk, as an operator needs it: actual rate, age of
// the newest frame, losses, saturation, queues, remaining disk time; alarms; and a one-line check
// before a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/capture/recorder.h>
#include <palpate/device/device.h>
#include <palpate/device/series_source.h>
#include <palpate/model/series.h>
#include <palpate/model/time_base.h>

namespace palpate {

struct HealthOptions {
  // Expected frames per second; empty: the value of LinkMonitor::expect(), else the mean since the
  // start.
  std::optional<double> expectedRateHz;
  // Alarm when the rate is below this fraction of the expected rate for longer than lowRateS.
  double lowRateFraction = 0.8;
  double lowRateS = 2.0;  // [s]
  // Alarm when no frame arrives for this time (and for 3 periods) [s].
  double noDataS = 1.0;
  // Alarm when a recording has no frame after this time [s].
  double emptyRecordingS = 2.0;
  double lowDiskHours = 1.0;  // [h]
  // Used until the rate is measured: an SDH-2 with angles writes 1.5 GB a day.
  double nominalBytesPerS = 18'000.0;
  // Recorded hands reached 61 [deg C].
  double maxTemperatureDegC = 65.0;
};

// Measures rates and saturation of the received frames by their arrival times. Thread-safe.
class LinkMonitor {
 public:
  explicit LinkMonitor(const HealthOptions& options = {}) : options_(options) {}

  struct Reading {
    std::uint64_t frames = 0;
    // Over the last 2 s (or the last 1024 frames if these cover less time).
    double rateHz = 0.0;
    double meanRateHz = 0.0;  // since the first frame
    // Time since the newest frame arrived [ms]; empty before the first one.
    std::optional<double> ageMs;
    std::uint64_t saturatedFrames = 0;  // frames with a saturated taxel
    double saturatedFraction = 0.0;     // of the last 2 s, 0..1
    // Duration for which the rate has been low [s].
    double lowRateS = 0.0;
    // Reference for a low rate; 0: not known yet.
    double expectedRateHz = 0.0;
    // Largest rate that the line carries, for frames like those of the last 2 s; 0: not known.
    double lineRateHz = 0.0;
  };

  // Sets the rate of the device at its present settings [Hz]; empty: not known.
  void expect(std::optional<double> rateHz);
  // monoUs: monotonic time of arrival [us], never decreasing; runs: number from dsaRunsOf(), 0: not
  // known.
  void frame(std::int64_t monoUs, bool saturated, std::size_t runs = 0);
  Reading read(std::int64_t monoUs) const;
  void reset();

 private:
  static constexpr std::size_t kRing = 1024;
  struct Arrival {
    std::int64_t monoUs = 0;
    bool saturated = false;
    std::uint32_t runs = 0;
  };
  const Arrival& arrival(std::size_t age) const;  // age 0: the newest
  Reading readLocked(std::int64_t monoUs) const;

  const HealthOptions options_;
  mutable std::mutex mutex_;
  std::vector<Arrival> ring_ = std::vector<Arrival>(kRing);
  std::uint64_t frames_ = 0;
  std::uint64_t saturated_ = 0;
  std::int64_t firstUs_ = 0;
  std::optional<std::int64_t> lowSinceUs_;
  std::optional<double> expectedHz_;
};

enum class AlarmKind {
  kNoData,
  kLowRate,
  kLowDisk,
  kOverflow,        // items were lost because the recorder could not keep up
  kWriteError,      // the disk is full or fails, or the file is gone; capture continues
  kMcapStopped,     // the MCAP file beside the recording is not whole; the recording goes on
  kSlowDisk,        // the disk makes the recorder wait
  kEmptyRecording,  // a recording was started, but no frame arrives
  kNoRows,          // a series beside the hand's: nothing comes from its source
  kTooHot,          // a motor or a board is hotter than HealthOptions::maxTemperatureDegC
};
struct Alarm {
  AlarmKind kind = AlarmKind::kNoData;
  std::string text;  // one line: what, and what to do
};

// The clock of a sender, of the last five minutes.
struct LinkClock {
  std::string of;  // "frames", or the name of the series
  ClockReport report;
};

// State of the session at one moment; input of assessHealth().
struct LinkInputs {
  bool started = false;
  DeviceStatus device;
  LinkMonitor::Reading frames;
  CaptureQueueStats queues;
  RecorderStatus recorder;
  // The newest temperatures; empty before the first ones.
  std::optional<Sample> temperatures;
  std::vector<SeriesStatus> series;  // of the sources of further series
  std::vector<LinkClock> clocks;
};

struct LinkHealth {
  LinkMonitor::Reading frames;
  DeviceStatus device;
  std::vector<SeriesStatus> series;  // of the sources of further series
  std::uint64_t lost = 0;            // frames that were sent but not received completely
  std::uint64_t badChecksums = 0;    // of both ports
  std::vector<LinkClock> clocks;     // of what comes with times of its sender
  CaptureQueueStats queues;          // queues of the recorder
  // Bytes written to disk, measured (or HealthOptions::nominalBytesPerS).
  double bytesPerS = 0.0;
  std::optional<std::uint64_t> freeBytes;
  std::optional<double> diskHours;  // at this rate
  RecorderStatus recorder;
  std::vector<Alarm> alarms;
};
LinkHealth assessHealth(const LinkInputs& inputs, const HealthOptions& options = {});

// How long free space lasts: "less than a minute", "12 minutes", "9.5 h", "30 h", "57 days", "over
// a year".
std::string diskTimeText(double hours);

// The port's message without its name at the front, for places where the name is shown already.
std::string withoutPort(const PortStatus& port);

// Result of the check before a run: ready or not, in one line.
struct PreflightCheck {
  bool ready = false;
  // Ready, but what comes should be looked at first; the text says why.
  bool doubtful = false;
  std::string text;
  std::optional<std::uint64_t> freeBytes;  // on the disk of the checked folder
  std::optional<double> diskHours;         // at this rate
};
// `writable`: whether files can be created there; `freeBytes` on its disk, empty when unknown.
struct FolderState {
  std::filesystem::path path;
  bool writable = false;
  std::optional<std::uint64_t> freeBytes;
};
PreflightCheck checkPreflight(const LinkInputs& inputs,
                              const FolderState& folder,
                              const HealthOptions& options = {});

}  // namespace palpate
