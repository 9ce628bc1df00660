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
// Parses "signals", "tactile" or "signals:9999"; throws UsageError that names the option.
StreamTarget streamTargetOf(const std::string& text, const std::string& option);
std::vector<StreamTarget> streamTargetsOf(const CommandLine& given, const std::string& option);

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
              const std::vector<StreamTarget>& targets,
              const std::optional<Calibration>& calibration);
  const LiveStream& stream() const noexcept { return stream_; }
  // Why processing ended by itself; empty when it did not.
  std::string failure() const { return chain_.failure(); }
  // One line for each target: "signals to 127.0.0.1:9870: 310 sent, 2 dropped".
  std::vector<std::string> lines() const;

 private:
  const std::vector<StreamTarget> targets_;
  LiveStream stream_;
  ProcessingChain chain_;
};

}  // namespace palpate::commands
