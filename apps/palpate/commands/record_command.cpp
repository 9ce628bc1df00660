// The command `palpate record (--dsa PORT [--sdh PORT] | --stream SOURCE --hand NAME) -o
// OUT.palpate` records a hand without a window.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <unistd.h>

#include "palpate/capture/capture_session.h"
#include "palpate/capture/recording_limits.h"
#include "palpate/capture/recording_name.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/live_hand.h"
#include "palpate/interop/remote_fields.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/live_streams.h"
#include "commands/remote_recording.h"
#include "commands/series_options.h"
#include "commands/stream_options.h"

namespace palpate::commands {
namespace {
namespace fs = std::filesystem;

// Shows the state of the recording on one line of the terminal.
class StatusLine {
 public:
  explicit StatusLine(bool quiet) : enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}
  ~StatusLine() { wipe(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const LinkHealth& health, const std::vector<Event>& events) {
    if (!enabled_) return;
    for (const Event& event : events) {
      wipe();
      std::fprintf(
          stderr, "%s: %s\n", escapedLine(event.kind).c_str(), escapedLine(event.text).c_str());
    }
    const RecorderStatus& recorder = health.recorder;
    std::string line =
        recorder.state == RecorderStatus::State::kArmed ? "waiting for contact"
        : recorder.state == RecorderStatus::State::kWaiting
            ? "waiting for the first frame"
            : fixedText(recorder.recordedS, 1) + " s, " + counted(recorder.frames, "frame") + ", " +
                  fixedText(health.frames.rateHz, 1) + "/s, " +
                  fixedText(static_cast<double>(recorder.bytesOnDisk) / 1e6, 1) + " MB";
    if (!health.alarms.empty()) line += " | " + escapedLine(health.alarms.front().text);
    std::fprintf(stderr, "\r\033[K%s", std::string(beginningOf(line, 118)).c_str());
    std::fflush(stderr);
    shown_ = true;
  }

 private:
  void wipe() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
  }
  bool enabled_;
  bool shown_ = false;
};

fs::path outputPath(const CommandLine& given) {
  const fs::path out(given.text("output").value());
  if (out.extension() != ".palpate")
    throw UsageError("a recording is written as .palpate, not '" + out.string() +
                     "'; 'palpate convert' makes .dsa, .csv and .npz of it");
  if (out.string().find('{') == std::string::npos) return out;
  const RecordingNameFields fields{systemClock().wallUs(),
                                   given.text("operator").value_or(""),
                                   given.text("object").value_or("")};
  try {
    return nextRecordingPath(
        out.has_parent_path() ? out.parent_path() : fs::path("."), out.filename().string(), fields);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

// What is bound to options of the command line.
struct RecordChoices {
  RecordingOptions recording = {};
  RecordingLimits limits = {};
  CaptureOptions capture = {};
  double firstFrameS = 15.0;
};

RecordingOptions recordingOptions(const CommandLine& given, const RecordChoices& choices) {
  RecordingOptions options = choices.recording;
  if (!given.has("remote")) options.path = outputPath(given);
  options.preTriggerS = 0.0;
  choices.limits.applyTo(options);
  for (const char* key : {"operator", "object", "run", "notes"})
    if (const auto text = given.text(key)) options.meta[key] = *text;
  if (given.has("remote") && (options.startOnContact || options.stopWithoutContactS))
    throw UsageError(
        "--start-on-contact and --stop-without-contact can't be used with --remote: other programs "
        "start and stop");
  // The moment of contact itself is not the first that counts.
  if (options.startOnContact) options.preTriggerS = RecordingOptions().preTriggerS;
  if (given.has("mcap")) options.mcap.emplace();
  return options;
}

// Waits for frames of this number of seconds and takes them as the sensor at rest. Throws Error
// when it is interrupted, when no frame arrives in time, and when the hand has no readings.
void takeBaseline(CaptureSession& session,
                  Interruption& interruption,
                  double seconds,
                  double firstFrameS,
                  bool quiet) {
  constexpr int kLookMs = 20;
  session.start();
  std::optional<std::int64_t> firstUs;
  const std::int64_t beginUs = systemClock().monotonicUs();
  while (true) {
    if (interruption.waitForSignal(kLookMs))
      throw Error("interrupted before the baseline was taken: nothing was recorded");
    if (const SharedFrame frame = session.takeFrame(); frame && !firstUs) firstUs = frame->hostUs;
    if (firstUs && static_cast<double>(session.nowUs() - *firstUs) >= seconds * kUsPerS) break;
    if (!firstUs &&
        static_cast<double>(systemClock().monotonicUs() - beginUs) > firstFrameS * kUsPerS)
      throw Error("no frame arrived for the baseline");
  }
  const std::string taken = session.takeBaseline();
  if (!quiet) std::fprintf(stderr, "baseline of %s\n", taken.c_str());
}

// Waits until the recording stops by itself, a signal arrives, or no first frame arrives in time.
void recordUntilDone(CaptureSession& session,
                     Interruption& interruption,
                     double firstFrameS,
                     bool quiet,
                     StreamNotice& notice) {
  SeriesNotice seriesNotice(session, quiet);
  constexpr int kLookMs = 50;
  constexpr int kShowEvery = 10;
  session.start();
  StatusLine status(quiet);
  const StreamDevice* const stream = streamOf(session);
  for (int look = 0; session.recording(); ++look) {
    if (interruption.waitForSignal(kLookMs)) return;
    notice.show();
    seriesNotice.show();
    if (stream != nullptr && stream->finished()) return;
    const RecorderStatus recorder = session.recorderStatus();
    if (recorder.state != RecorderStatus::State::kRecording && recorder.elapsedS >= firstFrameS &&
        !session.health().frames.ageMs)
      return;
    if (look % kShowEvery == 0) status.show(session.health(), session.takeEvents());
  }
}

// Why no frame arrived, and what the user can do.
std::string nothingText(const DeviceStatus& device,
                        const std::string& port,
                        const StreamDevice* stream) {
  const bool isStream = stream != nullptr;
  if (isStream && !stream->lastFault().empty())
    return port + ": no frame arrived: " + stream->lastFault();
  const PortStatus& tactile = device.tactile;
  if (!tactile.message.empty())
    return port + ": no frame arrived: " + (isStream ? withoutPort(tactile) : tactile.message);
  if (isStream) return port + ": no frame arrived; is the sender running?";
  return port +
         ": no frame arrived; is the hand switched on, and this its tactile port? ('palpate ports' "
         "shows it)";
}

std::uint64_t badChecksumsOf(const DeviceStatus& device) {
  return device.tactile.badChecksums + (device.motion ? device.motion->badChecksums : 0);
}

Json recordRateJson(double hz) { return hz > 0.0 ? Json(hz) : Json(); }

Json textOrNull(const std::string& text) { return text.empty() ? Json() : Json(text); }

std::string recordJsonText(const RecordingReport& report,
                           const DeviceStatus& device,
                           const StreamDevice* stream) {
  Json files = jsonList(report.paths, [](const fs::path& path) { return path.string(); });
  return Json::object()
      .set("files", files)
      .set("mcap_files",
           jsonList(report.mcapPaths, [](const fs::path& path) { return path.string(); }))
      .set("frames", report.frames)
      .set("angles", report.angles)
      .set("temperatures", report.temperatures)
      .set("bad_checksums", static_cast<std::int64_t>(badChecksumsOf(device)))
      .set("suspect", report.counter("suspect"))
      .set("last_refused", textOrNull(stream ? stream->lastFault() : std::string()))
      .set("out_of_range", report.counter("out_of_range"))
      .set("last_out_of_range", textOrNull(stream ? stream->lastOutOfRange() : std::string()))
      .set("lost", report.counter("lost") + report.lost)
      .set("lost_estimated", report.counter("lost_estimated"))
      .set("recorder_lost", report.lost)
      .set("gaps", report.gaps)
      .set("series", seriesJson(report))
      .set("events", report.events)
      .set("duration_s", report.durationS)
      .set("rate_hz", recordRateJson(report.rateHz))
      .set("mean_rate_hz", recordRateJson(report.meanRateHz))
      .set("bytes", report.bytes)
      .set("complete", report.complete)
      .set("message", report.message.empty() ? Json() : Json(report.message))
      .text();
}

std::string lineText(const RecordingReport& report, const DeviceStatus& device) {
  std::string line = escapedLine(report.paths.front().string());
  if (report.paths.size() > 1) line += " and " + std::to_string(report.paths.size() - 1) + " more";
  return line + ": " + counted(static_cast<std::uint64_t>(report.frames), "frame") + " in " +
         fixedText(report.durationS, 1) + " s (" + fixedText(report.meanRateHz, 1) + "/s), " +
         counted(static_cast<std::uint64_t>(report.angles), "angle sample") + ", " +
         counted(static_cast<std::uint64_t>(report.temperatures), "temperature sample") + "; " +
         std::to_string(report.counter("lost") + report.lost) + " lost, " +
         counted(badChecksumsOf(device), "bad checksum") + ", " +
         counted(static_cast<std::uint64_t>(report.gaps), "gap") + seriesText(report);
}

std::unique_ptr<Device> recordedDevice(const CommandLine& given) {
  if (given.has("stream")) return streamSourceOf(given);
  LiveHandOptions hand;
  hand.dsaPort = given.text("dsa").value();
  hand.sdhPort = given.text("sdh").value_or("");
  return std::make_unique<LiveHand>(std::move(hand));
}

CommandSpec recordSpec(RecordChoices& choices) {
  using Limits = RecordingLimits;
  RecordingOptions& recording = choices.recording;
  CommandSpec spec{
      .synopsis =
          "palpate record (--dsa PORT [--sdh PORT] | --stream SOURCE --hand NAME|FOLDER) -o "
          "OUT.palpate [--duration S] [--remote] ..",
      .purpose =
          "Records a hand until Ctrl-C, or for S seconds from the first frame. Received data is on "
          "disk within 150 ms; OUT is written from the first frame on and is never replaced. PORT: "
          "a serial device, a /dev/serial/by-id name, a pty, or tcp:HOST:PORT. OUT may hold "
          "{date}, {time}, {operator}, {object}, {run} (next free number). With --remote it "
          "records only when another program asks for it (palpate remote start); OUT is then a "
          "folder, or a folder with a template of file names. Exit code 3: the recorder lost "
          "something, frames were refused or hold values outside the hand's range, no frame came "
          "at "
          "its end, or a stream or a series lost some.",
      .options = {{"dsa", "PORT", "tactile controller"},
                  {"sdh", "PORT", "motion controller: angles and temperatures"},
                  {"output,o", "OUT.palpate", "record to this file"},
                  bound("duration",
                        "S",
                        "stop at this time after the first frame",
                        choices.limits.stopAfterS,
                        Limits::kStopAfterS),
                  bound("wait",
                        "S",
                        "give up if no frame arrives",
                        choices.firstFrameS,
                        StartLimits::kFirstFrameS),
                  {"operator", "NAME", "who records"},
                  {"object", "NAME", "what is grasped"},
                  {"run", "TEXT", "number or name of the run"},
                  {"notes", "TEXT", "any other notes"},
                  bound("baseline",
                        "S",
                        "take the readings of the first S seconds as those at rest, before the "
                        "recording begins",
                        choices.capture.baselineS,
                        CaptureOptions::kBaselineS,
                        ""),
                  bound("split-minutes",
                        "M",
                        "begin a new file after this time: NAME_002.palpate, ..",
                        choices.limits.splitMinutes,
                        Limits::kSplitMinutes),
                  bound("split-mb",
                        "N",
                        "begin a new file at about this size",
                        choices.limits.splitMb,
                        Limits::kSplitMb),
                  bound("start-on-contact",
                        "begin with the first contact, and include the " +
                            numberText(recording.preTriggerS) + " s before it",
                        recording.startOnContact),
                  bound("stop-without-contact",
                        "S",
                        "end after this time without contact",
                        recording.stopWithoutContactS,
                        RecordingOptions::kStopWithoutContactS),
                  bound("contact-threshold",
                        "N",
                        "treat a taxel above N counts as contact",
                        recording.contact.threshold,
                        ContactTriggerOptions::kThreshold),
                  {"mcap", "", "also write OUT.mcap: for Foxglove and ROS 2"},
                  remoteOption(),
                  socketOption(),
                  {"to",
                   "STREAM",
                   "signals, tactile or foxglove, live to other programs: 'stream --help'"},
                  {"calibration", "C.json", "with --to signals: also send pressures and forces"},
                  {"json", "", "report as JSON"}},
      .example = "palpate record --dsa /dev/ttyUSB0 --sdh /dev/ttyUSB1 -o grasp.palpate",
      .maxArguments = 0};
  const std::vector<OptionSpec> stream = streamSourceOptions();
  const std::vector<OptionSpec> series = seriesOptions();
  spec.options.insert(spec.options.begin() + 2, series.begin(), series.end());
  spec.options.insert(spec.options.begin() + 2, stream.begin(), stream.end());
  const std::vector<OptionSpec> foxglove = foxgloveOptions();
  spec.options.insert(spec.options.end(), foxglove.begin(), foxglove.end());
  return spec;
}

}  // namespace

int recordCommand(const Arguments& words) {
  RecordChoices choices;
  const CommandLine given(recordSpec(choices), words);
  if (given.helpShown()) return kDone;
  checkStreamSource(given);
  const bool isStream = given.has("stream");
  const auto port = given.text(isStream ? "stream" : "dsa");
  if (!port || port->empty())
    throw UsageError("record needs --dsa PORT, or --stream SOURCE and --hand NAME|FOLDER");
  if (!given.has("output")) throw UsageError("record needs -o OUT.palpate");
  if (given.has("socket") && !given.has("remote")) throw UsageError("--socket needs --remote");
  RecordingOptions options = recordingOptions(given, choices);
  const StreamTargets targets = streamTargetsOf(given, "to");
  const auto calibration = streamCalibrationOf(given);
  Interruption interruption;  // must exist until the file is finished
  CaptureOptions captureOptions = streamCaptureOptions(given);
  captureOptions.baselineS = choices.capture.baselineS;
  if (given.has("baseline") && given.has("remote"))
    throw UsageError("--baseline can't be used with --remote: other programs start and stop");
  CaptureSession session(recordedDevice(given), captureOptions);
  addSeriesSources(given, session);
  std::unique_ptr<LiveStreams> streams;
  if (!targets.empty()) streams = std::make_unique<LiveStreams>(session, targets, calibration);
  if (streams && !given.quiet())
    for (const std::string& place : streams->places())
      std::fprintf(stderr, "%s\n", escapedLine(place).c_str());
  if (given.has("remote")) return recordRemotely(given, session, interruption, std::move(options));
  if (given.has("baseline"))
    takeBaseline(
        session, interruption, captureOptions.baselineS, choices.firstFrameS, given.quiet());
  session.startRecording(std::move(options));
  StreamNotice notice(streamOf(session), given.quiet());
  recordUntilDone(session, interruption, choices.firstFrameS, given.quiet(), notice);
  const LinkHealth health = session.health();
  session.stop();
  notice.show();
  const RecordingReport report = session.stopRecording();
  if (report.paths.empty())
    throw Error(health.frames.ageMs ? "nothing was recorded: " + report.message
                                    : nothingText(health.device, *port, streamOf(session)));
  const DeviceStatus device = session.device().status();
  const std::string text = given.has("json") ? recordJsonText(report, device, streamOf(session))
                                             : lineText(report, device);
  if (given.has("json") || !given.quiet()) std::printf("%s\n", text.c_str());
  if (!report.mcapFailure.empty())
    sayLine("the MCAP file stopped before the end: " + report.mcapFailure);
  const std::string leftOut = leftOutText(report, streamOf(session));
  if (!leftOut.empty()) sayLine(leftOut);
  const std::string seriesLeftOut = seriesLeftOutText(report, session);
  if (!seriesLeftOut.empty()) sayLine(seriesLeftOut);
  if (!report.complete) sayLine(report.message);
  return report.complete && report.mcapFailure.empty() && leftOut.empty() && seriesLeftOut.empty()
             ? kDone
             : kPartlyDone;
}

}  // namespace palpate::commands
