// What is connected: a device with its capture session, live processing and control, and the
// emulated hand where it is one.
#pragma once

#include <filesystem>
#include <memory>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>
#include <palpate/core/progress.h>
#include <palpate/emulator/emulated_hand.h>
#include <palpate/interop/live_stream.h>
#include <palpate/live/filter_stage.h>
#include <palpate/live/pressure_stage.h>
#include <palpate/live/processing_chain.h>
#include <palpate/live/signal_history.h>
#include <palpate/live/slip_stage.h>

#include "gui/source/connection.h"

namespace palpate::gui {

struct LiveSource {
  LiveSource() = default;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;
  // A motion that runs is stopped first, then a running recording is finished. Up to a few seconds.
  ~LiveSource();

  // A replay that has come to its end: nothing is wrong, and nothing comes any more.
  bool finished() const;

  Connection connection;
  std::unique_ptr<EmulatedHand> emulated;  // of an emulated hand
  std::unique_ptr<CaptureSession> session;
  std::unique_ptr<SignalHistory> history;
  std::unique_ptr<LiveStream> stream;  // to other programs; off
  std::unique_ptr<ProcessingChain> chain;
  FilterStage* filters = nullptr;         // of the chain, the first stage
  PressureStage* pressure = nullptr;      // of the chain
  SlipStage* slip = nullptr;              // of the chain
  std::unique_ptr<GraspControl> control;  // null: a replay, which nobody can move
};

// Makes and starts it; nothing moves. A port that doesn't answer is looked for from now on. In a
// worker: reading a recording to be replayed may take seconds. `dataFolder` has the scenes. Throws
// Error, Cancelled, std::invalid_argument.
std::unique_ptr<LiveSource> openSource(const Connection& connection,
                                       const std::filesystem::path& dataFolder,
                                       const Progress& progress = {});

}  // namespace palpate::gui
