// palpate record --remote: a headless hand whose recordings others start and stop.
#pragma once

#include "palpate/core/interruption.h"
#include <palpate/capture/capture_session.h>
#include <palpate/capture/recorder.h>

#include "commands/command_line.h"

namespace palpate::commands {

// --remote and --socket PATH.
OptionSpec remoteOption();
OptionSpec socketOption();
// The socket that is named, or the usual one. Throws Error where there is no usual one.
std::filesystem::path remoteSocketOf(const CommandLine& given);

// Runs the session until it is interrupted; -o is a folder, or a template of names in one. Prints
// "remote=SOCKET" when it is ready, then a line per recording (--json: as the answer to stop).
// Returns the exit code.
int recordRemotely(const CommandLine& given,
                   CaptureSession& session,
                   Interruption& interruption,
                   RecordingOptions each);

}  // namespace palpate::commands
