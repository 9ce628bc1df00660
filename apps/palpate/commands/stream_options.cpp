#include "commands/stream_options.h"

#include <functional>
#include <stdexcept>
#include <string>

#include "palpate/core/escaped_line.h"
#include "palpate/imports/label_places.h"

#include "commands/hand_options.h"

namespace palpate::commands {
std::vector<OptionSpec> streamSourceOptions() {
  return {{"stream",
           "SOURCE",
           "frames of any hand: a port, tcp:HOST:PORT, listen:[ADDRESS:]PORT, udp:[ADDRESS:]PORT "
           "or - (standard input)"},
          handOption(),
          worded("format", "FORM", "of the stream", kStreamFormatWords, "auto"),
          worded("time", "UNIT", "of the time in lines", kStreamTimeWords, "auto"),
          rangedWhole("baud",
                      "N",
                      "speed of a serial port of the stream",
                      StreamDeviceOptions::kBaud,
                      std::to_string(StreamDeviceOptions{}.baud))};
}

void checkStreamSource(const CommandLine& given) {
  if (given.has("stream")) {
    for (const char* port : {"dsa", "sdh"})
      if (given.has(port)) throw UsageError("give --stream SOURCE or --dsa PORT, not both");
    if (!given.has("hand")) throw UsageError("--stream needs --hand NAME|FOLDER");
    return;
  }
  for (const char* option : {"hand", "format", "time", "baud"})
    if (given.has(option)) throw UsageError("--" + std::string(option) + " needs --stream");
}

std::unique_ptr<StreamDevice> streamSourceOf(const CommandLine& given) {
  StreamDeviceOptions options;
  options.source = given.text("stream").value();
  options.format = given.chosen("format", kStreamFormatWords).value_or(options.format);
  options.time = given.chosen("time", kStreamTimeWords).value_or(options.time);
  if (options.time != StreamTime::kAuto &&
      (options.format == StreamFormat::kJson || options.format == StreamFormat::kBinary))
    throw UsageError("--time is for lines: the other forms say their time themselves");
  options.baud = static_cast<int>(given.integer("baud", options.kBaud).value_or(options.baud));
  options.hand = handOf(given).value();
  options.placesOfLabels = std::bind_front(placesOfLabels, options.hand);
  try {
    auto stream = std::make_unique<StreamDevice>(std::move(options));
    if (stream->isOpenToOthers())
      sayLine(given.text("stream").value() +
              ": any machine that reaches this address can send frames");
    return stream;
  } catch (const std::invalid_argument& wrong) {
    throw UsageError("--stream: " + escapedLine(wrong.what()));
  }
}

CaptureOptions streamCaptureOptions(const CommandLine& given) {
  CaptureOptions options;
  options.recorder.queue.blockWhenFull = given.text("stream") == "-";
  return options;
}

const StreamDevice* streamOf(const CaptureSession& session) {
  return dynamic_cast<const StreamDevice*>(&session.device());
}

void StreamNotice::show() {
  if (stream_ == nullptr) return;
  const std::string place = placeShown_ ? std::string() : stream_->notice();
  if (!place.empty()) sayLine(place);
  placeShown_ = placeShown_ || !place.empty();
  const std::vector<std::string> remarks = stream_->remarks();
  for (; remarksShown_ < remarks.size(); ++remarksShown_) sayLine(remarks[remarksShown_]);
}

std::string leftOutText(FrameLosses losses, const StreamDevice* stream) {
  if (stream == nullptr) {
    losses.lost = 0;
  } else {
    losses.lastRefused = stream->lastFault();
    losses.lastOutOfRange = stream->lastOutOfRange();
  }
  return textOf(losses);
}

std::string leftOutText(const RecordingReport& report, const StreamDevice* stream) {
  const std::string losses = leftOutText(report.losses(), stream);
  const std::string end = report.openGapText();
  return losses + (losses.empty() || end.empty() ? "" : ", ") + end;
}

}  // namespace palpate::commands
