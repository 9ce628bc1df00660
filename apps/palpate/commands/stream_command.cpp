// The command `palpate stream` sends the signals of a hand to other programs while it runs: as
// datagrams to this machine, over a WebSocket, or as lines on standard output.
#include <atomic>
#include <cstdio>
#include <memory>
#include <string>

#include <unistd.h>

#include "palpate/capture/recording_limits.h"
#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/device/live_hand.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/live_streams.h"
#include "commands/recording_list.h"
#include "commands/stream_options.h"

namespace palpate::commands {
namespace {

constexpr int kStreamLookMs = 50;

// Writes lines to standard output. A failed write ends the command, but does not throw in the
// processing thread.
class Lines {
 public:
  Lines(StreamKind kind, bool live) : kind_(kind), live_(live) {}

  void write(const LiveResults& results, const LinkHealth* link) {
    if (failed_) return;
    std::string text;
    appendStreamed(text, kind_, results, sequence_++, link);
    try {
      output_.write(text + "\n");
      if (live_) output_.finish();
    } catch (const OutputError& error) {
      failure_ = error.what();
      failed_ = true;
    }
  }
  bool failed() const { return failed_; }
  // Throws OutputError.
  void finish() {
    if (failed_) throw OutputError(failure_);
    output_.finish();
  }

 private:
  const StreamKind kind_;
  const bool live_;
  StandardOutput output_;
  std::uint64_t sequence_ = 0;
  std::string failure_;
  std::atomic<bool> failed_ = false;
};

CommandSpec streamSpec() {
  CommandSpec spec{
      .synopsis =
          "palpate stream (--dsa PORT [--sdh PORT] | --stream SOURCE --hand NAME|FOLDER | FILE) "
          "[--to STREAM].. [--foxglove [PORT]] [--lines]",
      .purpose =
          "Sends what a hand measures live to other programs on this machine: a JSON object per "
          "frame, as UDP datagrams to 127.0.0.1 or as lines on standard output. STREAM: signals "
          "(default; for PlotJuggler, port 9870), tactile (all taxels as schunk_sdh/TactileSensor, "
          "port 9871) or foxglove (a WebSocket for Foxglove at 127.0.0.1:8765: heat maps, the hand "
          "in 3-D, joints, signals, events); another port is given as signals:9999. FILE: a "
          "recording, played at its recorded times (with --lines at once). Runs until Ctrl-C. Of a "
          "damaged recording it sends what can be read and reports the rest: exit code 3.",
      .options = {{"dsa", "PORT", "tactile controller"},
                  {"sdh", "PORT", "motion controller: angles and temperatures"},
                  {"to", "STREAM", "what to send, and to which port; may be repeated"},
                  {"foxglove", "[PORT]", "the same as --to foxglove[:PORT]; PORT 0: any free one"},
                  {"lines", "", "print lines on standard output instead of sending datagrams"},
                  {"calibration", "C.json", "also send pressures and forces"},
                  ranged("duration", "S", "stop after this time", RecordingLimits::kStopAfterS)},
      .example = "palpate stream --dsa /dev/ttyUSB0 --sdh /dev/ttyUSB1",
      .maxArguments = 1};
  const std::vector<OptionSpec> stream = streamSourceOptions();
  spec.options.insert(spec.options.begin() + 2, stream.begin(), stream.end());
  const std::vector<OptionSpec> foxglove = foxgloveOptions();
  spec.options.insert(spec.options.end(), foxglove.begin(), foxglove.end());
  return spec;
}

// Replaces --foxglove and --foxglove PORT by what they mean: options of CommandLine either have a
// value or have none.
Arguments withoutFoxgloveFlag(const Arguments& words) {
  Arguments result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    constexpr std::string_view kAssigned = "--foxglove=";
    if (words[i].starts_with(kAssigned)) {
      result.insert(result.end(), {"--to", "foxglove:" + words[i].substr(kAssigned.size())});
    } else if (words[i] == "--foxglove") {
      const bool hasPort = i + 1 < words.size() && parseInteger(words[i + 1]).has_value();
      result.insert(result.end(), {"--to", hasPort ? "foxglove:" + words[i + 1] : "foxglove"});
      if (hasPort) ++i;
    } else {
      result.push_back(words[i]);
    }
  }
  return result;
}

// The readable part of a recording; `damage` describes the rest.
Recording streamedRecording(const CommandLine& given, std::string& damage) {
  const std::string& file = given.words()[0];
  ProgressLine progress("reading " + file, given.quiet());
  Recording readable = readableRecording(file, {}, progress.callback());
  if (readable.profile.numFrames() == 0) throw Error(file + ": has no frames");
  if (!readable.damage.text.empty()) damage = file + ": " + readable.damage.text;
  return readable;
}

// Prints the damage of the recording. Returns the exit code of work that is otherwise done.
int endOf(const std::string& damage) {
  if (damage.empty()) return kDone;
  sayLine(damage);
  return kPartlyDone;
}

// Opens a recording that is replayed as a stream; samples are read when they are sent. If it cannot
// be opened, its readable part is used.
Profile playedRecording(const CommandLine& given, std::string& damage) {
  const std::string& file = given.words()[0];
  try {
    ProgressLine progress("reading " + file, given.quiet());
    Profile profile = openRecording(file, progress.callback());
    if (profile.numFrames() == 0) throw Error(file + ": has no frames");
    damage = lostLine(file, profile);
    return profile;
  } catch (const FormatError&) {
    return streamedRecording(given, damage).profile;
  }
}

// Describes what could not be read during the replay, or was lost of a received stream.
std::string sessionLosses(const CaptureSession& session, const CommandLine& given) {
  const DeviceStatus status = session.device().status();
  if (given.has("stream"))
    return leftOutText({.lost = static_cast<std::int64_t>(status.tactile.lost),
                        .refused = static_cast<std::int64_t>(status.tactile.suspect),
                        .outOfRange = static_cast<std::int64_t>(status.tactile.outOfRange)},
                       streamOf(session));
  const std::uint64_t lost = status.tactile.lost + (status.motion ? status.motion->lost : 0);
  if (given.words().empty() || lost == 0) return {};
  return given.words()[0] + ": " + std::to_string(lost) +
         " of the samples that were played can't be read: the recording is damaged";
}

std::unique_ptr<Device> streamDeviceOf(const CommandLine& given, std::string& damage) {
  if (!given.words().empty())
    return std::make_unique<Replay>(playedRecording(given, damage), ReplayOptions{});
  if (given.has("stream")) return streamSourceOf(given);
  LiveHandOptions hand;
  hand.dsaPort = given.text("dsa").value();
  hand.sdhPort = given.text("sdh").value_or("");
  return std::make_unique<LiveHand>(std::move(hand));
}

// Runs until the source ends, the duration is over, a signal arrives, or `over` returns true.
void runSession(const CommandLine& given,
                CaptureSession& session,
                Interruption& interruption,
                const std::function<bool()>& over) {
  const double durationS = given.number("duration", RecordingLimits::kStopAfterS).value_or(1e9);
  const std::int64_t beginUs = systemClock().monotonicUs();
  session.start();
  const auto* replay = dynamic_cast<const Replay*>(&session.device());
  const StreamDevice* const stream = streamOf(session);
  StreamNotice notice(stream, given.quiet());
  const auto ends = [&] {
    return (replay && replay->finished()) || (stream && stream->finished()) || over() ||
           static_cast<double>(systemClock().monotonicUs() - beginUs) >= durationS * 1e6;
  };
  while (!interruption.waitForSignal(kStreamLookMs) && !ends()) notice.show();
  notice.show();
}

void requireFrames(const CaptureSession& session, const CommandLine& given) {
  const LinkHealth health = session.health();
  if (health.frames.frames > 0) return;
  const std::string& why = health.device.tactile.message;
  if (const auto source = given.text("stream"))
    throw Error(*source + ": no frame arrived" +
                (why.empty() ? std::string("; is the sender running?")
                             : ": " + withoutPort(health.device.tactile)));
  throw Error(given.text("dsa").value_or("") + ": no frame arrived" +
              (why.empty() ? std::string("; is the hand switched on, and this its tactile port?")
                           : ": " + why));
}

int streamToPrograms(const CommandLine& given, StreamTargets targets) {
  if (targets.empty())
    targets.datagrams.push_back({StreamKind::kSignals, usualPort(StreamKind::kSignals)});
  const auto calibration = streamCalibrationOf(given);
  Interruption interruption;
  std::string damage;
  CaptureSession session(streamDeviceOf(given, damage));
  LiveStreams streams(session, targets, calibration);
  for (const std::string& place : streams.places()) std::printf("%s\n", escapedLine(place).c_str());
  std::fflush(stdout);
  runSession(given, session, interruption, [&] { return !streams.failure().empty(); });
  requireFrames(session, given);
  session.stop();
  if (const std::string failure = streams.failure(); !failure.empty()) throw Error(failure);
  if (!given.quiet())
    for (const std::string& line : streams.lines()) std::printf("%s\n", escapedLine(line).c_str());
  return endOf(damage.empty() ? sessionLosses(session, given) : damage);
}

// Prints the lines of the whole recording as fast as possible.
int streamLinesOf(const CommandLine& given, StreamKind kind) {
  std::string damage;
  const Recording recording = streamedRecording(given, damage);
  const Profile& profile = recording.profile;
  Lines lines(kind, false);
  ChainOptions options;
  options.onResults = [&lines](const LiveResults& results) { lines.write(results, nullptr); };
  const HandDescription hand =
      describeHand(profile.layout(),
                   profile.numAngles() > 0 ? profile.angles(0).values.size() : 0,
                   profile.numTemperatures() > 0 ? profile.temperatures(0).values.size() : 0);
  ProcessingChain chain(streamedStages(nullptr, hand, streamCalibrationOf(given)),
                        std::move(options));
  Interruption interruption;
  try {
    chain.runOver(profile, recording.events, [&](double) {
      return !interruption.waitForSignal(0) && !lines.failed();
    });
  } catch (const Cancelled&) {
    lines.finish();
    return kPartlyDone;
  }
  lines.finish();
  return endOf(damage);
}

int streamLines(const CommandLine& given, const StreamTargets& targets) {
  if (targets.foxglove)
    throw UsageError("--lines writes signals or tactile: the WebSocket has no lines");
  if (targets.size() > 1) throw UsageError("--lines writes one stream: give one --to");
  if (!targets.empty() && given.text("to")->find(':') != std::string::npos)
    throw UsageError("--lines writes to standard output: give no port");
  const StreamKind kind = targets.empty() ? StreamKind::kSignals : targets.datagrams.front().kind;
  if (!given.words().empty()) return streamLinesOf(given, kind);
  Interruption interruption;
  std::string damage;  // stays empty without a recording
  CaptureSession session(streamDeviceOf(given, damage));
  Lines lines(kind, true);
  ChainOptions options;
  options.furtherSeries = [&session] { return session.furtherSeries(); };
  options.onResults = [&](const LiveResults& results) {
    const LinkHealth health = session.health();
    lines.write(results, &health);
  };
  ProcessingChain chain(
      streamedStages(&session, session.device().hand(), streamCalibrationOf(given)),
      std::move(options));
  chain.connect(session);
  chain.start();
  runSession(
      given, session, interruption, [&] { return lines.failed() || !chain.failure().empty(); });
  if (!lines.failed()) requireFrames(session, given);
  session.stop();
  chain.stop();
  lines.finish();
  if (const std::string failure = chain.failure(); !failure.empty()) throw Error(failure);
  const ChainStats stats = chain.stats();
  if (stats.skipped == 0) return kDone;
  sayLine(std::to_string(stats.skipped) +
          " frames were skipped: the program that reads them is too slow");
  return kPartlyDone;
}

}  // namespace

int streamCommand(const Arguments& words) {
  const CommandLine given(streamSpec(), withoutFoxgloveFlag(words));
  if (given.helpShown()) return kDone;
  checkStreamSource(given);
  const bool isLive = given.has("dsa") || given.has("stream");
  if (given.words().empty() != isLive)
    throw UsageError(
        isLive ? "give --dsa PORT, --stream SOURCE or a recording, not two of them"
               : "stream needs --dsa PORT, --stream SOURCE and --hand NAME|FOLDER, or a recording");
  if (given.has("sdh") && !given.has("dsa")) throw UsageError("--sdh needs --dsa");
  const StreamTargets targets = streamTargetsOf(given, "to");
  return given.has("lines") ? streamLines(given, targets) : streamToPrograms(given, targets);
}

}  // namespace palpate::commands
