// --to STREAM of the commands that run a hand: what goes to other programs on this machine while
// they do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/calibration.h>
#include <palpate/capture/capture_session.h>
#include <palpate/interop/live_stream.h>
#include <palpate/live/processing_chain.h>

#include "commands/command_line.h"

namespace palpate::commands {

struct StreamTarget {
  StreamKind kind = StreamKind::kSignals;
  std::uint16_t port = 0;  // of 127.0.0.1
};
// "signals", "tactile", "signals:9999"; throws UsageError naming the option.
StreamTarget streamTargetOf(const std::string& text, const std::string& option);
std::vector<StreamTarget> streamTargetsOf(const CommandLine& given, const std::string& option);

// The stages that find what is streamed. `calibration`: nothing for no pressures and forces.
std::vector<std::unique_ptr<Stage>> streamedStages(CaptureSession* session,
                                                   const HandDescription& hand,
                                                   const std::optional<Calibration>& calibration);
std::optional<Calibration> streamCalibrationOf(const CommandLine& given);

// Processes what a session delivers and sends it, as long as it lives. The session must outlive it.
class LiveStreams {
 public:
  LiveStreams(CaptureSession& session,
              const std::vector<StreamTarget>& targets,
              const std::optional<Calibration>& calibration);
  const LiveStream& stream() const noexcept { return stream_; }
  // Why it ended by itself; empty: it didn't.
  std::string failure() const { return chain_.failure(); }
  // "signals to 127.0.0.1:9870: 310 sent, 2 dropped", a line for each.
  std::vector<std::string> lines() const;

 private:
  const std::vector<StreamTarget> targets_;
  LiveStream stream_;
  ProcessingChain chain_;
};

}  // namespace palpate::commands
