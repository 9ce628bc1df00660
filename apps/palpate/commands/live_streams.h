// Sends live results to other programs on this machine while a command runs a hand, for the option
// --to STREAM.
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

// A stream and the UDP port that it is sent to.
struct StreamTarget {
  StreamKind kind = StreamKind::kSignals;
  // UDP port on 127.0.0.1.
  std::uint16_t port = 0;
};

// What a command sends to other programs.
struct StreamTargets {
  std::vector<StreamTarget> datagrams = {};
  std::optional<FoxgloveOptions> foxglove = std::nullopt;  // nothing: no WebSocket

  bool empty() const { return datagrams.empty() && !foxglove; }
  std::size_t size() const { return datagrams.size() + (foxglove ? 1 : 0); }
};

// Parses the values of --to ("signals", "tactile", "foxglove", "signals:9999") and the options of
// foxgloveOptions(). Throws UsageError that names the option.
StreamTargets streamTargetsOf(const CommandLine& given, const std::string& option);
// The options of the WebSocket.
std::vector<OptionSpec> foxgloveOptions();

// The stages that compute what is streamed. Without `calibration` there are no pressures and
// forces.
std::vector<std::unique_ptr<Stage>> streamedStages(CaptureSession* session,
                                                   const HandDescription& hand,
                                                   const std::optional<Calibration>& calibration);
// The calibration that --calibration names; nothing when the option is missing. Throws Error.
std::optional<Calibration> streamCalibrationOf(const CommandLine& given);

// Processes the frames of a session and sends the results as long as this object exists. The
// session must outlive it.
class LiveStreams {
 public:
  LiveStreams(CaptureSession& session,
              const StreamTargets& targets,
              const std::optional<Calibration>& calibration);
  // "foxglove=ws://127.0.0.1:8765", a line for each interface that others connect to.
  std::vector<std::string> places() const;
  // Why processing ended by itself; empty when it did not.
  std::string failure() const { return chain_.failure(); }
  // One line for each target: "signals to 127.0.0.1:9870: 310 sent, 2 dropped", or that nobody
  // listened.
  std::vector<std::string> lines() const;

 private:
  const StreamTargets targets_;
  LiveStream stream_;
  ProcessingChain chain_;
};

}  // namespace palpate::commands
