// The options of commands that receive the frames of a stream: --stream SOURCE with --hand,
// --format, --time and --baud.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/device/frame_losses.h>
#include <palpate/device/stream_device.h>

#include "commands/command_line.h"

namespace palpate::commands {

// The options, for a command's list.
std::vector<OptionSpec> streamSourceOptions();
// Throws UsageError when one of them is given without --stream, or together with --dsa or --sdh.
void checkStreamSource(const CommandLine& given);
// The stream that --stream names. When other machines can send to it, a line on standard error
// says so. Throws UsageError, and Error of the hand's files.
std::unique_ptr<StreamDevice> streamSourceOf(const CommandLine& given);
// The capture of a stream: standard input waits for the recorder instead of losing frames.
CaptureOptions streamCaptureOptions(const CommandLine& given);
// The stream of a session; null when its device is another one.
const StreamDevice* streamOf(const CaptureSession& session);
// Prints on standard error where senders are awaited, as soon as it is known, and each remark about
// the stream (StreamDevice::remarks()); nothing with --quiet.
class StreamNotice {
 public:
  StreamNotice(const StreamDevice* stream, bool quiet) : stream_(quiet ? nullptr : stream) {}
  void show();

 private:
  const StreamDevice* stream_;
  bool placeShown_ = false;
  std::size_t remarksShown_ = 0;
};
// What ends `record` and `stream` with kPartlyDone, in one line; empty: nothing. `stream` may be
// null: frames that a hand's own controller sent and that were damaged on the line are normal.
std::string leftOutText(FrameLosses losses, const StreamDevice* stream);
// The same of a recording, which may have ended while no frames came.
std::string leftOutText(const RecordingReport& report, const StreamDevice* stream);

}  // namespace palpate::commands
