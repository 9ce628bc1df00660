// The options of commands that receive the frames of a stream: --stream SOURCE with --hand,
// --format, --time and --baud.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <palpate/capture/capture_session.h>
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
struct StreamLosses {
  std::uint64_t lost = 0, refused = 0, outOfRange = 0;  // frames
};
// What a stream lacks, or has beyond the description of the hand: "31 frames lost, 2 refused (the
// last: line 812: ..)"; empty: nothing.
std::string leftOutText(const StreamLosses& losses, const StreamDevice& stream);
// The same of the recording of a stream; empty also where `stream` is null.
std::string leftOutText(const RecordingReport& report, const StreamDevice* stream);

}  // namespace palpate::commands
