#include "palpate/capture/link_health.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "palpate/core/number_text.h"
#include "palpate/device/dsa_frame.h"

namespace palpate {
namespace {

constexpr std::int64_t kWindowUs = 2'000'000;
constexpr double kExpectationS = 5.0;  // minimum time before the mean rate is the expected one
constexpr double kMeasuredS = 5.0;     // minimum recorded time before the size per second is used
constexpr double kBlockedAlarmS = 1.0;

double seconds(std::int64_t us) { return static_cast<double>(us) / 1e6; }

std::string portFault(const PortStatus& port, const std::string& name) {
  const std::string where = name + (port.port.empty() ? "" : " " + port.port);
  const std::string why = port.message.empty() ? "" : ": " + withoutPort(port);
  switch (port.state) {
    case PortState::kStreaming:
      return {};
    case PortState::kClosed:
      return where + " is closed" + why;
    case PortState::kConnecting:
      return where + " is not connected yet" + why;
    case PortState::kSilent:
      return port.items == 0 && port.suspect > 0 && !why.empty()
                 ? where + " sends nothing that fits the hand" + why
             : port.suspect > 0 && !why.empty()
                 ? where + " sends no frames" + why
                 : where + " is silent" +
                       (why.empty() ? ": check the hand's power and cable" : why);
    case PortState::kLost:
      return where + " is disconnected" + (why.empty() ? ": plug it in again" : why);
    case PortState::kFault:
      return where + " failed" + why;
  }
  return {};
}

std::string noDataText(const LinkInputs& inputs) {
  const std::string fault = portFault(inputs.device.tactile, "the tactile port");
  if (!fault.empty()) return fault;
  return "no frame for " + fixedText(inputs.frames.ageMs.value_or(0.0) / 1000.0, 1) + " s";
}

bool noData(const LinkInputs& inputs, const HealthOptions& options) {
  if (!inputs.started) return false;
  if (!inputs.frames.ageMs) {
    const PortState state = inputs.device.tactile.state;
    return state == PortState::kSilent || state == PortState::kLost || state == PortState::kFault;
  }
  const double periodS = inputs.frames.meanRateHz > 0.0 ? 1.0 / inputs.frames.meanRateHz : 0.0;
  return *inputs.frames.ageMs / 1000.0 > std::max(options.noDataS, 3.0 * periodS);
}

double bytesPerSecond(const RecorderStatus& recorder, const HealthOptions& options) {
  if (recorder.recordedS < kMeasuredS) return options.nominalBytesPerS;
  return static_cast<double>(recorder.bytesOnDisk) / recorder.recordedS;
}

std::optional<double> hoursOf(std::optional<std::uint64_t> freeBytes, double bytesPerS) {
  if (!freeBytes || bytesPerS <= 0.0) return {};
  return static_cast<double>(*freeBytes) / bytesPerS / 3600.0;
}

void addRecorderAlarms(const RecorderStatus& recorder,
                       const HealthOptions& options,
                       std::vector<Alarm>& alarms) {
  if (recorder.state == RecorderStatus::State::kWaiting &&
      recorder.elapsedS > options.emptyRecordingS)
    alarms.push_back({AlarmKind::kEmptyRecording,
                      "the recording is empty: no frame for " + fixedText(recorder.elapsedS, 0) +
                          " s; is the hand switched on?"});
  if (!recorder.writeError.empty())
    alarms.push_back({AlarmKind::kWriteError,
                      recorder.writeError + " (new data waits in memory, writing is tried again)"});
  if (!recorder.relocation.empty()) alarms.push_back({AlarmKind::kWriteError, recorder.relocation});
  if (!recorder.mcapFailure.empty())
    alarms.push_back({AlarmKind::kMcapStopped,
                      "the MCAP file stopped, the recording continues: " + recorder.mcapFailure +
                          "; make an MCAP file of the recording afterwards"});
  if (recorder.blockedS > kBlockedAlarmS)
    alarms.push_back({AlarmKind::kSlowDisk,
                      "the disk has kept the recorder waiting for " +
                          fixedText(recorder.blockedS, 0) + " s; new data waits in memory"});
  if (recorder.lost > 0)
    alarms.push_back({AlarmKind::kOverflow,
                      std::to_string(recorder.lost) +
                          " items are missing in the recording; its gap events show where"});
}

// Text about a low rate for the operator: the problem, and what to do.
std::string lowRateText(const LinkMonitor::Reading& frames, const HealthOptions& options) {
  const std::string text = "only " + fixedText(frames.rateHz, 1) + " frames/s instead of " +
                           fixedText(frames.expectedRateHz, 1);
  if (frames.lineRateHz <= 0.0) return text;
  if (frames.lineRateHz < options.lowRateFraction * frames.expectedRateHz)
    return text + ": noise fills the line; raise the threshold (dock Hand), or scan fewer taxels";
  return text +
         ": frames arrive late or not at all; see lost and bad checksums (dock Link), try "
         "another USB port or cable, end other programs";
}

std::optional<double> hottestOf(const LinkInputs& inputs) {
  if (!inputs.temperatures || inputs.temperatures->values.empty()) return std::nullopt;
  return *std::max_element(inputs.temperatures->values.begin(), inputs.temperatures->values.end());
}

}  // namespace

const LinkMonitor::Arrival& LinkMonitor::arrival(std::size_t age) const {
  return ring_[(frames_ - 1 - age) % kRing];
}

void LinkMonitor::reset() {
  const std::lock_guard lock(mutex_);
  frames_ = saturated_ = 0;
  lowSinceUs_.reset();
}

void LinkMonitor::expect(std::optional<double> rateHz) {
  const std::lock_guard lock(mutex_);
  if (rateHz != expectedHz_) lowSinceUs_.reset();
  expectedHz_ = rateHz;
}

void LinkMonitor::frame(std::int64_t monoUs, bool saturated, std::size_t runs) {
  const std::lock_guard lock(mutex_);
  if (frames_ == 0) firstUs_ = monoUs;
  ++frames_;
  saturated_ += saturated ? 1 : 0;
  ring_[(frames_ - 1) % kRing] = {monoUs, saturated, static_cast<std::uint32_t>(runs)};
  // The rate is checked at every eighth frame, to save time.
  constexpr std::uint64_t kEvery = 8;
  if (frames_ % kEvery != 0) return;
  const Reading now = readLocked(monoUs);
  const bool low =
      now.expectedRateHz > 0.0 && now.rateHz < options_.lowRateFraction * now.expectedRateHz;
  if (!low)
    lowSinceUs_.reset();
  else if (!lowSinceUs_)
    lowSinceUs_ = monoUs;
}

LinkMonitor::Reading LinkMonitor::read(std::int64_t monoUs) const {
  const std::lock_guard lock(mutex_);
  return readLocked(monoUs);
}

LinkMonitor::Reading LinkMonitor::readLocked(std::int64_t monoUs) const {
  Reading reading;
  reading.frames = frames_;
  reading.saturatedFrames = saturated_;
  if (frames_ == 0) return reading;
  const std::int64_t newestUs = arrival(0).monoUs;
  reading.ageMs = static_cast<double>(monoUs - newestUs) / 1000.0;
  if (newestUs > firstUs_)
    reading.meanRateHz = static_cast<double>(frames_ - 1) / seconds(newestUs - firstUs_);
  // Number n of arrivals within the window, found by bisection.
  std::size_t n = 0;
  for (std::size_t beyond = std::min<std::uint64_t>(frames_, kRing); n < beyond;) {
    const std::size_t middle = n + (beyond - n) / 2;
    if (arrival(middle).monoUs >= monoUs - kWindowUs)
      n = middle + 1;
    else
      beyond = middle;
  }
  if (n >= 2) {
    const std::int64_t oldestUs = arrival(n - 1).monoUs;
    const double spanS = seconds(newestUs - oldestUs);
    const double periodS = spanS / static_cast<double>(n - 1);
    const double silentS = seconds(monoUs - newestUs);
    // The intervals between frames give the exact rate, until the next frame is overdue.
    const double overS = silentS > 2.0 * periodS ? spanS + silentS : spanS;
    if (overS > 0.0) reading.rateHz = static_cast<double>(n - 1) / overS;
  }
  std::size_t saturated = 0;
  std::size_t runs = 0;
  bool known = n > 0;
  for (std::size_t age = 0; age < n; ++age) {
    saturated += arrival(age).saturated ? 1 : 0;
    runs += arrival(age).runs;
    known = known && arrival(age).runs > 0;
  }
  if (known) reading.lineRateHz = dsaLineRateHz(static_cast<double>(runs) / static_cast<double>(n));
  if (n > 0) reading.saturatedFraction = static_cast<double>(saturated) / static_cast<double>(n);
  if (options_.expectedRateHz)
    reading.expectedRateHz = *options_.expectedRateHz;
  else if (expectedHz_)
    reading.expectedRateHz = *expectedHz_;
  else if (seconds(newestUs - firstUs_) >= kExpectationS)
    reading.expectedRateHz = reading.meanRateHz;
  if (lowSinceUs_) reading.lowRateS = std::max(0.0, seconds(monoUs - *lowSinceUs_));
  return reading;
}

std::string diskTimeText(double hours) {
  constexpr double kDayH = 24.0, kYearH = 8766.0, kMinutesPerH = 60.0;
  if (hours > kYearH) return "over a year";
  if (hours > 2 * kDayH) return fixedText(hours / kDayH, 0) + " days";
  if (hours >= 1.0) return fixedText(hours, hours < 10.0 ? 1 : 0) + " h";
  const auto minutes = static_cast<std::uint64_t>(std::max(0.0, std::round(hours * kMinutesPerH)));
  return minutes == 0 ? "less than a minute" : counted(minutes, "minute");
}

std::string withoutPort(const PortStatus& port) {
  const std::string prefix = port.port + ": ";
  return port.message.starts_with(prefix) ? port.message.substr(prefix.size()) : port.message;
}

LinkHealth assessHealth(const LinkInputs& inputs, const HealthOptions& options) {
  LinkHealth health;
  health.frames = inputs.frames;
  health.device = inputs.device;
  health.queues = inputs.queues;
  health.recorder = inputs.recorder;
  health.series = inputs.series;
  health.clocks = inputs.clocks;
  health.lost = inputs.device.tactile.lost;
  health.badChecksums = inputs.device.tactile.badChecksums;
  if (inputs.device.motion) health.badChecksums += inputs.device.motion->badChecksums;
  health.bytesPerS = bytesPerSecond(inputs.recorder, options);
  health.freeBytes = inputs.recorder.freeBytes;
  health.diskHours = hoursOf(health.freeBytes, health.bytesPerS);
  const bool silent = noData(inputs, options);
  if (silent) health.alarms.push_back({AlarmKind::kNoData, noDataText(inputs)});
  if (!silent && inputs.frames.lowRateS > options.lowRateS)
    health.alarms.push_back({AlarmKind::kLowRate, lowRateText(inputs.frames, options)});
  addRecorderAlarms(inputs.recorder, options, health.alarms);
  if (health.diskHours && *health.diskHours < options.lowDiskHours)
    health.alarms.push_back({AlarmKind::kLowDisk,
                             "the disk is full in " + diskTimeText(*health.diskHours) +
                                 ": free some space, or record elsewhere"});
  for (const SeriesStatus& series : inputs.series)
    if (inputs.started && series.port.state != PortState::kStreaming)
      health.alarms.push_back(
          {AlarmKind::kNoRows, "series " + series.name + ": " + series.port.message});
  if (const auto hottest = hottestOf(inputs); hottest && *hottest > options.maxTemperatureDegC)
    health.alarms.push_back({AlarmKind::kTooHot,
                             "the hand is " + fixedText(*hottest, 0) +
                                 " °C hot: relax it and let it cool down below " +
                                 fixedText(options.maxTemperatureDegC, 0)});
  return health;
}

PreflightCheck checkPreflight(const LinkInputs& inputs,
                              const FolderState& folder,
                              const HealthOptions& options) {
  const auto hours = hoursOf(folder.freeBytes, bytesPerSecond(inputs.recorder, options));
  const auto red = [&](std::string text) {
    return PreflightCheck{false, false, "not ready: " + std::move(text), folder.freeBytes, hours};
  };
  if (!inputs.started) return red("no hand is connected");
  for (const std::string& fault :
       {portFault(inputs.device.tactile, "the tactile port"),
        inputs.device.motion ? portFault(*inputs.device.motion, "the motion port") : std::string()})
    if (!fault.empty()) return red(fault);
  if (!inputs.frames.ageMs || noData(inputs, options)) return red(noDataText(inputs));
  const LinkMonitor::Reading& frames = inputs.frames;
  if (frames.expectedRateHz > 0.0 &&
      frames.rateHz < options.lowRateFraction * frames.expectedRateHz)
    return red(lowRateText(frames, options));
  const std::string where = folder.path.string();
  if (!folder.writable)
    return red(where + " can't be written: choose another folder, or change its permissions");
  if (hours && *hours < options.lowDiskHours)
    return red(where + " has space for " + diskTimeText(*hours) +
               ": choose another folder, or free some space");
  std::string text = "ready: " + fixedText(frames.rateHz, 1) + " frames/s";
  if (const auto hottest = hottestOf(inputs)) {
    if (*hottest > options.maxTemperatureDegC)
      return red("the hand is " + fixedText(*hottest, 0) + " °C hot: let it cool down");
    text += ", up to " + fixedText(*hottest, 0) + " °C";
  } else if (inputs.device.motion) {
    return red("no temperature has been received yet");
  }
  if (hours) text += ", disk for " + diskTimeText(*hours);
  const std::uint64_t outOfRange = inputs.device.tactile.outOfRange;
  if (outOfRange > 0)
    text += "; " + counted(outOfRange, "frame") + " with values outside the hand's range";
  return {true, outOfRange > 0, text, folder.freeBytes, hours};
}

}  // namespace palpate
