// The options of commands that record further series: --series NAME=SOURCE, --series-columns
// NAME=COLUMNS, both repeatable; and the messages about the series.
#pragma once

#include <string>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/core/json.h>

#include "commands/command_line.h"

namespace palpate::commands {

std::vector<OptionSpec> seriesOptions();
// Adds the sources that are named to the session. When other machines can send to one, a line on
// standard error says so. Throws UsageError.
void addSeriesSources(const CommandLine& given, CaptureSession& session);
// Prints on standard error where senders are awaited, and each time that a source is not there, is
// silent or is back; nothing with --quiet.
class SeriesNotice {
 public:
  SeriesNotice(const CaptureSession& session, bool quiet);
  void show();

 private:
  struct Shown {
    bool place = false;
    PortState state = PortState::kConnecting;
    bool missed = false;  // it was said that nothing comes
  };
  const CaptureSession& session_;
  std::vector<Shown> shown_;  // per source; empty: nothing is shown
};
// "; wrist: 1000 samples (100.0/s), 2 lost" for each series; empty without any.
std::string seriesText(const RecordingReport& report);
Json seriesJson(const RecordingReport& report);
// What ends `record` with kPartlyDone, in one line: rows that are missing or were refused, and
// series of which none came. Empty: nothing.
std::string seriesLeftOutText(const RecordingReport& report, const CaptureSession& session);

}  // namespace palpate::commands
