// Link health: what an operator must know about the way from the hand to the disk. True rate, age
// of the newest frame, what was lost, saturation, queues, disk in hours; alarms; and one line
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
#include <palpate/model/hand_state.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct HealthOptions {
  // Frames per second that are expected; nothing: what LinkMonitor::expect() says, else the mean
  // since the start.
  std::optional<double> expectedRateHz;
  double lowRateFraction = 0.8;        // of the expected rate: below is low ..
  double lowRateS = 2.0;               // .. when it lasts longer [s]
  double noDataS = 1.0;                // no frame for longer (and for 3 periods) is an alarm [s]
  double emptyRecordingS = 2.0;        // a recording without a frame after so long is empty [s]
  double lowDiskHours = 1.0;           // [h]
  double nominalBytesPerS = 18'000.0;  // until measured: an SDH-2 with angles writes 1.5 GB a day
  double maxTemperatureDegC = 65.0;    // recorded hands reached 61 [deg C]
};

// Frames per second that a DSACON32-M scans, by the number of its taxels that are enabled. Measured
// on a real hand (recordings of 2014): 2 taxels 13.2 ms, a matrix of 78 places 17.7 ms, all of an
// SDH-2 31.55 ms; between them linear.
double scanRateHz(std::size_t enabledTaxels);
// Frames per second that 115200 baud carry, of frames with so many runs of equal counts (a run is
// 15 long at most): 13 bytes of packet and 2 per run, 10 bits per byte.
double lineRateHz(double runs);
// Runs of the values of a frame, as the controller sends them.
std::size_t runsOf(const TactileFrame& frame);

// Rates and saturation of the frames that came, by the clock of their arrival. Thread-safe.
class LinkMonitor {
 public:
  explicit LinkMonitor(const HealthOptions& options = {}) : options_(options) {}

  struct Reading {
    std::uint64_t frames = 0;
    double rateHz = 0.0;      // of the last 2 s (of the last 1024 frames, when these are younger)
    double meanRateHz = 0.0;  // since the first frame
    std::optional<double> ageMs;        // since the newest frame came [ms]; nothing: none came yet
    std::uint64_t saturatedFrames = 0;  // frames with a saturated taxel
    double saturatedFraction = 0.0;     // of the last 2 s, 0..1
    double lowRateS = 0.0;              // for how long the rate has been low [s]
    double expectedRateHz = 0.0;        // what low is measured by; 0: not known yet
    // that the line carries of frames like those of the last 2 s; 0: not known
    double lineRateHz = 0.0;
  };

  // What the device gives as it is set now [Hz]; nothing: not known.
  void expect(std::optional<double> rateHz);
  // monoUs: monotonic time of arrival [us], never decreasing; runs: of runsOf(), 0: not known.
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
  const Arrival& arrival(std::size_t age) const;  // 0: the newest
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
  kWriteError,      // the disk is full or fails; capture goes on
  kSlowDisk,        // the disk keeps the recorder waiting
  kEmptyRecording,  // a recording was started, and no frame comes
  kTooHot,          // a motor or a board is hotter than HealthOptions::maxTemperatureDegC
};
struct Alarm {
  AlarmKind kind = AlarmKind::kNoData;
  std::string text;  // one line: what, and what to do
};

// What is known at one moment.
struct LinkInputs {
  bool started = false;
  DeviceStatus device;
  LinkMonitor::Reading frames;
  CaptureQueueStats queues;
  RecorderStatus recorder;
  std::optional<Temperatures> temperatures;  // the newest; nothing: none came yet
};

struct LinkHealth {
  LinkMonitor::Reading frames;
  DeviceStatus device;
  std::uint64_t lost = 0;          // frames that were sent and never came whole
  std::uint64_t badChecksums = 0;  // of both ports
  CaptureQueueStats queues;        // towards the recorder
  double bytesPerS = 0.0;          // to disk, measured (or HealthOptions::nominalBytesPerS)
  std::optional<std::uint64_t> freeBytes;
  std::optional<double> diskHours;  // at this rate
  RecorderStatus recorder;
  std::vector<Alarm> alarms;
};
LinkHealth assessHealth(const LinkInputs& inputs, const HealthOptions& options = {});

// What a port says is wrong, without its name in front: where the name is said already.
std::string withoutPort(const PortStatus& port);

// Result of the check before a run: ready or not, in one line.
struct PreflightCheck {
  bool ready = false;
  std::string text;
  std::optional<std::uint64_t> freeBytes;  // in the folder that was asked about
  std::optional<double> diskHours;         // at this rate
};
// `freeBytes` on the disk of `folder`, nothing when unknown; `writable`: whether files can be made
// there.
struct FolderState {
  std::filesystem::path path;
  bool writable = false;
  std::optional<std::uint64_t> freeBytes;
};
PreflightCheck checkPreflight(const LinkInputs& inputs,
                              const FolderState& folder,
                              const HealthOptions& options = {});

}  // namespace palpate
