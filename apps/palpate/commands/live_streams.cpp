#include "commands/live_streams.h"

#include <algorithm>
#include <utility>

#include "palpate/calibration/calibration.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/network_place.h"
#include "palpate/core/number_text.h"
#include "palpate/live/pressure_stage.h"
#include "palpate/live/signals_stage.h"
#include "palpate/live/slip_stage.h"

namespace palpate::commands {
namespace {

const char* nameOf(StreamKind kind) { return kind == StreamKind::kSignals ? "signals" : "tactile"; }

std::vector<SensorSettings> settingsOf(const CaptureSession& session) {
  std::vector<SensorSettings> settings;
  for (const MatrixSettings& matrix : session.device().info().matrices)
    settings.push_back({matrix.sensitivity, static_cast<double>(matrix.thresholdCounts), false});
  return settings;
}

std::string countsText(const DatagramStats& stats) {
  if (stats.nobodyListened())
    return "nobody listened: none of the " + counted(stats.sent + stats.dropped, "datagram") +
           " was received";
  return std::to_string(stats.sent) + " sent, " + std::to_string(stats.dropped) + " dropped";
}

ChainOptions sendingTo(const CaptureSession& session, LiveStream& stream) {
  ChainOptions options;
  options.furtherSeries = [&session] { return session.furtherSeries(); };
  options.onResults = [&](const LiveResults& results) { stream.send(results); };
  options.onEvent = [&](const Event& event) { stream.send(event); };
  return options;
}

[[noreturn]] void refuseTarget(const std::string& text, const std::string& option) {
  throw UsageError("--" + option +
                   " must be signals, tactile or foxglove, with a port of this machine where it is "
                   "another one (signals:9999), not '" +
                   text + "'");
}

// The port behind the name; nothing when there is none. Port 0 is for the WebSocket only: a free
// one.
std::optional<std::uint16_t> targetPort(const std::string& text,
                                        const std::string& name,
                                        const std::string& option,
                                        std::int64_t least) {
  if (name.size() == text.size()) return std::nullopt;
  const auto port = parseInteger(text.substr(name.size() + 1));
  if (!port || *port < least || *port > 65'535) refuseTarget(text, option);
  return static_cast<std::uint16_t>(*port);
}

void addFoxglove(const CommandLine& given, StreamTargets& targets) {
  for (const char* option : {"listen", "origin", "image"})
    if (given.has(option) && !targets.foxglove)
      throw UsageError("--" + std::string(option) + " needs --to foxglove");
  if (!targets.foxglove) return;
  FoxgloveServerOptions& server = targets.foxglove->server;
  server.address = given.text("listen").value_or(server.address);
  server.origins = given.texts("origin");
  FoxgloveImage& image = targets.foxglove->image;
  image = given.chosen("image", kFoxgloveImageWords).value_or(image);
}

}  // namespace

std::vector<OptionSpec> foxgloveOptions() {
  return {
      {"listen", "ADDRESS", "address of the WebSocket, default 127.0.0.1: only this machine"},
      {"origin", "URL", "allow this web page to connect, in addition to https://app.foxglove.dev"},
      worded("image", "FORM", "of the WebSocket's heat maps", kFoxgloveImageWords, "values")};
}

StreamTargets streamTargetsOf(const CommandLine& given, const std::string& option) {
  StreamTargets targets;
  const auto refuseTwice = [&](const std::string& name) {
    throw UsageError("--" + option + " " + name + " is given twice");
  };
  for (const std::string& text : given.texts(option)) {
    const std::string name = text.substr(0, text.find(':'));
    if (name == "foxglove") {
      if (targets.foxglove) refuseTwice(name);
      targets.foxglove.emplace();
      targets.foxglove->server.port =
          targetPort(text, name, option, 0).value_or(kUsualFoxglovePort);
      continue;
    }
    const auto kind = std::find_if(kAllStreamKinds.begin(),
                                   kAllStreamKinds.end(),
                                   [&](StreamKind each) { return name == nameOf(each); });
    if (kind == kAllStreamKinds.end()) refuseTarget(text, option);
    for (const StreamTarget& other : targets.datagrams)
      if (other.kind == *kind) refuseTwice(name);
    targets.datagrams.push_back(
        {*kind, targetPort(text, name, option, 1).value_or(usualPort(*kind))});
  }
  addFoxglove(given, targets);
  return targets;
}

std::optional<Calibration> streamCalibrationOf(const CommandLine& given) {
  const auto path = given.text("calibration");
  if (!path) return std::nullopt;
  return loadCalibration(*path);
}

std::vector<std::unique_ptr<Stage>> streamedStages(CaptureSession* session,
                                                   const HandDescription& hand,
                                                   const std::optional<Calibration>& calibration) {
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<SignalsStage>());
  PressureStage::AskSettings ask = [] { return std::vector<SensorSettings>(); };
  if (session) ask = [session] { return settingsOf(*session); };
  auto pressure = std::make_unique<PressureStage>(hand, ask);
  pressure->setCalibration(calibration);
  stages.push_back(std::move(pressure));
  stages.push_back(std::make_unique<SlipStage>(hand));
  return stages;
}

LiveStreams::LiveStreams(CaptureSession& session,
                         const StreamTargets& targets,
                         const std::optional<Calibration>& calibration)
    : targets_(targets),
      stream_(session.device().hand(), [&session] { return session.health(); }),
      chain_(streamedStages(&session, session.device().hand(), calibration),
             sendingTo(session, stream_)) {
  for (const StreamTarget& target : targets_.datagrams) stream_.switchOn(target.kind, target.port);
  if (targets_.foxglove) {
    FoxgloveOptions options = *targets_.foxglove;
    options.server.onRefusedOrigin = [](const std::string& why) { sayLine("foxglove: " + why); };
    const NetworkPlace place{options.server.address, options.server.port};
    stream_.switchOn(std::move(options));
    // Not before: an address that is refused isn't open to anyone.
    if (place.isOpenToOthers())
      sayLine(place.text() + ": any machine that reaches this address can read the hand");
  }
  chain_.connect(session);
  chain_.start();
}

std::vector<std::string> LiveStreams::places() const {
  if (!targets_.foxglove) return {};
  return {"foxglove=" + stream_.foxgloveUrl()};
}

std::vector<std::string> LiveStreams::lines() const {
  std::vector<std::string> lines;
  for (const StreamTarget& target : targets_.datagrams)
    if (const auto stats = stream_.stats(target.kind))
      lines.push_back(std::string(nameOf(target.kind)) +
                      " to 127.0.0.1:" + std::to_string(target.port) + ": " + countsText(*stats));
  if (const auto stats = stream_.foxgloveStats())
    lines.push_back(
        "foxglove at " + stream_.foxgloveUrl() + ": " + counted(stats->accepted, "client") + ", " +
        std::to_string(stats->sent) + " sent, " + std::to_string(stats->dropped) + " dropped" +
        (stats->refused == 0 ? std::string()
                             : ", " + std::to_string(stats->refused) +
                                   " refused (the last: " + escapedLine(stats->lastRefusal) + ")"));
  return lines;
}

}  // namespace palpate::commands
