// Owns everything that belongs to one connection: the device with its capture session, live
// processing and control, and the emulated hand where that is the device. LiveController creates it
// by openSource().
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>
#include <palpate/core/progress.h>
#include <palpate/emulator/emulated_hand.h>
#include <palpate/emulator/scene.h>
#include <palpate/interop/live_stream.h>
#include <palpate/live/filter_stage.h>
#include <palpate/live/pressure_stage.h>
#include <palpate/live/processing_chain.h>
#include <palpate/live/signal_history.h>
#include <palpate/live/slip_stage.h>
#include <palpate/recording/recording_data.h>

#include "gui/source/connection.h"

namespace palpate::gui {

struct LiveSource {
  LiveSource() = default;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;
  // Stops a running motion first, then finishes a running recording. Takes up to a few seconds.
  ~LiveSource();

  // True for a replay that has reached its end: no more frames arrive, and that is no fault.
  bool finished() const;
  // The stream that is received; null for other connections.
  const StreamDevice* streamDevice() const;

  Connection connection;
  // The objects around an emulated hand as of its newest frame, set by its thread; null for other
  // hands.
  std::atomic<std::shared_ptr<const std::vector<SceneObject>>> objects;
  // Set only for an emulated hand.
  std::unique_ptr<EmulatedHand> emulated;
  // Of the recording that is replayed.
  RecordingMeta replayedMeta;
  // Whether the hand is emulated, or a recording of an emulated one is replayed.
  bool isEmulated = false;
  std::unique_ptr<CaptureSession> session;
  std::unique_ptr<SignalHistory> history;
  // Sends live results to other programs; off at first.
  std::unique_ptr<LiveStream> stream;
  std::unique_ptr<ProcessingChain> chain;
  // The first stage of `chain`.
  FilterStage* filters = nullptr;
  // A stage of `chain`.
  PressureStage* pressure = nullptr;
  // A stage of `chain`.
  SlipStage* slip = nullptr;
  // Null for a replay and for a stream, which can't be moved.
  std::unique_ptr<GraspControl> control;
};

// Opens a connection; nothing moves. A port that doesn't answer is retried from then on. To be
// called in a worker thread: reading a recording for a replay may take seconds. `dataFolder`
// contains the scenes. Throws Error, Cancelled, std::invalid_argument.
std::unique_ptr<LiveSource> openSource(const Connection& connection,
                                       const std::filesystem::path& dataFolder,
                                       const Progress& progress = {});

}  // namespace palpate::gui
