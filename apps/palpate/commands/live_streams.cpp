#include "commands/live_streams.h"

#include <algorithm>

#include "palpate/calibration/calibration.h"
#include "palpate/core/number_text.h"
#include "palpate/live/pressure_stage.h"
#include "palpate/live/signals_stage.h"
#include "palpate/live/slip_stage.h"

namespace palpate::commands {
namespace {

const char* nameOf(StreamKind kind) { return kind == StreamKind::kSignals ? "signals" : "tactile"; }

std::vector<SensorSettings> settingsOf(const CaptureSession& session) {
  std::vector<SensorSettings> settings;
  for (const MatrixSettings& matrix : session.device().facts().matrices)
    settings.push_back({matrix.sensitivity, static_cast<double>(matrix.thresholdCounts), false});
  return settings;
}

ChainOptions sendingTo(LiveStream& stream) {
  ChainOptions options;
  options.onResults = [&stream](const LiveResults& results) { stream.send(results); };
  return options;
}

}  // namespace

StreamTarget streamTargetOf(const std::string& text, const std::string& option) {
  const std::string name = text.substr(0, text.find(':'));
  for (const StreamKind kind : kAllStreamKinds) {
    if (name != nameOf(kind)) continue;
    if (name.size() == text.size()) return {kind, usualPort(kind)};
    const auto port = parseInteger(text.substr(name.size() + 1));
    if (!port || *port < 1 || *port > 65'535) break;
    return {kind, static_cast<std::uint16_t>(*port)};
  }
  throw UsageError("--" + option +
                   " must be signals or tactile, with a port of this machine where it is another "
                   "one (signals:9999), not '" +
                   text + "'");
}

std::vector<StreamTarget> streamTargetsOf(const CommandLine& given, const std::string& option) {
  std::vector<StreamTarget> targets;
  for (const std::string& text : given.texts(option)) {
    const StreamTarget target = streamTargetOf(text, option);
    if (std::any_of(targets.begin(), targets.end(), [&](const StreamTarget& other) {
          return other.kind == target.kind;
        }))
      throw UsageError("--" + option + " " + nameOf(target.kind) + " is given twice");
    targets.push_back(target);
  }
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
                         const std::vector<StreamTarget>& targets,
                         const std::optional<Calibration>& calibration)
    : targets_(targets),
      stream_([&session] { return session.health(); }),
      chain_(streamedStages(&session, session.device().hand(), calibration), sendingTo(stream_)) {
  for (const StreamTarget& target : targets_) stream_.switchOn(target.kind, target.port);
  chain_.connect(session);
  chain_.start();
}

std::vector<std::string> LiveStreams::lines() const {
  std::vector<std::string> lines;
  for (const StreamTarget& target : targets_)
    if (const auto stats = stream_.stats(target.kind))
      lines.push_back(
          std::string(nameOf(target.kind)) + " to 127.0.0.1:" + std::to_string(target.port) + ": " +
          std::to_string(stats->sent) + " sent, " + std::to_string(stats->dropped) + " dropped");
  return lines;
}

}  // namespace palpate::commands
