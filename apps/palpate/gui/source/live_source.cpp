#include "gui/source/live_source.h"

#include <functional>

#include <palpate/calibration/force_series.h>
#include <palpate/capture/replay.h>
#include <palpate/core/error.h>
#include <palpate/device/live_hand.h>
#include <palpate/emulator/physical_hand.h>
#include <palpate/emulator/scene.h>
#include <palpate/imports/label_places.h>
#include <palpate/live/signals_stage.h>
#include <palpate/model/hand_file.h>
#include <palpate/recording/recording.h>

#include "gui/source/recording_opener.h"

namespace palpate::gui {
namespace {

std::unique_ptr<EmulatedHand> emulatedHand(LiveSource& source,
                                           const std::filesystem::path& dataFolder) {
  Scene scene = loadScene(source.connection.scene.toStdString(), dataFolder / "scenes");
  if (!source.connection.sceneScriptRuns) scene.script.clear();
  PhysicalHandOptions options;
  options.repeatsScript = true;
  auto hand = std::make_unique<PhysicalHand>(scene, options);
  const auto observe = [&source, model = hand.get()](const EmulatedFrame&) {
    source.objects = std::make_shared<const std::vector<SceneObject>>(model->objects());
  };
  return std::make_unique<EmulatedHand>(std::move(hand), EmulatedHandOptions{}, observe);
}

std::unique_ptr<Device> streamOf(const StreamConnection& stream,
                                 const std::filesystem::path& dataFolder) {
  StreamDeviceOptions options;
  options.source = stream.source.toStdString();
  options.hand = findHand(stream.hand.toStdString(), handFolders(dataFolder));
  options.placesOfLabels = std::bind_front(placesOfLabels, options.hand);
  options.format = stream.format;
  options.time = stream.time;
  options.baud = stream.baud;
  return std::make_unique<StreamDevice>(std::move(options));
}

std::unique_ptr<Device> deviceOf(LiveSource& source,
                                 const std::filesystem::path& dataFolder,
                                 const Progress& progress) {
  const Connection& connection = source.connection;
  LiveHandOptions ports;
  switch (connection.kind) {
    case Connection::Kind::kReplay: {
      const std::filesystem::path path = connection.recording.toStdString();
      Recording recording = readRecording(path, {}, progress);
      recording.requireEvents();
      if (recording.profile.numFrames() == 0)
        throw FileError(path, "has no frames: nothing to replay");
      source.replayedMeta = std::move(recording.meta);
      return std::make_unique<Replay>(
          std::move(recording.profile), ReplayOptions{}, std::move(recording.events));
    }
    case Connection::Kind::kStream:
      return streamOf(connection.stream, dataFolder);
    case Connection::Kind::kEmulated:
      source.emulated = emulatedHand(source, dataFolder);
      ports.dsaPort = source.emulated->dsaPort();
      ports.sdhPort = source.emulated->sdhPort();
      break;
    case Connection::Kind::kPorts:
      ports.dsaPort = connection.dsaPort.toStdString();
      ports.sdhPort = connection.sdhPort.toStdString();
      break;
  }
  return std::make_unique<LiveHand>(std::move(ports));
}

// Returns a function that supplies the settings of the matrices: those of the controller, or those
// of the recording that is replayed.
PressureStage::AskSettings settingsOf(LiveSource& source) {
  if (source.connection.kind == Connection::Kind::kReplay) {
    const auto found = source.replayedMeta.find("settings");
    return [reportedSettings = found == source.replayedMeta.end() ? std::string() : found->second] {
      return reportedSettings.empty() ? std::vector<SensorSettings>()
                                      : reportedSettingsFrom(Json::parse(reportedSettings));
    };
  }
  return [&session = *source.session] {
    std::vector<SensorSettings> settings;
    for (const MatrixSettings& matrix : session.device().info().matrices)
      settings.push_back({matrix.sensitivity, static_cast<double>(matrix.thresholdCounts), false});
    return settings;
  };
}

}  // namespace

LiveSource::~LiveSource() {
  control.reset();
  if (session) session->stop();
  chain.reset();
  session.reset();
  emulated.reset();
}

bool LiveSource::finished() const {
  const auto* replay = dynamic_cast<const Replay*>(&session->device());
  return replay && replay->finished();
}

const StreamDevice* LiveSource::streamDevice() const {
  return session ? dynamic_cast<const StreamDevice*>(&session->device()) : nullptr;
}

std::unique_ptr<LiveSource> openSource(const Connection& connection,
                                       const std::filesystem::path& dataFolder,
                                       const Progress& progress) {
  if (const QString problem = problemOf(connection); !problem.isEmpty())
    throw Error(problem.toStdString());
  auto source = std::make_unique<LiveSource>();
  source->connection = connection;
  source->session = std::make_unique<CaptureSession>(deviceOf(*source, dataFolder, progress));
  source->isEmulated = source->emulated || source->replayedMeta.contains("emulated");
  source->history = std::make_unique<SignalHistory>();
  std::vector<std::unique_ptr<Stage>> stages;
  auto filters = std::make_unique<FilterStage>();
  source->filters = filters.get();
  stages.push_back(std::move(filters));
  stages.push_back(std::make_unique<SignalsStage>());
  auto pressure =
      std::make_unique<PressureStage>(source->session->device().hand(), settingsOf(*source));
  source->pressure = pressure.get();
  stages.push_back(std::move(pressure));
  auto slip = std::make_unique<SlipStage>(source->session->device().hand());
  source->slip = slip.get();
  if (source->emulated)
    slip->opensByItself = [hand = source->emulated.get()] {
      return hand->counts().ownMotion == "opening";
    };
  stages.push_back(std::move(slip));
  ChainOptions options;
  source->stream =
      std::make_unique<LiveStream>(source->session->device().hand(),
                                   [session = source->session.get()] { return session->health(); });
  options.furtherSeries = [session = source->session.get()] { return session->furtherSeries(); };
  options.onResults = [history = source->history.get(),
                       stream = source->stream.get()](const LiveResults& results) {
    history->add(results);
    stream->send(results);
  };
  options.onFurther = [history = source->history.get()](const FurtherSample& sample) {
    history->add(sample);
  };
  options.onEvent = [session = source->session.get(),
                     stream = source->stream.get()](const Event& event) {
    session->note(event);
    stream->send(event);
  };
  source->chain = std::make_unique<ProcessingChain>(std::move(stages), std::move(options));
  source->chain->connect(*source->session);
  source->chain->start();
  if (connection.kind == Connection::Kind::kPorts ||
      connection.kind == Connection::Kind::kEmulated) {
    source->control = std::make_unique<GraspControl>(*source->session);
    source->control->run();
  }
  source->session->start();
  return source;
}

}  // namespace palpate::gui
