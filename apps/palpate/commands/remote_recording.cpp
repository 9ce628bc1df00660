#include "commands/remote_recording.h"

#include <atomic>
#include <cstdio>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/interop/remote_fields.h"
#include "palpate/interop/remote_file.h"
#include "palpate/interop/remote_recorder.h"
#include "palpate/interop/remote_server.h"

#include "commands/commands.h"
#include "commands/series_options.h"
#include "commands/stream_options.h"

namespace palpate::commands {
namespace {
namespace fs = std::filesystem;

constexpr int kRemoteRecordingLookMs = 100;

RemoteRecorderOptions remoteRecordingOptionsOf(const CommandLine& given, RecordingOptions each) {
  RemoteRecorderOptions options;
  const fs::path out(given.text("output").value());
  std::error_code ignored;
  if (fs::is_directory(out, ignored)) {
    options.folder = out;
  } else if (!out.has_filename()) {
    throw FileError(out, "isn't a folder: create it first");
  } else {
    options.folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
    options.nameTemplate = out.filename().string();
    if (const std::string problem = problemOfRemoteName(options.nameTemplate); !problem.empty())
      throw UsageError("-o: " + problem);
  }
  options.limits.firstFrameS =
      given.number("wait", StartLimits::kFirstFrameS).value_or(options.limits.firstFrameS);
  options.recording = std::move(each);
  return options;
}

void sayRemoteRecording(const RecordingReport& report, bool json) {
  const RemoteAnswer answer = stopAnswer(report);
  std::string line;
  if (json)
    line = answerLine(answer, "stop");
  else if (!answer.ok())
    line = "nothing was recorded: " + escapedLine(answer.message);
  else
    line = escapedLine(report.paths.front().string()) + ": " + counted(report.frames, "frame") +
           " in " + fixedText(report.durationS, 1) + " s, " +
           std::to_string(report.lost + report.refused) + " lost" +
           (report.message.empty() ? "" : "; " + escapedLine(report.message));
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

}  // namespace

OptionSpec remoteOption() {
  return {"remote", "", "let other programs start and stop recordings: 'palpate remote --help'"};
}

OptionSpec socketOption() {
  return {
      "socket", "PATH", "with --remote: where to listen; default $XDG_RUNTIME_DIR/palpate-remote"};
}

fs::path remoteSocketOf(const CommandLine& given) {
  const auto named = given.text("socket");
  return named ? fs::path(*named) : usualRemoteSocket();
}

int recordRemotely(const CommandLine& given,
                   CaptureSession& session,
                   Interruption& interruption,
                   RecordingOptions each) {
  RemoteRecorderOptions options = remoteRecordingOptionsOf(given, std::move(each));
  std::atomic<bool> whole = true;
  options.onFinished = [&](const RecordingReport& report) {
    std::string leftOut = leftOutText(report, streamOf(session));
    const std::string series = seriesLeftOutText(report, session);
    leftOut += (leftOut.empty() || series.empty() ? "" : "; ") + series;
    if ((!report.complete || !leftOut.empty()) && !report.paths.empty()) whole = false;
    if (given.has("json") || !given.quiet()) sayRemoteRecording(report, given.has("json"));
    if (!leftOut.empty()) sayLine(leftOut);
  };
  session.start();
  {
    RemoteRecorder recorder(session, std::move(options));
    const RemoteServer server(remoteSocketOf(given), recorder);
    std::printf("remote=%s\n", escapedLine(server.socket().string()).c_str());
    std::fflush(stdout);
    StreamNotice notice(streamOf(session), given.quiet());
    SeriesNotice seriesNotice(session, given.quiet());
    while (!interruption.waitForSignal(kRemoteRecordingLookMs)) {
      notice.show();
      seriesNotice.show();
    }
  }
  session.stop();
  return whole ? kDone : kPartlyDone;
}

}  // namespace palpate::commands
